"""`out=` of ContactLaw.evaluate: what cannot be written as it is, is refused before anything is written."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

import footfall
from footfall import ContactLaw, Response, _core

NORMAL = "azad-featherstone:stiffness=8.5e6,damping=3.1e3"
COUNT = 6
NAMES = [field.name for field in dataclasses.fields(Response)]

Wrong = Callable[[np.ndarray], object]

WRONG: dict[str, tuple[Wrong, str]] = {
    "too short": (lambda a: a[:3].copy(), "shape"),
    "too long": (lambda a: np.concatenate([a, a]), "shape"),
    "empty": (lambda a: a[:0].copy(), "shape"),
    "of no axis": (lambda a: np.zeros((), a.dtype), "shape"),
    "with one axis more": (lambda a: a[None].copy(), "shape"),
    "flat": (lambda a: np.zeros(a.size + 1, a.dtype), "shape"),
    "of another number type": (lambda a: a.astype(np.float32), "float32"),
    "of integers": (lambda a: a.astype(np.int64), "int64"),
    "unsigned": (lambda a: a.astype(np.uint8), "uint8"),
    "complex": (lambda a: a.astype(complex), "complex128"),
    "of objects": (lambda a: a.astype(object), "object"),
    "every other of an array": (lambda a: np.repeat(a, 2, axis=0)[::2], "not contiguous"),
    "backwards": (lambda a: a.copy()[::-1], "not contiguous"),
    "read-only": (lambda a: np.frombuffer(a.tobytes(), a.dtype).reshape(a.shape), "read-only"),
    "broadcast": (lambda a: np.broadcast_to(a[0], a.shape), "read-only"),
    "a masked array": (lambda a: np.ma.masked_array(a), "MaskedArray"),
    "a record array": (lambda a: a.copy().view(np.recarray), "recarray"),
    "a list": (lambda a: a.tolist(), "list"),
    "None": (lambda a: None, "None"),
    "a number": (lambda a: 0.0, "float"),
    "bytes": (lambda a: bytearray(a.tobytes()), "bytearray"),
}
#: Of the floats alone: there is one order of one byte, and one place for it.
WRONG_FLOATS: dict[str, tuple[Wrong, str]] = {
    "big-endian": (lambda a: a.astype(">f8"), "big-endian"),
    "not aligned": (lambda a: np.frombuffer(bytearray(a.nbytes + 1), np.float64, offset=1).reshape(a.shape), "aligned"),
    "by columns": (np.asfortranarray, "not contiguous"),
}


def arguments(count: int = COUNT) -> dict[str, np.ndarray]:
    return {
        "depth": np.linspace(-1e-4, 1e-3, count),
        "depth_rate": np.linspace(-0.5, 0.5, count),
        "slip_velocity": np.full((count, 2), 0.1),
    }


def responses_are_guarded(law: ContactLaw) -> tuple[Response, dict[str, np.ndarray]]:
    """A response each of whose arrays lies in the middle of memory that must stay as it is."""
    want = law.evaluate(**arguments())
    guards, arrays = {}, {}
    for name, array in vars(want).items():
        guards[name] = np.full(3 * array.size, 77, array.dtype)
        arrays[name] = guards[name][array.size : 2 * array.size].reshape(array.shape)
    return Response(**arrays), guards


def friction_laws() -> list[object]:
    from test_contact import law_classes, some

    return [some(cls) for cls in law_classes("Friction")]


@pytest.mark.parametrize("law", friction_laws(), ids=lambda law: law.name)
def test_nothing_is_written_beside_the_arrays(law: object) -> None:
    contact = ContactLaw(NORMAL, law)
    out, guards = responses_are_guarded(contact)
    want = contact.evaluate(**arguments())
    assert contact.evaluate(**arguments(), out=out) is out and out == want
    for name, guard in guards.items():
        size = getattr(out, name).size
        assert (guard[:size] == 77).all() and (guard[2 * size :] == 77).all(), name


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("kind", [*WRONG, *WRONG_FLOATS])
def test_an_array_that_cannot_be_written_is_named(paper_law: ContactLaw, name: str, kind: str) -> None:
    if kind in WRONG_FLOATS and name == "phase":
        pytest.skip("no floats")
    make, said = {**WRONG, **WRONG_FLOATS}[kind]
    out = paper_law.evaluate(**arguments())
    before = {other: array.copy() for other, array in vars(out).items()}
    wrong = make(getattr(out, name))
    if kind == "by columns" and getattr(out, name).ndim == 1:
        pytest.skip("one axis has no order")
    out = dataclasses.replace(out, **{name: wrong})
    others = {k: -v for k, v in arguments().items()}
    with pytest.raises(footfall.InvalidInput, match=rf"^out\.{name}: ") as caught:
        paper_law.evaluate(**others, out=out)
    assert said in str(caught.value) and "must be" in str(caught.value)
    for other, array in before.items():
        if other != name:
            np.testing.assert_array_equal(getattr(out, other), array)


def test_the_response_of_another_law_is_refused() -> None:
    laws = [ContactLaw(NORMAL, law) for law in friction_laws()]
    assert len({law.states for law in laws}) > 2
    for made in laws:
        for law in laws:
            out = made.evaluate(**arguments())
            if made.states == law.states:
                assert law.evaluate(**arguments(), out=out) is out
                continue
            with pytest.raises(footfall.InvalidInput, match=rf"out\.bristle_rate: .* {law.states} states"):
                law.evaluate(**arguments(), out=out)


def test_the_response_of_other_contacts_is_refused(paper_law: ContactLaw) -> None:
    for shape in [(), (0,), (5,), (7,), (6, 1), (1, 6), (2, 3)]:
        out = paper_law.evaluate(np.zeros(shape), 0.0, np.zeros((*shape, 2)))
        with pytest.raises(footfall.InvalidInput, match="out: is for contacts of shape"):
            paper_law.evaluate(**arguments(), out=out)
    # And one contact is written where one is asked for, none where there is none.
    for shape in [(), (0,), (1, 1)]:
        out = paper_law.evaluate(np.zeros(shape), 0.0, [0, 0])
        again = paper_law.evaluate(np.full(shape, 1e-4), 0.0, [0, 0], out=out)
        assert again is out and (out.normal_force > 0).all()


@pytest.mark.parametrize("given", [3, None.__class__, {"phase": 1}, (1, 2), "out", np.zeros(6)], ids=repr)
def test_what_is_no_response_is_a_type_error(paper_law: ContactLaw, given: object) -> None:
    with pytest.raises(TypeError, match="out: a Response, as evaluate\\(\\) returns it, is wanted"):
        paper_law.evaluate(**arguments(), out=given)  # type: ignore[arg-type]


def test_a_step_is_no_response(paper_law: ContactLaw) -> None:
    step = paper_law.step(None, **arguments(), dt=1e-3)
    with pytest.raises(TypeError, match="out: a Response, .* not Step"):
        paper_law.evaluate(**arguments(), out=step)  # type: ignore[arg-type]


@pytest.mark.parametrize("a", NAMES)
@pytest.mark.parametrize("b", NAMES)
def test_arrays_that_share_memory_are_refused(paper_law: ContactLaw, a: str, b: str) -> None:
    if a == b:
        return
    out = paper_law.evaluate(**arguments())
    one, other = getattr(out, a), getattr(out, b)
    size = one.nbytes + other.nbytes
    memory = bytearray(size)
    # They share the eight bytes in the middle.
    shared = {
        a: np.frombuffer(memory, one.dtype, one.size, 0).reshape(one.shape),
        b: np.frombuffer(memory, other.dtype, other.size, max(one.nbytes // 8 * 8 - 8, 0)).reshape(other.shape),
    }
    assert np.shares_memory(*shared.values())
    with pytest.raises(footfall.InvalidInput, match=rf"out\.({a}|{b}): shares memory with out\.({a}|{b})"):
        paper_law.evaluate(**arguments(), out=dataclasses.replace(out, **shared))


@pytest.mark.parametrize("argument", ["depth", "depth_rate", "slip_velocity", "bristle"])
def test_an_array_that_is_an_argument_is_refused(paper_law: ContactLaw, argument: str) -> None:
    given = {**arguments(), "bristle": np.zeros((COUNT, 2))}
    out = paper_law.evaluate(**given)
    name = "friction_force" if given[argument].ndim == 2 else "clutch_power"
    with pytest.raises(footfall.InvalidInput, match=rf"out\.{name}: shares memory with the argument {argument}"):
        paper_law.evaluate(**given, out=dataclasses.replace(out, **{name: given[argument]}))
    # A copy is read in place of what has to be converted: nothing is overwritten then.
    given[argument] = given[argument][::-1]
    want = paper_law.evaluate(**given)
    mixed = dataclasses.replace(out, **{name: given[argument][::-1]})
    assert paper_law.evaluate(**given, out=mixed) == want


def test_the_phase_is_fed_back_in_place() -> None:
    law = ContactLaw(NORMAL, friction_laws()[-1])
    out = law.evaluate(**arguments())
    want = law.evaluate(**arguments(), phase=out.phase.copy())
    assert law.evaluate(**arguments(), phase=out.phase, out=out) == want
    # But one phase for all contacts would be overwritten by the first.
    with pytest.raises(footfall.InvalidInput, match="out.phase: shares memory with the argument phase"):
        law.evaluate(**arguments(), phase=out.phase[:1], out=out)


def test_the_extension_is_safe_by_itself() -> None:
    # Whatever footfall/contact.py lets through, C++ writes into no array that is too short, and into no copy.
    law = _core.ContactLaw(footfall.laws.HertzNormal(stiffness=1.0), footfall.laws.NoneFriction(), None)
    right = [np.zeros(n) for n in (3, 3, 6, 6)] + [np.zeros(3, np.int8), np.zeros(3, np.int8)]
    right += [np.zeros(n) for n in (3, 6, 6, 3, 3, 3, 3, 3, 3)]
    law.evaluate(*right)
    for i in range(len(right)):
        for wrong in (right[i][:-1].copy(), np.concatenate([right[i], right[i][:1]]), right[i].astype(np.float32),
                      np.repeat(right[i], 2)[::2], right[i].reshape(1, -1), None):  # fmt: skip
            with pytest.raises((footfall.InvalidInput, TypeError)):
                law.evaluate(*right[:i], wrong, *right[i + 1 :])
    step = right[:5] + [1e-3, 1e-4] + [np.zeros(3, np.int8)] + [np.zeros(n) for n in (3, 6, 6, 3, 3)]
    law.step(*step)
    for i in [*range(5), *range(7, len(step))]:
        with pytest.raises((footfall.InvalidInput, TypeError)):
            law.step(*step[:i], step[i][:-1].copy(), *step[i + 1 :])

"""What is no number comes out as NaN for its contact alone; what is no phase is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

import footfall
from footfall import FLIGHT, ContactLaw
from test_contact import law_classes, some

COUNT = 5
FRICTIONS = [some(cls) for cls in law_classes("Friction")]
NORMALS = [some(cls) for cls in law_classes("Normal")]


def contacts(law: ContactLaw) -> dict[str, np.ndarray]:
    return {
        "depth": np.array([1e-3, -1e-3, 2e-3, 1e-3, 1e-3]),
        "depth_rate": np.array([0.1, 0.1, 0.0, -1e3, 0.2]),
        "slip_velocity": np.tile([0.1, -0.2], (COUNT, 1)),
        "bristle": np.zeros((COUNT, law.states)),
    }


def assert_nan_for(answer: footfall.Response | footfall.Step, right: footfall.Response | footfall.Step, i: int) -> None:
    for name, array in vars(answer).items():
        if name == "phase":
            assert array[i] == FLIGHT
        else:
            assert np.isnan(array[i]).all(), name
        np.testing.assert_array_equal(np.delete(array, i, 0), np.delete(getattr(right, name), i, 0))


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("friction", FRICTIONS, ids=lambda law: law.name)
def test_it_comes_out_as_nan_under_every_friction_law(friction: object, value: float) -> None:
    law = ContactLaw(NORMALS[0], friction)
    right = contacts(law)
    evaluated, stepped = law.evaluate(**right), law.step(**right, dt=1e-4)
    for argument, array in right.items():
        for i in range(COUNT):
            for component in range(array.shape[1] if array.ndim == 2 else 1):
                if argument == "depth" and value == -math.inf:
                    continue  # that is free flight
                wrong = array.copy()
                wrong[(i, component) if array.ndim == 2 else i] = value
                given = {**right, argument: wrong}
                assert_nan_for(law.evaluate(**given), evaluated, i)
                assert_nan_for(law.step(**given, dt=1e-4), stepped, i)


@pytest.mark.parametrize("normal", NORMALS, ids=lambda law: law.name)
def test_it_comes_out_as_nan_under_every_normal_law(normal: object) -> None:
    law = ContactLaw(normal, impact_speed=1.0)
    for given in ((math.nan, 0.0, [0, 0]), (1e-3, math.nan, [0, 0]), (1e-3, 0.0, [0, math.nan])):
        answer = law.evaluate(*given)
        assert all(np.isnan(array).all() for name, array in vars(answer).items() if name != "phase")


@pytest.mark.parametrize("friction", FRICTIONS, ids=lambda law: law.name)
def test_infinitely_far_above_the_ground_is_free_flight(friction: object) -> None:
    law = ContactLaw(NORMALS[0], friction)
    high, far = (law.evaluate(depth, 0.1, [0.1, 0.2]) for depth in (-1.0, -math.inf))
    assert far == high and far.normal_force == 0 and far.phase == FLIGHT
    bristle = np.full(law.states, 1e-6)
    high, far = (law.step(bristle, depth, 0.1, [0.1, 0.2], 1e-4) for depth in (-1.0, -math.inf))
    assert far == high


def test_a_list_of_masked_arrays_keeps_its_masks(paper_law: ContactLaw) -> None:
    depth = [np.ma.masked_array([1e-4, 2e-4], [False, True]), np.ma.masked_array([1e-4, 2e-4])]
    force = paper_law.evaluate(depth, 0.0, np.zeros((2, 2, 2))).normal_force
    np.testing.assert_array_equal(np.isnan(force), [[False, True], [False, False]])


@pytest.mark.parametrize("values", [[1e-4 + 2j], ["1e-4"], np.array(["2026-11-25"], "M8[D]"), np.array([3], "m8[s]")])
def test_masked_arrays_of_no_real_numbers_are_refused(paper_law: ContactLaw, values: object) -> None:
    with pytest.raises(TypeError, match="real numbers are wanted"):
        paper_law.evaluate(np.ma.masked_array(values), 0.0, [0.0, 0.0])


def test_what_is_masked_is_not_known(paper_law: ContactLaw) -> None:
    depth = np.ma.masked_array([1e-3, 1e-3], [False, True])
    assert np.isnan(paper_law.evaluate(depth, 0.0, [0, 0]).normal_force).tolist() == [False, True]


@pytest.mark.parametrize("value", [-1, 4, 127, 128, 256, -128, 0.5, math.nan, math.inf])
@pytest.mark.parametrize("friction", FRICTIONS, ids=lambda law: law.name)
def test_a_number_that_is_no_phase_is_refused_with_its_place(friction: object, value: float) -> None:
    law = ContactLaw(NORMALS[0], friction)
    given = contacts(law)
    phase = np.array([0, 1, value, 3, 2])
    for call in (law.evaluate, lambda **rest: law.step(**rest, dt=1e-4)):
        with pytest.raises(footfall.InvalidInput, match=rf"phase: {value}(\.0)? at index 2 is not allowed"):
            call(**given, phase=phase)
        with pytest.raises(footfall.InvalidInput, match=rf"phase: {value} is not allowed: must be one of 0 flight"):
            call(**given, phase=value)
    with pytest.raises(footfall.InvalidInput, match=rf"phase: {value}(\.0)? at index \(0, 2\) is not allowed"):
        law.evaluate(0.0, 0.0, [0, 0], phase=phase[None])


def test_every_phase_is_one_in_every_type(paper_law: ContactLaw) -> None:
    for kind in (np.int8, np.uint8, np.int64, np.float64, ">i4", bool):
        phases = np.arange(2 if kind is bool else 4).astype(kind)
        paper_law.evaluate(1e-3, 0.0, [0, 0], phase=phases)
    paper_law.evaluate(np.empty(0), 0.0, [0, 0], phase=np.empty(0, np.int8))

"""Contacts in the loop of a simulator in Python."""

import copy
import pickle
import runpy
from pathlib import Path

import numpy as np
import pytest

import footfall
from footfall import ContactLaw, ContactSet, InvalidInput

LAW = ContactLaw(
    "azad-featherstone:stiffness=8.5e6,damping=3.1e3",
    "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2,viscous=0.1",
)
MASS, RADIUS = 0.154, 0.0165
INERTIA = 0.4 * MASS * RADIUS**2
TANGENT = 1 / MASS + RADIUS**2 / INERTIA
DELASSUS = np.diag([TANGENT, TANGENT, 1 / MASS])
FREE = np.array([[0, 0, -9.81]])


def one_step(contacts, depth=-5e-4, dt=1e-3, **more):
    return contacts.step(dt, [depth], [[0.3, 0.1, -1.0]], FREE, DELASSUS, **more)


@pytest.mark.parametrize("dt", [1e-3, 2e-3])
def test_the_papers_ball_in_a_host_has_the_energies_of_the_exact_run(dt):
    contacts = ContactSet([LAW])
    x, v, w = np.array([0, 0, 0.1]), np.array([0.5, 0.5, 0.0]), np.zeros(2)
    taken = dict.fromkeys(("normal_damper", "tangential_damper", "clutch", "stiffness_change"), 0.0)
    kinds = []
    for _ in range(round(1 / dt)):
        slip = [v[0] - RADIUS * w[1], v[1] + RADIUS * w[0], v[2]]
        step = contacts.step(dt, [RADIUS - x[2]], [slip], FREE, DELASSUS)
        J, JJ = step.impulse[0], step.double_impulse[0]
        x = x + dt * v + dt**2 / 2 * FREE[0] + JJ / MASS
        v = v + dt * FREE[0] + J / MASS
        w = w + RADIUS / INERTIA * np.array([J[1], -J[0]])
        assert abs(step.energy.residual) <= 1e-6 * step.energy.scale
        assert step.unresolved_time == 0
        kinds += [event.kind for event in step.events]
        for channel in taken:
            taken[channel] += getattr(step.energy, channel).sum()
    exact = footfall.run("rolling-sphere")
    for channel, energy in taken.items():
        assert energy == pytest.approx(getattr(exact.energy, channel), rel=1e-4)
    assert x == pytest.approx(exact.final.position, abs=1e-6)
    assert kinds.count("touchdown") == sum(event.kind == "touchdown" for event in exact.events)


def test_a_copy_and_a_pickle_go_on_as_the_set_does():
    contacts = ContactSet([LAW], tolerance=1e-7)
    one_step(contacts)
    others = [copy.copy(contacts), copy.deepcopy(contacts), pickle.loads(pickle.dumps(contacts))]
    restored = ContactSet([LAW], tolerance=1e-7)
    restored.restore(contacts.states, contacts.phase)
    step = one_step(contacts, depth=3e-4)
    for other in [*others, restored]:
        assert one_step(other, depth=3e-4) == step
    assert contacts.phase[0] in (footfall.STICK, footfall.SLIP)
    assert contacts.bristle.shape == (1, 2)
    contacts.reset()
    assert contacts.phase.tolist() == [footfall.FLIGHT]
    assert not contacts.bristle.any()


def test_laws_stand_side_by_side():
    names = ["dahl:stiffness=1e4,coefficient=0.4", "none", None]
    laws = [ContactLaw("hertz:stiffness=1e7", name) for name in names]
    contacts = ContactSet([*laws, LAW])
    n = len(contacts)
    step = contacts.step(1e-3, np.full(n, 1e-4), np.tile([0.1, 0, 0], (n, 1)), np.zeros((n, 3)), np.eye(3 * n))
    assert step.impulse.shape == (n, 3)
    assert (step.impulse[:, 2] > 0).all()
    assert (step.impulse[[0, 3], 0] < 0).all()
    assert not step.impulse[[1, 2], 0].any()
    assert contacts.laws[3] == LAW


def test_the_ground_that_moves_is_in_the_account():
    contacts = ContactSet([LAW])
    step = one_step(contacts, depth=1e-4, ground_velocity=[[0.0, 0.0, 2.0]])
    assert step.energy.ground_work == pytest.approx(2 * step.impulse[0, 2])
    held = step.energy.held
    assert held == pytest.approx(step.energy.normal_spring.sum() + step.energy.tangential_spring.sum())
    missing = held + step.energy.taken + step.energy.contact_work - step.energy.held_before
    assert missing == pytest.approx(step.energy.residual, abs=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"dt": -1}, "dt: -1 s is not allowed: must be >= 0 and finite"),
        ({"depth": [0, 0]}, r"depth: shape \(2,\) is not allowed: must be \(1,\)"),
        ({"velocity": [0, 0, 1]}, r"velocity: shape \(3,\) is not allowed: must be \(1, 3\)"),
        ({"velocity": [[0, np.nan, 1]]}, r"velocity\[0\]\[1\] is nan m/s; must be finite"),
        ({"delassus": np.eye(2)}, r"delassus: shape \(2, 2\) is not allowed: must be \(3, 3\)"),
        ({"delassus": [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]}, "J M.-1 J.T is symmetric"),
        ({"frame_spin": [np.inf]}, r"frame_spin\[0\] is inf rad/s; must be finite"),
        ({"radius": [0]}, r"radius\[0\] is 0 m; must be > 0"),
    ],
)
def test_what_cannot_be_used_is_named(change, message):
    contacts = ContactSet([LAW])
    given = {"dt": 1e-3, "depth": [1e-4], "velocity": [[0, 0, 0]], "free_acceleration": FREE, "delassus": DELASSUS}
    with pytest.raises(InvalidInput, match=message):
        contacts.step(**(given | change))
    contacts.step(**given)


def test_sets_that_cannot_be_made_say_why():
    with pytest.raises(InvalidInput, match="laws: there are none"):
        ContactSet([])
    with pytest.raises(TypeError, match=r"laws\[0\]: a ContactLaw is wanted, not the text 'hertz'"):
        ContactSet(["hertz"])
    with pytest.raises(TypeError, match="laws: a ContactLaw for each contact is wanted, in a list"):
        ContactSet(LAW)
    with pytest.raises(InvalidInput, match="tolerance: 0.5 is not allowed"):
        ContactSet([LAW], tolerance=0.5)
    with pytest.raises(InvalidInput, match="states: has 0 numbers; the laws of this set have 2"):
        ContactSet([LAW]).restore([], [0])


def test_a_step_that_needs_too_much_says_so():
    stiff = ContactLaw("hertz:stiffness=1e12")
    contacts = ContactSet([stiff], max_evaluations=40)
    step = contacts.step(1e-2, [1e-6], [[0, 0, 0]], FREE, np.eye(3))
    assert 0 < step.unresolved_time <= 1e-2
    assert np.isfinite(step.impulse).all()


def test_the_foot_of_the_example_is_right(capsys):
    folder = Path(__file__).parents[1]
    example = next(p for p in (folder / "python", folder.parent / "examples/python") if p.exists())
    made = runpy.run_path(str(example / "foot_on_a_slope.py"))
    exact = made["exact"].energy
    for channel in ("normal_damper", "tangential_damper", "clutch"):
        assert made["two"][channel] == pytest.approx(getattr(exact, channel), rel=2e-3)
        assert made["one"][channel] == pytest.approx(getattr(exact, channel), rel=1.5e-2)
    assert abs(made["lost_twice"]) < 1e-4
    assert "two passes" in capsys.readouterr().out

"""The contact law over arrays."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import footfall
from footfall import ContactLaw, laws

K_n, D_n, K_t, D_t, mu, C_V = 8.5e6, 3.1e3, 12.75e6, 3.1e3, 0.2, 0.1


def contacts(count: int, seed: int = 2010) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    return (
        random.uniform(-1e-3, 1e-3, count),
        random.uniform(-1, 1, count),
        random.uniform(-0.5, 0.5, (count, 2)),
        random.uniform(-5e-5, 5e-5, (count, 2)),
    )


def test_the_papers_law_in_numpy_agrees(paper_law: ContactLaw) -> None:
    # (13), (14), (22), (26), (27) solved for F_f, (28), (17), as the paper prints them.
    z, rate, V, u = contacts(10_000)
    got = paper_law.evaluate(z, rate, V, u)
    s = np.sqrt(np.maximum(z, 0))
    normal = np.where(z > 0, np.maximum(K_n * s**3 + D_n * s * rate, 0), 0)
    stick = -(K_t * s[:, None] * u + D_t * s[:, None] * V)
    size = np.linalg.norm(stick, axis=1)
    loaded = normal > 0
    holds = loaded & (size <= mu * normal)
    slips = loaded & ~holds
    with np.errstate(invalid="ignore", divide="ignore"):
        share = (s * D_t * mu * normal + C_V * size) / (s * D_t + C_V) / size
    force = np.where(holds[:, None], stick, np.where(slips[:, None], share[:, None] * stick, 0))
    assert {0, 1, 2, 3} == set(got.phase)
    np.testing.assert_array_equal(got.phase, np.select([z <= 0, holds, slips], [0, 1, 2], 3))
    np.testing.assert_allclose(got.normal_force, normal, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(got.friction_force, force, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(got.normal_spring, 0.4 * K_n * s**5, rtol=1e-12)
    np.testing.assert_allclose(got.tangential_spring, 0.5 * K_t * s * (u**2).sum(1), rtol=1e-12)
    udot = got.bristle_rate
    np.testing.assert_allclose(
        got.tangential_damper_power[loaded], (D_t * s * (udot**2).sum(1))[loaded], rtol=1e-12
    )
    np.testing.assert_allclose(
        got.clutch_power[loaded], -(force * (V - udot)).sum(1)[loaded], rtol=1e-6, atol=1e-9
    )
    for power in (got.normal_damper_power, got.tangential_damper_power, got.clutch_power):
        assert (power >= -1e-12).all() or power is got.normal_damper_power


def test_arguments_broadcast(paper_law: ContactLaw) -> None:
    z = np.linspace(-1e-4, 1e-3, 5)[:, None, None]
    rate = np.array([-0.5, 0.0, 0.5])[:, None]
    V = np.array([[0.1, 0.0], [0.2, -0.3]])
    grid = paper_law.evaluate(z, rate, V, [1e-5, 0])
    assert grid.normal_force.shape == (5, 3, 2)
    assert grid.friction_force.shape == (5, 3, 2, 2)
    for i, j, k in np.ndindex(5, 3, 2):
        one = paper_law.evaluate(z[i, 0, 0], rate[j, 0], V[k], [1e-5, 0])
        assert one.normal_force == grid.normal_force[i, j, k]
        np.testing.assert_array_equal(one.friction_force, grid.friction_force[i, j, k])
        assert one.phase == grid.phase[i, j, k]


def test_views_and_other_number_types_are_read_rightly(paper_law: ContactLaw) -> None:
    z, rate, V, u = contacts(100)
    want = paper_law.evaluate(z, rate, V, u)
    strided = np.repeat(z, 3)[::3]
    swapped = np.asfortranarray(V)
    got = paper_law.evaluate(strided, rate.tolist(), swapped, u[::-1][::-1])
    np.testing.assert_array_equal(got.friction_force, want.friction_force)
    single = paper_law.evaluate(z.astype(np.float32), 0, [0, 0], [0, 0])
    np.testing.assert_allclose(single.normal_force, paper_law.evaluate(z, 0, [0, 0], [0, 0]).normal_force, rtol=1e-5)


def test_no_contacts_give_no_responses(paper_law: ContactLaw) -> None:
    got = paper_law.evaluate(np.empty(0), 0.0, np.empty((0, 2)), [0, 0])
    assert got.normal_force.shape == (0,) and got.friction_force.shape == (0, 2)
    assert paper_law.step(np.empty((0, 2)), 1e-3, 0, [0, 0], 1e-3).bristle.shape == (0, 2)


def test_out_is_written_and_returned(paper_law: ContactLaw) -> None:
    z, rate, V, u = contacts(50)
    want = paper_law.evaluate(z, rate, V, u)
    out = paper_law.evaluate(-z, rate, V, u)
    assert paper_law.evaluate(z, rate, V, u, out=out) is out
    np.testing.assert_array_equal(out.friction_force, want.friction_force)
    with pytest.raises(footfall.InvalidInput, match=r"out: is for contacts of shape \(50,\), the arguments are for"):
        paper_law.evaluate(z[:10], 0, V[:10], u[:10], out=out)


def test_shapes_that_do_not_fit_are_named(paper_law: ContactLaw) -> None:
    with pytest.raises(footfall.InvalidInput, match=r"slip_velocity: shape \(3,\) is not allowed"):
        paper_law.evaluate(0, 0, [1, 2, 3], [0, 0])
    with pytest.raises(footfall.InvalidInput, match="do not broadcast"):
        paper_law.evaluate(np.zeros(3), np.zeros(4), [0, 0], [0, 0])
    with pytest.raises(TypeError, match="depth: real numbers are wanted"):
        paper_law.evaluate(1j, 0, [0, 0], [0, 0])


def test_a_law_can_be_given_as_text_as_on_the_command_line(paper_law: ContactLaw) -> None:
    law = ContactLaw(
        "azad-featherstone:stiffness=8.5e6,damping=3.1 kN s/m^1.5",
        "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2,viscous=0.1",
    )
    assert law.normal == paper_law.normal and law.friction == paper_law.friction
    assert laws.normal(law.normal.text) == law.normal
    with pytest.raises(footfall.InvalidInput, match="azad-featherstone"):
        ContactLaw("azad-fetherstone:stiffness=8.5e6,damping=1")
    with pytest.raises(TypeError, match="a law of footfall.laws or its text"):
        ContactLaw(3)


def law_classes(kind: str) -> list[type]:
    return [getattr(laws, name) for name in dir(laws) if name.endswith(kind)]


def test_every_law_of_the_command_line_is_a_class(command: str) -> None:
    import json

    from conftest import footfall_command

    told = json.loads(footfall_command(command, "laws", "--json").stdout)
    for kind in ("normal", "friction"):
        classes = {cls.name: cls for cls in law_classes(kind.capitalize())}
        assert set(classes) == {law["name"] for law in told[kind]}
        for law in told[kind]:
            cls = classes[law["name"]]
            assert cls.formula == law["formula"] and cls.source == law["source"] and cls.limits == law["limits"]
            assert cls.units == {p["key"]: p["unit"] for p in law["parameters"]}
            for parameter in law["parameters"]:
                assert parameter["description"] in getattr(cls, parameter["key"]).__doc__


def some(cls: type) -> object:
    """A law of the class with parameters that any law takes."""
    return cls(**{key: 0.5 if unit == "1" else 1e3 for key, unit in cls.units.items()})


@pytest.mark.parametrize("cls", law_classes("Normal") + law_classes("Friction"), ids=lambda cls: cls.__name__)
def test_every_law_is_a_value(cls: type) -> None:
    law = some(cls)
    assert pickle.loads(pickle.dumps(law)) == law
    assert hash(law) == hash(some(cls))
    assert eval(repr(law), {cls.__name__: cls}) == law
    assert law != 3
    for key in cls.units:
        with pytest.raises(AttributeError):
            setattr(law, key, 1.0)


@pytest.mark.parametrize("normal", law_classes("Normal"), ids=lambda cls: cls.__name__)
def test_every_normal_law_presses_and_stores(normal: type) -> None:
    law = ContactLaw(some(normal), impact_speed=1.0)
    z = np.linspace(1e-6, 1e-3, 2001)
    got = law.evaluate(z, 0.0, [0, 0], [0, 0])
    assert (got.normal_force > 0).all()
    # At rest the force is the slope of what is stored.
    slope = np.gradient(got.normal_spring, z)[1:-1]
    np.testing.assert_allclose(slope[200:], got.normal_force[1:-1][200:], rtol=1e-3)


def test_bad_parameters_say_what_is_allowed() -> None:
    with pytest.raises(footfall.InvalidInput, match="stiffness .* is -1 N/m\\^1.5; allowed is > 0"):
        laws.AzadFeatherstoneNormal(stiffness=-1, damping=0)
    with pytest.raises(footfall.InvalidInput, match="nan"):
        laws.AzadFeatherstoneNormal(stiffness=float("nan"), damping=0)
    with pytest.raises(footfall.InvalidInput, match="stiffness: .*got a mass"):
        laws.AzadFeatherstoneNormal(stiffness="1 kg", damping=0)
    with pytest.raises(TypeError, match="has no parameter 'stifness'; it has: stiffness, damping"):
        laws.AzadFeatherstoneNormal(stifness=1, damping=0)
    with pytest.raises(TypeError, match="needs damping"):
        laws.AzadFeatherstoneNormal(stiffness=1)


# The step -----------------------------------------------------------------------------------------------------------


def test_step_agrees_with_many_explicit_ones(paper_law: ContactLaw) -> None:
    z, rate, V, u = contacts(200)
    dt, steps = 1e-3, 4000
    got = paper_law.step(u, z, rate, V, dt, tolerance=1e-7)
    h, bristle = dt / steps, u.copy()
    force = np.zeros_like(u)
    for _ in range(steps):
        middle = bristle + 0.5 * h * paper_law.evaluate(z, rate, V, bristle).bristle_rate
        now = paper_law.evaluate(z, rate, V, middle)
        force += now.friction_force / steps
        bristle += h * now.bristle_rate
    np.testing.assert_allclose(got.bristle, bristle, atol=1e-4 * np.abs(bristle).max())
    np.testing.assert_allclose(got.friction_force, force, atol=1e-4 * np.abs(force).max())


def test_explicit_euler_is_unstable_where_step_is_not(paper_law: ContactLaw) -> None:
    # Slipping at the depth of rest; K_t/D_t dt = 4.
    z, dt, V = 3.2e-5, 1e-3, np.array([0.05, 0.0])
    euler, stepped = np.array([0.0, 1e-6]), np.array([0.0, 1e-6])
    for _ in range(200):
        euler = euler + dt * paper_law.evaluate(z, 0, V, euler).bristle_rate
        stepped = paper_law.step(stepped, z, 0, V, dt).bristle
    steady = paper_law.step(stepped, z, 0, V, 1.0).bristle
    assert np.linalg.norm(stepped - steady) < 1e-3 * np.linalg.norm(steady)
    assert np.linalg.norm(euler - steady) > np.linalg.norm(steady)


def test_step_broadcasts_and_keeps_its_account(paper_law: ContactLaw) -> None:
    z, _, V, u = contacts(300)
    z = np.abs(z) + 1e-6
    dt = 1e-3
    got = paper_law.step(u, z, 0.0, V, dt, tolerance=1e-8)
    assert got.bristle.shape == (300, 2)

    def stored(bristle: np.ndarray) -> np.ndarray:
        return 0.5 * K_t * np.sqrt(z) * (bristle**2).sum(1)

    work = -(got.friction_force * V).sum(1) * dt
    np.testing.assert_allclose(
        work, stored(got.bristle) - stored(u) + got.tangential_damper + got.clutch, atol=1e-5 * np.abs(work).max()
    )


@pytest.mark.parametrize("dt", [0, -1, float("nan"), float("inf")])
def test_a_step_that_is_no_time_is_refused(paper_law: ContactLaw, dt: float) -> None:
    with pytest.raises(footfall.InvalidInput, match="dt: .* is not allowed: must be > 0"):
        paper_law.step([0, 0], 1e-3, 0, [0, 0], dt)


def test_what_is_not_a_number_stays_that_way(paper_law: ContactLaw) -> None:
    step = paper_law.step([0, 0], [float("nan"), 1e-3], 0, [0.1, 0], 1e-3)
    assert np.isnan(step.normal_force[0]) and np.isfinite(step.normal_force[1])


def test_a_step_that_cannot_be_followed_to_its_end_is_refused() -> None:
    law = ContactLaw(
        "azad-featherstone:stiffness=8.5e6,damping=3.1e3",
        "lugre:stiffness=1e5,damping=300,static_coefficient=0.5,kinetic_coefficient=0.3,stribeck_velocity=0.01",
    )
    speeds = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]])
    first = law.step(None, 1e-4, 0.0, speeds, 1e-2)
    steady = law.step(first.bristle, 1e-4, 0.0, speeds, 1e-2, phase=first.phase)
    assert steady.friction_force[1, 0] == pytest.approx(-0.3 * 8.5, rel=1e-2)
    for dt, slip in ((10.0, speeds), (1e-2, 1e3 * speeds)):
        with pytest.raises(footfall.TooExpensive, match=rf"step: contact 1 needs .* s of dt = {dt:g} s are left"):
            law.step(None, 1e-4, 0.0, slip, dt)


# Every friction law -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("cls", law_classes("Friction"), ids=lambda cls: cls.__name__)
def test_every_friction_law_opposes_a_long_slide(cls: type) -> None:
    law = ContactLaw("linear:stiffness=1e4,damping=0", some(cls))
    V = np.array([[0.3, -0.4], [0.0, 0.05]])
    bristle, phase = np.zeros((2, law.states)), np.zeros(2)
    for _ in range(50):
        step = law.step(bristle, 1e-3, 0.0, V, 1e-3, phase=phase)
        bristle, phase = step.bristle, step.phase
    now = law.evaluate(1e-3, 0.0, V, bristle, phase=phase)
    assert np.isfinite(step.friction_force).all() and np.isfinite(now.friction_force).all()
    assert ((step.friction_force * V).sum(1) <= 0).all()
    lost = -(step.friction_force * V).sum(1) * 1e-3
    assert (step.tangential_damper + step.clutch <= lost * (1 + 1e-3) + 1e-9).all()
    # Lifted off, what friction remembers fades or is forgotten, and there is no force.
    off = law.step(bristle, -1e-3, 0.0, V, 30.0, phase=phase)
    assert (off.friction_force == 0).all() and np.abs(off.bristle).max(initial=0) < 1e-6

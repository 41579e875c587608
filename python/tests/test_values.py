"""Laws, scenarios and results are values: pickled, copied, sent to other processes, compared."""

from __future__ import annotations

import copy
import dataclasses
import math
import multiprocessing
import pickle
from collections.abc import Callable

import numpy as np
import pandas as pd
import pytest

import footfall
from footfall import ContactLaw, laws, studies
from test_contact import law_classes, some

NORMAL = "azad-featherstone:stiffness=8.5e6,damping=3.1e3"
FLORES = "flores:stiffness=1e6,restitution=0.7"

Way = Callable[[object], object]
WAYS: dict[str, Way] = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{f"pickle {n}": lambda value, n=n: pickle.loads(pickle.dumps(value, n)) for n in range(2, 6)},
}


def fit() -> studies.Fit:
    speeds = np.geomspace(0.05, 5, 12)
    noise = 1e-3 * np.random.default_rng(2010).standard_normal(speeds.size)
    data = pd.DataFrame({"speed": speeds, "restitution": 0.9 - 0.05 * speeds**0.2 + noise})
    wanted = ["azad-featherstone:stiffness=8.5e6,damping=?", "linear:stiffness=1e4,damping=?"]
    return studies.fit(data, wanted, mass=0.1)


@pytest.fixture(scope="module")
def values() -> dict[str, object]:
    law = ContactLaw(FLORES, "dahl:stiffness=1e5,coefficient=0.2", impact_speed=0.5)
    given = {"depth": [1e-3, math.nan], "depth_rate": 0.1, "slip_velocity": [0.1, 0.2]}
    run = footfall.run("foot-heel-first")
    fitted = fit()
    return {
        "law": law,
        "law without a speed": ContactLaw(NORMAL),
        "response": law.evaluate(**given),
        "step": law.step(None, **given, dt=1e-4),
        "scenario": footfall.Scenario.load("slope-stick"),
        "scenario of a dict": footfall.Scenario.from_dict(run.scenario.to_dict(), "mine"),
        "run": run,
        "event": run.events[0],
        "impact": run.impacts[0],
        "final": run.final,
        "energy": run.energy,
        "cost": run.cost,
        "fit": fitted,
        "fit of one law": fitted.best,
        "material": studies.Material(1e9, 0.3),
        "coefficients": studies.material("steel", "steel", 0.01, alpha=1.0),
        **{cls.__name__: some(cls) for cls in law_classes("Normal") + law_classes("Friction")},
    }


NAMES = ["law", "law without a speed", "response", "step", "scenario", "scenario of a dict", "run", "event", "impact",
         "final", "energy", "cost", "fit", "fit of one law", "material", "coefficients",
         *(cls.__name__ for cls in law_classes("Normal") + law_classes("Friction"))]  # fmt: skip


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", NAMES)
def test_what_comes_back_is_equal(values: dict[str, object], name: str, way: str) -> None:
    value = values[name]
    again = WAYS[way](value)
    assert type(again) is type(value)
    assert again == value and not again != value
    assert repr(again) == repr(value) and str(again) == str(value)
    if type(value).__hash__ is not None and name not in ("event", "final"):
        assert hash(again) == hash(value)
    assert value != 3 and value != None  # noqa: E711


def test_another_process_gives_the_same(values: dict[str, object]) -> None:
    names = ["law", "scenario", "run", "response", "step", "fit"]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        for name, again in zip(names, pool.map(copy.deepcopy, [values[name] for name in names])):
            assert again == values[name], name
        law = values["law"]
        assert isinstance(law, ContactLaw)
        there = pool.apply(law.evaluate, (1e-3, 0.1, [0.1, 0.2]))
    assert there == law.evaluate(1e-3, 0.1, [0.1, 0.2])


def test_a_copied_law_keeps_its_impact_speed() -> None:
    law = ContactLaw(FLORES, impact_speed=0.5)
    for way in WAYS.values():
        again = way(law)
        assert isinstance(again, ContactLaw) and again.impact_speed == 0.5
        assert again.evaluate(1e-3, 0.1, [0, 0]) == law.evaluate(1e-3, 0.1, [0, 0])
    assert "impact_speed=0.5" in repr(law)
    # The speed is part of the law: with another it damps otherwise.
    assert ContactLaw(FLORES, impact_speed=1.0) != law
    assert ContactLaw(FLORES, impact_speed=1.0).evaluate(1e-3, 0.1, [0, 0]) != law.evaluate(1e-3, 0.1, [0, 0])


def test_contact_laws_are_equal_where_their_parameters_are() -> None:
    law = ContactLaw(NORMAL)
    assert law == ContactLaw(laws.AzadFeatherstoneNormal(stiffness=8.5e6, damping=3.1e3), laws.NoneFriction())
    assert law != ContactLaw("azad-featherstone:stiffness=8.5e6,damping=3.2e3") and law != "law"
    assert law != ContactLaw(NORMAL, "linear:stiffness=1,damping=1,coefficient=0.1")
    assert len({law, ContactLaw(NORMAL), copy.copy(law)}) == 1
    zero, minus_zero = (laws.AzadFeatherstoneNormal(stiffness=1.0, damping=d) for d in (0.0, -0.0))
    assert zero == minus_zero and hash(zero) == hash(minus_zero)


def test_responses_differ_where_one_number_does(paper_law: ContactLaw) -> None:
    one, other = (paper_law.evaluate(1e-3, rate, [0.1, 0]) for rate in (0.1, 0.1 + 1e-12))
    assert one == paper_law.evaluate(1e-3, 0.1, [0.1, 0]) and one != other
    assert one != paper_law.step(None, 1e-3, 0.1, [0.1, 0], 1e-3)
    with pytest.raises(TypeError, match="unhashable"):
        hash(one)
    for field in dataclasses.fields(one):
        wrong = dataclasses.replace(one, **{field.name: getattr(one, field.name) + 1})
        assert wrong != one


def test_scenarios_and_runs_are_equal_where_they_say_the_same() -> None:
    scenario = footfall.Scenario.load("single-impact")
    run = footfall.run(scenario)
    assert run.scenario == scenario and len({run.scenario, scenario}) == 1
    assert run == footfall.run(scenario) and len({run, footfall.run(scenario)}) == 1
    assert run != footfall.run(scenario, tolerance=1e-6) and scenario != footfall.Scenario.load("rolling-sphere")
    assert run.events == footfall.run(scenario).events
    assert run.final == footfall.run(scenario).final != run.events[0].state


def test_a_copy_is_a_run_of_its_own(rolling: footfall.Run) -> None:
    again = copy.deepcopy(rolling)
    again.dataset["position"][0] = 7.0
    assert again != rolling and rolling.dataset["position"][0, 0] != 7.0
    assert again.events == rolling.events
    rolling.events, rolling.impacts  # noqa: B018
    # What is computed on the way is not carried along.
    assert len(pickle.dumps(rolling)) < 1.1 * sum(v.nbytes for v in rolling.dataset.variables.values()) + 50_000


# What print shows ---------------------------------------------------------------------------------------------------


def test_a_fit_prints_its_report(values: dict[str, object]) -> None:
    fitted = values["fit"]
    assert isinstance(fitted, studies.Fit)
    assert str(fitted) == fitted.report.rstrip("\n") and "damping" in str(fitted)
    assert repr(fitted).startswith("<footfall.studies.Fit of 2 laws to 12 rows: best is ") and len(repr(fitted)) < 250
    assert "rms" in repr(fitted.best) and "\n" not in repr(fitted)


def test_a_scenario_prints_what_it_describes() -> None:
    scenario = footfall.Scenario.load("rolling-sphere")
    page = str(scenario)
    for said in (scenario.title, "154 g", "16.5 mm", "8.5e6 N/m^1.5", "mu = 0.2", "1e-12", "1 s", "(0, 0, -9.81)"):
        assert said in page
    assert repr(scenario).startswith("Scenario(") and "\n" not in repr(scenario)


def test_a_run_prints_the_page_of_the_command_line(command: str, rolling: footfall.Run, tmp_path: object) -> None:
    from conftest import SCENARIOS, footfall_command

    told = footfall_command(command, "run", SCENARIOS["rolling-sphere"]).stdout
    cut = "evaluations in"
    assert str(rolling).split(cut)[0] == told.split(cut)[0]
    assert str(rolling).startswith(str(rolling.scenario))
    # A file does not keep it.
    opened = footfall.open(rolling.save(f"{tmp_path}/run.nc"))
    assert str(opened) == repr(opened) == repr(rolling)

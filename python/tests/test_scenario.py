"""Scenarios as Python has them."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import footfall
from conftest import SCENARIOS


def test_the_simulation_is_in_si_units() -> None:
    simulation = footfall.Scenario.load(SCENARIOS["rolling-sphere"]).simulation
    assert simulation.body.mass == 0.154
    assert simulation.body.spheres[0].radius == 0.0165
    np.testing.assert_allclose(simulation.body.inertia, 0.4 * 0.154 * 0.0165**2 * np.eye(3), rtol=1e-15)
    np.testing.assert_array_equal(simulation.initial.orientation, [1, 0, 0, 0])
    np.testing.assert_array_equal(simulation.ground.normal, [0, 0, 1])
    assert simulation.options.tolerance == 1e-12
    assert simulation.contacts[0].normal == footfall.laws.AzadFeatherstoneNormal(stiffness=8.5e6, damping=3.1e3)
    assert simulation.contacts[0].friction.coefficient == 0.2


def test_the_simulation_outlives_its_scenario() -> None:
    simulation = footfall.Scenario.load(SCENARIOS["foot-heel-first"]).simulation
    body = simulation.body
    del simulation
    assert len(body.spheres) == 4


@pytest.mark.parametrize("name", sorted(SCENARIOS))
def test_a_dict_says_the_same_as_the_text(name: str) -> None:
    scenario = footfall.Scenario.load(SCENARIOS[name])
    again = footfall.Scenario.from_dict(scenario.to_dict())
    assert again.to_dict() == scenario.to_dict()
    assert again.title == scenario.title
    np.testing.assert_array_equal(again.simulation.initial.position, scenario.simulation.initial.position)
    assert [c.normal for c in again.simulation.contacts] == [c.normal for c in scenario.simulation.contacts]


def test_numpy_values_stand_for_numbers_and_lists() -> None:
    scenario = footfall.Scenario.load(SCENARIOS["rolling-sphere"]).to_dict()
    scenario["body"]["initial"]["velocity"] = np.array([0.25, 0, 0], dtype=np.float32)
    scenario["contact"]["friction"]["coefficient"] = np.float64(0.3)
    simulation = footfall.Scenario.from_dict(scenario).simulation
    np.testing.assert_array_equal(simulation.initial.velocity, [0.25, 0, 0])
    assert simulation.contacts[0].friction.coefficient == 0.3


def test_awkward_texts_survive_the_way_through_toml() -> None:
    scenario = footfall.Scenario.load(SCENARIOS["rolling-sphere"]).to_dict()
    scenario["title"] = 'quotes " and \\ and\nlines and ü ∞ \t'
    assert footfall.Scenario.from_dict(scenario).title == scenario["title"]


def test_a_scenario_can_be_pickled() -> None:
    scenario = footfall.Scenario.load(SCENARIOS["slope-stick"])
    again = pickle.loads(pickle.dumps(scenario))
    assert again.text == scenario.text and again.name == scenario.name


def test_the_first_bounce_is_that_of_the_rolling_sphere() -> None:
    whole, bounce = (
        footfall.Scenario.load(SCENARIOS[name]).to_dict() for name in ("rolling-sphere", "rolling-sphere-first-bounce")
    )
    for tables in (whole, bounce):
        del tables["title"], tables["time"]
    assert bounce == whole

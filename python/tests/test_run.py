"""footfall.run and footfall.open against the command line and the file that it writes."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import footfall
from conftest import SCENARIOS, footfall_command


@pytest.mark.parametrize("name", ["rolling-sphere", "foot-heel-first", "slope-stick", "single-impact-classical"])
def test_command_line_and_python_give_the_same_bits(name: str, command: str) -> None:
    done = footfall_command(command, "run", SCENARIOS[name], "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    run = footfall.run(SCENARIOS[name])

    final = told["final"]
    assert final["time"] == run.final.time
    for key in ("position", "velocity", "angular_velocity", "orientation"):
        assert final[key] == getattr(run.final, key).tolist()
    assert told["events"] == [{"time": e.time, "kind": e.kind, "sphere": e.sphere} for e in run.events]
    assert len(told["impacts"]) == len(run.impacts)
    for theirs, ours in zip(told["impacts"], run.impacts):
        assert theirs == {key: dataclasses.asdict(ours)[key] for key in theirs}
    assert told["energy"] == {key: getattr(run.energy, key) for key in told["energy"]}
    assert told["steps"] == run.cost.steps
    assert told["evaluations"] == run.cost.evaluations
    assert told["version"] == footfall.__version__


@pytest.mark.parametrize("name", sorted(SCENARIOS))
def test_dataset_is_what_the_file_holds(name: str, command: str, tmp_path: Path) -> None:
    file = tmp_path / "run.nc"
    assert footfall_command(command, "run", SCENARIOS[name], "-q", "-o", file).returncode == 0
    run = footfall.run(SCENARIOS[name])
    with xr.open_dataset(file) as written:
        xr.testing.assert_identical(run.dataset, written.load())
        assert {n: v.dtype.kind for n, v in run.dataset.variables.items() if v.dtype.kind != "O"} == {
            n: v.dtype.kind for n, v in written.variables.items() if n in run.dataset and v.dtype.kind not in "OTU"
        }


def assert_same(a: footfall.Run, b: footfall.Run) -> None:
    xr.testing.assert_identical(a.dataset, b.dataset)
    assert a.impacts == b.impacts
    assert a.energy == b.energy
    assert [(e.time, e.kind, e.sphere) for e in a.events] == [(e.time, e.kind, e.sphere) for e in b.events]
    for ours, theirs in zip((*a.events, a.final), (*b.events, b.final)):
        one, other = getattr(ours, "state", ours), getattr(theirs, "state", theirs)
        for field in dataclasses.fields(one):
            np.testing.assert_array_equal(getattr(one, field.name), getattr(other, field.name))


def test_open_gives_the_same_object_back(foot: footfall.Run, command: str, tmp_path: Path) -> None:
    by_command, by_xarray = tmp_path / "command.nc", tmp_path / "xarray.nc"
    footfall_command(command, "run", SCENARIOS["foot-heel-first"], "-q", "-o", by_command)
    foot.dataset.to_netcdf(by_xarray)
    assert_same(footfall.open(by_command), foot)
    assert_same(footfall.open(str(by_xarray)), foot)
    assert footfall.open(by_xarray).cost.wall_seconds is None


def test_open_refuses_what_is_no_run(tmp_path: Path) -> None:
    file = tmp_path / "other.nc"
    xr.Dataset({"a": 1}).to_netcdf(file)
    with pytest.raises(footfall.InvalidInput, match="other.nc: is not a run of footfall"):
        footfall.open(file)
    with pytest.raises(OSError):
        footfall.open(tmp_path / "missing.nc")


def test_a_path_a_dict_and_a_scenario_give_the_same(rolling: footfall.Run) -> None:
    scenario = footfall.Scenario.load(SCENARIOS["rolling-sphere"])
    for way in (str(SCENARIOS["rolling-sphere"]), scenario, scenario.to_dict()):
        run = footfall.run(way)
        np.testing.assert_array_equal(run.final.position, rolling.final.position)
        assert run.events[-1].time == rolling.events[-1].time


def test_the_papers_first_bounce(rolling: footfall.Run) -> None:
    # Section 4, figure 14: it slips, sticks for less than 1 ms, slips again.
    first = [event.kind for event in rolling.events[:5]]
    assert first == ["touchdown", "stick", "slip", "separation", "recovered"]
    assert 0 < rolling.impacts[0].stick_time < 1e-3
    # A solid sphere that friction has made roll: 5/7 of the speed it was thrown with.
    assert rolling.final.velocity[0] == pytest.approx(5 / 7 * 0.5, abs=1e-9)


def test_final_is_the_last_sample_and_has_every_sphere(foot: footfall.Run) -> None:
    assert foot.final.time == foot.dataset["time"][-1]
    assert foot.final.depth.shape == (4,)
    assert foot.final.friction_force.shape == (4, 3)
    assert len(foot.final.phase) == 4
    assert {event.sphere for event in foot.events} == {0, 1, 2, 3}


def test_energy_adds_up(rolling: footfall.Run) -> None:
    energy = rolling.energy
    entries = (
        energy.kinetic
        + energy.potential
        + energy.normal_spring
        + energy.tangential_spring
        + energy.normal_damper
        + energy.tangential_damper
        + energy.clutch
        + energy.stiffness_change
    )
    assert entries == pytest.approx(energy.initial, rel=1e-12)
    assert abs(energy.residual) <= energy.max_residual < 1e-12


def test_every_column_of_events_impacts_and_energies_has_a_field(foot: footfall.Run) -> None:
    def columns(prefix: str) -> set[str]:
        return {str(n).removeprefix(prefix) for n in foot.dataset.variables if str(n).startswith(prefix)}

    def fields(kind: type) -> set[str]:
        return {field.name for field in dataclasses.fields(kind)}

    assert columns("event_") == fields(footfall.State) | {"time", "kind", "sphere"}
    assert columns("impact_") == fields(footfall.Impact)
    assert columns("energy_") <= fields(footfall.Energy)


def test_arrays_are_not_copied(rolling: footfall.Run) -> None:
    position = rolling.dataset["position"].values
    assert not position.flags.owndata  # the memory is that of C++
    assert np.shares_memory(position, rolling.final.position)


def test_what_has_not_happened_is_none(rolling: footfall.Run) -> None:
    last = rolling.impacts[-1]
    assert last.recovered is None and last.restitution is None and last.speed_out is None
    assert math.isnan(float(rolling.dataset["impact_recovered"][-1]))


def test_tolerance_takes_the_place_of_the_scenarios() -> None:
    loose = footfall.run(SCENARIOS["rolling-sphere"], tolerance=1e-6)
    assert loose.dataset.attrs["tolerance"] == 1e-6
    assert loose.cost.steps < footfall.run(SCENARIOS["rolling-sphere"]).cost.steps
    with pytest.raises(footfall.InvalidInput, match="tolerance is 1; it must be from 1e-14 to 1e-3"):
        footfall.run(SCENARIOS["rolling-sphere"], tolerance=1)


def test_repr_says_what_the_run_was(rolling: footfall.Run) -> None:
    assert "section 4" in repr(rolling) and "10 impacts" in repr(rolling)


def test_a_run_without_contact() -> None:
    scenario = footfall.Scenario.load(SCENARIOS["single-impact"]).to_dict()
    scenario["time"] = {"end": 1e-4, "sample": 0}
    scenario["body"]["initial"] = {"position": [0, 0, 10.0]}
    run = footfall.run(scenario)
    assert run.events == [] and run.impacts == []
    assert run.dataset.sizes["event"] == 0

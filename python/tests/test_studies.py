"""The studies as functions: the same numbers as the commands, labelled."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import footfall
from conftest import SCENARIOS, footfall_command
from footfall import studies

NORMAL = "azad-featherstone:stiffness=8.5e6,damping=3.1e3"
FRICTION = "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2"


def test_a_table_becomes_a_dataset() -> None:
    table = (
        "A title",
        [
            ("speed", "m/s", "speed into the ground", "", np.array([1.0, 2.0])),
            ("force", "N", "largest force", "first", np.array([3.0, 4.0])),
            ("force", "N", "largest force", "second", np.array([5.0, 6.0])),
            ("theory", "1", "of the first alone", "first", np.array([7.0, 8.0])),
        ],
    )
    data = studies._labelled(table, "speed", coordinate=True)
    assert data.attrs["title"] == "A title"
    assert data["force"].dims == ("series", "speed")
    assert data["force"].sel(series="second", speed=2.0) == 6.0
    assert data["theory"].sel(series="second").isnull().all()
    assert data["speed"].attrs == {"units": "m/s", "long_name": "speed into the ground"}
    assert list(data.to_dataframe().columns) == ["force", "theory"]
    assert studies._labelled(table)["speed"].dims == ("row",)


def test_restitution_is_that_of_the_command_and_of_a_run(command: str) -> None:
    data = studies.restitution([NORMAL, "hertz:stiffness=8.5e6"], 0.154, [0.5, 1.0, 2.0])
    done = footfall_command(
        command, "restitution", "--mass", "0.154", "--normal", NORMAL, "--normal", "hertz:stiffness=8.5e6",
        "--from", "0.5", "--to", "2", "--points", "3", "--json",
    )  # fmt: skip
    told = {(c["name"], c["series"]): c["values"] for c in json.loads(done.stdout)["columns"]}
    np.testing.assert_allclose(data["speed"], told["speed", ""], rtol=1e-15)
    np.testing.assert_allclose(
        data["restitution"].sel(series="azad-featherstone"), told["restitution", "azad-featherstone"], rtol=1e-11
    )
    # Hertz's law loses nothing.
    np.testing.assert_allclose(data["restitution"].sel(series="hertz"), 1, rtol=1e-11)

    impact = footfall.run(SCENARIOS["rolling-sphere"]).impacts[0]
    with_gravity = studies.restitution(NORMAL, 0.154, impact.speed_in, gravity=9.81)
    assert float(with_gravity["restitution"][0, 0]) == pytest.approx(impact.restitution, rel=1e-9)
    assert float(with_gravity["slowest_bounce"][0]) > 0


def test_laws_of_one_kind_are_told_apart() -> None:
    other = "azad-featherstone:stiffness=8.5e6,damping=1e3"
    data = studies.restitution([NORMAL, other], 0.154, [1.0])
    assert data.sizes["series"] == 2
    named = studies.restitution({"stiff": NORMAL, "soft": other}, 0.154, [1.0])
    assert list(named["series"].values) == ["stiff", "soft"]
    np.testing.assert_array_equal(named["restitution"], data["restitution"])


def test_the_papers_figures() -> None:
    assert studies.restitution_figure(2).sizes["series"] == 3
    assert studies.restitution_figure(4).sizes["series"] == 4
    with pytest.raises(footfall.InvalidInput):
        studies.restitution_figure(5)


def test_an_oblique_impact_without_friction_keeps_what_is_sideways() -> None:
    angles = np.radians([0, 30, 60])
    data = studies.oblique(NORMAL, None, 0.154, 0.0165, angles=angles, speed=1.0)
    assert data.sizes["impact"] == 3
    np.testing.assert_allclose(data["tangential_velocity_after"], np.sin(angles), atol=1e-12)
    assert isinstance(data, xr.Dataset)


def test_an_oblique_impact_that_slides_throughout_has_mu_of_the_impulse() -> None:
    data = studies.oblique(NORMAL, FRICTION, 0.154, 0.0165, angles=math.radians(80), speed=1.0)
    assert float(data["impulse_ratio"][0]) == pytest.approx(0.2, rel=1e-3)
    with pytest.raises(footfall.InvalidInput, match="speed, normal_speed: one of the two"):
        studies.oblique(NORMAL, FRICTION, 0.154, 0.0165, angles=0.1)


def test_a_rig_is_driven(tmp_path: Path) -> None:
    rigs = sorted((Path(footfall.__file__).parent / "scenarios" / "rigs").glob("*.toml"))
    assert rigs
    data = studies.drive(next(rig for rig in rigs if "presliding" in rig.name))
    assert data["time"][0] == 0
    assert float(data["max_residual"].max()) < 1e-6


def test_a_measured_bounce_gives_the_damping_back() -> None:
    law = studies.with_restitution("azad-featherstone:stiffness=8.5e6,damping=0", 0.154, 1.0, 0.6)
    data = studies.restitution(law, 0.154, 1.0)
    assert float(data["restitution"][0, 0]) == pytest.approx(0.6, abs=1e-10)


def test_coefficients_from_materials() -> None:
    table = studies.materials()
    assert {"youngs_modulus", "poisson_ratio", "density"} <= set(table.columns)
    name = table.index[0]
    given = studies.material(name, name, 0.01, damping_time=1e-6)
    E, nu = table.loc[name, "youngs_modulus"], table.loc[name, "poisson_ratio"]
    # (9), (10), (23), (12)
    assert given.effective_modulus == pytest.approx(E / (2 * (1 - nu**2)), rel=1e-12)
    assert given.normal_stiffness == pytest.approx(4 / 3 * given.effective_modulus * math.sqrt(0.01), rel=1e-12)
    assert given.tangential_stiffness == pytest.approx(1.5 * given.normal_stiffness, rel=1e-12)
    assert given.normal().damping == pytest.approx(1.5e-6 * given.normal_stiffness, rel=1e-12)
    measured = studies.material(name, name, 0.01, restitution=0.9, speed=0.5)
    mass = 4 / 3 * math.pi * 1e-6 * table.loc[name, "density"]
    bounced = studies.restitution(measured.normal(), mass, 0.5)
    assert float(bounced["restitution"][0, 0]) == pytest.approx(0.9, abs=1e-9)
    with pytest.raises(footfall.InvalidInput, match="one of the three is wanted"):
        studies.material(name, name, 0.01)
    with pytest.raises(footfall.InvalidInput, match="unobtainium"):
        studies.material("unobtainium", name, 0.01, alpha=1)


def test_a_fit_finds_the_damping_that_made_the_data(tmp_path: Path) -> None:
    speeds = np.geomspace(0.05, 5, 20)
    clean = studies.restitution(NORMAL, 0.154, speeds)["restitution"].values[0]
    noisy = clean + 1e-3 * np.random.default_rng(2010).standard_normal(speeds.size)
    data = pd.DataFrame({"speed": speeds, "restitution": noisy})
    fit = studies.fit(data, "azad-featherstone:stiffness=8.5e6,damping=?", mass=0.154)
    estimate = fit.best.estimates.loc["damping"]
    assert estimate["low"] < 3.1e3 < estimate["high"]
    assert fit.best.law.damping == estimate["value"]
    assert "damping" in fit.report
    file = tmp_path / "data.csv"
    data.to_csv(file, index=False, float_format="%.17g")
    again = studies.fit(file, "azad-featherstone:stiffness=8.5e6,damping=?", mass=0.154)
    assert again.best.law == fit.best.law
    with pytest.raises(footfall.ScenarioError, match="speed"):
        studies.fit(pd.DataFrame({"speed": [-1.0, 1.0], "restitution": [0.5, 0.5]}), NORMAL, mass=0.154)

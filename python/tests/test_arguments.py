"""Whatever a function of the package is given, its error speaks of the argument in the words of the user."""

from __future__ import annotations

import inspect
import math
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
import xarray as xr

import footfall
from conftest import SCENARIOS
from footfall import figures, laws, plot, studies

NORMAL = "azad-featherstone:stiffness=8.5e6,damping=3.1e3"
FRICTION = "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2"

NOT_ALLOWED_WORDS = re.compile(
    r"incompatible function arguments|std::|filesystem error|nanobind|_core|ndarray\[|could not convert|substring|"
    r"inhomogeneous|setting an array element|unsupported operand|not subscriptable|has no attribute|"
    r"is not iterable|is not callable|"
    r"ambiguous|must be real number|float\(\) argument|embedded null|NetCDF:|HDF|codec can't|index out of|"
    r"zero-size array|out of bounds|broadcast together|not supported between",
)

WRONG: dict[str, Any] = {
    "None": None,
    "text": "a text",
    "half a character": "\ud800",
    "null character": "a\0b",
    "bytes": b"bytes",
    "empty list": [],
    "ragged list": [[1.0], [2.0, 3.0]],
    "list of texts": ["a", "b"],
    "list of None": [None],
    "dict": {"a": 1},
    "number key": {1: 2},
    "set": {1, 2},
    "object": object(),
    "function": lambda: None,
    "class": int,
    "NaN": math.nan,
    "list of NaN": [math.nan],
    "infinity": math.inf,
    "minus infinity": -math.inf,
    "minus one": -1,
    "zero": 0,
    "a half": 0.5,
    "huge float": 1e300,
    "huge int": 10**400,
    "2**40": 2**40,
    "complex": 1j,
    "bool": True,
    "array": np.arange(3.0),
    "matrix": np.ones((2, 2)),
    "array of objects": np.array([None, 1], object),
    "empty array": np.empty(0),
    "table": pd.DataFrame({"a": [1.0]}),
    "dataset": xr.Dataset({"a": 1}),
    "missing NA": pd.NA,
    "law": laws.HertzNormal(stiffness=1.0),
    "friction law": laws.NoneFriction(),
}

RIG = {
    "rig": {
        "end": 0.01,
        "sample": 1e-3,
        "load": [{"shape": "constant", "value": "10 N"}],
        "displacement": [{"shape": "sine", "amplitude": "1 um", "frequency": "100 Hz"}],
    },
    "contact": {
        "normal": {"law": "hertz", "stiffness": 8.5e6},
        "friction": {"law": "dahl", "stiffness": 1e5, "coefficient": 0.2},
    },
}
SPEEDS = np.array([0.5, 1.0, 2.0])


@pytest.fixture(scope="module")
def shown() -> footfall.Run:
    tables = footfall.Scenario.load("rolling-sphere").to_dict()
    tables["time"] = {"end": 0.2, "sample": 1e-3}
    return footfall.run(tables)


@pytest.fixture(autouse=True)
def figures_are_closed() -> Iterator[None]:
    yield
    plt.close("all")


def calls(run: footfall.Run, folder: Path) -> dict[str, tuple[Callable[..., Any], dict[str, Any]]]:
    """Every public function, with arguments that are right."""
    law = footfall.ContactLaw(NORMAL, FRICTION)
    contact = {"depth": [1e-4], "depth_rate": 0.0, "slip_velocity": [0.1, 0.0], "bristle": [0.0, 0.0]}
    data = pd.DataFrame({"speed": SPEEDS, "restitution": [0.8, 0.7, 0.6]})
    bounce = studies.restitution(NORMAL, 0.154, SPEEDS)
    loop = studies.drive(RIG)
    axes = plt.subplots()[1]
    return {
        "run": (footfall.run, {"scenario": run.scenario, "tolerance": 1e-8, "progress": None}),
        "open": (footfall.open, {"path": folder / "missing.nc"}),
        "to_toml": (footfall.to_toml, {"tables": {}}),
        "Scenario": (footfall.Scenario, {"core": run.scenario._core}),
        "Scenario.load": (footfall.Scenario.load, {"path": SCENARIOS["single-impact"]}),
        "Scenario.parse": (footfall.Scenario.parse, {"text": run.scenario.text, "name": "scenario"}),
        "Scenario.from_dict": (footfall.Scenario.from_dict, {"tables": run.scenario.to_dict(), "name": "scenario"}),
        "Run.save": (run.save, {"path": folder / "run.nc"}),
        "ContactLaw": (footfall.ContactLaw, {"normal": NORMAL, "friction": FRICTION, "impact_speed": 1.0}),
        "ContactLaw.evaluate": (law.evaluate, {**contact, "phase": 0, "out": None}),
        "ContactLaw.step": (law.step, {**contact, "dt": 1e-3, "phase": 0, "tolerance": 1e-4}),
        "laws.normal": (laws.normal, {"text": NORMAL}),
        "laws.friction": (laws.friction, {"text": FRICTION}),
        "laws.HertzNormal": (laws.HertzNormal, {"stiffness": 1e6}),
        "laws.DahlFriction": (laws.DahlFriction, {"stiffness": 1e6, "coefficient": 0.2}),
        "studies.restitution": (
            studies.restitution,
            {"normal": NORMAL, "mass": 0.154, "speeds": SPEEDS, "radius": math.inf, "gravity": 0.0, "tolerance": 1e-9},
        ),
        "studies.restitution_figure": (studies.restitution_figure, {"number": 2, "tolerance": 1e-6}),
        "studies.oblique": (
            studies.oblique,
            {
                "normal": NORMAL, "friction": FRICTION, "mass": 0.154, "radius": 0.0165, "angles": 0.5, "speed": 1.0,
                "normal_speed": None, "spin": 0.0, "inertia": None, "gravity": 0.0, "poisson_ratio": 0.3,
                "tolerance": 1e-9,
            },
        ),
        "studies.drive": (studies.drive, {"rig": RIG, "normal": None, "friction": None, "tolerance": None}),
        "studies.material": (
            studies.material,
            {"sphere": "steel", "ground": "steel", "radius": 0.01, "restitution": 0.9, "speed": 0.5, "alpha": None,
             "damping_time": None, "mass": None, "tangential": "paper"},
        ),
        "studies.material, alpha": (
            studies.material, {"sphere": "steel", "ground": "steel", "radius": 0.01, "alpha": 1.0}
        ),
        "studies.material, time": (
            studies.material, {"sphere": "steel", "ground": "steel", "radius": 0.01, "damping_time": 1e-6}
        ),
        "studies.with_restitution": (
            studies.with_restitution, {"normal": NORMAL, "mass": 0.154, "speed": 1.0, "restitution": 0.6}
        ),
        "studies.Coefficients.friction": (
            studies.material("steel", "steel", 0.01, alpha=1.0).friction, {"coefficient": 0.2, "viscous": 0.0}
        ),
        "studies.fit": (
            studies.fit,
            {"data": data, "normal": "azad-featherstone:stiffness=8.5e6,damping=?", "mass": 0.154, "speed": None,
             "touchdown": 0.0, "quasistatic": False, "loss": "none", "starts": 1, "confidence": 0.95,
             "sigma_is_true": False},
        ),
        "plot.phases": (plot.phases, {"run": run, "sphere": 0}),
        "plot.shade_phases": (
            plot.shade_phases, {"axes": axes, "run": run, "sphere": 0, "window": None, "impact": None}
        ),
        "plot.height": (plot.height, {"axes": axes, "run": run, "window": None}),
        "plot.trajectory": (plot.trajectory, {"axes": axes, "run": run, "horizontal": "x"}),
        "plot.contact_force": (
            plot.contact_force,
            {"axes": axes, "run": run, "component": "x", "sphere": 0, "window": None, "impact": None, "shade": True},
        ),
        "plot.force_indentation": (plot.force_indentation, {"axes": axes, "of": run, "sphere": 0, "impact": None}),
        "plot.presliding_loop": (plot.presliding_loop, {"axes": axes, "data": loop, "direction": "x"}),
        "plot.energy": (plot.energy, {"axes": axes, "run": run, "window": None}),
        "plot.residual": (plot.residual, {"axes": axes, "run": run}),
        "plot.restitution": (plot.restitution, {"axes": axes, "data": bounce, "logarithmic": True, "theory": None}),
        "plot.filmstrip": (
            plot.filmstrip,
            {"axes": axes, "run": run, "times": None, "frames": 2, "horizontal": "x", "arrow": None},
        ),
        "plot.animation": (
            plot.animation,
            {"run": run, "path": folder / "a.gif", "window": (0.13, 0.14), "seconds": 0.1, "frames_per_second": 10,
             "horizontal": "x", "arrow": None, "width": 2.0, "progress": None},
        ),
        "figures.make": (figures.make, {"run": run, "out": folder / "out", "drawings": figures.WHOLE[1:2]}),
    }  # fmt: skip


#: Finite and out of all proportion: what comes of them is said by the run, whose words they are.
HUGE = {"huge float", "2**40"}
#: Is tried with whatever takes no time; these take long, or run the caller's own function.
SKIPPED = {
    *((name, argument, kind) for name, argument in (
        ("plot.animation", "seconds"), ("studies.oblique", "mass"), ("studies.oblique", "spin"),
        ("studies.oblique", "inertia"), ("studies.oblique", "gravity"),
    ) for kind in HUGE),
    *(("plot.animation", "progress", kind) for kind in ("function", "class")),
}  # fmt: skip

FUNCTIONS = list(calls(footfall.run("single-impact"), Path("unused")))
plt.close("all")


def test_every_public_function_is_tried() -> None:
    tried = {name.split(",")[0] for name in FUNCTIONS}
    public = {name for name in footfall.__all__ if inspect.isfunction(getattr(footfall, name))}
    for module in (studies, plot):
        short = module.__name__.removeprefix("footfall.")
        public |= {
            f"{short}.{name}"
            for name, value in vars(module).items()
            if inspect.isfunction(value) and value.__module__ == module.__name__ and not name.startswith("_")
        }
    assert public - tried <= {"shipped_scenarios", "studies.materials"}  # which take nothing


@pytest.mark.parametrize("function", FUNCTIONS)
def test_errors_are_in_the_words_of_the_user(
    function: str, shown: footfall.Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    call, right = calls(shown, tmp_path)[function]
    if function != "open":
        call(**right)
    allowed = (TypeError, footfall.InvalidInput, OSError, MemoryError)
    problems = []
    for argument in right:
        for kind, value in WRONG.items():
            if (function, argument, kind) in SKIPPED:
                continue
            try:
                call(**{**right, argument: value})
            except allowed if kind not in HUGE else (*allowed, RuntimeError) as error:
                said = str(error)
                if os.environ.get("SHOW"):
                    print(f"{function}({argument}={kind}): {type(error).__name__}: {said}")
                named = (
                    argument in said
                    or isinstance(error, (OSError, footfall.ScenarioError, MemoryError))
                    or said.startswith(("a: ", "the law '"))  # a key of the dict that was given, a law by its name
                    or kind in HUGE
                )
                if NOT_ALLOWED_WORDS.search(said) or not said or not named:
                    problems.append(f"{argument}={kind}: {type(error).__name__}: {said}")
            except Exception as error:  # noqa: BLE001
                problems.append(f"{argument}={kind}: {type(error).__name__}: {error}")
    assert not problems, "\n" + "\n".join(problems)

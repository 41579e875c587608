"""The package as it is installed."""

from __future__ import annotations

import doctest
import importlib.metadata
import re
import subprocess
import sys
from pathlib import Path

import pytest

import footfall
import footfall.contact
import footfall.results
from conftest import footfall_command

HERE = Path(__file__).resolve().parent


def test_it_is_the_installed_one() -> None:
    assert "site-packages" in footfall.__file__


def test_the_command_comes_with_it(command: str) -> None:
    # The commit follows where the wheel was built from a clone.
    assert footfall_command(command, "--version").stdout.split()[:2] == ["footfall", footfall.__version__]
    assert importlib.metadata.version("footfall") == footfall.__version__


@pytest.mark.parametrize("module", [footfall, footfall.contact, footfall.results], ids=lambda m: m.__name__)
def test_examples_in_docstrings(module: object) -> None:
    done = doctest.testmod(module, extraglobs={"ContactLaw": footfall.ContactLaw})
    assert done.attempted > 0 and done.failed == 0


def test_examples_in_the_readme(tmp_path: Path) -> None:
    blocks = re.findall(r"```python\n(.*?)```", (HERE.parent / "README.md").read_text(), re.DOTALL)
    program = tmp_path / "readme.py"
    program.write_text("\n".join(blocks))
    done = subprocess.run([sys.executable, str(program)], capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stderr
    assert "restitution 0.6027" in done.stdout


def test_a_simulator_in_numpy_alone_uses_the_law() -> None:
    program = HERE.parent / "python" / "numpy_simulator.py"
    done = subprocess.run([sys.executable, str(program)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    rolled = float(re.search(r"speed ([0-9.]+) of the initial", done.stdout)[1])  # type: ignore[index]
    assert abs(rolled - 5 / 7) < 0.002


def python(program: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=False, timeout=120
    )


def test_figures_are_there_without_an_import_of_their_own() -> None:
    done = python("import footfall; print(footfall.plot.height, footfall.figures.make, footfall.paper.make)")
    assert done.returncode == 0, done.stderr
    assert {"plot", "figures", "paper", "laws", "studies", "run"} <= set(dir(footfall))
    with pytest.raises(AttributeError, match="has no attribute 'plots'"):
        footfall.plots  # noqa: B018


def test_importing_the_package_loads_nothing_else() -> None:
    loaded = "[m for m in sys.modules if m.split('.')[0] in ('numpy', 'xarray', 'pandas', 'matplotlib', 'netCDF4')]"
    done = python(f"import sys, footfall; dir(footfall); print({loaded})")
    assert done.stdout.strip() == "[]", done.stderr


def test_without_matplotlib_it_says_how_to_install_it() -> None:
    without = "import sys; sys.modules['matplotlib'] = None; import footfall\n"
    use = "print('plot' in dir(footfall), footfall.run('single-impact').title)\nfrom footfall import *"
    done = python(without + use)
    assert done.returncode == 0 and done.stdout.startswith("False Azad"), done.stderr
    done = python(without + "footfall.plot")
    assert done.stderr.strip().endswith("ImportError: footfall.plot needs Matplotlib: pip install 'footfall[plot]'")
    for module in ("figures", "paper"):
        program = without + f"import runpy; runpy.run_module('footfall.{module}', run_name='__main__')"
        done = python(program, "a", "b")
        assert done.returncode == 1
        assert done.stderr == "error: footfall.plot needs Matplotlib: pip install 'footfall[plot]'\n"


def test_everything_public_is_documented() -> None:
    for name in footfall.__all__:
        thing = getattr(footfall, name)
        if callable(thing):
            assert thing.__doc__, name
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert value.__doc__, f"{name}.{member}"


def test_the_types_are_those_of_use(tmp_path: Path) -> None:
    program = tmp_path / "typed.py"
    program.write_text(
        """
from pathlib import Path

import footfall
import matplotlib.pyplot as plt
import xarray as xr
from matplotlib.axes import Axes

run: footfall.Run = footfall.run("a.toml", tolerance=1e-10, progress=lambda t: t < 1)
data: xr.Dataset = run.dataset
kind: str = run.events[0].kind
speed: float | None = run.impacts[0].speed_out
law = footfall.ContactLaw(footfall.laws.AzadFeatherstoneNormal(stiffness=1.0, damping="1 N s/m^1.5"))
force: float = float(law.evaluate(0.0, 0.0, [0, 0], [0, 0]).normal_force)
saved: Path = run.save("a.nc")
again: float | None = footfall.ContactLaw("hertz:stiffness=1").impact_speed
drawn: Axes = footfall.plot.height(plt.subplots()[1], run)
made: list[tuple[Path, str]] = footfall.figures.make(run, Path("figures"))
mass: float = footfall.Scenario.load("a.toml").simulation.body.mass
taken: float = run.energy.clutch
powers: int = law.evaluate(0.0, 0.0, [0, 0]).clutch_power.size
run.energy.cluch  # type: ignore[attr-defined]
footfall.run(3)  # type: ignore[arg-type]
footfall.laws.AzadFeatherstoneNormal(stifness=1)  # type: ignore[call-arg]
"""
    )
    pytest.importorskip("mypy")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--warn-unused-ignores", str(program)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr

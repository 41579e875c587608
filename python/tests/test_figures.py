"""A run's file is drawn, with nothing compiled."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

import footfall
from conftest import SCENARIOS, footfall_command

WITHOUT_THE_EXTENSION = """
import sys
sys.modules["footfall._core"] = None
from footfall.figures import main
raise SystemExit(main(sys.argv[1:]))
"""


def draw(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", WITHOUT_THE_EXTENSION, *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize(
    ("options", "names"),
    [
        ([], ["trajectory", "height", "energy", "residual"]),
        (["--impact"], ["impact-filmstrip", "impact-forces", "impact-loop", "impact-energy"]),
    ],
    ids=["the whole run", "its first impact"],
)
def test_it_draws_what_the_command_has_written(
    command: str, tmp_path: Path, options: list[str], names: list[str]
) -> None:
    file = tmp_path / "run.nc"
    assert footfall_command(command, "run", SCENARIOS["foot-heel-first"], "-o", file).returncode == 0
    done = draw(file, tmp_path / "out", *options)
    assert done.returncode == 0, done.stderr
    drawn = [Path(line.split()[0]) for line in done.stdout.splitlines()]
    assert drawn == [tmp_path / "out" / f"{name}.png" for name in names]
    for path in drawn:
        with Image.open(path) as picture:
            assert picture.format == "PNG" and len(picture.getcolors(1 << 24) or []) > 10  # not a blank one


def test_it_says_what_it_cannot_draw(tmp_path: Path) -> None:
    done = draw(tmp_path / "missing.nc", tmp_path)
    assert done.returncode == 1 and "error:" in done.stderr and "missing.nc" in done.stderr

    falling = footfall.Scenario.load(SCENARIOS["rolling-sphere"]).to_dict()
    falling["time"] = {"end": 0.1, "sample": 0.01}
    footfall.run(falling).dataset.to_netcdf(tmp_path / "falling.nc")
    assert draw(tmp_path / "falling.nc", tmp_path).returncode == 0
    done = draw(tmp_path / "falling.nc", tmp_path, "--impact")
    assert done.returncode == 1 and "run: has no impact to draw" in done.stderr


@pytest.mark.parametrize("module", ["figures", "paper"])
def test_a_folder_that_cannot_be_made_is_named(module: str, tmp_path: Path) -> None:
    run = footfall.run("single-impact").save(tmp_path / "run.nc")
    arguments = [str(run)] if module == "figures" else []
    for out, said in ((run, "is a file, not a folder"), (run / "below", "cannot make the folder")):
        done = subprocess.run(
            [sys.executable, "-m", f"footfall.{module}", *arguments, str(out)],
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 1 and done.stderr.startswith("error: ") and done.stderr.count("\n") == 1
        assert said in done.stderr and str(out) in done.stderr


def test_what_is_no_run_is_named(tmp_path: Path) -> None:
    (tmp_path / "text.nc").write_text("a,b\n")
    done = draw(tmp_path / "text.nc", tmp_path / "out")
    assert done.returncode == 1 and "text.nc: is not a NetCDF file" in done.stderr and done.stderr.count("\n") == 1
    assert not (tmp_path / "out").exists()

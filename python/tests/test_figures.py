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

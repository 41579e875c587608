"""The page of the paper's figures: the marks are those of the numbers, and the files are there."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
import xarray as xr
from PIL import Image

import footfall
from conftest import SCENARIOS
from footfall import paper

NUMBERS = [2, 3, 4, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16]


@pytest.fixture(scope="module")
def runs() -> paper.Runs:
    return paper.Runs()


@pytest.fixture(scope="module")
def figures(runs: paper.Runs) -> dict[int, paper.Figure]:
    return {figure.number: figure for figure in (make(runs) for make in paper.FIGURES)}


def verdict(figures: dict[int, paper.Figure], number: int, words: str) -> tuple[str, str]:
    found = [check for check in figures[number].checks if words in check.claim]
    assert len(found) == 1, words
    return found[0].verdict, found[0].measured


def test_it_has_the_figures_that_are_plots(figures: dict[int, paper.Figure]) -> None:
    assert list(figures) == NUMBERS
    assert all(figure.checks for figure in figures.values())
    assert figures[2].file == "figure-02.png" and figures[16].file == "figure-16.png"


@pytest.mark.parametrize(
    ("number", "words", "expected", "measured"),
    [
        (2, "linear model", "holds", "e = 0.6203"),
        (3, "linear relation", "differs", "0.031 (D_n = 3100)"),
        (4, "more accurately", "not decided", "not drawn"),
        (6, "classical law", "holds", "202.0 N"),
        (7, "reaches zero before z", "holds", "0.2262 mm"),
        (7, "never negative", "holds", "0 N"),
        (8, "released", "holds", "0.142784 s"),
        (9, "lower peak", "holds", "266.6"),
        (10, "continuous", "holds", "266.6 N"),
        (10, "smoothly", "differs", "-125 N/ms"),
        (10, "sticky", "holds", "0 N"),
        (11, "constant", "holds", "176.001 mJ"),
        (13, "the same", "holds", "differ by at most"),
        (14, "continuous", "holds", "0.009 N"),
        (14, "less than 1ms", "holds", "0.860 ms"),
        (14, "starts with slipping", "holds", "slip 0.934 ms, stick 0.860 ms, slip"),
        (15, "the velocity is zero", "holds", "0.40 mm/s"),
        (15, "still increasing", "holds", "0.1955 m"),
        (15, "rolling", "holds", "5/7"),
        (16, "constant", "holds", "189.574 mJ"),
        (16, "(33)", "differs", "0.670 mJ"),
        (16, "(29)", "differs", "8.033 mJ"),
    ],
)
def test_the_marks(
    figures: dict[int, paper.Figure], number: int, words: str, expected: str, measured: str
) -> None:
    said, numbers = verdict(figures, number, words)
    assert said == expected
    assert measured in numbers


def test_a_mark_changes_with_the_numbers(runs: paper.Runs) -> None:
    changed = paper.Runs()
    changed.impact = runs.classical_impact
    assert verdict({7: paper.figure_7(changed)}, 7, "before z")[0] == "differs"

    tables = runs.bouncing.scenario.to_dict()
    tables["body"]["initial"]["position"] = [0, 0, 0.06]
    changed.bouncing = footfall.run(tables)
    assert verdict({8: paper.figure_8(changed)}, 8, "released")[0] == "differs"
    changed.classical_impact = runs.impact
    assert verdict({6: paper.figure_6(changed)}, 6, "classical law")[0] == "differs"

    tables = runs.rolling.scenario.to_dict()
    tables["body"]["initial"]["velocity"] = [0.5, 0.4, 0]
    tables["contact"]["friction"]["coefficient"] = 0.05
    changed.rolling = footfall.run(tables)
    assert verdict({13: paper.figure_13(changed)}, 13, "the same")[0] == "differs"
    assert verdict({15: paper.figure_15(changed)}, 15, "velocity is zero")[0] == "differs"


def test_a_jump_and_a_corner_are_told_apart(runs: paper.Runs) -> None:
    """The force of a linear damper is there at once: it jumps at touchdown from 0 to b v, and nowhere else."""
    tables = runs.impact.scenario.to_dict()
    tables["time"]["sample"] = 2e-6
    tables["contact"]["normal"] = {"law": "linear", "stiffness": 2e5, "damping": 30.0}
    crossings = {c.kind: c for c in paper.crossings(footfall.run(tables), "normal_force")}
    assert crossings["touchdown"].jump == pytest.approx(30.0, rel=1e-6)
    assert abs(crossings["separation"].jump) < 1e-3
    assert crossings["separation"].slope_before < -1e3 and crossings["separation"].slope_after == 0


def test_the_distance_from_a_line() -> None:
    speed = np.geomspace(0.1, 10, 21)
    assert paper.off_line(speed, 0.5 - 0.1 * np.log(speed)) < 1e-14
    assert paper.off_line(speed, 0.5 - 0.1 * np.log(speed) ** 2) > 0.1


def test_the_clutch_as_printed_is_what_the_force_does_on_the_slip() -> None:
    """Dragged at 0.5 m/s for 0.01 s against 2 N, with no bristle: -10 mJ."""
    time = np.linspace(0, 0.01, 101)
    force, velocity = (np.zeros((time.size, 1, 3)) for _ in range(2))
    force[..., 0], velocity[..., 0] = -2.0, 0.5
    dims = ["time", "sphere", "axis"]
    data = xr.Dataset(
        {"friction_force": (dims, force), "slip_velocity": (dims, velocity), "bristle": (dims, np.zeros_like(force))},
        {"time": time},
    )
    assert paper.clutch_as_printed(data) == pytest.approx(-0.01)


def test_the_clutch_of_the_ledger_is_the_integral_with_the_other_sign(runs: paper.Runs) -> None:
    bounce = runs.first_rolling_bounce.dataset
    assert -paper.clutch_as_printed(bounce) == pytest.approx(float(bounce["energy_clutch"][-1]), rel=1e-4)


def test_it_writes_the_figures_and_a_page(tmp_path: Path, figures: dict[int, paper.Figure]) -> None:
    said: list[str] = []
    paper.make(tmp_path / "out", list(figures.values()), say=said.append)
    assert len(said) == len(NUMBERS)
    text = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    for number in NUMBERS:
        file = f"figure-{number:02d}.png"
        with Image.open(tmp_path / "out" / file) as picture:
            picture.verify()
            assert picture.format == "PNG" and min(picture.size) > 500
        assert f'src="{file}"' in text
    checks = [check for figure in figures.values() for check in figure.checks]
    for mark, expected in (("✔ holds", "holds"), ("✘ differs", "differs"), ("– not decided", "not decided")):
        assert text.count(mark) == sum(check.verdict == expected for check in checks)


def test_the_command_says_where_it_cannot_write(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    assert paper.main([str(blocked / "out")]) == 1
    assert "error:" in capsys.readouterr().err


def test_the_fine_runs_are_the_shipped_ones(runs: paper.Runs) -> None:
    assert runs.first_bounce.impacts[0].peak_normal_force == pytest.approx(
        footfall.run(SCENARIOS["bouncing-sphere"]).impacts[0].peak_normal_force, rel=1e-9
    )

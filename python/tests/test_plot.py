"""Figures say what they show, and show what the data say."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import Circle
from PIL import Image

import footfall
from conftest import SCENARIOS
from footfall import plot


@pytest.fixture
def axes() -> Iterator[Axes]:
    figure, made = plt.subplots()
    yield made
    figure.canvas.draw()
    plt.close(figure)


@pytest.fixture(scope="module")
def impact() -> footfall.Run:
    return footfall.run(SCENARIOS["single-impact"])


def drive_table(series: list[str]) -> xr.Dataset:
    """A dataset as studies.drive gives it, of a spring of 1 N/um that slides at 2 N."""
    time = np.linspace(0, 1, 101)
    x = 5e-6 * np.sin(2 * np.pi * time)
    force = np.clip(-1e6 * x, -2, 2)
    columns = {"slip_displacement_x": x, "friction_force_x": force, "depth": np.abs(x), "normal_force": np.abs(force)}
    return xr.Dataset(
        {name: (["series", "time"], np.tile(values, (len(series), 1))) for name, values in columns.items()},
        {"series": series, "time": time},
    )


def test_each_function_returns_its_axes_and_labels_units(rolling: footfall.Run) -> None:
    restitution = xr.Dataset(
        {"restitution": (["series", "speed"], [[0.9, 0.8]])}, {"series": ["a"], "speed": [0.1, 1.0]}
    )
    table = drive_table(["a", "b"])
    calls = [
        lambda a: plot.height(a, rolling),
        lambda a: plot.trajectory(a, rolling),
        lambda a: plot.contact_force(a, rolling),
        lambda a: plot.contact_force(a, rolling, component="friction", impact=0),
        lambda a: plot.force_indentation(a, rolling, impact=0),
        lambda a: plot.energy(a, rolling),
        lambda a: plot.residual(a, rolling),
        lambda a: plot.restitution(a, restitution),
        lambda a: plot.presliding_loop(a, table),
        lambda a: plot.filmstrip(a, rolling, frames=2),
    ]
    for call in calls:
        figure, axes = plt.subplots()
        assert call(axes) is axes
        assert axes.get_xlabel().endswith("]") and axes.get_ylabel().endswith("]"), axes.get_ylabel()
        plt.close(figure)


def test_heights_and_times_are_in_the_unit_of_the_label(axes: Axes, impact: footfall.Run) -> None:
    plot.height(axes, impact)
    time, gap = axes.lines[-1].get_data()
    assert axes.get_xlabel() == "time [ms]" and axes.get_ylabel() == "height of the lowest point [mm]"
    assert time[-1] == pytest.approx(5.0)
    assert gap[0] == pytest.approx(0.1)  # the scenario's gap; it comes in at 1 m/s


def test_the_phases_meet_at_the_events(rolling: footfall.Run) -> None:
    found = plot.phases(rolling)
    assert found[0][:2] == ("flight", 0.0) and found[-1][2] == pytest.approx(1.0)
    assert all(before[2] == after[1] for before, after in zip(found, found[1:]))
    assert [name for name, _, _ in found[:6]] == ["flight", "slip", "stick", "slip", "recovering", "flight"]
    # Each sample lies in the phase that the run has given it.
    names = rolling.dataset["phase"].attrs["flag_meanings"].split()
    times, sampled = rolling.dataset["time"].values, rolling.dataset["phase"].values[:, 0]
    for name, start, end in found:
        inside = (times > start) & (times < end)
        assert {names[phase] for phase in sampled[inside]} <= {name}


def test_without_friction_a_contact_neither_sticks_nor_slips(impact: footfall.Run) -> None:
    assert [name for name, _, _ in plot.phases(impact)] == ["flight", "pressing", "recovering", "flight"]


def test_the_shades_of_an_impact_are_its_phases(axes: Axes, rolling: footfall.Run) -> None:
    plot.contact_force(axes, rolling, component="x", impact=0)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["slip", "stick", "recovering"]
    widths = sorted(patch.get_width() for patch in axes.patches)
    assert sum(widths) == pytest.approx(1e3 * (rolling.impacts[0].recovered - rolling.impacts[0].touchdown))
    assert any(width == pytest.approx(1e3 * rolling.impacts[0].stick_time) for width in widths)


def test_the_loop_marks_where_contact_ends(axes: Axes, impact: footfall.Run) -> None:
    plot.force_indentation(axes, impact)
    marked = next(line for line in axes.lines if line.get_marker() == "o")
    separation = next(event for event in impact.events if event.kind == "separation")
    assert marked.get_xdata()[0] == pytest.approx(1e3 * separation.state.depth)


def bands(axes: Axes, hatched: bool) -> dict[str, np.ndarray]:
    """The areas of a stack by their label: vertices."""
    return {
        str(area.get_label()): area.get_paths()[0].vertices
        for area in axes.collections
        if isinstance(area, PolyCollection) and bool(area.get_hatch()) == hatched
    }


def test_energy_stacks_up_to_a_flat_line_though_a_part_is_negative(axes: Axes, rolling: footfall.Run) -> None:
    plot.energy(axes, rolling)
    assert axes.get_ylabel() == "energy [mJ]"
    stacked, below = bands(axes, hatched=False), bands(axes, hatched=True)
    assert list(below) == ["changing stiffness (negative)"]
    times = np.unique(stacked["kinetic"][:, 0])[5:-5:200]
    heights = np.zeros_like(times)
    top = np.zeros_like(times)
    for vertices in stacked.values():
        for i, time in enumerate(times):
            column = vertices[vertices[:, 0] == time, 1]
            heights[i] += np.ptp(column)
            top[i] = max(top[i], column.max())
    np.testing.assert_allclose(top, 189.574, rtol=1e-9)
    # Each band is as high as its energy: together more than the total, by what the law has made.
    made = -1e3 * rolling.dataset["energy_stiffness_change"].sel(time=times, method="nearest").values
    np.testing.assert_allclose(heights - top, made, atol=1e-9)
    assert below["changing stiffness (negative)"][:, 1].min() == pytest.approx(
        1e3 * float(rolling.dataset["energy_stiffness_change"].min())
    )


def test_the_residual_has_a_logarithmic_axis_and_no_zeros(axes: Axes, rolling: footfall.Run) -> None:
    plot.residual(axes, rolling)
    assert axes.get_yscale() == "log"
    drawn = axes.lines[0].get_ydata()
    size = np.abs(rolling.dataset["energy_residual"].values)
    assert np.nanmin(drawn) > 0 and np.nanmax(drawn) == size.max()
    assert np.count_nonzero(np.isfinite(drawn)) == np.count_nonzero(size)


def test_a_presliding_loop_is_drawn_for_each_law(axes: Axes) -> None:
    plot.presliding_loop(axes, drive_table(["first", "second"]))
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["first", "second"]
    x, force = axes.lines[0].get_data()
    assert axes.get_xlabel() == "displacement [µm]" and np.max(x) == pytest.approx(5.0)
    assert force[int(np.argmax(x))] == pytest.approx(2.0)  # against the motion: positive where x is


def test_a_filmstrip_has_the_body_in_each_frame(axes: Axes) -> None:
    foot = footfall.run(SCENARIOS["foot-heel-first"], tolerance=1e-8)
    plot.filmstrip(axes, foot, times=[0.0, 0.05, 0.1])
    circles = [patch for patch in axes.patches if isinstance(patch, Circle)]
    assert len(circles) == 3 * 4
    assert all(circle.radius == pytest.approx(0.015) for circle in circles)
    # The heel, spheres 0 and 1, comes down first: toes up by 15 degrees over 20 cm.
    heights = [circle.center[1] for circle in circles[:4]]
    assert heights[2] - heights[0] == pytest.approx(0.2 * np.sin(np.radians(15)))


def test_on_a_slope_each_frame_has_the_body_on_the_ground(axes: Axes) -> None:
    """A sphere of radius r that touches a slope of 45 degrees has its centre r sqrt(2) above the ground below it."""
    slide = footfall.run(SCENARIOS["slope-slide"], tolerance=1e-8)
    plot.filmstrip(axes, slide, times=[0.1, 0.3, 0.5])
    heights = [patch.center[1] for patch in axes.patches if isinstance(patch, Circle)]
    np.testing.assert_allclose(heights, 0.0165 * np.sqrt(2), rtol=0.01)
    low, high = axes.get_ylim()
    assert low < 0 and high > max(heights) + 0.0165


def test_an_animation_is_a_gif_that_moves(tmp_path: Path, impact: footfall.Run) -> None:
    path = plot.animation(impact, tmp_path / "impact.gif", seconds=0.3, frames_per_second=10, width=3)
    with Image.open(path) as film:
        assert film.format == "GIF" and film.n_frames == 3
        first = np.asarray(film.convert("RGB"))
        film.seek(1)
        assert np.any(first != np.asarray(film.convert("RGB")))


def test_what_cannot_be_drawn_is_said(axes: Axes, impact: footfall.Run, tmp_path: Path) -> None:
    with pytest.raises(footfall.InvalidInput, match="sphere: 1 is not allowed"):
        plot.contact_force(axes, impact, sphere=1)
    with pytest.raises(footfall.InvalidInput, match="has 1 impacts"):
        plot.contact_force(axes, impact, impact=1)
    with pytest.raises(footfall.InvalidInput, match=r"must end in \.gif or \.mp4"):
        plot.animation(impact, tmp_path / "impact.avi")
    with pytest.raises(footfall.InvalidInput, match="times: must be from"):
        plot.filmstrip(axes, impact, times=[1.0])
    with pytest.raises(footfall.InvalidInput, match="studies.drive"):
        plot.presliding_loop(axes, impact.dataset)


def test_arguments_in_the_wrong_order_are_named(axes: Axes, impact: footfall.Run) -> None:
    with pytest.raises(TypeError, match=r"axes: Axes of Matplotlib are wanted, .* not Run"):
        plot.height(impact, axes)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="run: a run is wanted, .* not the text 'run.nc'"):
        plot.height(axes, "run.nc")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="axes: .* not a list of 2"):
        plot.height([axes, axes], impact)  # type: ignore[arg-type]


def test_a_window_that_holds_nothing_is_named(axes: Axes, impact: footfall.Run) -> None:
    for window, said in (
        ((1.0, 2.0), "the run is from 0 s to 0.005 s"),
        ((0.002, 0.001), "start < end"),
        ((0.0010001, 0.0010002), "must hold two samples of the run, which has one every 5e-06 s"),
        ((0.001, np.nan), "start < end"),
    ):
        with pytest.raises(footfall.InvalidInput, match=f"window: .* {said}"):
            plot.energy(axes, impact, window=window)


def test_words_that_are_none_are_answered_with_those_that_are(axes: Axes, impact: footfall.Run) -> None:
    with pytest.raises(footfall.InvalidInput, match="component: 'w' is not allowed: must be 'normal', 'x', 'y', 'z'"):
        plot.contact_force(axes, impact, component="w")  # type: ignore[arg-type]
    with pytest.raises(footfall.InvalidInput, match="horizontal: 'z' is not allowed: must be 'x' or 'y'"):
        plot.trajectory(axes, impact, horizontal="z")  # type: ignore[arg-type]

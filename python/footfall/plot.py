"""Figures of runs and studies. Each function draws on Axes of Matplotlib that it is given, labels them with units, and
returns them.

Matplotlib is needed: ``pip install 'footfall[plot]'``.

>>> import footfall
>>> import matplotlib.pyplot as plt
>>> run = footfall.run("single-impact")
>>> figure, axes = plt.subplots()
>>> footfall.plot.force_indentation(axes, run).get_xlabel()
'indentation [mm]'
"""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import xarray as xr

from footfall import _arguments, _channels
from footfall._channels import Channel
from footfall.errors import InvalidInput
from footfall.results import Run

try:
    import matplotlib.pyplot as plt
    from matplotlib import animation as _animation
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle, Patch
except ImportError as error:
    raise ImportError("footfall.plot needs Matplotlib: pip install 'footfall[plot]'", name=error.name) from error

Floats = npt.NDArray[np.float64]
Window = tuple[float, float]

# Okabe & Ito 2008: people of every colour vision tell these apart.
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, VERMILLION, PURPLE = "#F0E442", "#0072B2", "#D55E00", "#CC79A7"
GREY = "#8A8A8A"

#: The order in which curves take their colours, and the dashes that tell them apart in print.
CURVES: tuple[tuple[str, Any], ...] = (
    (BLUE, "-"),
    (VERMILLION, (0, (6, 2))),
    (GREEN, (0, (5, 1.5, 1, 1.5))),
    (PURPLE, (0, (2, 1.2))),
    (BLACK, (0, (8, 2, 1, 2, 1, 2))),
)

#: What the phases of a contact are shaded with.
PHASE_SHADES = {"stick": "#FBE3B3", "slip": "#CFE6F5", "pressing": "#CFE6F5", "recovering": "#E4E4E4"}

_CHANNEL_COLORS = (VERMILLION, ORANGE, YELLOW, PURPLE, GREEN, BLACK, GREY)


def _stack(channels: Sequence[Channel]) -> tuple[tuple[str, str, str], ...]:
    """The parts of the energy, what comes back above what does not: name in the dataset, label, colour."""
    ordered = sorted(channels, key=lambda channel: channel.kind == "held")
    colored = zip(ordered, itertools.cycle(_CHANNEL_COLORS))
    return (
        *((channel.name, channel.label, color) for channel, color in colored),
        ("potential", "potential", SKY),
        ("kinetic", "kinetic", BLUE),
    )


#: The parts of the energy in the order in which they are stacked: name in the dataset, label, colour.
ENERGIES: tuple[tuple[str, str, str], ...] = _stack(_channels.TABLE)

#: Settings for a printed page; ``with plt.rc_context(plot.STYLE): ...``
STYLE: Any = {
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "figure.dpi": 100,
    "savefig.dpi": 200,
}

_PREFIXES = ((1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n"))


def _scale(values: npt.ArrayLike) -> tuple[float, str]:
    """The factor and the SI prefix that make the largest of the values a number of one digit or more."""
    largest = float(np.nanmax(np.abs(values), initial=0.0))
    for factor, prefix in _PREFIXES:
        if largest * factor >= 0.5:
            return factor, prefix
    return (1.0, "") if largest == 0 else _PREFIXES[-1]


# What the functions are given ---------------------------------------------------------------------------------------


def _check(axes: Any, run: Any) -> None:
    """That the two are what they must be, and not in the other order."""
    _check_axes(axes)
    _check_run(run)


def _check_axes(axes: Any) -> None:
    if not isinstance(axes, Axes):
        raise TypeError(f"axes: Axes of Matplotlib are wanted, such as plt.subplots() makes, not {_said(axes)}")


def _check_run(run: Any) -> None:
    if not isinstance(run, Run):
        raise TypeError(f"run: a run is wanted, as footfall.run and footfall.open give it, not {_said(run)}")


def _check_dataset(name: str, data: Any, of: str) -> None:
    if not isinstance(data, xr.Dataset):
        raise TypeError(f"{name}: a dataset is wanted, as footfall.studies.{of} gives it, not {_said(data)}")


def _said(value: Any) -> str:
    return f"a list of {len(value)}" if isinstance(value, (list, tuple)) else _arguments.described(value)


def _check_sphere(data: xr.Dataset, sphere: int) -> int:
    last = data.sizes["sphere"] - 1
    if last == 0:
        return _arguments.integer("sphere", sphere, 0, 0, ", the index of the only sphere")
    return _arguments.integer("sphere", sphere, 0, last, ", an index of the body's spheres")


def _check_window(run: Run, window: Any) -> Window:
    """The window, or the whole run."""
    first, last = (float(run.dataset["time"][i]) for i in (0, -1))
    if window is None:
        return first, last
    pair = _arguments.real_array("window", window)
    if pair.shape != (2,):
        raise InvalidInput(f"window: shape {pair.shape} is not allowed: must be two times, (start, end) [s]")
    start, end = (float(time) for time in pair)
    if not (math.isfinite(start) and math.isfinite(end) and start < end):
        raise InvalidInput(f"window: ({start:g}, {end:g}) is not allowed: must be (start, end) with start < end [s]")
    if end < first or start > last:
        raise InvalidInput(f"window: ({start:g}, {end:g}) is not allowed: the run is from {first:g} s to {last:g} s")
    return start, end


def _samples(run: Run, window: Any) -> tuple[Window, xr.Dataset]:
    """The window, and the samples in it."""
    shown = _check_window(run, window)
    data = run.dataset.sel(time=slice(*shown))
    if data.sizes["time"] < 2:
        every = np.median(np.diff(run.dataset["time"].values)) if run.dataset.sizes["time"] > 1 else math.nan
        raise InvalidInput(
            f"window: ({shown[0]:g}, {shown[1]:g}) is not allowed: must hold two samples of the run, which has one "
            f"every {every:g} s"
        )
    return shown, data


def _window(run: Run, sphere: int, window: Window | None, impact: int | None) -> tuple[Window, float]:
    """The times to draw, and the one that they are counted from."""
    data = run.dataset
    sphere = _check_sphere(data, sphere)
    end = float(data["time"][-1])
    if impact is None:
        return _check_window(run, window), 0.0
    if window is not None:
        raise InvalidInput("window, impact: one of the two is wanted")
    own = [visit for visit in run.impacts if visit.sphere == sphere]
    impact = _arguments.integer("impact", impact, 0)
    if impact >= len(own):
        raise InvalidInput(f"impact: {impact} is not allowed: sphere {sphere} has {len(own)} impacts, counted from 0")
    start, stop = own[impact].touchdown, own[impact].recovered or end
    margin = 0.1 * (stop - start)
    return (start - margin, stop + margin), start


def _course(data: xr.Dataset, name: str, sphere: int, window: Window) -> tuple[Floats, Any]:
    """Times and values of a quantity of a contact: the samples, and the states at its events between them."""
    here = data["event_sphere"].values == sphere
    times = np.concatenate([data["time"].values, data["event_time"].values[here]])
    values = np.concatenate([data[name].values[:, sphere], data[f"event_{name}"].values[here]])
    order = np.argsort(times, kind="stable")
    order = order[(times[order] >= window[0]) & (times[order] <= window[1])]
    return times[order], values[order]


def _time_label(axes: Axes, times: Floats, origin: float) -> Floats:
    """Labels the axis of time, and gives the times in its unit."""
    factor, prefix = _scale(times - origin)
    axes.set_xlabel(f"time since touchdown [{prefix}s]" if origin else f"time [{prefix}s]")
    return (times - origin) * factor


# Phases -------------------------------------------------------------------------------------------------------------


def phases(run: Run, sphere: int = 0) -> list[tuple[str, float, float]]:
    """The phases of a contact in the order of time: name, start and end [s], between the exact times of the events.

    Names are flight, stick, slip and recovering; where there is no friction to stick or slip, ``pressing``.
    """
    _check_run(run)
    data = run.dataset
    sphere = _check_sphere(data, sphere)
    names = data["phase"].attrs["flag_meanings"].split()
    sampled, times = data["phase"].values[:, sphere], data["time"].values
    starts = [(float(times[0]), names[sampled[0]])]
    begun = {"touchdown": "slip", "stick": "stick", "slip": "slip", "separation": "recovering", "recovered": "flight"}
    starts += [(event.time, begun[event.kind]) for event in run.events if event.sphere == sphere]
    ends = [time for time, _ in starts[1:]] + [float(times[-1])]
    frictionless = data.attrs["friction_law"] == "none"
    found: list[tuple[str, float, float]] = []
    for (start, name), end in zip(starts, ends):
        if frictionless and name in ("stick", "slip"):
            name = "pressing"
        if end > start:
            found.append((name, start, end))
    return found


def shade_phases(
    axes: Axes, run: Run, *, sphere: int = 0, window: Window | None = None, impact: int | None = None
) -> list[Patch]:
    """Shades the phases of a contact behind what is drawn over time, and gives the patches for a legend.

    The axis of time is taken as :func:`contact_force` has made it with the same ``window`` or ``impact``.
    """
    _check(axes, run)
    shown, origin = _window(run, sphere, window, impact)
    factor, _ = _scale(np.array(shown) - origin)
    seen: dict[str, Patch] = {}
    for name, start, end in phases(run, sphere):
        start, end = max(start, shown[0]), min(end, shown[1])
        if name == "flight" or end <= start:
            continue
        axes.axvspan(
            (start - origin) * factor, (end - origin) * factor, facecolor=PHASE_SHADES[name], linewidth=0, zorder=0
        )
        seen.setdefault(name, Patch(facecolor=PHASE_SHADES[name], label=name))
    return list(seen.values())


# Motion -------------------------------------------------------------------------------------------------------------


def _gaps(data: xr.Dataset) -> Floats:
    """Of the lowest sphere: its height above the ground [m], shape (time,); negative in the ground."""
    return np.asarray(-data["depth"].values.max(axis=1))


def height(axes: Axes, run: Run, *, window: Window | None = None) -> Axes:
    """Height of the body's lowest point above the undeformed ground, over time."""
    _check(axes, run)
    _, data = _samples(run, window)
    gaps = _gaps(data)
    factor, prefix = _scale(gaps)
    if prefix == "m" and np.max(np.abs(gaps)) >= 0.02:
        factor, prefix = 100.0, "c"
    axes.axhline(0, color=GREY, linewidth=0.8)
    times = _time_label(axes, data["time"].values, 0.0)
    axes.plot(times, gaps * factor, color=BLUE)
    axes.set_xlim(times[0], times[-1])
    axes.set_ylabel(f"height of the lowest point [{prefix}m]")
    return axes


def trajectory(axes: Axes, run: Run, *, horizontal: Literal["x", "y"] = "x") -> Axes:
    """Path of the centre of mass seen from the side, with the places of its touchdowns."""
    _check(axes, run)
    data = run.dataset
    side = "xyz".index(_arguments.choice("horizontal", horizontal, ("x", "y")))
    path = data["position"].values
    touchdowns = np.array([event.state.position for event in run.events if event.kind == "touchdown"]).reshape(-1, 3)
    axes.plot(path[:, side] * 100, path[:, 2] * 100, color=BLUE, label="centre of mass")
    axes.plot(touchdowns[:, side] * 100, touchdowns[:, 2] * 100, "o", ms=4, mfc="white", color=VERMILLION,
              label="at touchdown", zorder=3)  # fmt: skip
    axes.plot(path[-1, side] * 100, path[-1, 2] * 100, "s", ms=4.5, color=BLUE, label="at the end")
    axes.set_xlabel(f"{horizontal} [cm]")
    axes.set_ylabel("z [cm]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return axes


# Forces -------------------------------------------------------------------------------------------------------------


def contact_force(
    axes: Axes,
    run: Run,
    *,
    component: Literal["normal", "x", "y", "z", "friction"] = "normal",
    sphere: int = 0,
    window: Window | None = None,
    impact: int | None = None,
    shade: bool = True,
) -> Axes:
    """Force on a sphere over time, with the phases of its contact shaded.

    Parameters
    ----------
    component
        The normal force, a component of the friction force in the world's frame, or its size.
    window
        Times to draw [s]; all by default.
    impact
        One impact of the sphere in place of a window, from 0; time is then counted from its touchdown.
    shade
        Whether to shade the phases.
    """
    _check(axes, run)
    shown, origin = _window(run, sphere, window, impact)
    _arguments.choice("component", component, ("normal", "x", "y", "z", "friction"))
    shade = _arguments.flag("shade", shade)
    if component == "normal":
        times, force = _course(run.dataset, "normal_force", sphere, shown)
        label = "normal force [N]"
    else:
        times, force = _course(run.dataset, "friction_force", sphere, shown)
        force = np.linalg.norm(force, axis=1) if component == "friction" else force[:, "xyz".index(component)]
        label = "friction force [N]" if component == "friction" else f"friction force along {component} [N]"
    if shade:
        patches = shade_phases(axes, run, sphere=sphere, window=window, impact=impact)
        axes.legend(handles=patches, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    # The axis of time has the unit that suits the window, as the shades have.
    factor, prefix = _scale(np.array(shown) - origin)
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.plot((times - origin) * factor, force, color=BLACK)
    axes.set_xlim((shown[0] - origin) * factor, (shown[1] - origin) * factor)
    axes.set_xlabel(f"time since touchdown [{prefix}s]" if origin else f"time [{prefix}s]")
    axes.set_ylabel(label)
    return axes


def force_indentation(axes: Axes, of: Run | xr.Dataset, *, sphere: int = 0, impact: int | None = None) -> Axes:
    """Normal force against indentation: of a run, or of a dataset of :func:`footfall.studies.drive`.

    An arrow shows the way round, and in a run of one visit a mark where the sphere leaves.
    """
    _check_axes(axes)
    if not isinstance(of, (Run, xr.Dataset)):
        raise TypeError(f"of: a run, or a dataset of footfall.studies.drive, is wanted, not {_said(of)}")
    if isinstance(of, Run):
        shown, _ = _window(of, sphere, None, impact)
        _, depth = _course(of.dataset, "depth", sphere, shown)
        _, force = _course(of.dataset, "normal_force", sphere, shown)
        curves = [("", depth, force)]
    else:
        curves = [(name, z, f) for name, (z, f) in _series(of, "depth", "normal_force")]
    factor, prefix = _scale(np.concatenate([depth for _, depth, _ in curves]))
    for (name, depth, force), (color, dashes) in zip(curves, _endless()):
        pressed = depth >= 0
        z, f = depth[pressed] * factor, force[pressed]
        axes.plot(z, f, color=color, linestyle=dashes, label=name or None)
        _arrow_along(axes, z, f, color)
    if isinstance(of, Run):
        left = [e.state.depth for e in of.events
                if e.kind == "separation" and e.sphere == sphere and shown[0] <= e.time <= shown[1]]  # fmt: skip
        if len(left) == 1:
            at = "zero depth" if abs(left[0]) * factor < 1e-9 else f"{left[0] * factor:.3g} {prefix}m"
            axes.plot(left[0] * factor, 0, "o", ms=5, mfc="white", color=VERMILLION, clip_on=False, zorder=4,
                      linestyle="none", label=f"contact ends at {at}")  # fmt: skip
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper left")
    axes.set_xlabel(f"indentation [{prefix}m]")
    axes.set_ylabel("normal force [N]")
    return axes


def presliding_loop(axes: Axes, data: xr.Dataset, *, direction: Literal["x", "y"] = "x") -> Axes:
    """Friction against displacement, as :func:`footfall.studies.drive` gives them: a loop where the contact is dragged
    to and fro. The force is the one on the ground, along the motion."""
    _check_axes(axes)
    _check_dataset("data", data, "drive")
    _arguments.choice("direction", direction, ("x", "y"))
    curves = list(_series(data, f"slip_displacement_{direction}", f"friction_force_{direction}"))
    factor, prefix = _scale(np.concatenate([x for _, (x, _) in curves]))
    for (name, (x, force)), (color, dashes) in zip(curves, _endless()):
        axes.plot(x * factor, -force, color=color, linestyle=dashes, label=name or None)
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.axvline(0, color=GREY, linewidth=0.8)
    if len(curves) > 1:
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    axes.set_xlabel(f"displacement [{prefix}m]")
    axes.set_ylabel("friction against the motion [N]")
    return axes


def _series(data: xr.Dataset, *names: str, study: str = "drive") -> Iterator[tuple[str, tuple[Floats, ...]]]:
    """Columns of a study, for each of its series where it has several."""
    missing = [name for name in names if name not in data]
    if missing:
        raise InvalidInput(f"dataset: has no {', '.join(missing)}; those of footfall.studies.{study} have")
    if not any("series" in data[name].dims for name in names):
        yield "", tuple(data[name].values for name in names)
        return
    for name in data["series"].values:
        one = data.sel(series=name)
        yield str(name), tuple(one[column].values for column in names)


def _endless() -> Iterator[tuple[str, Any]]:
    while True:
        yield from CURVES


def _arrow_along(axes: Axes, x: Floats, y: Floats, color: str) -> None:
    """An arrow on the rising part of a curve, a third of the way to its top."""
    top = int(np.argmax(y))
    rising = np.flatnonzero(y[:top] >= 0.5 * y[top])
    if rising.size == 0 or rising[0] == 0:
        return
    at = int(rising[0])
    axes.annotate(
        "", xy=(x[at], y[at]), xytext=(x[at - 1], y[at - 1]),
        arrowprops={"arrowstyle": "-|>", "color": color, "mutation_scale": 14, "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip


# Energy -------------------------------------------------------------------------------------------------------------


def energy(axes: Axes, run: Run, *, window: Window | None = None) -> Axes:
    """The account of energy as stacked areas, whose upper edge is the total: flat where every joule is accounted for.

    Each band is as high as its energy. A part that is negative cannot be a band of the stack: the stack starts that
    far below zero instead, and the part is hatched there. The changing stiffness is such a part where the law has made
    energy. The line on top is the total at the start, computed from nothing else.
    """
    _check(axes, run)
    _, data = _samples(run, window)
    times = _time_label(axes, data["time"].values, 0.0)
    factor, prefix = _scale(data["energy_total"].values)
    channels = _channels.of_dataset(data)
    stack = _stack(channels)
    parts = {name: data[f"energy_{name}"].values * factor for name, _, _ in stack}
    for channel in channels:
        if channel.kind == "worked":  # the others have it
            parts[channel.name] = -parts[channel.name]
    base = sum((np.minimum(part, 0) for part in parts.values()), np.zeros_like(times))
    visible = 1e-9 * max(float(np.max(np.abs(part))) for part in parts.values())
    top, below = base.copy(), np.zeros_like(times)
    for name, label, color in stack:
        part = parts[name]
        if np.any(part > visible):
            upper = top + np.maximum(part, 0)
            axes.fill_between(times, top, upper, facecolor=color, linewidth=0, label=label)
            top = upper
        if np.any(part < -visible):
            lower = below + np.minimum(part, 0)
            axes.fill_between(times, lower, below, facecolor="none", edgecolor=color, hatch="////", linewidth=0.6,
                              zorder=3, label=f"{label} (negative)")  # fmt: skip
            below = lower
    initial = float(run.dataset["energy_total"][0]) * factor
    axes.axhline(initial, color=BLACK, linewidth=1.0, linestyle=(0, (5, 2)), label="total at the start", zorder=4)
    axes.axhline(0, color=BLACK, linewidth=0.6, zorder=4)
    axes.set_xlim(times[0], times[-1])
    axes.set_ylabel(f"energy [{prefix}J]")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.01, 0.5))
    return axes


def residual(axes: Axes, run: Run) -> Axes:
    """What the account of energy does not explain, over its scale, on a logarithmic axis. Exact zeros are left out.

    Samples lie between the steps of the integration, so the error of interpolation counts here;
    ``run.energy.max_residual`` is that of the steps.
    """
    _check(axes, run)
    data = run.dataset
    size = np.abs(data["energy_residual"].values)
    size[size == 0] = np.nan
    axes.semilogy(_time_label(axes, data["time"].values, 0.0), size, ".", ms=2, color=BLUE)
    epsilon = float(np.finfo(float).eps)
    axes.axhline(epsilon, color=GREY, linewidth=1, linestyle=(0, (5, 2)))
    axes.annotate("rounding of one number", (1, epsilon), (-3, -3), xycoords=("axes fraction", "data"),
                  textcoords="offset points", ha="right", va="top", color="#555555", fontsize="small")  # fmt: skip
    low = np.nanmin(size) if np.any(np.isfinite(size)) else epsilon
    axes.set_ylim(min(low, epsilon) / 10, 10 * max(np.nanmax(size, initial=epsilon), epsilon))
    axes.set_ylabel("|residual| of the energy, relative [1]")
    return axes


# Restitution --------------------------------------------------------------------------------------------------------


def restitution(axes: Axes, data: xr.Dataset, *, logarithmic: bool = True, theory: str | None = None) -> Axes:
    """Restitution against impact speed, as :func:`footfall.studies.restitution` gives it.

    Parameters
    ----------
    logarithmic
        Whether the axis of speed is.
    theory
        A column of the dataset to draw beside the curves as points, such as ``closed_form`` or ``mueller_poeschel``.
    """
    _check_axes(axes)
    _check_dataset("data", data, "restitution")
    logarithmic = _arguments.flag("logarithmic", logarithmic)
    curves = list(_series(data, "restitution", "speed", study="restitution"))
    speed = data["speed"].values
    for (name, (e, _)), (color, dashes) in zip(curves, _endless()):
        axes.plot(speed, e, color=color, linestyle=dashes, label=name or None)
    if theory is not None:
        columns = [str(name) for name in data.data_vars if data[name].dims == data["restitution"].dims]
        if _arguments.text("theory", theory) not in columns:
            raise InvalidInput(f"theory: {theory!r} is not allowed: must be one of {', '.join(columns)}")
        for (_, (e,)), (color, _) in zip(_series(data, theory), _endless()):
            axes.plot(speed, e, "o", ms=3, mfc="none", color=color)
    if logarithmic:
        axes.set_xscale("log")
    axes.set_ylim(0, 1.02)
    axes.set_xlabel("impact speed [m/s]")
    axes.set_ylabel("coefficient of restitution [1]")
    if len(axes.get_legend_handles_labels()[0]) > 1:
        axes.legend(loc="best")
    return axes


# Pictures of the body -----------------------------------------------------------------------------------------------


def _rotate(quaternion: Floats, vector: Floats) -> Floats:
    """A vector of the body's frame in the world's."""
    w, axis = quaternion[0], quaternion[1:]
    turned = 2.0 * np.cross(axis, vector)
    return np.asarray(vector + w * turned + np.cross(axis, turned))


class _Picture:
    """The body, the ground and the forces at one time of a run, seen from the side."""

    def __init__(self, run: Run, horizontal: str, arrow: float | None) -> None:
        data = run.dataset
        self._data = data
        self._side = ["xyz".index(_arguments.choice("horizontal", horizontal, ("x", "y"))), 2]
        if arrow is not None:
            arrow = _arguments.number("arrow", arrow, "m/N", at_least=0)
        self.radii = data["sphere_radius"].values
        self._centers = data["sphere_center"].values
        self._normal = data["ground_normal"].values
        self.reach = max(float(np.linalg.norm(c)) + float(r) for c, r in zip(self._centers, self.radii))
        largest = np.max(np.hypot(data["normal_force"].values,
                                  np.linalg.norm(data["friction_force"].values, axis=2)))  # fmt: skip
        #: Metres for each newton.
        self.arrow = arrow if arrow is not None else (1.8 * self.reach / largest if largest > 0 else 0.0)

    def at(self, time: float) -> dict[str, Any]:
        """The state at a time, between the samples where need be."""
        times = self._data["time"].values
        after = int(np.clip(np.searchsorted(times, time), 1, len(times) - 1))
        span = times[after] - times[after - 1]
        share = float(np.clip((time - times[after - 1]) / span, 0, 1)) if span > 0 else 1.0
        state = {}
        for name in ("position", "orientation", "normal_force", "friction_force"):
            before, now = self._data[name].values[after - 1 : after + 1]
            state[name] = (1 - share) * before + share * now
        state["orientation"] = state["orientation"] / np.linalg.norm(state["orientation"])
        return state

    def draw(self, axes: Axes, time: float, at: Floats | None = None) -> list[Any]:
        """Draws the body, with its centre at ``at`` of the picture where that is given, and gives what was drawn."""
        state = self.at(time)
        shift = np.zeros(2) if at is None else at - state["position"][self._side]
        drawn: list[Any] = []
        centres = [state["position"] + _rotate(state["orientation"], c) for c in self._centers]
        if len(centres) > 1:
            flat = np.array([c[self._side] + shift for c in [state["position"], *centres]])
            for end in flat[1:]:
                drawn += axes.plot([flat[0, 0], end[0]], [flat[0, 1], end[1]], color=GREY, linewidth=1.2, zorder=2)
        for i, (centre, radius) in enumerate(zip(centres, self.radii)):
            flat_centre = centre[self._side] + shift
            drawn.append(axes.add_patch(Circle(tuple(flat_centre), radius, facecolor="#DCEAF5", edgecolor=BLUE,
                                               linewidth=1.1, zorder=3)))  # fmt: skip
            # A line that turns with the sphere shows how it rolls.
            mark = _rotate(state["orientation"], np.eye(3)[2]) * radius
            flat_mark = flat_centre + mark[self._side]
            drawn += axes.plot([flat_centre[0], flat_mark[0]], [flat_centre[1], flat_mark[1]], color=BLUE,
                               linewidth=0.9, zorder=4)  # fmt: skip
            bottom = (centre - radius * self._normal)[self._side] + shift
            for force, color in ((state["normal_force"][i] * self._normal, VERMILLION),
                                 (state["friction_force"][i], BLACK)):  # fmt: skip
                tip = bottom + self.arrow * force[self._side]
                # A quiver's head shrinks with a short arrow.
                drawn.append(axes.quiver(*bottom, *(tip - bottom), angles="xy", scale_units="xy", scale=1, color=color,
                                         units="inches", width=0.02, headwidth=4.5, headlength=5, headaxislength=5,
                                         minlength=0.5, zorder=5))  # fmt: skip
        return drawn

    def ground(self, axes: Axes, left: float, right: float, through: tuple[float, float]) -> float:
        """The ground's section from left to right, through a point of the picture. Gives how far it rises between."""
        across, up = self._normal[self._side]
        x = np.array([left, right])
        z = through[1] - across / up * (x - through[0])
        axes.fill_between(x, z, np.min(z) - 10 * self.reach, facecolor="#E9E4DC", linewidth=0, zorder=1)
        axes.plot(x, z, color="#6B5E4B", linewidth=1, zorder=1)
        return float(abs(z[1] - z[0]))

    def below(self, position: Floats) -> float:
        """The height of the ground straight below a point [m]."""
        height = float(self._data["ground_height"])
        return float((height - self._normal[0] * position[0] - self._normal[1] * position[1]) / self._normal[2])


def _legend_of_forces(axes: Axes) -> None:
    handles = [Line2D([], [], color=VERMILLION, lw=1.6, label="normal force"),
               Line2D([], [], color=BLACK, lw=1.6, label="friction")]  # fmt: skip
    axes.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)


#: More frames than this are no film that somebody looks at: the argument was mistaken for another.
_MOST_FRAMES = 1000


def filmstrip(
    axes: Axes,
    run: Run,
    *,
    times: Sequence[float] | None = None,
    frames: int = 8,
    horizontal: Literal["x", "y"] = "x",
    arrow: float | None = None,
) -> Axes:
    """The body at several times, side by side, with arrows for the forces on it. Lengths are to scale, arrows apart.

    In each frame the ground below the body's centre is at zero, on a slope as well.

    Parameters
    ----------
    times
        [s]; by default ``frames`` of them, evenly through the first impact, or the whole run where there is none.
    horizontal
        The axis of the world that goes to the right.
    arrow
        Length of an arrow for each newton [m/N]; by default the largest force is nearly as long as the body.
    """
    _check(axes, run)
    data = run.dataset
    frames = _arguments.integer("frames", frames, 1, _MOST_FRAMES)
    if times is not None:
        times = _arguments.column("times", times)
    else:
        end = float(data["time"][-1])
        start, stop = (run.impacts[0].touchdown, run.impacts[0].recovered or end) if run.impacts else (0.0, end)
        times = np.linspace(start, stop, frames).tolist()
    if len(times) == 0 or min(times) < data["time"].values[0] or max(times) > data["time"].values[-1]:
        raise InvalidInput(f"times: must be from {data['time'].values[0]:g} s to {data['time'].values[-1]:g} s")
    picture = _Picture(run, horizontal, arrow)
    pitch = 2.9 * picture.reach
    origin = times[0]
    factor, prefix = _scale(np.array(times) - origin)
    highest, rise = 0.0, 0.0
    for i, time in enumerate(times):
        position = picture.at(time)["position"]
        above = float(position[2]) - picture.below(position)
        rise = picture.ground(axes, (i - 0.5) * pitch, (i + 0.5) * pitch, (i * pitch, 0.0))
        picture.draw(axes, time, np.array([i * pitch, above]))
        highest = max(highest, above + 1.15 * picture.reach)
    axes.set_aspect("equal")
    axes.set_xlim(-0.5 * pitch, (len(times) - 0.5) * pitch)
    axes.set_ylim(-0.35 * picture.reach - rise / 2, max(highest, rise / 2))
    axes.set_xticks([i * pitch for i in range(len(times))], [f"{(time - origin) * factor:.3g}" for time in times])
    axes.set_xlabel(f"time after {origin:.6g} s [{prefix}s]")
    axes.yaxis.set_major_formatter(lambda value, _: f"{value * 100:g}")
    axes.set_ylabel("height above\nthe ground [cm]")
    axes.grid(visible=False)
    _legend_of_forces(axes)
    return axes


def animation(
    run: Run,
    path: str | os.PathLike[str],
    *,
    window: Window | None = None,
    seconds: float = 6.0,
    frames_per_second: int = 20,
    horizontal: Literal["x", "y"] = "x",
    arrow: float | None = None,
    width: float = 6.4,
    progress: Callable[[int, int], object] | None = None,
) -> Path:
    """Writes a film of the body with arrows for the forces on it: a GIF, or an MP4 where ffmpeg is installed.

    An impact lasts milliseconds: to see its forces, give a ``window`` around it.

    Parameters
    ----------
    path
        Ends in ``.gif`` or ``.mp4``.
    window
        Times of the run to show [s]; all by default.
    seconds
        That the film lasts.
    width
        Of the picture [inch], at 100 dots per inch.
    progress
        Called with the number of the frame and how many there are.

    Raises
    ------
    InvalidInput
        Where the file's ending is another, or ffmpeg is missing for an MP4.
    """
    _check_run(run)
    path = _arguments.path("path", path)
    seconds = _arguments.number("seconds", seconds, "s", above=0)
    frames_per_second = _arguments.integer("frames_per_second", frames_per_second, 1, _MOST_FRAMES)
    width = _arguments.number("width", width, "inch", at_least=1, at_most=100)
    _arguments.function("progress", progress)
    if path.suffix not in (".gif", ".mp4"):
        raise InvalidInput(f"path: {path.name!r} is not allowed: must end in .gif or .mp4")
    if path.suffix == ".mp4" and not _animation.writers.is_available("ffmpeg"):
        raise InvalidInput(
            f"path: {path.name!r} is not allowed: an MP4 needs ffmpeg, which is not installed; a .gif does not"
        )
    if not path.absolute().parent.is_dir():
        raise _arguments.os_error(2, f"cannot write {path}: there is no folder {path.parent}")
    data = run.dataset
    picture = _Picture(run, horizontal, arrow)
    _, part = _samples(run, window)
    side = "xyz".index(horizontal)
    x, z = part["position"].values[:, side], part["position"].values[:, 2]
    left, right = x.min() - 1.6 * picture.reach, x.max() + 1.6 * picture.reach
    top = z.max() + 1.3 * picture.reach
    flat = float(data["ground_normal"][2]) == 1.0
    bottom = float(data["ground_height"]) - 0.3 * picture.reach if flat else z.min() - 1.5 * picture.reach
    tall = width * (top - bottom) / (right - left)
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(width, min(max(tall + 0.9, 2.0), 6.4)), dpi=100, layout="constrained")
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    picture.ground(axes, left, right, (0.0, picture.below(np.zeros(3))))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(lambda value, _: f"{value * 100:g}")
    axes.set_xlabel(f"{horizontal} [cm]")
    axes.set_ylabel("z [cm]")
    axes.grid(visible=False)
    _legend_of_forces(axes)
    # The layout is that of the first frame: finding it anew for each costs as much as drawing it.
    figure.canvas.draw()
    figure.set_layout_engine("none")
    clock = axes.text(0.99, 0.97, "", transform=axes.transAxes, ha="right", va="top", family="monospace")
    count = max(2, math.ceil(seconds * frames_per_second))
    moments = np.linspace(part["time"].values[0], part["time"].values[-1], count)
    writer: Any = (
        _animation.PillowWriter(fps=frames_per_second)
        if path.suffix == ".gif"
        else _animation.FFMpegWriter(fps=frames_per_second)
    )
    drawn: list[Any] = []
    try:
        with writer.saving(figure, str(path), 100):
            for i, moment in enumerate(moments):
                for artist in drawn:
                    artist.remove()
                drawn = picture.draw(axes, float(moment))
                clock.set_text(f"{moment:.4f} s")
                writer.grab_frame()
                if progress is not None:
                    progress(i + 1, count)
    finally:
        plt.close(figure)
    return path

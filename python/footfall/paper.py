"""The figures of Azad & Featherstone 2010, computed, and a page that holds the paper's text against the numbers.

    python -m footfall.paper OUT/

draws figures 2 to 4, 6 to 11 and 13 to 16 as OUT/figure-02.png and so on, with the paper's parameters, and writes
OUT/index.html. Each sentence of the paper that a number can decide has a mark, computed here from the runs. Figures 1,
5 and 12 are drawings.
"""

from __future__ import annotations

import argparse
import html
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import xarray as xr

from footfall import _arguments, _channels, studies
from footfall._channels import Channel
from footfall.results import Run, run
from footfall.scenario import Scenario, shipped_scenarios

try:
    from footfall import plot
except ImportError as error:
    if __name__ != "__main__":
        raise
    raise SystemExit(f"error: {error}") from None

import matplotlib.pyplot as plt  # after footfall.plot, which says how to install it
from matplotlib.figure import Figure as Canvas

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Check:
    """One sentence of the paper, and what the numbers say about it."""

    claim: str
    """What the paper says, in its words where they are in quotation marks."""
    section: str
    """Where it says so."""
    holds: bool | None
    """Whether the numbers bear it out; None where nothing here can decide it."""
    measured: str
    """The numbers."""

    @property
    def verdict(self) -> str:
        """holds, differs or not decided."""
        return "not decided" if self.holds is None else "holds" if self.holds else "differs"


@dataclass(frozen=True)
class Figure:
    """A figure of the paper."""

    number: int
    caption: str
    draw: Callable[[], Canvas]
    checks: list[Check]
    note: str = ""
    """What a reader has to know who compares it with the paper's."""
    file: str = field(init=False)
    """figure-02.png and so on."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "file", f"figure-{self.number:02d}.png")


# What the figures are drawn from --------------------------------------------------------------------------------------


class Runs:
    """The runs and studies behind the figures, each computed when it is first asked for."""

    #: Between the samples of the runs of a first bounce [s].
    FINE = 2e-6

    def _shipped(self, name: str) -> Run:
        return run(shipped_scenarios()[name])

    def _first_bounce(self, whole: Run) -> Run:
        tables = Scenario.parse(whole.scenario.text).to_dict()
        recovered = whole.impacts[0].recovered
        assert recovered is not None
        tables["time"] = {"end": recovered + 3e-4, "sample": self.FINE}
        return run(tables)

    @cached_property
    def impact(self) -> Run:
        """Figure 7."""
        return self._shipped("single-impact")

    @cached_property
    def classical_impact(self) -> Run:
        """Figure 6."""
        return self._shipped("single-impact-classical")

    @cached_property
    def bouncing(self) -> Run:
        """Figures 8, 9 and 11."""
        return self._shipped("bouncing-sphere")

    @cached_property
    def first_bounce(self) -> Run:
        """Figure 10."""
        return self._first_bounce(self.bouncing)

    @cached_property
    def rolling(self) -> Run:
        """Figures 13, 15 and 16."""
        return self._shipped("rolling-sphere")

    @cached_property
    def first_rolling_bounce(self) -> Run:
        """Figure 14."""
        return self._first_bounce(self.rolling)

    @cached_property
    def restitution_2(self) -> xr.Dataset:
        return studies.restitution_figure(2)

    @cached_property
    def restitution_3(self) -> xr.Dataset:
        return studies.restitution_figure(3)

    @cached_property
    def restitution_4(self) -> xr.Dataset:
        return studies.restitution_figure(4)

    @cached_property
    def slow(self) -> xr.Dataset:
        """The two nonlinear laws of figure 2 down to speeds where nothing is lost any more."""
        laws = {
            "paper": "azad-featherstone:stiffness=8.5e6,damping=3.1e3",
            "classical": "hunt-crossley:stiffness=8.5e6,damping=3.1e6",
        }
        return studies.restitution(laws, 0.154, [1e-12, 1e-9, 1e-6, 1e-3])


# Measures -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Crossing:
    """How a force passes an event: what it is before and after, and its slope."""

    kind: str
    time: float
    before: float
    after: float
    slope_before: float
    slope_after: float

    @property
    def jump(self) -> float:
        return self.after - self.before


def crossings(fine: Run, name: str, component: int | None = None) -> list[Crossing]:
    """A force at the events of a first bounce. Between events the laws are smooth, so only there can it jump.

    Before the event the force is continued from the samples; after it is that of the event, which is in the phase that
    it begins. Of events at the same moment only the last counts.
    """
    data = fine.dataset
    times, force = data["time"].values, data[name].values[:, 0]
    force = force if component is None else force[:, component]
    events = [e for i, e in enumerate(fine.events) if i + 1 == len(fine.events) or fine.events[i + 1].time > e.time]
    found = []
    for event in events:
        value = getattr(event.state, name)
        after = float(value if component is None else value[component])
        first = int(np.searchsorted(times, event.time, side="right"))
        last = int(np.searchsorted(times, event.time, side="left")) - 1
        steps = np.array([last - 2, last - 1, last])
        line = np.polynomial.Polynomial.fit(times[steps] - event.time, force[steps], 2)
        slope_after = (force[first + 1] - force[first]) / (times[first + 1] - times[first])
        found.append(Crossing(event.kind, event.time, float(line(0)), after, float(line.deriv()(0)), slope_after))
    return found


def off_line(speed: Floats, e: Floats) -> float:
    """The largest distance of e from the straight line in ln(speed) that is nearest to it by least squares."""
    x = np.log(speed)
    return float(np.max(np.abs(e - np.polynomial.Polynomial.fit(x, e, 1)(x))))


def dissipated(data: xr.Dataset) -> Floats:
    """All that dampers and clutch have taken [J], (16), (28) and (29)."""
    return np.sum([data[f"energy_{channel.name}"].values for channel in _of_kind(data, "taken")], axis=0)


def _of_kind(data: xr.Dataset, kind: str) -> list[Channel]:
    return [channel for channel in _channels.of_dataset(data) if channel.kind == kind]


def clutch_as_printed(data: xr.Dataset) -> float:
    """(29) as the paper prints it [J], from the force and the motion alone: V_clutch dt is V_sph dt - du, (30)."""
    force, velocity = data["friction_force"].values[:, 0], data["slip_velocity"].values[:, 0]
    slipped = 0.5 * (velocity[1:] + velocity[:-1]) * np.diff(data["time"].values)[:, None]
    slipped -= np.diff(data["bristle"].values[:, 0], axis=0)
    # In the air the bristle goes back by itself and the clutch has nothing to hold.
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * slipped))


def body(data: xr.Dataset) -> Floats:
    """Energy of the body [J], (18) and (37)."""
    return np.asarray((data["energy_kinetic"] + data["energy_potential"]).values)


def _never_falls(values: Floats, slack: float) -> bool:
    return bool(np.all(np.diff(values) >= -slack))


def _total_is_constant(whole: Run) -> Check:
    """(15) from the paper's own parts, not from the ledger's total."""
    data = whole.dataset
    springs = (data["energy_normal_spring"] + data["energy_tangential_spring_paper"]).values
    total = dissipated(data) + springs + body(data)
    spread = float(np.ptp(total)) / total[0]
    return Check(
        "The sum of dissipated and stored energy, that of the body included, must be constant (15): “the amount of "
        "total energy is constant during the simulation and does not change”.",
        "2.3 and 4",
        spread < 1e-9,
        f"The sum of (16), (17), (18) or (37), (28), (29) and (33) stays at {1e3 * total[0]:.3f} mJ within "
        f"{spread:.1e} of it.",
    )


# Restitution: figures 2 to 4 ------------------------------------------------------------------------------------------


def _restitution(data: xr.Dataset, labels: dict[str, str], logarithmic: bool) -> Canvas:
    figure, axes = plt.subplots(figsize=(5.6, 3.6), layout="constrained")
    named = data.assign_coords(series=[labels.get(str(name), str(name)) for name in data["series"].values])
    plot.restitution(axes, named, logarithmic=logarithmic)
    if not logarithmic:
        axes.set_xlim(left=0)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def figure_2(runs: Runs) -> Figure:
    data = runs.restitution_2
    curves = {str(name): data["restitution"].sel(series=name).values for name in data["series"].values}
    slow = {name: runs.slow["restitution"].sel(series=name).values for name in ("paper", "classical")}
    speed = data["speed"].values
    return Figure(
        2,
        "Coefficient of restitution against impact velocity under three laws, without gravity.",
        lambda: _restitution(data, {"paper": "the paper's law (13)", "classical": "classical law (2)"}, False),
        [
            Check(
                "“for the linear model, the coefficient of restitution is constant at all velocities”",
                "2.1",
                float(np.ptp(curves["linear"])) < 1e-9,
                f"e = {curves['linear'][0]:.4f}; from {speed[0]:g} to {speed[-1]:g} m/s it varies by "
                f"{np.ptp(curves['linear']):.0e}.",
            ),
            Check(
                "“for the nonlinear contact models, this coefficient decreases with increasing impact velocity”",
                "2.1",
                all(bool(np.all(np.diff(curves[name]) < 0)) for name in ("paper", "classical")),
                f"The paper's law: from {curves['paper'][0]:.3f} to {curves['paper'][-1]:.3f}; the classical law: from "
                f"{curves['classical'][0]:.3f} to {curves['classical'][-1]:.3f}; at each of the {len(speed)} speeds "
                "lower than at the one before.",
            ),
            Check(
                "The coefficient should “tend to unity at low impact velocities”, as Goldsmith measured.",
                "2.1",
                all(bool(np.all(np.diff(e) < 0)) and e[0] > 0.99 for e in slow.values()),
                f"At 1 mm/s the paper's law has e = {slow['paper'][-1]:.4f}, the classical law "
                f"{slow['classical'][-1]:.6f}; at 1 pm/s {slow['paper'][0]:.4f} and 1 within "
                f"{1 - slow['classical'][0]:.0e}. Under the paper's law 1 − e falls only as the fifth root of the "
                "speed.",
            ),
        ],
        "The paper does not give the linear law's parameters; here it is as deep at 1 m/s as the spring of (10) alone, "
        "and has the e of the paper's law there.",
    )


def figure_3(runs: Runs) -> Figure:
    data = runs.restitution_3
    speed = data["speed"].values
    off = {str(name): off_line(speed, data["restitution"].sel(series=name).values) for name in data["series"].values}
    ours = {name: value for name, value in off.items() if name != "classical"}
    worst = max(ours, key=lambda name: ours[name])
    labels = {name: f"$D_n$ = {float(name.removeprefix('D_n=')):g} N s/m$^{{1.5}}$" for name in ours}
    labels["classical"] = "classical law (2)"
    listed = ", ".join(f"{value:.3f} ({name.replace('=', ' = ')})" for name, value in off.items())
    return Figure(
        3,
        "Coefficient of restitution against the logarithm of the impact velocity: the paper's law with several "
        "dampings, and the classical law.",
        lambda: _restitution(data, labels, True),
        [
            Check(
                "“our model represents a linear relation between the coefficient of restitution and the logarithm of "
                "impact velocity for different values of damping coefficient”",
                "2.1",
                max(ours.values()) < 0.01,
                f"Distance of e from the nearest straight line over {speed[0]:g} to {speed[-1]:g} m/s: {listed}; "
                "within 0.01 would count as straight. The curve is that straight only around its inflection, where e "
                "is between 0.66 and 0.26; towards low speeds it bends up to 1.",
            ),
            Check(
                "This is “in contrast with curves that we obtain from the classical model”.",
                "2.1",
                max(ours.values()) < 0.5 * off["classical"],
                f"The least straight curve of the paper's law ({worst.replace('=', ' = ')}) is off its line by "
                f"{ours[worst]:.3f}, that of the classical law by {off['classical']:.3f}.",
            ),
        ],
        "The paper does not give its values of D_n; here they are 10³, 3.1·10³ (that of figure 7), 10⁴ and 3.1·10⁴.",
    )


def figure_4(runs: Runs) -> Figure:
    data = runs.restitution_4
    speed = data["speed"].values
    curves = {str(name): data["restitution"].sel(series=name).values for name in data["series"].values}
    off = {name: off_line(speed, e) for name, e in curves.items()}
    return Figure(
        4,
        "Coefficient of restitution of a steel sphere on (A) cast iron, (B) cork, (C) brass and (D) lead: the curves "
        "of the model.",
        lambda: _restitution(data, {name: f"({name[0]}) {name[2:].replace('-', ' ')}" for name in curves}, True),
        [
            Check(
                "The coefficient falls with the logarithm of the velocity for all four pairs.",
                "2.1",
                all(bool(np.all(np.diff(e) < 0)) for e in curves.values()),
                "e from " + ", ".join(f"{e[0]:.3f} to {e[-1]:.3f} ({name[0]})" for name, e in curves.items()) + ".",
            ),
            Check(
                "The calculated curves are straight lines: the measured ones “still show a linear behaviour but their "
                "slopes are a bit different from our calculated one”.",
                "2.1",
                max(off.values()) < 0.01,
                "Distance from the nearest straight line: "
                + ", ".join(f"{value:.3f} ({name[0]})" for name, value in off.items())
                + f", over {speed[0]:g} to {speed[-1]:g} m/s; within 0.01 would count as straight.",
            ),
            Check(
                "“our model fits the empirical results more accurately than the classical model”",
                "2.1",
                None,
                "The measured curves are not in the text, so they are not drawn and nothing here is compared with "
                "them.",
            ),
        ],
        "The dashed, measured curves of the paper are not drawn. The paper gives materials and radii. Elastic "
        "constants and density are those of footfall material; the damping is chosen so that e at 1 m/s is 0.7 (A), "
        "0.5 (B), 0.6 (C) and 0.25 (D), for illustration.",
    )


# One impact: figures 6 and 7 ------------------------------------------------------------------------------------------


def _loop(of: Run) -> Canvas:
    figure, axes = plt.subplots(figsize=(4.6, 3.4), layout="constrained")
    plot.force_indentation(axes, of)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    return figure


def _loop_area(of: Run) -> Check:
    """The loop's area against the kinetic energy that is missing, which is measured in flight."""
    data, visit = of.dataset, of.impacts[0]
    z, f = data["depth"].values[:, 0], data["normal_force"].values[:, 0]
    area = float(np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(z)))
    assert visit.speed_out is not None
    lost = 0.5 * float(data["mass"]) * (visit.speed_in**2 - visit.speed_out**2)
    return Check(
        "The loop encloses what the damper dissipates (16), the only dissipative part.",
        "2.3",
        abs(area - lost) < 1e-3 * lost,
        f"Area {1e3 * area:.3f} mJ; the sphere has lost {1e3 * lost:.3f} mJ (e = {visit.restitution:.4f}).",
    )


def _left_at(of: Run) -> tuple[float, float]:
    """Depth where the force has come to zero, and the largest depth [m]."""
    left = next(event for event in of.events if event.kind == "separation")
    return float(left.state.depth), of.impacts[0].peak_indentation


def figure_6(runs: Runs) -> Figure:
    left, deepest = _left_at(runs.classical_impact)
    return Figure(
        6,
        "Contact force against ground deformation under the classical law (2), k = 8.5·10⁶, λ = 3.1·10⁶; sphere of "
        "r = 1.65 cm, m = 154 g, at 1 m/s.",
        lambda: _loop(runs.classical_impact),
        [
            Check(
                "Under the classical law the force reaches zero only together with z (the comparison of section 2.2).",
                "2.2",
                left < 1e-6 * deepest,
                f"Contact ends at a depth of zero, within {max(left, 1e-15):.0e} m; the largest is {1e3 * deepest:.4f} "
                f"mm, the peak force {runs.classical_impact.impacts[0].peak_normal_force:.1f} N.",
            ),
            _loop_area(runs.classical_impact),
        ],
    )


def figure_7(runs: Runs) -> Figure:
    left, deepest = _left_at(runs.impact)
    lowest = float(runs.impact.dataset["normal_force"].min())
    return Figure(
        7,
        "Contact force against ground deformation under the paper's law (13), (14), K_n = 8.5·10⁶, D_n = 3.1·10³; the "
        "same sphere.",
        lambda: _loop(runs.impact),
        [
            Check(
                "“the normal force reaches zero before z”: contact “ends before the ground has fully recovered to zero "
                "deformation”",
                "2.2",
                left > 1e-6 * deepest,
                f"Contact ends at a depth of {1e3 * left:.4f} mm, {100 * left / deepest:.0f} % of the largest, "
                f"{1e3 * deepest:.4f} mm; the peak force is {runs.impact.impacts[0].peak_normal_force:.1f} N.",
            ),
            Check(
                "(14) “ensures that f in Eq. (3) is never negative”",
                "2.2",
                lowest >= 0,
                f"The least force of {runs.impact.dataset.sizes['time']} samples is {lowest:g} N.",
            ),
            _loop_area(runs.impact),
        ],
    )


# A bouncing sphere: figures 8 to 11 -----------------------------------------------------------------------------------


def _one(draw: Callable[[Any], object], size: tuple[float, float] = (6.4, 3.0)) -> Canvas:
    figure, axes = plt.subplots(figsize=size, layout="constrained")
    draw(axes)
    return figure


def _tops(whole: Run) -> Floats:
    """Largest height of the sphere's bottom before each touchdown [m]."""
    data = whole.dataset
    times, bottom = data["time"].values, -data["depth"].values[:, 0]
    bounds = [times[0], *(visit.touchdown for visit in whole.impacts)]
    return np.array([bottom[(times >= a) & (times <= b)].max() for a, b in zip(bounds, bounds[1:])])


def figure_8(runs: Runs) -> Figure:
    data = runs.bouncing.dataset
    bottom, speed = -float(data["depth"][0, 0]), float(np.linalg.norm(data["velocity"][0]))
    tops = _tops(runs.bouncing)
    fall = float(np.sqrt(2 * tops[0] / 9.81))
    touchdown = runs.bouncing.impacts[0].touchdown
    return Figure(
        8,
        "Height of the lowest point of a bouncing sphere, K_n = 8.5·10⁶, D_n = 3.1·10³.",
        lambda: _one(lambda axes: plot.height(axes, runs.bouncing, window=(0.0, 1.0))),
        [
            Check(
                "The sphere is “released without initial velocity from initial height of 10cm, measured from the "
                "bottom of the sphere”.",
                "2.2",
                abs(bottom - 0.1) < 1e-12 and speed == 0 and abs(touchdown - fall) < 1e-9,
                f"Bottom at {100 * bottom:.12g} cm, speed {speed:g} m/s; it touches down after {touchdown:.6f} s, as "
                f"free fall has it ({fall:.6f} s).",
            ),
            Check(
                "It bounces, lower each time (figure 8).",
                "2.2",
                len(tops) > 3 and bool(np.all(np.diff(tops) < 0)),
                f"{len(tops) - 1} bounces, up to " + ", ".join(f"{100 * top:.3g}" for top in tops[1:5]) + " cm and so "
                f"on; the last touchdown is at {runs.bouncing.impacts[-1].touchdown:.4f} s.",
            ),
        ],
    )


def figure_9(runs: Runs) -> Figure:
    force = runs.bouncing.dataset["normal_force"].values[:, 0]
    peaks = np.array([visit.peak_normal_force for visit in runs.bouncing.impacts])
    weight = 0.154 * 9.81
    return Figure(
        9,
        "Normal force on the bouncing sphere.",
        lambda: _one(lambda axes: plot.contact_force(axes, runs.bouncing, window=(0.0, 1.0), shade=False)),
        [
            Check(
                "The force is never negative (14).",
                "2.2",
                float(force.min()) >= 0,
                f"The least of {force.size} samples is {force.min():g} N.",
            ),
            Check(
                "Each bounce has a lower peak than the one before, and in the end the ground carries the weight "
                "(figure 9).",
                "2.2",
                bool(np.all(np.diff(peaks) < 0)) and abs(force[-1] - weight) < 1e-6 * weight,
                "Peaks of " + ", ".join(f"{peak:.1f}" for peak in peaks[:5]) + " N and so on; in the end "
                f"{force[-1]:.6f} N, "
                f"where m g = {weight:.6f} N.",
            ),
        ],
    )


def figure_10(runs: Runs) -> Figure:
    fine = runs.first_bounce
    force = fine.dataset["normal_force"].values[:, 0]
    peak = fine.impacts[0].peak_normal_force
    across = crossings(fine, "normal_force")
    jump = max(abs(crossing.jump) for crossing in across)
    begins = next(crossing for crossing in across if crossing.kind == "touchdown")
    ends = next(crossing for crossing in across if crossing.kind == "separation")
    return Figure(
        10,
        "The first bounce of figure 9.",
        lambda: _one(lambda axes: plot.contact_force(axes, fine, impact=0), (5.2, 3.3)),
        [
            Check(
                "“the force is continuous and starts from zero at the beginning of the contact and comes back to zero”",
                "2.2",
                jump < 1e-3 * peak and abs(begins.after) < 1e-3 * peak and ends.after == 0,
                f"{begins.after:.0e} N at touchdown, {peak:.1f} N at most, {ends.after:g} N when contact ends; the "
                f"largest jump at an event is {jump:.0e} N.",
            ),
            Check(
                "It comes back to zero “smoothly”.",
                "2.2",
                abs(ends.slope_before - ends.slope_after) < 1e-2 * peak / 1e-3,
                "There is no jump, but a corner: the force reaches zero with a slope of "
                f"{1e-3 * ends.slope_before:.0f} N/ms, where (14) cuts it off, and stays at zero from then on.",
            ),
            Check(
                "“it is not sticky (negative) during the contact”",
                "2.2",
                float(force.min()) >= 0,
                f"The least of {force.size} samples, {1e6 * Runs.FINE:g} µs apart, is {force.min():g} N.",
            ),
        ],
    )


def _energies(whole: Run, window: plot.Window) -> Canvas:
    """The three curves of the paper above, the account in bands below."""
    figure, (curves, bands) = plt.subplots(
        2, 1, figsize=(7.2, 5.4), layout="constrained", sharex=True, height_ratios=(1, 1.3)
    )
    data = whole.dataset.sel(time=slice(*window))
    times = data["time"].values
    stored = body(data) + (data["energy_normal_spring"] + data["energy_tangential_spring_paper"]).values
    taken = dissipated(data)
    lines = (("total", taken + stored), ("stored (body and springs)", stored), ("dissipated", taken))
    for (name, values), (color, dashes) in zip(lines, plot.CURVES):
        curves.plot(times, 1e3 * values, color=color, linestyle=dashes, label=name)
    curves.set_ylabel("energy [mJ]")
    curves.set_ylim(0, 1.1e3 * float(np.max(taken + stored)))
    curves.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    plot.energy(bands, whole, window=window)
    return figure


def figure_11(runs: Runs) -> Figure:
    data = runs.bouncing.dataset
    taken = dissipated(data)
    other = float(np.max(np.abs(data["energy_tangential_damper"].values) + np.abs(data["energy_clutch"].values)))
    return Figure(
        11,
        "Total, dissipated and stored energy of the bouncing sphere; below, every part of it as a band.",
        lambda: _energies(runs.bouncing, (0.0, 1.0)),
        [
            _total_is_constant(runs.bouncing),
            Check(
                "“The only dissipative component in this model is the damper”, and the record of it never decreases.",
                "2.3",
                other == 0 and _never_falls(taken, 1e-15),
                f"Of {1e3 * data['energy_total'].values[0]:.3f} mJ the normal damper has taken {1e3 * taken[-1]:.3f} "
                f"mJ in the end; everything else {other:g}.",
            ),
        ],
        "Stored energy is that of springs and body together, as in (15). Potential energy is zero where the centre of "
        "mass would be at the height of the ground.",
    )


# A rolling sphere: figures 13 to 16 -----------------------------------------------------------------------------------


def figure_13(runs: Runs) -> Figure:
    force = runs.rolling.dataset["friction_force"].values[:, 0, :]
    difference = float(np.max(np.abs(force[:, 0] - force[:, 1])))
    return Figure(
        13,
        "Friction force in the x direction on a sphere thrown sideways.",
        lambda: _one(lambda axes: plot.contact_force(axes, runs.rolling, component="x", shade=False)),
        [
            Check(
                "“friction forces in both x and y directions are the same”",
                "4",
                difference < 1e-9 * float(np.max(np.abs(force))),
                f"They differ by at most {difference:.1g} N, of {np.max(np.abs(force[:, 0])):.2f} N.",
            ),
        ],
        "The paper names neither the direction of the force on the sphere nor its sign: here it is the force on the "
        "sphere, negative where it brakes.",
    )


def figure_14(runs: Runs) -> Figure:
    fine = runs.first_rolling_bounce
    visit = fine.impacts[0]
    across = crossings(fine, "friction_force", 0)
    largest = float(np.max(np.abs(fine.dataset["friction_force"].values[:, 0, 0])))
    at_end = next(crossing for crossing in across if crossing.kind == "separation")
    before_end = max(abs(crossing.jump) for crossing in across if crossing.kind not in ("separation", "recovered"))
    corners = [crossing for crossing in across if crossing.kind in ("stick", "slip")]
    corner = max(corners, key=lambda c: abs(c.slope_after - c.slope_before))
    spells = [phase for phase in plot.phases(fine) if phase[0] in ("slip", "stick")]
    order = [name for name, _, _ in spells]
    sticks = next((spell for spell in spells if spell[0] == "stick"), ("stick", np.nan, np.nan))
    stuck = next(event.state for event in fine.events if event.kind == "stick")
    peak = visit.peak_normal_force
    other = runs.bouncing.impacts[0]
    return Figure(
        14,
        "Friction force in the x direction at the first bounce.",
        lambda: _one(lambda axes: plot.contact_force(axes, fine, component="x", impact=0), (5.4, 3.4)),
        [
            Check(
                "“the friction force is completely continuous”",
                "4",
                abs(at_end.jump) < 1e-3 * largest and before_end < 1e-3 * largest,
                f"Up to the end of contact it is: the largest jump at an event is {before_end:.0e} N. At the end it "
                f"jumps from {at_end.before:.3f} N to {at_end.after:g}, {100 * abs(at_end.jump) / largest:.2f} % of "
                "the largest force: the viscous term of (27) does not vanish with the normal force, and without "
                "contact there is no friction.",
            ),
            Check(
                "It is “smooth”.",
                "4",
                all(abs(c.slope_after - c.slope_before) < 1e-2 * largest / 1e-3 for c in corners),
                "It has corners where slip and stick meet: the largest is at the change to "
                f"{corner.kind}, {1e3 * (corner.time - visit.touchdown):.3f} ms after touchdown, where the slope goes "
                f"from {1e-3 * corner.slope_before:.1f} to {1e-3 * corner.slope_after:.1f} N/ms.",
            ),
            Check(
                "“the contact starts with slipping”, then the sphere sticks, “and then again starts slipping until the "
                "end of the contact”",
                "4",
                order == ["slip", "stick", "slip"],
                "Phases until contact ends: "
                + ", ".join(f"{name} {1e3 * (end - start):.3f} ms" for name, start, end in spells)
                + ".",
            ),
            Check(
                "It sticks “as the normal force approaches its maximum value”.",
                "4",
                abs(stuck.normal_force - peak) < 0.02 * peak,
                f"It begins to stick at a normal force of {stuck.normal_force:.1f} N; the maximum is {peak:.1f} N.",
            ),
            Check(
                "It sticks “for less than 1ms”.",
                "4",
                bool(sticks[2] - sticks[1] < 1e-3),
                f"For {1e3 * (sticks[2] - sticks[1]):.3f} ms.",
            ),
        ],
        "For the normal force the paper points to figure 10, where the sphere falls from 10 cm below its bottom "
        f"({other.speed_in:.3f} m/s, peak {other.peak_normal_force:.1f} N). By the text of section 4 it is the centre "
        f"that starts at 10 cm here ({visit.speed_in:.3f} m/s, peak {peak:.1f} N).",
    )


def _position_and_velocity(whole: Run) -> Canvas:
    figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 4.4), layout="constrained", sharex=True)
    data = whole.dataset
    times = data["time"].values
    above.plot(times, data["position"].values[:, 0], color=plot.BLUE)
    above.set_ylabel("position of the COM,\n$c_x$ [m]")
    below.plot(times, data["slip_velocity"].values[:, 0, 0], color=plot.VERMILLION)
    below.set_ylabel("velocity of the contact\npoint, $V_{sph,x}$ [m/s]")
    below.set_xlabel("time [s]")
    below.set_xlim(times[0], times[-1])
    return figure


def figure_15(runs: Runs) -> Figure:
    data = runs.rolling.dataset
    late = data.sel(time=slice(0.5, None))
    slip = np.abs(late["slip_velocity"].values[:, 0, 0])
    after = 0.5 + float(np.max(late["time"].values[slip > 1e-6] - 0.5, initial=0.0))
    x = late["position"].values[:, 0]
    start, end = float(data["velocity"][0, 0]), float(data["velocity"][-1, 0])
    turning = float(data["angular_velocity"][-1, 1] * data["sphere_radius"][0])
    return Figure(
        15,
        "Position of the centre of mass and velocity of the contact point, both along x.",
        lambda: _position_and_velocity(runs.rolling),
        [
            Check(
                "“after 0.5s, the velocity is zero”",
                "4",
                float(slip.max()) < 1e-3 * start,
                f"It is at most {1e3 * slip.max():.2f} mm/s, less than a thousandth of the {start:g} m/s at the start: "
                f"zero in the figure. It is not zero exactly: the last, small bounces still shake the contact. From "
                f"{after:.2f} s on it is below 1 µm/s.",
            ),
            Check(
                "“but the position is still increasing”",
                "4",
                bool(np.all(np.diff(x) > 0)),
                f"From {x[0]:.4f} m at 0.5 s to {x[-1]:.4f} m at {float(late['time'][-1]):g} s, from each sample to "
                "the next.",
            ),
            Check(
                "“which means that the sphere is rolling on the ground”",
                "4",
                abs(turning - end) < 1e-6 * end,
                f"In the end ω r = {turning:.6f} m/s and the centre moves at {end:.6f} m/s, {end / start:.6f} of the "
                "speed that it was thrown with: 5/7, as for any solid sphere that friction has made roll.",
            ),
        ],
    )


def _rolling_energies(whole: Run) -> Canvas:
    figure = _energies(whole, (0.0, 1.0))
    figure.set_size_inches(7.2, 7.4)
    curves, bands = figure.axes
    grid = figure.add_gridspec(3, 1, height_ratios=(1, 1.3, 0.9))
    curves.set_subplotspec(grid[0])
    bands.set_subplotspec(grid[1])
    bands.set_xlabel("")
    small = figure.add_subplot(grid[2], sharex=bands)
    data = whole.dataset
    parts = (
        ("(33) as printed", "energy_tangential_spring_paper"),
        ("held by the spring", "energy_tangential_spring"),
        *((channel.label, f"energy_{channel.name}") for channel in _of_kind(data, "unpaid")),
    )
    for (label, name), (color, dashes) in zip(parts, plot.CURVES):
        small.plot(data["time"].values, 1e3 * data[name].values, color=color, linestyle=dashes, label=label)
    small.axhline(0, color=plot.GREY, linewidth=0.8)
    small.set_ylabel("energy [mJ]")
    small.set_xlabel("time [s]")
    small.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def figure_16(runs: Runs) -> Figure:
    data = runs.rolling.dataset
    printed = data["energy_tangential_spring_paper"].values
    made = -sum(float(data[f"energy_{channel.name}"][-1]) for channel in _of_kind(data, "unpaid"))
    total = float(data["energy_total"][0])
    clutch = data["energy_clutch"].values
    bounce = runs.first_rolling_bounce.dataset
    as_printed = clutch_as_printed(bounce)
    return Figure(
        16,
        "Total, dissipated and stored energy of the rolling sphere; below, every part of it as a band, and the parts "
        "of (33).",
        lambda: _rolling_energies(runs.rolling),
        [
            _total_is_constant(runs.rolling),
            Check(
                "(33) is “the amount of energy stored in the tangential spring”.",
                "3.1",
                float(printed.min()) >= 0,
                f"It goes down to {1e3 * printed.min():.3f} mJ and ends at {1e3 * printed[-1]:.3f} mJ, when the spring "
                f"is relaxed; no spring stores less than nothing. (33) is the energy held, ½ K_t √z u², plus what the "
                f"changing stiffness takes with no force paying for it. The law has made {1e3 * made:.3f} mJ, "
                f"{100 * made / total:.2f} % of the total, which the paper's sum counts as stored and so cannot see.",
            ),
            Check(
                "(29), ∫ F_f · V_clutch dt, is “energy dissipation by the clutch”.",
                "3.1",
                as_printed >= 0,
                f"Over the first bounce the integral is {1e3 * as_printed:.3f} mJ: the force opposes the slipping. The "
                f"clutch takes {1e3 * float(bounce['energy_clutch'][-1]):.3f} mJ there, and {1e3 * clutch[-1]:.3f} mJ "
                f"in the whole run. With the sign as printed the sum of (15) would fall by {2e3 * clutch[-1]:.3f} mJ.",
            ),
            Check(
                "What is dissipated never comes back (15).",
                "2.3 and 3.1",
                all(
                    _never_falls(data[f"energy_{channel.name}"].values, 1e-15)
                    for channel in _of_kind(data, "taken")
                ),
                f"Normal damper {1e3 * float(data['energy_normal_damper'][-1]):.3f} mJ, tangential damper "
                f"{1e3 * float(data['energy_tangential_damper'][-1]):.3f} mJ, clutch {1e3 * clutch[-1]:.3f} mJ in the "
                "end; none of them falls from one sample to the next.",
            ),
        ],
    )


FIGURES: tuple[Callable[[Runs], Figure], ...] = (
    figure_2,
    figure_3,
    figure_4,
    figure_6,
    figure_7,
    figure_8,
    figure_9,
    figure_10,
    figure_11,
    figure_13,
    figure_14,
    figure_15,
    figure_16,
)


# The page -----------------------------------------------------------------------------------------------------------

_MARKS = {"holds": "✔", "differs": "✘", "not decided": "–"}

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; max-width: 76rem; margin: 2rem auto; padding: 0 1rem; }
h2 { margin: 3rem 0 .3rem; font-size: 1.2rem; }
section { display: grid; grid-template-columns: minmax(20rem, 5fr) 6fr; gap: 0 2rem; align-items: start; }
section h2, section p.caption { grid-column: 1 / -1; }
p.caption { margin: 0 0 .8rem; }
img { max-width: 100%; height: auto; background: white; }
table { border-collapse: collapse; width: 100%; }
td { vertical-align: top; padding: .45rem .5rem; border-top: 1px solid #ddd; }
td.mark { white-space: nowrap; font-weight: 600; }
.holds { color: #00664a; } .differs { color: #a33c00; } .undecided { color: #555; }
td small, p.note { color: #444; }
@media (max-width: 60rem) { section { display: block; } }
@media print { section { break-inside: avoid; } }
"""


def page(figures: Sequence[Figure]) -> str:
    """The page, as HTML."""
    checks = [check for figure in figures for check in figure.checks]
    counts = {verdict: sum(check.verdict == verdict for check in checks) for verdict in _MARKS}
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">',
        f"<title>Azad &amp; Featherstone 2010, computed</title><style>{_STYLE}</style></head><body>",
        "<h1>The figures of Azad &amp; Featherstone 2010, computed</h1>",
        "<p>M. Azad and R. Featherstone, <i>Modeling the contact between a rolling sphere and a compliant ground "
        "plane</i>, Australasian Conference on Robotics and Automation, 2010. Every figure is drawn by footfall with "
        "the paper's parameters. Beside it stands what the paper's text says; each mark is computed from the numbers. "
        "A statement about the look of a curve holds where it is true to a thousandth of the curve's range; what is "
        "left of it is given.</p>",
        f"<p>{len(checks)} statements: {counts['holds']} hold, {counts['differs']} differ, {counts['not decided']} "
        "cannot be decided from the text.</p>",
    ]
    for figure in figures:
        parts.append(
            f'<section id="figure-{figure.number}"><h2>Figure {figure.number}</h2>'
            f'<p class="caption">{html.escape(figure.caption)}</p>'
            f'<div><a href="{figure.file}"><img src="{figure.file}" alt="{html.escape(figure.caption)}"></a>'
        )
        if figure.note:
            parts.append(f'<p class="note">{html.escape(figure.note)}</p>')
        parts.append("</div><table>")
        for check in figure.checks:
            style = {"not decided": "undecided"}.get(check.verdict, check.verdict)
            parts.append(
                f'<tr><td class="mark {style}">{_MARKS[check.verdict]} {check.verdict}</td>'
                f"<td>{html.escape(check.claim)} <small>(section {html.escape(check.section)})</small><br>"
                f"<small>{html.escape(check.measured)}</small></td></tr>"
            )
        parts.append("</table></section>")
    parts.append("<p>Figures 1, 5 and 12 of the paper are drawings.</p></body></html>\n")
    return "\n".join(parts)


def make(out: Path, figures: Sequence[Figure] | None = None, *, say: Callable[[str], object] = print) -> list[Figure]:
    """Draws the figures into ``out``, writes ``index.html`` there, and gives the figures with their checks."""
    out = _arguments.folder("out", out)
    _arguments.function("say", say)
    runs = Runs()
    if figures is None:
        figures = [figure(runs) for figure in FIGURES]
    for figure in figures:
        with plt.rc_context(plot.STYLE):
            canvas = figure.draw()
            canvas.savefig(out / figure.file)
            plt.close(canvas)
        marks = "  ".join(f"{_MARKS[check.verdict]} {check.verdict}" for check in figure.checks)
        say(f"{figure.file}  {marks}")
    (out / "index.html").write_text(page(figures), encoding="utf-8")
    return list(figures)


def main(arguments: Sequence[str] | None = None) -> int:
    """The command ``python -m footfall.paper OUT/``."""
    parser = argparse.ArgumentParser(
        prog="python -m footfall.paper",
        description="Draws the figures of Azad & Featherstone 2010, and checks its text.",
    )
    parser.add_argument("out", type=Path, metavar="OUT", help="folder for the figures and index.html")
    out: Path = parser.parse_args(arguments).out
    plt.switch_backend("Agg")
    try:
        make(out)
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(f"\nThe figures beside what the paper says of them:  {out / 'index.html'}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

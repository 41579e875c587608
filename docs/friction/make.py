#!/usr/bin/env python3
"""Drives every friction law through the same tests: the figures and the tables of docs/friction.md.

Run it with `make friction-page`. Every number comes from `footfall drive`; this file holds the parameters under which the
laws are compared, and how a figure looks. The tables go between markers in the page, so that text and numbers cannot
disagree.
"""

import argparse
import dataclasses
import io
import json
import math
import pathlib
import re
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
RIGS = ROOT / "scenarios" / "rigs"
PAGE = ROOT / "docs" / "friction.md"
FIGURES = ROOT / "docs" / "figures"

# Okabe & Ito's colours, which people of every colour vision tell apart.
BLUE, VERMILLION, GREY = "#0072B2", "#D55E00", "#777777"

# What all laws have in common -----------------------------------------------------------------------------------------

LOAD = 10.0  # N, in the rigs
K_N, K_T, D_T = 8.5e6, 12.75e6, 3.1e3  # the paper's, in the rigs
ROOT_DEPTH = (LOAD / K_N) ** (1 / 3)  # sqrt(z), where the normal spring carries the load
STIFFNESS, DAMPING = K_T * ROOT_DEPTH, D_T * ROOT_DEPTH  # k_t [N/m], b_t [N s/m]
SIGMA_0, SIGMA_1 = STIFFNESS / LOAD, DAMPING / LOAD  # the same, over the load
MU, MU_STATIC = 0.2, 0.3
STRIBECK_VELOCITY = 1e-3  # m/s

# At one load it is the paper's law, whose panel stands for both.
PAPER, PASSIVE = "azad-featherstone", "azad-featherstone-passive"


def parameters():
    """The parameters of each law, by its name in `footfall laws`."""
    stribeck = {
        "stiffness": SIGMA_0,
        "damping": SIGMA_1,
        "static_coefficient": MU_STATIC,
        "kinetic_coefficient": MU,
        "stribeck_velocity": STRIBECK_VELOCITY,
    }
    slow, share = MU, 1 / 3  # a peak of 0.27; the length gives the stiffness at rest
    return {
        "azad-featherstone": {"stiffness": K_T, "damping": D_T, "coefficient": MU},
        PASSIVE: {"stiffness": K_T, "damping": D_T, "coefficient": MU},
        "linear": {"stiffness": STIFFNESS, "damping": DAMPING, "coefficient": MU},
        "regularized-coulomb": {"coefficient": MU, "rounding_speed": 1e-5},
        "dahl": {"stiffness": SIGMA_0, "coefficient": MU},
        "lugre": stribeck,
        "elasto-plastic": stribeck,
        "bliman-sorine": {
            "coefficient": MU,
            "slow_coefficient": slow,
            "slow_length": ((MU + slow) / share - slow) / SIGMA_0,
            "fast_share": share,
        },
        "seven-parameter": {
            "stiffness": SIGMA_0,
            "kinetic_coefficient": MU,
            "stribeck_coefficient": MU_STATIC - MU,
            "stribeck_velocity": STRIBECK_VELOCITY,
            "memory_time": 1e-3,
            "rise_time": 0.1,
        },
        "reset-integrator": {
            "stiffness": SIGMA_0 * MU / MU_STATIC,
            "damping": SIGMA_1,
            "reach": MU_STATIC / SIGMA_0,
            "stiction": MU_STATIC / MU - 1,
        },
        "haessig-friedland": {"stiffness": SIGMA_0, "reach": MU_STATIC / SIGMA_0},
    }


def law(name, values):
    return f"{name}:" + ",".join(f"{key}={value:.10g}" for key, value in values.items())


# What footfall says ---------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Run:
    columns: dict  # numpy arrays by name
    stick_slip: dict | None
    residual: float

    def __getitem__(self, name):
        return self.columns[name]

    def taken(self):
        """All that has been dissipated [J]."""
        return self["normal_damper"] + self["tangential_damper"] + self["clutch"]

    def at(self, time, values):
        return float(np.interp(time, self["time"], values))


def drive(program, rig):
    """The runs of a rig under every law, by the law's name."""
    words = [program, "drive", RIGS / f"{rig}.toml", "--json"]
    for name, values in parameters().items():
        words += ["--friction", law(name, values)]
    answer = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    time = np.array(answer["samples"][0]["values"])
    runs = {}
    for run in answer["runs"]:
        columns = {c["name"]: np.array(c["values"]) for c in answer["samples"] if c["series"] == run["name"]}
        runs[run["name"]] = Run({"time": time, **columns}, run["stick_slip"], run["max_residual"])
    return runs


def check_registered(program):
    """Every friction law that can slide or stick is on the page."""
    laws = json.loads(subprocess.run([program, "laws", "--json"], check=True, capture_output=True, text=True).stdout)
    missing = {entry["name"] for entry in laws["friction"]} - {"none"} - set(parameters())
    if missing:
        raise SystemExit(f"friction laws without parameters in {__file__}: {', '.join(sorted(missing))}")


# Figures --------------------------------------------------------------------------------------------------------------


def style():
    plt.rcParams.update(
        {
            "font.size": 8.5,
            "axes.labelsize": 8.5,
            "axes.titlesize": 9,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "grid.color": "#e2e2e2",
            "grid.linewidth": 0.6,
            "lines.linewidth": 1.2,
        }
    )


def panels(runs, xlabel, ylabel, draw):
    """One small panel for each law, all to the same scale."""
    figure, axes = plt.subplots(2, 5, figsize=(9.6, 4.3), sharex=True, sharey=True, layout="constrained")
    for axis, (name, run) in zip(axes.flat, ((name, run) for name, run in runs.items() if name != PASSIVE), strict=True):
        draw(axis, run)
        axis.set_title(name, loc="left")
    figure.supxlabel(xlabel, fontsize=8.5)
    figure.supylabel(ylabel, fontsize=8.5)
    return figure


def save(figure, name):
    FIGURES.mkdir(exist_ok=True)
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=150)
    plt.close(figure)
    # A few colours and their shades: a palette makes the file a third of the size.
    Image.open(drawn).convert("RGB").quantize(64).save(FIGURES / f"friction-{name}.png", optimize=True, dpi=(150, 150))


def draw_loops(runs):
    def draw(axis, run):
        axis.plot(run["slip_displacement_x"] * 1e6, -run["friction_force_x"], color=BLUE, linewidth=0.9)

    save(panels(runs, "slip displacement [µm]", "friction against the motion [N]", draw), "presliding")


def draw_belt(runs):
    def draw(axis, run):
        late = run["time"] > 12
        axis.plot(run["time"][late], run["position_x"][late] * 1e3, color=BLUE)
        axis.axhline(LOAD * MU, color=GREY, linewidth=0.7, dashes=(4, 3), zorder=0)

    save(panels(runs, "time [s]", "deflection of the spring [mm]", draw), "stick-slip")


def draw_drift(runs):
    figure, axis = plt.subplots(figsize=(7.2, 3.8), layout="constrained")
    labels, holding = [], []
    for name, run in runs.items():
        drifts = creep(run) > 1e-9
        x = run["position_x"] * 1e6
        axis.plot(run["time"], x, color=VERMILLION if drifts else BLUE, linewidth=1.1)
        if drifts:
            labels.append((x[-1], name, VERMILLION))
        else:
            holding.append(x[run["time"] > 3].mean())
    labels.append((sum(holding) / len(holding), f"the other {len(holding)}", BLUE))
    height = max(end for end, _, _ in labels) * 1.06
    # Names beside the ends of their lines, pushed apart where they would overlap.
    apart, at = 0.055 * height, -math.inf
    for end, name, color in sorted(labels):
        at = max(end, at + apart)
        axis.annotate(name, (6, end), (6.1, at), color=color, va="center", annotation_clip=False)
    axis.set_xlim(0, 6)
    axis.set_ylim(0, height)
    axis.set_xlabel("time [s]")
    axis.set_ylabel("position of the mass [µm]")
    save(figure, "drift")


# Closed paths of depth and displacement -------------------------------------------------------------------------------

DEPTH, DEPTH_SWING, WAY = 1e-4, 4e-5, 5e-6  # m
CYCLES, PATHS, WAVES = 6, 120, 3


def waves(random):
    """Amplitudes and phases of the waves of one period, of which the k-th is the smaller the faster."""
    k = np.arange(1, WAVES + 1)
    return k, random.normal(size=WAVES) / k, random.uniform(0, 360, size=WAVES)


def sines(kind, amplitudes, frequencies, phases):
    parts = zip(amplitudes, frequencies, phases)
    return "".join(
        f'[[rig.{kind}]]\nshape = "sine"\namplitude = {a:.17g}\nfrequency = {f:.17g}\nphase = "{p:.17g} deg"\n'
        for a, f, p in parts
    )


def closed_path(program, depth_waves, way_waves, cycles):
    """A contact that never slips, driven round a closed path once a second: P [J] over time, and the largest W, by law."""
    text = f'title = "closed path"\n[rig]\nend = {cycles}\nsample = 0.002\n'
    text += f'[[rig.indentation]]\nshape = "constant"\nvalue = {DEPTH}\n' + sines("indentation", *depth_waves)
    text += sines("displacement", *way_waves)
    text += f'[contact.normal]\nlaw = "azad-featherstone"\nstiffness = {K_N}\ndamping = 0\n'
    made = {}
    with tempfile.TemporaryDirectory() as folder:
        rig = pathlib.Path(folder) / "path.toml"
        rig.write_text(text)
        stuck = {"stiffness": K_T, "damping": 0, "coefficient": 1e3}
        words = [program, "drive", rig, "--json"]
        for name in (PAPER, PASSIVE):
            words += ["--friction", law(name, stuck)]
        answer = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    time = np.array(answer["samples"][0]["values"])
    for name in (PAPER, PASSIVE):
        columns = {c["name"]: np.array(c["values"]) for c in answer["samples"] if c["series"] == name}
        made[name] = (time, columns["stiffness_change"], columns["tangential_spring"].max())
    return made


def draw_closed_paths(program):
    figure, (pumped, many) = plt.subplots(1, 2, figsize=(9.6, 3.6), layout="constrained", width_ratios=(1.15, 1))
    colors = {PAPER: VERMILLION, PASSIVE: BLUE}
    for phase, dashes in ((0, (None, None)), (180, (4, 2))):
        runs = closed_path(program, ([DEPTH_SWING], [1], [phase]), ([WAY], [1], [90]), CYCLES)
        for name, (time, change, _) in runs.items():
            pumped.plot(time, -change * 1e6, color=colors[name], dashes=dashes)
    pumped.axhline(0, color=GREY, linewidth=0.7)
    pumped.set_xlabel("time round a closed path [s]")
    pumped.set_ylabel("made by the changing stiffness [µJ]")
    pumped.set_title("one path, and the same run the other way (dashed)", loc="left")

    random = np.random.default_rng(2010)
    made = {PAPER: [], PASSIVE: []}
    for _ in range(PATHS):
        k, a, depth_phases = waves(random)
        _, b, way_phases = waves(random)
        a *= 0.8 * DEPTH / max(np.abs(a).sum(), 1)
        runs = closed_path(program, (a, k, depth_phases), (b * WAY, k, way_phases), 1)
        for name, (_, change, most) in runs.items():
            made[name].append(-change[-1] / most)
    edges = np.arange(-1.5, 0.85, 0.1)
    for name, values in made.items():
        many.hist(np.clip(values, edges[0], edges[-1]), bins=edges, color=colors[name], alpha=0.65, label=name)
    many.margins(y=0.25)
    many.axvline(0, color=GREY, linewidth=0.7)
    many.set_xlabel("made in one round, over the largest energy stored")
    many.set_ylabel("paths")
    many.set_title(f"{PATHS} random closed paths", loc="left")
    many.legend(loc="upper right", frameon=False, fontsize=8)
    save(figure, "closed-paths")
    paper, passive = (np.array(made[name]) for name in (PAPER, PASSIVE))
    if passive.max() > 0:
        raise SystemExit(f"{PASSIVE} has made energy")
    gains = paper[paper > 0]
    return (
        f"Of {PATHS} random closed paths the paper's law makes energy on {gains.size}: {gains.mean():.2f} of the largest energy "
        f"stored on the way in the mean, {gains.max():.2f} at most. The passive law makes some on none, and takes between "
        f"{-passive.max():.2g} and {-passive.min():.2g}."
    )


# Tables ---------------------------------------------------------------------------------------------------------------


def number(value, digits=3):
    """A measured value with that many significant digits."""
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else "–"
    places = max(digits - 1 - math.floor(math.log10(abs(value))), 0)
    return f"{value:.{places}f}"


def creep(run):
    """How far the mass goes in a cycle of the force, in the second half of the run [m]: from means over three cycles each,
    since some laws let the mass swing on the contact as well."""
    period, cycles = 0.2, 12

    def mean(start):
        chosen = (run["time"] >= start) & (run["time"] < start + 3 * period - 1e-9)
        return run["position_x"][chosen].mean()

    return (mean(3 + cycles * period) - mean(3)) / cycles


def loop_energies(run):
    """What the second cycle of each amplitude takes [J]."""
    return [run.at(end, run.taken()) - run.at(end - 2, run.taken()) for end in (4, 8, 12)]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def comparison(loops, drifts, belts):
    rows = []
    for name in loops:
        taken = [number(energy * 1e6) if abs(energy) > 1e-12 else "0" for energy in loop_energies(loops[name])]
        crept = creep(drifts[name]) * 1e9
        swing = belts[name].stick_slip
        slips = swing is not None and swing["amplitude"] > 1e-4
        rows.append(
            [
                f"`{name}`",
                *taken,
                number(crept) if abs(crept) > 1 else "0",
                number(swing["period"]) if slips else "–",
                number(swing["amplitude"] * 1e3) if slips else "–",
                number(swing["greatest"] * 1e3) if slips else "–",
            ]
        )
    head = ["law", "loop ±5 µm [µJ]", "±15 µm [µJ]", "±30 µm [µJ]", "drift [nm/cycle]", "period [s]", "amplitude [mm]"]
    return table([*head, "greatest [mm]"], rows)


def parameter_table():
    return table(
        ["law", "parameters"],
        [
            [f"`{name}`", ", ".join(f"`{key}` {value:.4g}" for key, value in values.items())]
            for name, values in parameters().items()
        ],
    )


def closed_forms():
    """What is known about the loops without a computer, for the reader to compare."""
    give = MU / SIGMA_0
    coulomb = 4 * MU * LOAD * (30e-6 - give)
    dahl = [4 * MU * LOAD * (a - give * math.tanh(a / give)) for a in (5e-6, 15e-6, 30e-6)]
    delta, w, speed = (MU_STATIC - MU) * LOAD / 1e3, math.sqrt(1e3), 2e-3
    period = 2 * delta / speed + (2 * math.pi - 2 * math.atan(delta * w / speed)) / w
    return table(
        ["", "closed form", "value"],
        [
            ["Coulomb behind a spring, ±30 µm", "$4\\mu F_n(A-\\mu/\\sigma_0)$", f"{coulomb * 1e6:.1f} µJ"],
            [
                "Dahl, ±5, ±15, ±30 µm",
                "$4\\mu F_n(A-\\frac\\mu{\\sigma_0}\\tanh\\frac{A\\sigma_0}\\mu)$",
                ", ".join(number(e * 1e6) for e in dahl) + " µJ",
            ],
            [
                "stick-slip of $\\mu_s$ and $\\mu_k$, rigid contact: period",
                "$\\frac{2\\Delta}{v}+\\frac2\\omega(\\pi-\\arctan\\frac{\\Delta\\omega}v)$",
                f"{period:.3f} s",
            ],
            ["the same: amplitude", "$\\sqrt{\\Delta^2+v^2/\\omega^2}$", f"{math.hypot(delta, speed / w) * 1e3:.3f} mm"],
        ],
    )


def write_page(tables):
    text = PAGE.read_text()
    for name, content in tables.items():
        pattern = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
        text, found = pattern.subn(lambda match: match[1] + content + "\n" + match[2], text)
        if found != 1:
            raise SystemExit(f"{PAGE}: {found} places for the table '{name}'")
    PAGE.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--footfall", type=pathlib.Path, default=ROOT / "build" / "footfall", help="the footfall to ask")
    program = parser.parse_args().footfall
    check_registered(program)
    style()
    loops, drifts, belts = (drive(program, rig) for rig in ("presliding-loop", "drift", "stick-slip-belt"))
    draw_loops(loops)
    draw_drift(drifts)
    draw_belt(belts)
    paths = draw_closed_paths(program)
    worst = max(run.residual for runs in (loops, drifts, belts) for run in runs.values())
    write_page(
        {
            "comparison": comparison(loops, drifts, belts),
            "closed": closed_forms(),
            "parameters": parameter_table(),
            "paths": paths,
            "residual": f"Largest residual of the account in these {3 * len(loops)} runs: {worst:.0e}.",
        }
    )


if __name__ == "__main__":
    main()

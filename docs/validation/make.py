#!/usr/bin/env python3
"""Compares footfall with the published curves of data/published: figures, and the tables of docs/validation.md.

Run it with `make validation`. Every number comes from `footfall`; this file holds what the publications say about their
spheres, how a published quantity is called in footfall, and how a figure looks. The tables go between markers in the
page, so that text and numbers cannot disagree.
"""

import argparse
import csv
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
import PIL.Image  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DATA = ROOT / "data" / "published"
PAGE = ROOT / "docs" / "validation.md"
FIGURES = ROOT / "docs" / "figures"

# Okabe & Ito's colours, which people of every colour vision tell apart.
BLACK, BLUE, VERMILLION, GREEN, ORANGE, PURPLE = "#000000", "#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7"

PAPER_LOOK = {"color": BLUE, "linewidth": 1.8}
CLASSICAL_LOOK = {"color": BLACK, "linewidth": 1.2, "linestyle": (0, (4, 3))}


# What is published ----------------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class Material:
    youngs_modulus: float  # Pa
    poisson_ratio: float
    density: float  # kg/m^3

    def compliance(self):
        """1/E* of this side alone. Azad & Featherstone 2010, (9)."""
        return (1 - self.poisson_ratio**2) / self.youngs_modulus

    def shear_compliance(self):
        """1/G* of this side alone, (2 - nu)/G. Johnson 1985, Contact Mechanics, (7.43)."""
        return (2 - self.poisson_ratio) * 2 * (1 + self.poisson_ratio) / self.youngs_modulus


def materials():
    """The materials of dem_benchmark_materials.csv by test and name, where the file gives their moduli."""
    found = {}
    for row in csv.DictReader(line for line in open(DATA / "dem_benchmark_materials.csv") if not line.startswith("#")):
        if row["E_Pa"] != "n/a":
            found[row["test"], row["material"]] = Material(float(row["E_Pa"]), float(row["nu"]), float(row["rho"]))
    return found


def published(name, x, y, **where):
    """Two columns of a published table, the rows where other columns have given values."""
    rows = csv.DictReader(line for line in open(DATA / name) if not line.startswith("#"))
    chosen = [row for row in rows if all(row[key] == value for key, value in where.items())]
    return np.array([[float(row[x]), float(row[y])] for row in chosen]).T


def ball_mass(density, radius):
    return density * 4 / 3 * math.pi * radius**3


# What footfall says ---------------------------------------------------------------------------------------------------


class Footfall:
    """The program, with the last of its answers kept by question."""

    def __init__(self, program):
        self.program = program
        self.known = {}

    def text(self, *words):
        done = subprocess.run([self.program, *words], capture_output=True, text=True, check=False)
        if done.returncode:
            raise SystemExit(f"{' '.join(map(str, words))}\n{done.stderr}")
        return done.stdout

    def json(self, *words):
        words = tuple(str(word) for word in words)
        if words not in self.known:
            self.known[words] = json.loads(self.text(*words, "--json"))
        return self.known[words]


def law(name, **parameters):
    return f"{name}:" + ",".join(f"{key}={value!r}" for key, value in parameters.items())


@dataclasses.dataclass(frozen=True)
class Impact:
    """One sphere of the publications, and the laws that it is computed under."""

    footfall: Footfall
    radius: float
    mass: float
    pace: tuple  # ("--speed", v) or ("--normal-speed", v)
    stiffness: float  # K_n
    restitution: float  # of a straight impact at that speed
    friction: float  # mu

    def base(self, normal_law):
        words = ["oblique", "--radius", repr(self.radius), "--mass", repr(self.mass), *map(str, self.pace)]
        words += ["--normal", law(normal_law, stiffness=self.stiffness, damping=0.0)]
        return words + ([] if self.restitution == 1 else ["--restitution", repr(self.restitution)])

    def tangential_damping(self):
        """D_t = D_n of the paper's law, (24), at the given restitution."""
        if self.restitution == 1:
            return 0.0
        answer = self.footfall.json(*self.base("azad-featherstone"), "--angles", 0, "--friction", "none")
        return float(re.search(r"damping=([^,]*)", answer["normal"])[1])

    def friction_law(self, ratio):
        return law(
            "azad-featherstone",
            stiffness=ratio * 1.5 * self.stiffness,
            damping=self.tangential_damping(),
            coefficient=self.friction,
        )

    def table(self, normal_law, ratio, angles=(0.0,), spins=(0.0,)):
        """Columns of `footfall oblique` by name."""
        answer = self.footfall.json(
            *self.base(normal_law),
            *("--friction", self.friction_law(ratio)),
            "--angles=" + ",".join(repr(float(a)) for a in angles),
            "--spins=" + ",".join(repr(float(s)) for s in spins),
        )
        return {c["name"]: np.array(c["values"], dtype=float) for c in answer["columns"]}

    def fit(self, observable, columns, ratio, keys):
        """`footfall oblique --fit` on columns by name; the answer with kappa and mu in place of the raw parameters."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "data.csv"
            names = [*columns, observable[0]]
            rows = np.array([*columns.values(), observable[1]]).T
            file.write_text(",".join(names) + "\n" + "".join(",".join(map(repr, map(float, r))) + "\n" for r in rows))
            words = [*self.base("azad-featherstone"), "--friction", self.friction_law(ratio)]
            answer = json.loads(self.footfall.text(*words, "--fit", file, "--vary", ",".join(keys), "--json"))
        estimates = {}
        for e in answer["estimates"]:
            scale = 1.5 * self.stiffness if e["name"] == "friction.stiffness" else 1
            error = e["standard_error"]
            estimates[e["name"]] = (e["value"] / scale, None if error is None else error / scale)
        answer["by name"] = estimates
        answer["misfit"] = merit(np.array(answer["model"]), np.array(answer["measured"]))
        return answer


# How well they agree --------------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class Merit:
    rms: float
    largest: float


def merit(model, measured):
    """Deviations relative to the span of the published values."""
    deviation = np.abs(model - measured) / (measured.max() - measured.min())
    return Merit(float(np.sqrt(np.mean(deviation**2))), float(deviation.max()))


def percent(value):
    return f"{100 * value:.1f} %"


@dataclasses.dataclass(frozen=True)
class Line:
    """One law in a figure, and its name in a table."""

    label: str
    normal_law: str
    ratio: float
    style: dict


def three_laws(ratio, where):
    """The paper's law, the same with Mindlin's stiffness, the classical one with the paper's friction."""
    return [
        Line("Azad–Featherstone, κ = 1", "azad-featherstone", 1.0, PAPER_LOOK),
        Line(f"Azad–Featherstone, κ = {ratio:.3g} ({where})", "azad-featherstone", ratio,
             {"color": VERMILLION, "linewidth": 1.8}),
        Line("Hunt–Crossley, κ = 1", "hunt-crossley", 1.0, CLASSICAL_LOOK),
    ]


# Figures --------------------------------------------------------------------------------------------------------------


def style():
    plt.rcParams.update(
        {
            "font.size": 9,
            "axes.labelsize": 9,
            "axes.titlesize": 9.5,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "grid.color": "#dddddd",
            "grid.linewidth": 0.6,
            "legend.frameon": False,
            "legend.fontsize": 8.5,
            "lines.markersize": 4.5,
            "savefig.dpi": 150,
            "figure.constrained_layout.use": True,
        }
    )


def points(axes, xy, label, marker="o", color=BLACK):
    axes.plot(*xy, marker, label=label, color=color, markerfacecolor="white", markeredgewidth=1.1, zorder=5)


def save(figure, name, columns=3):
    """The legend stands below the axes, each entry once."""
    entries = {}
    for axes in figure.axes:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    figure.legend(entries.values(), entries.keys(), loc="outside lower center", ncols=columns)
    FIGURES.mkdir(exist_ok=True)
    drawn = io.BytesIO()
    figure.savefig(drawn)
    plt.close(figure)
    # A figure has few colours: a palette makes the file a third as large, and its date and program stay out of it.
    PIL.Image.open(drawn).convert("RGB").quantize(128, dither=PIL.Image.Dither.NONE).save(
        FIGURES / f"validation-{name}.png", optimize=True, dpi=(150, 150))


# The page -------------------------------------------------------------------------------------------------------------


class Page:
    def __init__(self):
        self.tables = {}

    def table(self, name, head, rows):
        lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
        self.tables[name] = "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])

    def write(self):
        text = PAGE.read_text()
        for name, table in self.tables.items():
            begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
            if begin not in text:
                raise SystemExit(f"{PAGE}: there is no {begin}")
            head, rest = text.split(begin)
            text = head + begin + "\n" + table + "\n" + end + rest.split(end)[1]
        PAGE.write_text(text)


def with_error(value, error, digits=3):
    if error is None:
        return f"{value:.{digits}g}"
    places = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{places}f} ± {error:.{places}f}"


# Tests 1 and 2: straight, elastic -------------------------------------------------------------------------------------


def straight_run(footfall, normal_law, stiffness, mass, radius, speed, duration):
    """time, depth and force of one impact of `footfall run`."""
    scenario = f"""
title = "Straight impact"
[time]
end = {duration!r}
sample = {duration / 400!r}
[gravity]
acceleration = [0, 0, 0]
[body]
mass = {mass!r}
inertia = "solid-sphere"
[[body.spheres]]
radius = {radius!r}
[body.initial]
position = [0, 0, {radius!r}]
velocity = [0, 0, {-speed!r}]
[contact.normal]
law = "{normal_law}"
stiffness = {stiffness!r}
damping = 0
"""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "run.toml"
        file.write_text(scenario)
        footfall.text("run", file, "--quiet", "--csv", folder)
        with open(pathlib.Path(folder) / "samples.csv") as table:
            rows = list(csv.DictReader(table))
    return tuple(
        np.array([float(row[name]) for row in rows]) for name in ("time [s]", "depth_0 [m]", "normal_force_0 [N]")
    )


def fit_stiffness(footfall, points_xy, kind, mass, speed):
    """K_n of an elastic impact by `footfall fit`, with its standard error, and what misfit is left."""
    column = {"force_disp": "indentation [m]", "force_time": "time [s]"}[kind]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "data.csv"
        file.write_text(f"{column},force [N]\n" + "".join(f"{x!r},{y!r}\n" for x, y in points_xy.T.tolist()))
        words = ["fit", file, "--normal", "azad-featherstone:stiffness=?,damping=0"]
        words += ["--mass", repr(mass), "--speed", repr(speed)]
        (fitted,) = json.loads(footfall.text(*words, "--json"))["laws"]
    (estimate,) = (e for e in fitted["estimates"] if e["name"] == "stiffness")
    measured = points_xy[1]
    return estimate["value"], estimate["standard_error"], merit(measured - np.array(fitted["residuals"]), measured)


def straight_tests(footfall, page, known):
    glass, alloy = known["1", "glass"], known["2", "Al_alloy"]
    # Two equal spheres are one sphere against their plane of symmetry, in relative coordinates: half the radius, half
    # the mass, the speed of approach, and the indentation of both together.
    cases = [
        ("1", "two glass spheres", 1 / (2 * glass.compliance()), 0.005, ball_mass(2800, 0.010) / 2, 20.0, 45e-6),
        ("2", "aluminium alloy on a rigid plane", 1 / alloy.compliance(), 0.1, ball_mass(2699, 0.1), 0.2, 800e-6),
    ]
    rows, fits = [], []
    for test, what, modulus, radius, mass, speed, duration in cases:
        stiffness = 4 / 3 * modulus * math.sqrt(radius)  # (10)
        figure, panels = plt.subplots(1, 2, figsize=(6.8, 3.1))
        curves = {
            "force_disp": ("normal_disp_um", "indentation [µm]", 1),
            "force_time": ("time_us", "time [µs]", 0),
        }
        for axes, (kind, (column, label, index)) in zip(panels, curves.items(), strict=True):
            xy = published(f"chung_ooi_test{test}_{kind}.csv", column, "force_kN") * [[1e-6], [1e3]]
            for name, title, look in (
                ("azad-featherstone", "Azad–Featherstone", PAPER_LOOK),
                ("hunt-crossley", "Hunt–Crossley", CLASSICAL_LOOK),
            ):
                run = straight_run(footfall, name, stiffness, mass, radius, speed, duration)
                top = np.argmax(run[1]) + 1 if index == 1 else None
                model = np.interp(xy[0], run[index][:top], run[2][:top])
                quality = merit(model, xy[1])
                curve = "force against " + {"force_disp": "indentation", "force_time": "time"}[kind]
                rows.append([test, curve, name, percent(quality.rms), percent(quality.largest)])
                axes.plot(run[index][:top] * 1e6, run[2][:top] / 1e3, label=title, **look)
            value, error, quality = fit_stiffness(footfall, xy, kind, mass, speed)
            to_modulus = 3 / 4 / math.sqrt(radius)
            fits.append([test, curve, f"{modulus / 1e9:.4g}",
                         with_error(value * to_modulus / 1e9, error * to_modulus / 1e9),
                         f"{100 * (value / stiffness - 1):+.1f} %", percent(quality.rms)])
            points(axes, xy * [[1e6], [1e-3]], "Chung & Ooi 2011")
            axes.set(xlabel=label, ylabel="normal force [kN]", xlim=(0, None), ylim=(0, None))
        figure.suptitle(f"Test {test}: {what}, {speed:g} m/s", fontsize=9.5)
        save(figure, f"test{test}")
    page.table("straight", ["test", "curve", "law", "RMS", "largest"], rows)
    head = ["test", "from", "given E* [GPa]", "fitted E* [GPa]", "difference", "RMS after the fit"]
    page.table("modulus", head, fits)


# Oblique impacts ------------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Oblique:
    """The rows of the page's tables on oblique impacts."""

    merits: list = dataclasses.field(default_factory=list)
    fits: list = dataclasses.field(default_factory=list)

    def compare(self, curve, series, lines, measured, model_of):
        for line in lines:
            quality = merit(model_of(line), measured)
            name = f"{line.normal_law}, κ = {line.ratio:.3g}"
            self.merits.append([curve, series, name, percent(quality.rms), percent(quality.largest)])

    def fitted(self, curve, series, mindlin, answer):
        estimates = answer["by name"]
        mu = estimates.get("friction.coefficient")
        kappa = estimates.get("friction.stiffness")
        self.fits.append([curve, series, with_error(*mu) if mu else "given", with_error(*kappa),
                          f"{mindlin:.3f}" if mindlin else "not known",
                          percent(answer["misfit"].rms), percent(answer["misfit"].largest)])


def angle_tests(footfall, out, known):
    """Test 4, and the experiment that it repeats."""
    oxide, alloy, glass = known["4", "Al_oxide"], known["4", "Al_alloy"], known["1", "glass"]
    radius, speed = 0.0025, 3.9

    def impact(compliance, density):
        return Impact(footfall, radius, ball_mass(density, radius), ("--speed", speed),
                      4 / 3 / compliance * math.sqrt(radius), 0.98, 0.092)

    on_rigid = impact(oxide.compliance(), oxide.density)
    ratio = 4 * oxide.compliance() / oxide.shear_compliance()
    on_glass = impact(oxide.compliance() + glass.compliance(), oxide.density)
    glass_ratio = 4 * (oxide.compliance() + glass.compliance()) / (oxide.shear_compliance() + glass.shear_compliance())
    alloy_impact = impact(alloy.compliance(), alloy.density)
    alloy_ratio = 4 * alloy.compliance() / alloy.shear_compliance()

    both = ["friction.coefficient", "friction.stiffness"]
    dense = np.concatenate([np.arange(0.25, 40, 0.5), np.arange(40, 89.6, 1.0)])
    lines = three_laws(ratio, "ν = 0.23")

    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.7))
    quantities = [
        ("et", "tangential_restitution", "tangential restitution, centre [1]",
         [("Al oxide", published("chung_ooi_test4_et.csv", "incident_deg", "tangential_restitution_of_centre"))]),
        ("omega", "spin_after", "spin after [rad/s]",
         [(s, published("chung_ooi_test4_omega.csv", "incident_deg", "final_omega_rad_s", series=s.replace(" ", "_"))
           * [[1], [-1]]) for s in ("Al oxide", "Al alloy", "Experiment")]),  # footfall: top spin is positive
        ("rebound", "contact_rebound_angle", "rebound angle, contact point [°]",
         [("Al oxide", published("chung_ooi_test4_rebound.csv", "incident_deg", "rebound_deg"))]),
    ]
    looks = {
        "Al oxide": ("o", BLACK, "Chung & Ooi 2011, Al oxide"),
        "Al alloy": ("^", GREEN, "Chung & Ooi 2011, Al alloy"),
        "Experiment": ("s", PURPLE, "Kharaz et al. 2001, experiment"),
    }
    for axes, (name, column, label, series) in zip(panels, quantities, strict=True):
        for line in lines:
            axes.plot(dense, on_rigid.table(line.normal_law, line.ratio, dense)[column], label=line.label, **line.style)
        for kind, xy in series:
            sphere, its_ratio = (alloy_impact, alloy_ratio) if kind == "Al alloy" else (on_rigid, ratio)
            its_lines = three_laws(its_ratio, "")
            out.compare(f"4, {name}", kind, its_lines, xy[1],
                        lambda line: sphere.table(line.normal_law, line.ratio, xy[0])[column])  # noqa: B023
            out.fitted(f"4, {name}", kind, its_ratio, sphere.fit((column, xy[1]), {"angle": xy[0]}, its_ratio, both))
            marker, color, legend = looks[kind]
            points(axes, xy, legend, marker, color)
        axes.set(xlabel="angle of incidence [°]", ylabel=label, xlim=(0, 90))
    figure.suptitle("Test 4: sphere of 5 mm, 3.9 m/s, µ = 0.092, e = 0.98", fontsize=9.5)
    save(figure, "test4")

    lines = three_laws(glass_ratio, "alumina on glass")
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 3.7))
    quantities = [
        ("et", "tangential_restitution", "tangential restitution, centre [1]"),
        ("omega_rad_s", "spin_after", "spin after [rad/s]"),
        ("rebound_deg_centre", "rebound_angle", "rebound angle, centre [°]"),
    ]
    for axes, (quantity, column, label) in zip(panels, quantities, strict=True):
        xy = published("kharaz2001_lethe.csv", "incident_deg", "value", quantity=quantity)
        for line in lines:
            axes.plot(dense, on_glass.table(line.normal_law, line.ratio, dense)[column], label=line.label, **line.style)
        name = quantity.split("_")[0]
        out.compare(f"Kharaz, {name}", "experiment", lines, xy[1],
                    lambda line: on_glass.table(line.normal_law, line.ratio, xy[0])[column])  # noqa: B023
        out.fitted(f"Kharaz, {name}", "experiment", glass_ratio,
                   on_glass.fit((column, xy[1]), {"angle": xy[0]}, glass_ratio, both))
        if quantity == "et":
            simulated = published("kharaz2001_lethe.csv", "incident_deg", "value", quantity="et_MFIX_DEM05_sim")
            moving = simulated[:, simulated[0] > 0]  # at 0 the centre has no tangential velocity to compare
            points(axes, simulated, "simulation, MFIX-DEM", "x", ORANGE)
            out.compare("Kharaz, et", "MFIX-DEM", lines, moving[1],
                        lambda line: on_glass.table(line.normal_law, line.ratio, moving[0])["tangential_restitution"])
            out.fitted("Kharaz, et", "MFIX-DEM", glass_ratio,
                       on_glass.fit(("tangential_restitution", moving[1]), {"angle": moving[0]}, glass_ratio, both))
        points(axes, xy, "Kharaz et al. 2001, experiment", "s", PURPLE)
        axes.set(xlabel="angle of incidence [°]", ylabel=label, xlim=(0, 90))
    figure.suptitle("Kharaz et al.: alumina sphere of 5 mm on glass, 3.9 m/s", fontsize=9.5)
    save(figure, "kharaz")


def map_test(footfall, out, known):
    """Test 5: elastic, so the map depends on kappa alone, and the stiffness is any at all."""
    steel, polyethylene = known["5", "steel"], known["5", "polyethylene"]
    radius, normal_speed, mu = 1e-5, 5.0, 0.3
    sphere = Impact(footfall, radius, ball_mass(steel.density, radius), ("--normal-speed", normal_speed), 1e9, 1, mu)
    mindlin = {kind: 4 * material.compliance() / material.shear_compliance()
               for kind, material in (("Steel", steel), ("Polyethylene", polyethylene))}
    lines = three_laws(mindlin["Steel"], "ν = 0.3")
    figure, panels = plt.subplots(1, 2, figsize=(8.0, 3.8))
    dense = np.concatenate([np.linspace(0.02, 8, 240), np.linspace(8.2, 20, 30)])

    def angles(psi1):
        return np.degrees(np.arctan(mu * psi1))

    quantities = [
        (
            ("psi2_psi1", "psi1", "psi2"),
            ("psi2", "$\\psi_2 = V'/(\\mu V_n)$ [1]", 13.5),
            ("Steel", "Polyethylene", "FEM_Wu2003"),
            ("contact_velocity_after", mu * normal_speed),
        ),
        (
            ("romega", "Vst_over_muVcn", "r_omega_over_muVcn"),
            ("r omega", "$r\\,\\omega'/(\\mu V_n)$ [1]", 20.5),
            ("Steel", "Polyethylene", "FEM_Wu2003"),
            ("spin_after", -mu * normal_speed / radius),  # the publication's spin is positive the other way round
        ),
    ]
    looks = {
        "Steel": ("o", BLACK, "Chung & Ooi 2011, steel"),
        "Polyethylene": ("^", GREEN, "Chung & Ooi 2011, polyethylene"),
        "FEM_Wu2003": ("s", PURPLE, "Wu et al. 2003, finite elements"),
    }
    for axes, (source, (name, label, end), series, (column, scale)) in zip(panels, quantities, strict=True):

        def model(line, psi1):
            return sphere.table(line.normal_law, line.ratio, angles(psi1))[column] / scale  # noqa: B023

        for line in lines:
            axes.plot(dense, model(line, dense), label=line.label, **line.style)
        for kind in series:
            xy = published(f"chung_ooi_test5_{source[0]}.csv", *source[1:], series=kind)
            out.compare(f"5, {name}", kind.replace("_", " "), lines, xy[1],
                        lambda line: model(line, xy[0]))  # noqa: B023
            out.fitted(f"5, {name}", kind.replace("_", " "), mindlin.get(kind),
                       sphere.fit((column, xy[1] * scale), {"angle": angles(xy[0])}, 0.82, ["friction.stiffness"]))
            marker, color, legend = looks[kind]
            points(axes, xy, legend, marker, color)
        axes.set(xlabel="$\\psi_1 = V/(\\mu V_n)$ [1]", ylabel=label, xlim=(0, end))
        axes.locator_params(axis="x", integer=True)
    panels[0].set_ylim(-3.4, 6.5)
    figure.suptitle("Test 5: elastic sphere, µ = 0.3, velocity of the contact point and spin", fontsize=9.5)
    save(figure, "test5")


def spin_test(footfall, out, known):
    """Test 6: a sphere that only spins."""
    alloy = known["4", "Al_alloy"]  # the file does not give that of test 6
    radius, normal_speed, mu, e = 0.1, 0.2, 0.4, 0.5
    sphere = Impact(footfall, radius, ball_mass(alloy.density, radius), ("--normal-speed", normal_speed),
                    4 / 3 / alloy.compliance() * math.sqrt(radius), e, mu)
    ratio = 4 * alloy.compliance() / alloy.shear_compliance()
    lines = three_laws(ratio, "ν = 0.33")
    xy = published("chung_ooi_test6_beta.csv", "s", "beta")

    def spins(s):
        return -3.5 * mu * (1 + e) * normal_speed / (s * radius)

    figure, axes = plt.subplots(figsize=(5.2, 3.9))
    dense = np.concatenate([np.linspace(0.12, 3, 100), np.linspace(3.1, 25, 60)])
    for line in lines:
        axes.plot(dense, sphere.table(line.normal_law, line.ratio, spins=spins(dense))["contact_restitution"],
                  label=line.label, **line.style)
    out.compare("6, beta", "aluminium alloy", lines, xy[1],
                lambda line: sphere.table(line.normal_law, line.ratio, spins=spins(xy[0]))["contact_restitution"])
    measured = ("contact_restitution", xy[1])
    out.fitted("6, beta", "aluminium alloy", ratio,
               sphere.fit(measured, {"spin": spins(xy[0])}, ratio, ["friction.stiffness"]))
    damped = sphere.fit(measured, {"spin": spins(xy[0])}, ratio, ["friction.stiffness", "friction.damping"])
    damping = with_error(*(x / sphere.tangential_damping() for x in damped["by name"]["friction.damping"]))
    out.fitted("6, beta", f"the same, with $D_t$ = ({damping}) $D_n$", ratio, damped)
    points(axes, xy, "Chung & Ooi 2011")
    axes.set(xlabel="$s = \\frac{7}{2}\\mu(1+e)V_n/V$ [1]", ylabel="$\\beta = -V'/V$ of the contact point [1]")
    axes.set_xlim(0, 25)
    figure.suptitle("Test 6: spin without translation, µ = 0.4, e = 0.5", fontsize=9.5)
    save(figure, "test6", columns=2)


def reading_errors():
    """What reading a curve off a printed figure costs: points on branches that rigid-body theory knows exactly."""
    rows = []
    for kind in ("Steel", "Polyethylene", "FEM_Wu2003"):
        x, y = published("chung_ooi_test5_psi2_psi1.csv", "psi1", "psi2", series=kind)
        far = x > 9
        rows.append(["5, psi2", kind.replace("_", " "), "psi2 = psi1 - 7", x, y, y[far] - (x[far] - 7)])
    for kind in ("Steel", "Polyethylene", "FEM_Wu2003"):
        x, y = published("chung_ooi_test5_romega.csv", "Vst_over_muVcn", "r_omega_over_muVcn", series=kind)
        rows.append(["5, r omega", kind.replace("_", " "), "-5", x, y, y[x > 9] + 5])
    x, y = published("chung_ooi_test6_beta.csv", "s", "beta")
    rows.append(["6, beta", "aluminium alloy", "beta = s - 1", x, y, y[x < 0.7] - (x[x < 0.7] - 1)])
    return [[curve, kind, exact, str(len(d)), percent(float(np.abs(d).max() / (y.max() - y.min())))]
            for curve, kind, exact, _, y, d in rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--footfall", default=ROOT / "build" / "footfall", type=pathlib.Path, help="the program")
    footfall = Footfall(parser.parse_args().footfall)
    style()
    page, out, known = Page(), Oblique(), materials()
    straight_tests(footfall, page, known)
    angle_tests(footfall, out, known)
    map_test(footfall, out, known)
    spin_test(footfall, out, known)
    page.table("oblique", ["curve", "series", "law", "RMS", "largest"], out.merits)
    page.table("fits", ["curve", "series", "µ", "κ", "Mindlin's κ", "RMS", "largest"], out.fits)
    page.table("reading", ["curve", "series", "exact", "points", "largest error"], reading_errors())
    page.write()
    print(f"{PAGE.relative_to(ROOT)}: {len(page.tables)} tables; figures in {FIGURES.relative_to(ROOT)}")


if __name__ == "__main__":
    main()

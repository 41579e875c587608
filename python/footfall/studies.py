"""Studies of contact laws. Each gives an :class:`xarray.Dataset` with units, as the command of the same name does.

Quantities are in SI units, angles in radians where they are given. Laws are those of :mod:`footfall.laws` or their
text.
``dataset.to_dataframe()`` makes a pandas table of any dataset. Studies go on without the GIL, and Ctrl-C
(KeyboardInterrupt) ends them.
"""

from __future__ import annotations

import io
import math
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import pandas as pd
import xarray as xr

from footfall import _arguments, _core, laws
from footfall._values import Compared
from footfall.errors import InvalidInput
from footfall.scenario import document

_studies = _core.studies


def _labelled(
    table: tuple[str, list[tuple[str, str, str, str, Any]]], dimension: str = "row", *, coordinate: bool = False
) -> xr.Dataset:
    """A table of the C++ library as a dataset of one dimension, whose coordinate is the column of its name where
    ``coordinate`` says so. Columns that exist for several laws or curves have the dimension ``series`` as well."""
    title, columns = table
    series = list(dict.fromkeys(of for _, _, _, of, _ in columns if of))
    data: dict[str, Any] = {}
    for name, unit, description, of, values in columns:
        attributes = {"units": unit, "long_name": description}
        if not of:
            data[name] = ([dimension], values, attributes)
            continue
        if name not in data:
            data[name] = (["series", dimension], np.full((len(series), len(values)), np.nan), attributes)
        data[name][1][series.index(of)] = values
    coordinates: dict[str, Any] = {"series": np.array(series, dtype=object)} if series else {}
    if coordinate:
        coordinates[dimension] = data.pop(dimension)
    return xr.Dataset(data, coordinates, {"title": title, "source": f"footfall {_core.__version__}"})


def _named(name: str, given: Any, kind: str) -> dict[str, Any]:
    """Laws by name: a mapping, one law, or several, which are told apart by their parameters where their kinds are
    the same. ``kind`` is Normal or Friction; None stands for no friction."""

    def read(where: str, law: Any) -> Any:
        return laws._friction_or_none(where, law) if kind == "Friction" else laws._law(where, law, kind)

    if isinstance(given, Mapping):
        named = {_arguments.text(name, key): read(f"{name}[{key!r}]", law) for key, law in given.items()}
    elif isinstance(given, Iterable) and not isinstance(given, (str, bytes)):
        made = [read(f"{name}[{i}]", law) for i, law in enumerate(given)]
        kinds = [law.name for law in made]
        named = {law.name if kinds.count(law.name) == 1 else law.text: law for law in made}
    else:
        law = read(name, given)
        named = {law.name: law}
    if not named:
        raise InvalidInput(f"{name}: at least one law is wanted")
    return named


def _tolerance(value: float) -> float:
    return _arguments.number("tolerance", value, at_least=1e-14, at_most=1e-3)


# Restitution --------------------------------------------------------------------------------------------------------


def restitution(
    normal: Any,
    mass: float,
    speeds: npt.ArrayLike | None = None,
    *,
    radius: float = math.inf,
    gravity: float = 0.0,
    tolerance: float = 1e-12,
) -> xr.Dataset:
    """Restitution against the speed of a normal impact.

    Parameters
    ----------
    normal
        A normal law, several in a list, or a dict of them by name.
    mass
        Of the sphere [kg], > 0.
    speeds
        Into the ground [m/s], each > 0; by default 50 from 0.01 to 10 m/s in equal ratios.
    radius
        [m]; only what the depth is to stay small beside.
    gravity
        Towards the ground [m/s^2]; with it ``slowest_bounce`` is found as well.
    tolerance
        Of the runs, from 1e-14 to 1e-3; the error of the restitution is of this order.

    Returns
    -------
    xarray.Dataset
        Dimensions series (the laws) and speed: restitution, theory where there is one, peak force, peak indentation,
        durations. NaN stands for what does not exist.

    Raises
    ------
    InvalidInput
        Where a value is out of its range.
    """
    named = _named("normal", normal, "Normal")
    mass = _arguments.number("mass", mass, "kg", above=0)
    radius = _arguments.number("radius", radius, "m", above=0, infinite=True)
    gravity = _arguments.number("gravity", gravity, "m/s^2", at_least=0)
    tolerance = _tolerance(tolerance)
    along = _arguments.column("speeds", np.geomspace(0.01, 10, 50) if speeds is None else speeds, "m/s", above=0)
    title = f"Restitution of a sphere of {mass:g} kg" + (f", gravity {gravity:g} m/s^2" if gravity else "")
    table, slowest = _studies.restitution(
        title, list(named.items()), mass, radius, along, gravity, tolerance
    )
    return _with_slowest(_labelled(table, "speed", coordinate=True), slowest, gravity)


def restitution_figure(number: int, *, tolerance: float = 1e-12) -> xr.Dataset:
    """The curves of figure 2, 3 or 4 of Azad & Featherstone 2010, as :func:`restitution` gives them."""
    number = _arguments.integer("number", number, 2, 4)
    tolerance = _tolerance(tolerance)
    table, _ = _studies.restitution_figure(number, tolerance)
    return _labelled(table, "speed", coordinate=True)


def _with_slowest(data: xr.Dataset, slowest: npt.NDArray[np.float64], gravity: float) -> xr.Dataset:
    if gravity:
        attributes = {"units": "m/s", "long_name": "speed below which gravity keeps the sphere; 0: it always bounces"}
        data["slowest_bounce"] = ("series", slowest, attributes)
    return data


# Oblique impact -----------------------------------------------------------------------------------------------------


def oblique(
    normal: Any,
    friction: Any,
    mass: float,
    radius: float,
    *,
    angles: npt.ArrayLike,
    speed: float | None = None,
    normal_speed: float | None = None,
    spin: npt.ArrayLike = 0.0,
    inertia: float | None = None,
    gravity: float = 0.0,
    poisson_ratio: float | None = None,
    tolerance: float = 1e-10,
) -> xr.Dataset:
    """Impacts of a sphere that hits the ground at an angle, with or without spin.

    Parameters
    ----------
    normal, friction
        Laws, or their text.
    mass, radius
        Of the sphere [kg], [m], > 0.
    angles
        Of incidence, from the ground's normal [rad], 0 <= angle < pi/2. Broadcasts against ``spin``.
    speed, normal_speed
        Of the centre, or its part towards the ground [m/s]: one of the two.
    spin
        [rad/s], > 0 where the sphere would roll forward.
    inertia
        About the centre [kg m^2]; a solid sphere's by default.
    gravity
        [m/s^2]
    poisson_ratio
        With it the dimensionless angles of Maw, Barber & Fawcett are given as well.

    Returns
    -------
    xarray.Dataset
        Dimension impact: angles (in degrees), velocities, spins, restitutions, impulse ratio, times in slip and stick,
        psi1 and psi2 where the law has a coefficient of friction. Dimension part, every stretch of slip or stick:
        ``part_row`` (which impact, from 0), ``part_phase`` (0 slip, 1 stick, 2 recovering), ``part_start`` and
        ``part_duration`` [s].

    Raises
    ------
    InvalidInput
        Where a value is out of its range.
    """
    if (speed is None) == (normal_speed is None):
        raise InvalidInput("speed, normal_speed: one of the two is wanted")
    normal = laws._law("normal", normal, "Normal")
    friction = laws._friction_or_none("friction", friction)
    mass = _arguments.number("mass", mass, "kg", above=0)
    radius = _arguments.number("radius", radius, "m", above=0)
    if inertia is not None:
        inertia = _arguments.number("inertia", inertia, "kg m^2", above=0)
    gravity = _arguments.number("gravity", gravity, "m/s^2", at_least=0)
    if poisson_ratio is not None:
        poisson_ratio = _arguments.number("poisson_ratio", poisson_ratio, above=-1, at_most=0.5)
    tolerance = _tolerance(tolerance)
    name, given = ("normal_speed", normal_speed) if speed is None else ("speed", speed)
    approach = _arguments.number(name, given, "m/s", above=0)
    angle = _arguments.column("angles", angles, "rad", at_least=0, below=math.pi / 2)
    turning = _arguments.column("spin", spin, "rad/s")
    try:
        angle, turning = (array.tolist() for array in np.broadcast_arrays(angle, turning))
    except ValueError:
        raise InvalidInput(
            f"angles, spin: {len(angle)} and {len(turning)} numbers are not allowed: must be as many of both, or one"
        ) from None
    table, history = _studies.oblique(
        mass, radius, inertia, normal, friction, gravity, tolerance, approach, speed is None, angle, turning,
        poisson_ratio,
    )  # fmt: skip
    parts = _labelled(history, "part")
    return _labelled(table, "impact").assign({f"part_{name}": parts[name] for name in parts.data_vars})


# Driven loops -------------------------------------------------------------------------------------------------------


def drive(
    rig: str | os.PathLike[str] | Mapping[str, Any],
    *,
    normal: Any = None,
    friction: Any = None,
    tolerance: float | None = None,
) -> xr.Dataset:
    """Drives one contact along the paths of a test rig: loops, pre-sliding, stick-slip, drift.

    Parameters
    ----------
    rig
        A rig file, or a dict nested as its tables.
    normal, friction
        Laws in place of the rig's: one, several in a list, or a dict by name. Every normal law is driven with every
        friction law.
    tolerance
        Of a step, in place of the rig's.

    Returns
    -------
    xarray.Dataset
        Dimensions series (the pairs of laws) and time: forces, deflections, the account of energy; largest forces and
        residual, and for a mass on a belt period, amplitude, extremes and share of sticking (NaN where nothing swings).

    Raises
    ------
    ScenarioError
        With everything that is wrong in the rig.
    InvalidInput, TooExpensive
        Where a pair of laws cannot be driven; the message names it.
    """
    if tolerance is not None:
        tolerance = _tolerance(tolerance)
    if isinstance(rig, Mapping):
        name, file = "rig", _studies.RigFile.parse(document("rig", rig), "rig")
    elif isinstance(rig, (str, os.PathLike)):
        name, file = str(rig), _studies.RigFile.load(_arguments.path("rig", rig))
    else:
        raise TypeError(f"rig: a path or a dict is wanted, not {_arguments.described(rig)}")
    normals = _named("normal", file.normal if normal is None else normal, "Normal")
    frictions = _named("friction", file.friction if friction is None else friction, "Friction")
    pairs = []
    for normal_name, normal_law in normals.items():
        for friction_name, friction_law in frictions.items():
            both = f"{normal_name} + {friction_name}" if len(frictions) > 1 else normal_name
            pairs.append((both if len(normals) > 1 else friction_name, (normal_law, friction_law)))
    table, summaries, doubts = _studies.drive(file, name, pairs, tolerance)
    _warn(doubts)
    data = _labelled(table, "time", coordinate=True)
    if "series" not in data.coords:
        data = data.assign_coords(series=np.array([pair_name for pair_name, _ in pairs], dtype=object))
    for key, unit, meaning in (
        ("largest_normal_force", "N", "largest normal force"),
        ("largest_friction_force", "N", "largest friction force"),
        ("max_residual", "1", "largest residual of the account of energy"),
    ):
        data[key] = ("series", [summary[key] for summary in summaries], {"units": unit, "long_name": meaning})
    for key, unit, meaning in (
        ("period", "s", "of the stick-slip"),
        ("amplitude", "m", "half the way between the extremes of the spring's deflection"),
        ("greatest", "m", "greatest deflection of the spring"),
        ("least", "m", "least deflection of the spring"),
        ("sticking", "1", "share of the time that the mass goes with the belt"),
    ):
        values = [math.nan if s["stick_slip"] is None else s["stick_slip"][key] for s in summaries]
        data[f"stick_slip_{key}"] = ("series", values, {"units": unit, "long_name": meaning})
    return data


# Materials ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Material:
    """What a solid is made of."""

    youngs_modulus: float
    """E [Pa], > 0; may be infinite."""
    poisson_ratio: float
    """nu, > -1 and <= 0.5."""
    density: float | None = None
    """[kg/m^3], where the mass of a sphere is wanted."""


@dataclass(frozen=True)
class Coefficients:
    """The coefficients of the paper's laws for two materials and a radius."""

    effective_modulus: float
    """E* [Pa], (9)."""
    effective_shear_modulus: float
    """G* [Pa]."""
    damping_time: float
    """tau [s]."""
    alpha: float
    """[N s/m^2.5], (11)."""
    normal_stiffness: float
    """K_n [N/m^1.5], (10)."""
    normal_damping: float
    """D_n [N s/m^1.5], (12)."""
    tangential_stiffness: float
    """K_t [N/m^1.5], (23) or Mindlin's."""
    tangential_damping: float
    """D_t [N s/m^1.5], (24)."""

    def normal(self) -> Any:
        """The paper's normal law with these coefficients."""
        return laws.AzadFeatherstoneNormal(stiffness=self.normal_stiffness, damping=self.normal_damping)

    def friction(self, coefficient: float, viscous: float = 0.0) -> Any:
        """The paper's friction law with these coefficients; mu and C_V are no property of the two materials alone."""
        return laws.AzadFeatherstoneFriction(
            stiffness=self.tangential_stiffness,
            damping=self.tangential_damping,
            coefficient=coefficient,
            viscous=viscous,
        )


def materials() -> pd.DataFrame:
    """The materials that :func:`material` knows by name: E [Pa], nu, density [kg/m^3], each with its source."""
    return pd.DataFrame(_studies.material_presets()).set_index("name")


def _material(name: str, given: str | Material) -> Material:
    if isinstance(given, str):
        try:
            return Material(*_studies.material_preset(_arguments.text(name, given)))
        except InvalidInput as error:
            raise InvalidInput(f"{name}: {error}") from None
    if not isinstance(given, Material):
        said = _arguments.described(given)
        raise TypeError(f"{name}: a name of studies.materials() or a Material is wanted, not {said}")
    density = given.density
    return Material(
        _arguments.number(f"{name}.youngs_modulus", given.youngs_modulus, "Pa", above=0, infinite=True),
        _arguments.number(f"{name}.poisson_ratio", given.poisson_ratio, above=-1, at_most=0.5),
        None if density is None else _arguments.number(f"{name}.density", density, "kg/m^3", above=0),
    )


def material(
    sphere: str | Material,
    ground: str | Material,
    radius: float,
    *,
    alpha: float | None = None,
    damping_time: float | None = None,
    restitution: float | None = None,
    speed: float | None = None,
    mass: float | None = None,
    tangential: Literal["paper", "mindlin"] = "paper",
) -> Coefficients:
    """Coefficients of the paper's laws from two materials, a radius and one number that says how much is lost.

    Parameters
    ----------
    sphere, ground
        Names of :func:`materials`, or a :class:`Material`.
    radius
        Of the sphere [m], > 0.
    alpha, damping_time, restitution
        One of the three: alpha of (11) [N s/m^2.5], tau [s], or the restitution that was measured at ``speed`` [m/s].
    mass
        Of the sphere [kg], with ``restitution``; by default that of a solid sphere of its material.
    tangential
        K_t of the paper, 1.5 K_n, or that of Mindlin & Deresiewicz 1953, which depends on nu.

    Raises
    ------
    InvalidInput
        Where a value is missing or out of its range, or no damping gives the restitution.
    """
    ball, plane = _material("sphere", sphere), _material("ground", ground)
    radius = _arguments.number("radius", radius, "m", above=0)
    if sum(value is not None for value in (alpha, damping_time, restitution)) != 1:
        raise InvalidInput("alpha, damping_time, restitution: one of the three is wanted")
    _arguments.choice("tangential", tangential, ("paper", "mindlin"))
    if alpha is not None:
        alpha = _arguments.number("alpha", alpha, "N s/m^2.5", at_least=0)
    if damping_time is not None:
        damping_time = _arguments.number("damping_time", damping_time, "s", at_least=0)
    sides = (ball.youngs_modulus, ball.poisson_ratio), (plane.youngs_modulus, plane.poisson_ratio)
    modulus = _studies.effective_modulus(*sides)
    if alpha is not None:
        damping_time = _studies.damping_time(alpha, modulus, radius)
    elif restitution is not None:
        if speed is None:
            raise InvalidInput("speed is missing: the restitution was measured at one")
        restitution = _arguments.number("restitution", restitution)
        speed = _arguments.number("speed", speed, "m/s", above=0)
        if mass is None:
            if ball.density is None:
                raise InvalidInput("mass is missing: the sphere's material has no density to compute it from")
            mass = 4 / 3 * math.pi * radius * radius * radius * ball.density
        stiffness = _studies.normal_stiffness(modulus, radius)
        law = with_restitution(
            laws.AzadFeatherstoneNormal(stiffness=stiffness, damping=0.0), mass, speed, restitution
        )
        damping_time = law.damping / (1.5 * stiffness)
    return Coefficients(**_studies.contact_coefficients(*sides, radius, damping_time, tangential == "mindlin"))


def with_restitution(normal: Any, mass: float, speed: float, restitution: float) -> Any:
    """The law with the damping at which a sphere of ``mass`` [kg] that comes in at ``speed`` [m/s] keeps
    ``restitution`` of it, without gravity. The damping that the law has plays no part.

    Raises InvalidInput where the law has no damping, or none gives that restitution.
    """
    return _studies.with_restitution(
        laws._law("normal", normal, "Normal"),
        _arguments.number("mass", mass, "kg", above=0),
        _arguments.number("speed", speed, "m/s", above=0),
        _arguments.number("restitution", restitution),
    )


# Parameters from measurements ---------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class LawFit(Compared):
    """What one law makes of the data."""

    law: Any
    """With the estimates."""
    estimates: pd.DataFrame
    """By parameter: value, unit, standard_error, low and high of the interval, fixed, at_bound. NaN where the data do
    not determine it."""
    correlation: pd.DataFrame
    """Of the estimates."""
    combinations: pd.DataFrame
    """Products of powers that the data determine where they do not determine each factor: value, standard_error, low,
    high."""
    warnings: list[str]
    """Whole sentences."""
    rms: float
    """Of data - model, in the data's unit."""
    aicc: float
    """Akaike's criterion, corrected for few data."""
    aicc_difference: float
    """To the best law; below 2 there is little to choose."""
    weight: float
    """Akaike's: how likely this law is the best of those compared."""
    converged: bool

    def __repr__(self) -> str:
        state = "" if self.converged else ", not converged"
        return f"<footfall.studies.LawFit {self.law!r}: rms {self.rms:.3g}, AICc {self.aicc:.4g}{state}>"


@dataclass(frozen=True, eq=False)
class Fit(Compared):
    """A fit of one or more laws to the same data. ``print(fit)`` shows the report."""

    dataset: xr.Dataset
    """The data, and each law's model and residuals."""
    fits: list[LawFit]
    """In the order of the laws asked for."""
    best: LawFit
    """The one with the smallest AICc."""
    report: str
    """A page for a person, as ``footfall fit`` prints it."""
    notes: list[str]
    """What was read as what, which columns were not used, how many rows were left out; whole sentences."""
    warnings: list[str]
    """What of the data may not be meant, such as depths in metres without a unit; whole sentences. Python's
    :mod:`warnings` has them too."""

    def __str__(self) -> str:
        return self.report.rstrip("\n")

    def __repr__(self) -> str:
        laws_ = f"{len(self.fits)} law{'s' * (len(self.fits) != 1)}"
        return f"<footfall.studies.Fit of {laws_} to {self.dataset.sizes['row']} rows: best is {self.best!r}>"


def _warn(doubts: list[str]) -> None:
    """Says what a caller may not have meant, at the line that called the study."""
    for text in doubts:
        warnings.warn(text, stacklevel=3)


#: Points to search from that make sense: with more, somebody has mistaken the argument for another.
_MOST_STARTS = 1_000_000


def fit(
    data: str | os.PathLike[str] | pd.DataFrame,
    normal: str | Sequence[str],
    *,
    mass: float | str | None = None,
    speed: float | str | None = None,
    touchdown: float | str = 0.0,
    quasistatic: bool = False,
    loss: Literal["none", "huber", "cauchy"] = "none",
    starts: int = 4,
    confidence: float = 0.95,
    sigma_is_true: bool = False,
    columns: Mapping[str, str] | None = None,
    where: Mapping[str, str] | None = None,
    skip_bad_rows: bool = False,
    kind: Literal["restitution", "force-indentation", "force-time"] | None = None,
    gravity: float = 9.81,
) -> Fit:
    """Fits parameters of normal laws to measurements.

    Parameters
    ----------
    data
        A file, or a DataFrame, with a column for each quantity, read as ``docs/tables.md`` says: speed and restitution
        (or speeds or heights before and after, or the times of bounces); or indentation, force and perhaps rate; or
        time and force. A column sigma has the standard deviations. Units stand in the columns' names, "speed [mm/s]";
        without one they are in SI units.
    normal
        One law or several in a list, as text; ``?`` stands for what is fitted:
        ``"azad-featherstone:stiffness=?,damping=?"``, ``"...=?8e6"`` with a start, ``"...=?1e6..1e7"`` with bounds.
    mass, speed, touchdown
        [kg], [m/s] and [s], or such a text, where the data need them.
    quasistatic
        Force against indentation was measured so slowly that the rate is 0.
    loss
        huber or cauchy where some of the data may be far off.
    starts
        Points to search from.
    confidence
        Of the intervals.
    sigma_is_true
        The column sigma has true standard deviations, not only their ratios.
    columns
        Which column holds a quantity, where its name does not tell: ``{"speed": "U [mm/s]"}``. A minus before the
        column's name turns the sign of its numbers.
    where
        Only the rows that have these values in these columns: ``{"series": "Experiment"}``.
    skip_bad_rows
        Rows that cannot be used are left out and counted in :attr:`Fit.notes`; otherwise they are errors.
    kind
        What was measured, where the columns fit more than one kind.
    gravity
        [m/s^2], > 0: turns heights and times of flight into speeds.

    Raises
    ------
    ScenarioError
        With everything that is wrong in the data, and where.
    InvalidInput
        Where something needed is missing or out of its range.
    """
    _arguments.choice("loss", loss, ("none", "huber", "cauchy"))
    starts = _arguments.integer("starts", starts, 1, _MOST_STARTS)
    confidence = _arguments.number("confidence", confidence, above=0)
    quasistatic = _arguments.flag("quasistatic", quasistatic)
    sigma_is_true = _arguments.flag("sigma_is_true", sigma_is_true)
    skip_bad_rows = _arguments.flag("skip_bad_rows", skip_bad_rows)
    gravity = _arguments.number("gravity", gravity, "m/s^2", above=0)
    if kind is not None:
        _arguments.choice("kind", kind, ("restitution", "force-indentation", "force-time"))
    if isinstance(normal, str):
        texts = [_arguments.text("normal", normal)]
    elif isinstance(normal, Iterable) and not isinstance(normal, bytes):
        texts = [_arguments.text(f"normal[{i}]", text) for i, text in enumerate(normal)]
    else:
        raise TypeError(f"normal: a law's text or a list of them is wanted, not {_arguments.described(normal)}")
    if not texts:
        raise InvalidInput("normal: at least one law is wanted")
    file, csv = None, ""
    if isinstance(data, pd.DataFrame):
        buffer = io.StringIO()
        data.to_csv(buffer, index=False, float_format="%.17g")
        csv = buffer.getvalue()
    elif isinstance(data, (str, os.PathLike)):
        file = _arguments.path("data", data)
    else:
        raise TypeError(f"data: a path or a pandas.DataFrame is wanted, not {_arguments.described(data)}")

    def written(name: str, value: float | str | None) -> str | None:
        if value is None or isinstance(value, str):
            return None if value is None else _arguments.text(name, value)
        return repr(_arguments.number(name, value))

    table, results, best, report, notes, doubts = _studies.fit(
        file,
        csv,
        _arguments.texts("columns", columns),
        list(_arguments.texts("where", where).items()),
        skip_bad_rows,
        kind,
        gravity,
        texts,
        written("mass", mass),
        written("speed", speed),
        written("touchdown", touchdown) or "0",
        quasistatic,
        loss,
        starts,
        confidence,
        sigma_is_true,
    )
    fits = [_law_fit(**result) for result in results]
    _warn(doubts)
    return Fit(_labelled(table), fits, fits[best], report, notes, doubts)


def _law_fit(estimates: Any, correlation: Any, combinations: Any, **rest: Any) -> LawFit:
    columns = ["parameter", "unit", "value", "standard_error", "low", "high", "fixed", "at_bound"]
    table = pd.DataFrame(estimates, columns=columns).set_index("parameter")
    names = list(table.index)
    return LawFit(
        estimates=table,
        correlation=pd.DataFrame(correlation, index=names, columns=names),
        combinations=pd.DataFrame(
            combinations, columns=["combination", "value", "standard_error", "low", "high"]
        ).set_index("combination"),
        **rest,
    )

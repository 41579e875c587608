"""A run: everything it gives back, from one labelled dataset."""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, make_dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import xarray as xr

from footfall import _arguments, _channels
from footfall._files import read_netcdf, written_whole
from footfall._values import Compared
from footfall.errors import InvalidInput

if TYPE_CHECKING:
    from footfall._core import EnergyChannels
    from footfall.scenario import Scenario
else:
    EnergyChannels = object

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class State(Compared):
    """A body and its contacts at one moment. Vectors are in the world's frame.

    Of an event the contact is that of the event's sphere; :class:`Final` has those of all spheres.
    """

    position: Floats
    """Of the centre of mass [m], shape (3,)."""
    velocity: Floats
    """Of the centre of mass [m/s], shape (3,)."""
    orientation: Floats
    """Unit quaternion w, x, y, z from the body's frame to the world's, shape (4,)."""
    angular_velocity: Floats
    """[rad/s], shape (3,)."""
    depth: Any
    """Indentation [m]; negative in flight: minus the gap."""
    depth_rate: Any
    """[m/s], > 0 while loading."""
    normal_force: Any
    """On the body, along the ground's normal [N], >= 0."""
    friction_force: Floats
    """On the body [N], shape (3,) or (sphere, 3)."""
    slip_velocity: Floats
    """Of the sphere's bottom point in the ground's plane [m/s], shape (3,) or (sphere, 3)."""
    bristle: Floats
    """Tangential deformation of the ground [m], shape (3,) or (sphere, 3)."""


@dataclass(frozen=True)
class Event:
    """Something that happened to one contact."""

    time: float
    """[s]"""
    kind: str
    """touchdown, stick, slip, separation or recovered."""
    sphere: int
    """Index into the body's spheres."""
    state: State
    """At that time, in the phase that the event begins."""


@dataclass(frozen=True, eq=False)
class Final(State):
    """The end of a run. Contacts are those of all spheres, along the first axis."""

    time: float
    """[s]"""
    phase: tuple[str, ...]
    """Of each sphere: flight, stick, slip or recovering."""


@dataclass(frozen=True)
class Impact:
    """One visit of a sphere to the ground. What had not happened by the end of the run is None."""

    sphere: int
    touchdown: float
    """[s]"""
    separation: float | None
    """Last time before recovery that the normal force reached zero [s]."""
    recovered: float | None
    """When the indentation returned to zero [s]."""
    speed_in: float
    """Into the ground at touchdown [m/s]."""
    speed_out: float | None
    """Out of the ground at recovery [m/s]."""
    restitution: float | None
    """speed_out / speed_in."""
    peak_normal_force: float
    """[N]"""
    peak_indentation: float
    """[m]"""
    stick_time: float
    """Time spent sticking [s]."""


@dataclass(frozen=True)
class Energy(EnergyChannels):
    """The account of energy at the end of a run [J]; its course is in the dataset's ``energy_...``.

    It has an attribute for each channel of energy of the contacts: ``normal_spring``, ``clutch`` and so on.
    """

    initial: float
    """Total at the start."""
    kinetic: float
    potential: float
    """Zero at the world's origin."""
    if not TYPE_CHECKING:  # one for each channel; type checkers have them from EnergyChannels
        __annotations__.update({channel.name: "float" for channel in _channels.TABLE})
    tangential_spring_paper: float
    """Azad & Featherstone 2010, (33): what the tangential spring holds and its changing stiffness takes."""
    total: float
    residual: float
    """(total - initial) / scale."""
    max_residual: float
    """The largest residual over all steps, without its sign."""
    scale: float
    """The largest sum of all entries without their signs [J]."""


_channels.list_in_docstring(Energy, lambda channel: f"{channel.name}: {channel.description}")


def _energy(entries: dict[str, float]) -> Energy:
    """The account, with what a file has beside the channels of the table."""
    beside = tuple(name for name in entries if name not in _fields(Energy))
    return (_energy_with(beside) if beside else Energy)(**entries)


@cache
def _energy_with(names: tuple[str, ...]) -> type[Energy]:
    return make_dataclass(
        "Energy",
        [(name, float) for name in names],
        bases=(Energy,),
        namespace={"__reduce__": lambda self: (_energy, (dataclasses.asdict(self),))},
        frozen=True,
    )


@dataclass(frozen=True)
class Cost:
    """What a run cost, all its attempts together."""

    steps: int
    """Accepted."""
    rejected: int
    """Rejected for their error."""
    stiff_steps: int
    """Those of ``steps`` that the implicit method took."""
    evaluations: int
    """Of the equations of motion."""
    wall_seconds: float | None
    """None where the run comes from a file, which does not keep it."""


def _fields(kind: type) -> list[str]:
    return [field.name for field in dataclasses.fields(kind)]


def _none_if_missing(value: float) -> float | None:
    return None if math.isnan(value) else value


class Run:
    """A run, as :func:`footfall.run` and :func:`footfall.open` give it.

    ``print(run)`` shows the page that the command line prints, of a run that was just made; of one from a file, which
    does not keep it, a line. Runs can be pickled and copied; they are equal where their datasets are identical.
    """

    def __init__(self, dataset: xr.Dataset, wall_seconds: float | None = None, page: str | None = None) -> None:
        self._dataset = dataset
        self._wall_seconds = wall_seconds
        self._page = page

    @property
    def dataset(self) -> xr.Dataset:
        """Every sample, event and impact, labelled with units: what ``footfall run -o RUN.nc`` writes.

        Dimensions: time, sphere, axis (x, y, z), quaternion (w, x, y, z), event, impact.
        :meth:`save` writes it; :func:`footfall.open` reads it.
        """
        return self._dataset

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the dataset as a NetCDF-4 file, as ``footfall run -o`` does, and gives its path.

        The file appears whole or not at all, in place of one that was there. Any number of threads may save and
        :func:`footfall.open` at once. ``dataset.to_netcdf`` writes the same file, but only one thread at a time may
        call it: the NetCDF library below it is not made for threads.

        Raises
        ------
        OSError
            Where the file cannot be written.
        """
        return written_whole(_arguments.path("path", path), self._dataset)

    @property
    def title(self) -> str:
        """Of the scenario."""
        return str(self._dataset.attrs["title"])

    @cached_property
    def scenario(self) -> Scenario:
        """The scenario as it was read. ``dataset.attrs["tolerance"]`` is the tolerance that was used."""
        from footfall.scenario import Scenario

        return Scenario.parse(str(self._dataset.attrs["scenario"]))

    @cached_property
    def events(self) -> list[Event]:
        """In the order of time."""
        data = self._dataset
        kinds = data["event_kind"].attrs["flag_meanings"].split()
        columns = {name: data[f"event_{name}"].values for name in _fields(State)}
        times, kind, sphere = (data[f"event_{name}"].values for name in ("time", "kind", "sphere"))
        return [
            Event(
                float(times[i]),
                kinds[kind[i]],
                int(sphere[i]),
                State(**{name: _number_or_view(values[i]) for name, values in columns.items()}),
            )
            for i in range(data.sizes["event"])
        ]

    @cached_property
    def impacts(self) -> list[Impact]:
        """In the order of touchdown."""
        data = self._dataset
        columns = {name: data[f"impact_{name}"].values for name in _fields(Impact)}
        missing = {field.name for field in dataclasses.fields(Impact) if "None" in str(field.type)}
        impacts = []
        for i in range(data.sizes["impact"]):
            values: dict[str, Any] = {name: column[i].item() for name, column in columns.items()}
            for name in missing:
                values[name] = _none_if_missing(values[name])
            impacts.append(Impact(**values))
        return impacts

    @cached_property
    def final(self) -> Final:
        """The last moment of the run."""
        last = self._dataset.isel(time=-1)
        phases = last["phase"].attrs["flag_meanings"].split()
        return Final(
            **{name: last[name].values for name in _fields(State)},
            time=float(last["time"]),
            phase=tuple(phases[phase] for phase in last["phase"].values),
        )

    @cached_property
    def energy(self) -> Energy:
        """Where every joule is at the end, as ``footfall run --json`` has it."""
        data = self._dataset
        entries = {
            "initial": float(data["energy_total"][0]),
            "max_residual": float(data.attrs["max_residual"]),
            "scale": float(data.attrs["energy_scale"]),
        }
        names = [*_fields(Energy), *(channel.name for channel in _channels.of_dataset(data))]
        return _energy(entries | {name: float(data[f"energy_{name}"][-1]) for name in names if name not in entries})

    @cached_property
    def cost(self) -> Cost:
        """How much work it was."""
        attrs = self._dataset.attrs
        return Cost(
            steps=int(attrs["steps"]),
            rejected=int(attrs["rejected_steps"]),
            stiff_steps=int(attrs["stiff_steps"]),
            evaluations=int(attrs["evaluations"]),
            wall_seconds=self._wall_seconds,
        )

    def __getstate__(self) -> dict[str, Any]:
        # Not what is computed from the dataset when it is asked for.
        return {"_dataset": self._dataset, "_wall_seconds": self._wall_seconds, "_page": self._page}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Run):
            return NotImplemented
        return bool(self._dataset.identical(other._dataset))

    def __hash__(self) -> int:
        return hash((self.title, self._dataset.attrs["scenario"]))

    def __str__(self) -> str:
        return repr(self) if self._page is None else self._page.rstrip("\n")

    def __repr__(self) -> str:
        sizes = self._dataset.sizes
        return (
            f"<footfall.Run {self.title!r}: {self.final.time:g} s, {sizes['time']} samples, {sizes['event']} events, "
            f"{sizes['impact']} impacts, largest residual {self.energy.max_residual:.1e}>"
        )


# What makes a file one of a run: what Run reads.
_ATTRIBUTES = ("footfall_version", "title", "scenario", "tolerance", "steps", "rejected_steps", "stiff_steps",
               "evaluations", "max_residual", "energy_scale", "friction_law")  # fmt: skip
_OF_BODY = {"position": ("axis",), "velocity": ("axis",), "orientation": ("quaternion",),
            "angular_velocity": ("axis",)}  # fmt: skip
_OF_CONTACT: dict[str, tuple[str, ...]] = {"depth": (), "depth_rate": (), "normal_force": (),
                                           "friction_force": ("axis",), "slip_velocity": ("axis",),
                                           "bristle": ("axis",)}  # fmt: skip
_VARIABLES: dict[str, tuple[str, ...]] = {
    "time": ("time",),
    "phase": ("time", "sphere"),
    "sphere_radius": ("sphere",),
    "sphere_center": ("sphere", "axis"),
    "ground_normal": ("axis",),
    "ground_height": (),
    **{name: ("time", *axis) for name, axis in _OF_BODY.items()},
    **{name: ("time", "sphere", *axis) for name, axis in _OF_CONTACT.items()},
    **{f"event_{name}": ("event", *axis) for name, axis in (_OF_BODY | _OF_CONTACT).items()},
    **{f"event_{name}": ("event",) for name in ("time", "kind", "sphere")},
    **{f"impact_{name}": ("impact",) for name in _fields(Impact)},
    **{f"energy_{name}": ("time",) for name in _fields(Energy) if name not in ("initial", "max_residual", "scale")},
}


def _number_or_view(value: Any) -> Any:
    return float(value) if value.ndim == 0 else value


def run(
    scenario: str | os.PathLike[str] | Mapping[str, Any] | Scenario,
    *,
    tolerance: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Run:
    """Runs a scenario.

    The run goes on without the GIL, and Ctrl-C (KeyboardInterrupt) ends it.

    Parameters
    ----------
    scenario
        A file, the name of a shipped scenario where there is no such file, a dict nested as the file's tables, or a
        :class:`Scenario`.
    tolerance
        Relative error of a step, from 1e-14 to 1e-3, in place of the scenario's.
    progress
        Called some fifty times a second with the time reached [s]; where it returns False the run ends with
        :class:`Interrupted`.

    Raises
    ------
    ScenarioError
        With everything that is wrong in the scenario, and where.
    InvalidInput
        Where the tolerance is out of range, or the scenario cannot be simulated.
    TypeError
        Where an argument is of another kind.
    TooExpensive
        Where it would need more than ``solver.max_evaluations``.
    OSError
        Where the file cannot be read.

    Examples
    --------
    >>> import footfall
    >>> run = footfall.run("single-impact")
    >>> print(f"{run.impacts[0].restitution:.3f}")
    0.620
    """
    from footfall import _core  # here, so that what reads and draws runs does without the extension
    from footfall.scenario import as_scenario

    if tolerance is not None:
        tolerance = _arguments.number("tolerance", tolerance, infinite=True)
    _arguments.function("progress", progress)
    watch = progress and (lambda time: not _is_false(progress(time)))
    (attributes, variables), wall_seconds, page = _core.run(as_scenario(scenario)._core, tolerance, watch)
    return Run(_dataset(attributes, variables), wall_seconds, page)


def _is_false(answer: object) -> bool:
    """Whether it is False, Python's or NumPy's; None and 0 are no answer."""
    return isinstance(answer, (bool, np.bool_)) and not answer


def open(path: str | os.PathLike[str]) -> Run:  # noqa: A001
    """Reads a run from a NetCDF file that ``footfall run -o`` or :meth:`footfall.Run.save` has written.

    Any number of threads may do so at once.

    Raises
    ------
    InvalidInput
        Where the file is not one of a run, or not a whole one.
    OSError
        Where it cannot be read.
    """
    file = _arguments.path("path", path)
    dataset = read_netcdf(file)
    missing = [f"the attribute '{name}'" for name in _ATTRIBUTES if name not in dataset.attrs]
    missing += [f"the variable '{name}'" for name in _VARIABLES if name not in dataset.variables]
    if missing:
        raise InvalidInput(f"{file}: is not a run of footfall: {missing[0]} is missing")
    for name, dimensions in _VARIABLES.items():
        if dataset[name].dims != dimensions:
            raise InvalidInput(f"{file}: is not a run of footfall: the variable '{name}' is not one over {dimensions}")
    if dataset.sizes["time"] == 0:
        raise InvalidInput(f"{file}: is not a run of footfall: it has no sample")
    return Run(dataset)


def _dataset(attributes: dict[str, Any], variables: list[tuple[str, list[str], Any, dict[str, Any]]]) -> xr.Dataset:
    """Arrays of C++, labelled. Nothing is copied."""
    coordinates: dict[str, Any] = {}
    data: dict[str, Any] = {}
    for name, dimensions, values, attrs in variables:
        if isinstance(values, list):
            values = np.array(values, dtype=object)
        # A variable named as its own dimension is that dimension's coordinate.
        (coordinates if dimensions == [name] else data)[name] = (dimensions, values, attrs)
    return xr.Dataset(data, coordinates, attributes)

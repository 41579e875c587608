"""The channels of energy of a contact: the table of the C++ library (include/footfall/energy/channels.hpp)."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import xarray as xr


class Channel(NamedTuple):
    """One channel, as files and figures know it."""

    name: str
    kind: str
    """held, taken, unpaid or worked."""
    label: str
    """For a legend."""
    description: str
    response: str
    """What a Response calls it."""


def _table() -> tuple[Channel, ...]:
    try:
        from footfall._core import CHANNELS
    except ModuleNotFoundError:  # what reads and draws runs does without the extension: files say what is in them
        return ()
    return tuple(Channel(c.name, c.kind, c.label, c.description, c.response) for c in CHANNELS)


#: In the order of every output; empty without the extension.
TABLE: tuple[Channel, ...] = _table()

_SUMS = ("tangential_spring_paper",)  # made of channels, with variables like theirs


def of_dataset(data: xr.Dataset) -> tuple[Channel, ...]:
    """The channels of a run's dataset. What is not in the table is what the file says of it."""
    known = {channel.name: channel for channel in (*_listed(data), *TABLE)}
    said = {
        name: _described(name, str(data[f"sphere_energy_{name}"].attrs.get("long_name", "")))
        for name in (str(n).removeprefix("sphere_energy_") for n in data if str(n).startswith("sphere_energy_"))
        if name not in _SUMS
    }
    return tuple(known[name] for name in known if name in said) + tuple(said[name] for name in said if name not in known)


def _listed(data: xr.Dataset) -> tuple[Channel, ...]:
    """The channels that the file lists, in its order: variables of a file have none."""
    entries = (entry.split(": ") for entry in str(data.attrs.get("energy_channels", "")).split(", ") if entry)
    return tuple(Channel(name, kind, label, "", _response(name, kind)) for name, kind, label in entries)


def _response(name: str, kind: str) -> str:
    return name if kind == "held" else f"{name}_power"


def _described(name: str, description: str) -> Channel:
    """A channel from the text of its variable: "energy taken by the clutch"."""
    said = re.match(r"energy (held|taken) by the ([^;]+)", description)
    kind, label = said.groups() if said else ("taken", name.replace("_", " "))
    return Channel(name, kind, label, description, _response(name, kind))


def list_in_docstring(kind: type, line: Callable[[Channel], str]) -> None:
    """Adds a line for each channel of the table to the docstring of a class that has an attribute for each."""
    if TABLE:
        kind.__doc__ = "\n".join([inspect.getdoc(kind) or "", "", "Channels:", "", *(f"- {line(c)}" for c in TABLE)])

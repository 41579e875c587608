"""The channels of energy of a contact: the table of the C++ library (include/footfall/energy/channels.hpp)."""

from __future__ import annotations

import importlib.util
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
    # What reads and draws runs does without the extension: the file says what is in it.
    if importlib.util.find_spec("footfall._core") is None:
        return ()
    from footfall import _core

    return tuple(Channel(c.name, c.kind, c.label, c.description, c.response) for c in _core.CHANNELS)


#: In the order of every output; empty without the extension.
TABLE: tuple[Channel, ...] = _table()

_SUMS = ("tangential_spring_paper",)  # made of channels, with a variable beside them


def of_dataset(data: xr.Dataset) -> tuple[Channel, ...]:
    """The channels of a run's dataset. What is not in the table is what the file says of it."""
    known = {channel.name: channel for channel in TABLE}
    names = [str(name).removeprefix("sphere_energy_") for name in data if str(name).startswith("sphere_energy_")]
    return tuple(
        known.get(name) or _described(name, str(data[f"sphere_energy_{name}"].attrs.get("long_name", "")))
        for name in names
        if name not in _SUMS
    )


def _described(name: str, description: str) -> Channel:
    """A channel from the text of its variable: "energy taken by the clutch"."""
    said = re.match(r"energy (held|taken) by the ([^;]+)", description)
    kind, label = said.groups() if said else ("taken", name.replace("_", " "))
    return Channel(name, kind, label, description, name if kind == "held" else f"{name}_power")


def list_in_docstring(kind: type, line: Callable[[Channel], str]) -> None:
    """Adds a line for each channel of the table to the docstring of a class that has an attribute for each."""
    if TABLE:
        kind.__doc__ = "\n    ".join([f"{kind.__doc__}Channels:", "", *(f"- {line(channel)}" for channel in TABLE), ""])

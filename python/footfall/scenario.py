"""Scenarios: files, texts or dicts that say what to simulate."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from footfall import _arguments, _core
from footfall.errors import InvalidInput

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


class Scenario:
    """What to simulate: read from a file, a text or a dict, and checked.

    Make one with :meth:`load`, :meth:`parse` or :meth:`from_dict`; :func:`footfall.run` takes all of these directly.
    ``print(scenario)`` shows what it describes. Scenarios are equal where their texts are; they can be pickled, copied
    and used as keys.
    """

    __slots__ = ("_core",)

    def __init__(self, core: _core.Scenario) -> None:
        if not isinstance(core, _core.Scenario):
            raise TypeError("Scenario(core): make one with Scenario.load, Scenario.parse or Scenario.from_dict")
        self._core = core

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scenario:
        """Reads a scenario file (TOML), or a shipped scenario by its name where there is no such file.

        Raises
        ------
        ScenarioError
            With everything that is wrong in it, and where.
        OSError
            Where it cannot be read.
        """
        return cls(_load("path", path))

    @classmethod
    def parse(cls, text: str, name: str = "scenario") -> Scenario:
        """Reads a scenario from its text; ``name`` stands for the file in messages. Raises ScenarioError."""
        return cls(_core.Scenario.parse(_arguments.text("text", text, null=True), _arguments.text("name", name)))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], name: str = "scenario") -> Scenario:
        """Reads a scenario from dicts nested as the file's tables. Raises ScenarioError; InvalidInput where a value is
        of a kind that TOML does not have."""
        return cls.parse(to_toml(tables), name)

    @property
    def name(self) -> str:
        """The file, or what stands for it in messages."""
        return self._core.name

    @property
    def title(self) -> str:
        """As the scenario says; may be empty."""
        return self._core.title

    @property
    def text(self) -> str:
        """The TOML text as it was read."""
        return self._core.text

    @property
    def simulation(self) -> _core.Simulation:
        """What the text describes, in SI units with every default in place. To read; to change it, change the text or
        the dict."""
        return self._core.simulation

    def to_dict(self) -> dict[str, Any]:
        """The text as dicts, to change and give to :func:`footfall.run`. Defaults are not filled in."""
        return tomllib.loads(self.text)

    def __str__(self) -> str:
        return self._core.summary().rstrip("\n")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scenario):
            return NotImplemented
        return self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"Scenario({self.name!r}, title={self.title!r})"

    def __reduce__(self) -> tuple[object, ...]:
        return _parse, (self.text, self.name)


def _load(argument: str, path: str | os.PathLike[str]) -> _core.Scenario:
    """The scenario in a file, or the shipped one of that name; ``argument`` is what the caller calls the path."""
    file = _arguments.path(argument, path)
    shipped = shipped_scenarios()
    if str(file) in shipped and not os.path.lexists(file):
        file = shipped[str(file)]
    try:
        return _core.Scenario.load(file)
    except FileNotFoundError as error:
        said = _arguments.shown(file)
        message = (
            f"cannot read {said}: there is no such file, and no scenario of this name comes with footfall"
            f"{_core.did_you_mean(Path(said).stem, list(shipped))} (footfall.shipped_scenarios() has their names)"
        )
        raise _arguments.os_error(error.errno or 0, message) from None


def _parse(text: str, name: str) -> Scenario:
    return Scenario.parse(text, name)


def to_toml(tables: Mapping[str, Any]) -> str:
    """The TOML text of dicts nested as a scenario's tables. NumPy numbers and arrays may stand for numbers and lists.

    Raises InvalidInput where a value is of a kind that TOML does not have, with the key.
    """
    return document("tables", tables)


def document(argument: str, tables: Mapping[str, Any]) -> str:
    """The TOML text of dicts that were given as ``argument``."""
    if not isinstance(tables, Mapping):
        raise TypeError(f"{argument}: a dict nested as the file's tables is wanted, not {_arguments.described(tables)}")
    try:
        return tomli_w.dumps(_plain(tables, "", argument))
    except RecursionError:
        raise InvalidInput(f"{argument}: is nested too deeply, or contains itself") from None


def _plain(value: Any, key: str, argument: str) -> Any:
    """The value as TOML knows it."""
    if isinstance(value, Mapping):
        for name in value:
            if not isinstance(name, str):
                raise InvalidInput(f"{key or argument}: the key {name!r} is not allowed: must be a string")
            _arguments.text(key or argument, name)
        return {name: _plain(item, f"{key}.{name}" if key else name, argument) for name, item in value.items()}
    if isinstance(value, (np.ndarray, np.generic)):
        return _plain(value.tolist(), key, argument)
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{key}[{i}]", argument) for i, item in enumerate(value)]
    if isinstance(value, str):
        return _arguments.text(key, value, null=True)
    if isinstance(value, (bool, int, float)):
        return value
    said = _arguments.described(value)
    raise InvalidInput(
        f"{key}: {said} is not allowed: must be a number, a string, true or false, a list or a dict"
    )


def as_scenario(scenario: str | os.PathLike[str] | Mapping[str, Any] | Scenario) -> Scenario:
    """What footfall.run takes, as a Scenario."""
    if isinstance(scenario, Scenario):
        return scenario
    if isinstance(scenario, Mapping):
        return Scenario.parse(document("scenario", scenario))
    if isinstance(scenario, (str, os.PathLike)):
        return Scenario(_load("scenario", scenario))
    raise TypeError(f"scenario: a path, a dict or a Scenario is wanted, not {type(scenario).__name__}")


def shipped_scenarios() -> dict[str, Path]:
    """The scenarios that come with the package, the paper's figures among them, by name."""
    folder = Path(__file__).parent / "scenarios"
    return {file.stem: file for file in sorted(folder.glob("*.toml"))}

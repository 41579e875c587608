"""Every normal and friction law, as a class of its parameters.

The classes come from the registry of the C++ library; ``footfall laws`` on the command line lists the same. A parameter
is a number in the unit that the class's documentation gives, or a string with a unit::

    normal = footfall.laws.AzadFeatherstoneNormal(stiffness=8.5e6, damping="3.1 kN s/m^1.5")
    friction = footfall.laws.friction("azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2")
"""

from __future__ import annotations

from typing import Any

from footfall import _arguments
from footfall._core import laws as _laws
from footfall._core.laws import *  # noqa: F403


def normal(text: str) -> Any:  # type: ignore[no-redef]
    """A normal law from one line, such as ``"azad-featherstone:stiffness=8.5e6,damping=3.1e3"``. Raises
    InvalidInput."""
    return _laws.normal(_arguments.text("text", text))


def friction(text: str) -> Any:  # type: ignore[no-redef]
    """A friction law from one line, such as
    ``"azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2"``. Raises InvalidInput."""
    return _laws.friction(_arguments.text("text", text))


_KINDS = {
    kind: tuple(getattr(_laws, name) for name in dir(_laws) if name.endswith(kind)) for kind in ("Normal", "Friction")
}


def _law(name: str, given: Any, kind: str) -> Any:
    """A law of the kind, ``Normal`` or ``Friction``, that was given as such or as its text to the argument ``name``."""
    if isinstance(given, str):
        read = _laws.normal if kind == "Normal" else _laws.friction
        return read(_arguments.text(name, given))
    if isinstance(given, _KINDS[kind]):
        return given
    other = "Friction" if kind == "Normal" else "Normal"
    said = _arguments.described(given)
    if isinstance(given, _KINDS[other]):
        said = f"{type(given).__name__}, which is a {other.lower()} law"
    elif isinstance(given, type):
        said = f"the class {given.__name__} itself: call it with its parameters"
    raise TypeError(f"{name}: a law of footfall.laws or its text is wanted, not {said}")


def _friction_or_none(name: str, given: Any) -> Any:
    """A friction law; None stands for no friction."""
    return _laws.NoneFriction() if given is None else _law(name, given, "Friction")


def _make(name: str, parameters: dict[str, float]) -> object:
    """What a pickled law is made from."""
    return getattr(_laws, name)(**parameters)


def __dir__() -> list[str]:
    return [name for name in dir(_laws) if not name.startswith("_")]

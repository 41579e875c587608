"""Every normal and friction law, as a class of its parameters.

The classes come from the registry of the C++ library; ``footfall laws`` on the command line lists the same. A parameter
is a number in the unit that the class's documentation gives, or a string with a unit::

    normal = footfall.laws.AzadFeatherstoneNormal(stiffness=8.5e6, damping="3.1 kN s/m^1.5")
    friction = footfall.laws.friction("azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2")
"""

from __future__ import annotations

from footfall._core import laws as _laws
from footfall._core.laws import *  # noqa: F403


def _make(name: str, parameters: dict[str, float]) -> object:
    """What a pickled law is made from."""
    return getattr(_laws, name)(**parameters)


def __dir__() -> list[str]:
    return [name for name in dir(_laws) if not name.startswith("_")]

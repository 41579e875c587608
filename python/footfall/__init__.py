"""Compliant contact between spheres and the ground, with every joule accounted for.

>>> import footfall
>>> run = footfall.run("rolling-sphere")
>>> run.events[0].kind
'touchdown'
>>> run.dataset["normal_force"].attrs["units"]
'N'
"""

from __future__ import annotations

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from footfall import figures, laws, paper, plot, studies
    from footfall._core import __version__
    from footfall.contact import FLIGHT, PHASES, RECOVERING, SLIP, STICK, ContactLaw, Response, Step
    from footfall.contact_set import ContactSet, HostEnergy, HostEvent, HostStep
    from footfall.errors import Interrupted, InvalidInput, Problem, ScenarioError, TooExpensive
    from footfall.results import Cost, Energy, Event, Final, Impact, Run, State, open, run
    from footfall.scenario import Scenario, shipped_scenarios, to_toml

__all__ = [
    "FLIGHT",
    "PHASES",
    "RECOVERING",
    "SLIP",
    "STICK",
    "ContactLaw",
    "ContactSet",
    "Cost",
    "Energy",
    "Event",
    "Final",
    "HostEnergy",
    "HostEvent",
    "HostStep",
    "Impact",
    "Interrupted",
    "InvalidInput",
    "Problem",
    "Response",
    "Run",
    "Scenario",
    "ScenarioError",
    "State",
    "Step",
    "TooExpensive",
    "__version__",
    "laws",
    "open",
    "run",
    "shipped_scenarios",
    "studies",
    "to_toml",
]

# Loaded when first asked for, the extension last: to read a run and draw it takes no compiled code.
_MODULES = ("errors", "results", "scenario", "contact", "contact_set", "_core")


# Loaded when first asked for. These draw with Matplotlib, which not everybody has, so that `import *` leaves them out.
_DRAWING = ("figures", "paper", "plot")


def __getattr__(name: str) -> Any:
    if name in ("laws", "studies", *_DRAWING):
        return importlib.import_module(f"footfall.{name}")
    if name in __all__:
        for module in _MODULES:
            found = vars(importlib.import_module(f"footfall.{module}"))
            if name in found:
                return globals().setdefault(name, found[name])
    raise AttributeError(f"module 'footfall' has no attribute '{name}'")


def __dir__() -> list[str]:
    drawing = _DRAWING if importlib.util.find_spec("matplotlib") else ()
    own = (name for name in globals() if name.startswith("__"))
    return sorted({*own, *__all__, *drawing})

"""The contact law by itself, over NumPy arrays, for simulators of your own."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from footfall import _core, laws
from footfall.errors import InvalidInput

Floats = npt.NDArray[np.float64]

#: Names of the phases, in the order of the numbers that stand for them: flight, stick, slip, recovering.
PHASES: tuple[str, ...] = _core.PHASES

FLIGHT, STICK, SLIP, RECOVERING = range(4)


@dataclass(frozen=True)
class Response:
    """What contacts do at one moment. Forces act on the body; ``(...)`` is the shape that the arguments share.

    Tangential vectors have two components, in the ground's plane.
    """

    phase: npt.NDArray[np.int8]
    """Index into :data:`PHASES`, shape (...)."""
    normal_force: Floats
    """F_n [N], >= 0, shape (...)."""
    friction_force: Floats
    """F_f [N], shape (..., 2)."""
    bristle_rate: Floats
    """du/dt [m/s], shape (..., 2); of a friction law with internal states their rates, shape (..., law.states)."""
    normal_spring: Floats
    """Energy stored in the normal spring [J], shape (...)."""
    tangential_spring: Floats
    """Energy stored in the bristle [J], shape (...)."""
    normal_damper_power: Floats
    """Dissipated [W], shape (...)."""
    tangential_damper_power: Floats
    """Dissipated [W], shape (...)."""
    clutch_power: Floats
    """Dissipated [W], shape (...)."""
    stiffness_change_power: Floats
    """What the changing tangential stiffness takes with no force paying for it [W], shape (...); negative: it gives."""


@dataclass(frozen=True)
class Step:
    """What contacts do over one time step of a host's simulator; ``(...)`` is the shape that the arguments share."""

    phase: npt.NDArray[np.int8]
    """At the end of the step: index into :data:`PHASES`, shape (...)."""
    normal_force: Floats
    """F_n [N], >= 0, held over the step, shape (...)."""
    friction_force: Floats
    """F_f [N], its mean over the step, shape (..., 2)."""
    bristle: Floats
    """u at the end of the step [m], shape (..., 2), or the internal states, shape (..., law.states)."""
    tangential_damper: Floats
    """Energy that the damper has taken over the step [J], shape (...)."""
    clutch: Floats
    """Energy that the clutch has taken over the step [J], shape (...)."""


def _operand(name: str, value: npt.ArrayLike, width: int | None) -> tuple[Floats, tuple[int, ...]]:
    """The argument as an array, and the shape of the contacts that it is for. Numbers have no width."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{name}: real numbers are wanted, not {array.dtype}")
    array = array.astype(np.float64, copy=False)
    if width is None:
        return array, array.shape
    if array.ndim == 0 or array.shape[-1] != width:
        raise InvalidInput(f"{name}: shape {array.shape} is not allowed: the last axis must have {width} components")
    return array, array.shape[:-1]


class ContactLaw:
    """A normal law and a friction law, composed: the whole contact law of one sphere, or of a million.

    It holds no state: the bristle u belongs to the caller. Friction laws that have internal states in its place
    (Dahl's, LuGre and others) take those, :attr:`states` numbers for each contact, wherever a bristle is asked for.

    Parameters
    ----------
    normal, friction
        Laws of :mod:`footfall.laws`, or their text as the command line takes it,
        ``"azad-featherstone:stiffness=8.5e6,damping=3.1e3"``. No friction by default.
    impact_speed
        dz/dt at touchdown [m/s], for normal laws whose damping depends on it. Others need not know.

    Raises
    ------
    InvalidInput
        Where a law or a parameter cannot be used.

    Examples
    --------
    >>> law = ContactLaw("azad-featherstone:stiffness=8.5e6,damping=3.1e3",
    ...                  "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2")
    >>> r = law.evaluate(depth=[1e-4, 2e-4], depth_rate=0, slip_velocity=[0.1, 0], bristle=[0, 0])
    >>> r.normal_force.round(3)
    array([ 8.5  , 24.042])
    """

    __slots__ = ("_law",)

    def __init__(
        self, normal: Any, friction: Any = None, *, impact_speed: float | None = None
    ) -> None:
        if isinstance(normal, str):
            normal = laws.normal(normal)
        if friction is None:
            friction = laws.NoneFriction()
        elif isinstance(friction, str):
            friction = laws.friction(friction)
        try:
            self._law = _core.ContactLaw(normal, friction, impact_speed)
        except TypeError:
            raise TypeError(
                "ContactLaw(normal, friction): a law of footfall.laws or its text is wanted for each, not "
                f"{type(normal).__name__} and {type(friction).__name__}"
            ) from None

    @property
    def normal(self) -> Any:
        """The normal law, a class of :mod:`footfall.laws`."""
        return self._law.normal

    @property
    def friction(self) -> Any:
        """The friction law, a class of :mod:`footfall.laws`."""
        return self._law.friction

    @property
    def states(self) -> int:
        """How many numbers the bristle of a contact has: 2, or as many as the friction law has internal states."""
        return self._law.states

    def __repr__(self) -> str:
        return f"ContactLaw(normal={self.normal!r}, friction={self.friction!r})"

    def evaluate(
        self,
        depth: npt.ArrayLike,
        depth_rate: npt.ArrayLike,
        slip_velocity: npt.ArrayLike,
        bristle: npt.ArrayLike | None = None,
        *,
        phase: npt.ArrayLike | None = None,
        out: Response | None = None,
    ) -> Response:
        """The response of contacts to where they are and how they move.

        The arguments broadcast against each other, the last axis of the vectors aside. Where D_t = C_V = 0 and a
        contact slips, ``bristle_rate`` takes the load as constant.

        Parameters
        ----------
        depth
            z [m], > 0 in the ground, shape (...).
        depth_rate
            dz/dt [m/s], > 0 while loading, shape (...).
        slip_velocity
            V [m/s] of the point that touches, in the ground's plane, shape (..., 2).
        bristle
            u [m], shape (..., 2), or internal states, shape (..., law.states); that of a new contact by default.
        phase
            As it was, shape (...). Only friction laws whose force jumps look at it; the others decide the phase here.
        out
            A response of the same shape, whose arrays are written and which is returned: for loops that allocate
            nothing.

        Raises
        ------
        InvalidInput
            Where the shapes do not fit together.
        """
        flat, shape = self._flatten(depth, depth_rate, slip_velocity, bristle, phase)
        if out is None:
            out = Response(
                np.empty(shape, np.int8),
                np.empty(shape),
                np.empty((*shape, 2)),
                np.empty((*shape, self.states)),
                *(np.empty(shape) for _ in range(6)),
            )
        elif out.phase.shape != shape:
            raise InvalidInput(f"out: is for contacts of shape {out.phase.shape}, the arguments are for {shape}")
        self._law.evaluate(*flat, *(_flat(array) for array in vars(out).values()))
        return out

    def step(
        self,
        bristle: npt.ArrayLike | None,
        depth: npt.ArrayLike,
        depth_rate: npt.ArrayLike,
        slip_velocity: npt.ArrayLike,
        dt: float,
        *,
        phase: npt.ArrayLike | None = None,
        tolerance: float = 1e-4,
    ) -> Step:
        """Advances bristles over a time step of a simulator of your own, and gives the mean force over it.

        Depth, rate and slip velocity are held over the step. It is stable for every ``dt``; an explicit step with
        ``bristle_rate`` is not beyond 2 D_t/K_t, half a millisecond for the paper's numbers. Sticking and free recovery
        are exact; slipping is integrated by an L-stable method with sub-steps.

        A simulator with semi-implicit steps takes its forces from :meth:`evaluate`, moves its velocities, and then the
        bristles with the new ones by this, as it moves its positions. The mean force is for motions that are
        prescribed: taken in place of that of :meth:`evaluate` it comes half a step late, which a stiff contact does
        not forgive.

        Parameters
        ----------
        bristle
            u at the start of the step [m], shape (..., 2), or internal states, shape (..., law.states); None for new
            contacts.
        depth, depth_rate, slip_velocity, phase
            As for :meth:`evaluate`; ``phase`` as the last step gave it.
        dt
            [s], > 0.
        tolerance
            Of each sub-step, relative to the size of bristle and force, from 1e-12 to 1e-2.

        Raises
        ------
        InvalidInput
            Where the shapes do not fit together, or ``dt`` or ``tolerance`` is out of range.
        """
        if not (math.isfinite(dt) and dt > 0):
            raise InvalidInput(f"dt: {dt} s is not allowed: must be > 0 and finite")
        if not 1e-12 <= tolerance <= 1e-2:
            raise InvalidInput(f"tolerance: {tolerance} is not allowed: must be from 1e-12 to 1e-2")
        flat, shape = self._flatten(depth, depth_rate, slip_velocity, bristle, phase)
        step = Step(
            np.empty(shape, np.int8),
            np.empty(shape),
            np.empty((*shape, 2)),
            np.empty((*shape, self.states)),
            np.empty(shape),
            np.empty(shape),
        )
        self._law.step(*flat, float(dt), float(tolerance), *(_flat(array) for array in vars(step).values()))
        return step

    def _flatten(
        self,
        depth: npt.ArrayLike,
        depth_rate: npt.ArrayLike,
        slip_velocity: npt.ArrayLike,
        bristle: npt.ArrayLike | None,
        phase: npt.ArrayLike | None,
    ) -> tuple[list[npt.NDArray[Any]], tuple[int, ...]]:
        """The arguments as flat arrays, of one contact or of all, and the shape that they share."""
        if bristle is None:
            bristle = np.zeros(self.states)
        operands = [
            (*_operand(name, value, width), width)
            for name, value, width in (
                ("depth", depth, None),
                ("depth_rate", depth_rate, None),
                ("slip_velocity", slip_velocity, 2),
                ("bristle", bristle, self.states),
                ("phase", FLIGHT if phase is None else phase, None),
            )
        ]
        try:
            shape = np.broadcast_shapes(*(contacts for _, contacts, _ in operands))
        except ValueError:
            said = ", ".join(str(contacts) for _, contacts, _ in operands)
            raise InvalidInput(
                f"depth, depth_rate, slip_velocity, bristle and phase are for contacts of shapes {said}, which do not "
                "broadcast"
            ) from None
        flat = []
        for array, contacts, width in operands:
            # One value for all contacts is not copied: the loop in C++ stands still on it.
            if math.prod(contacts) != 1 and contacts != shape:
                array = np.broadcast_to(array, shape if width is None else (*shape, width))
            flat.append(np.ascontiguousarray(array).reshape(-1))
        flat[-1] = flat[-1].astype(np.int8)
        return flat, shape


def _flat(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    if not array.flags.c_contiguous:
        raise InvalidInput("out: its arrays must be contiguous, as evaluate() makes them")
    return array.reshape(-1)

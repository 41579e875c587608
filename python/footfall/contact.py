"""The contact law by itself, over NumPy arrays, for simulators of your own."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from footfall import _arguments, _channels, _core, laws
from footfall._values import Compared
from footfall.errors import InvalidInput

if TYPE_CHECKING:
    from footfall._core import ResponseChannels
else:
    ResponseChannels = object

Floats = npt.NDArray[np.float64]

#: Names of the phases, in the order of the numbers that stand for them: flight, stick, slip, recovering.
PHASES: tuple[str, ...] = _core.PHASES

FLIGHT, STICK, SLIP, RECOVERING = range(4)


@dataclass(frozen=True, eq=False)
class Response(Compared, ResponseChannels):
    """What contacts do at one moment. Forces act on the body; ``(...)`` is the shape that the arguments share.

    It has an array of shape (...) for each channel of energy: what is held [J], and the power of the others [W], as in
    ``normal_spring`` and ``clutch_power``.

    Tangential vectors have two components, in the ground's plane. Responses are equal where all their arrays are, NaN
    taken as equal to NaN.
    """

    phase: npt.NDArray[np.int8]
    """Index into :data:`PHASES`, shape (...)."""
    normal_force: Floats
    """F_n [N], >= 0, shape (...)."""
    friction_force: Floats
    """F_f [N], shape (..., 2)."""
    bristle_rate: Floats
    """du/dt [m/s], shape (..., 2); of a friction law with internal states their rates, shape (..., law.states)."""
    if TYPE_CHECKING:
        # Type checkers have the channels from ResponseChannels, and the arrays of a call from evaluate().
        def __init__(self, *arrays: npt.NDArray[Any], **named: npt.NDArray[Any]) -> None: ...
    else:
        __annotations__.update({channel.response: "Floats" for channel in _channels.TABLE})


_channels.list_in_docstring(
    Response,
    lambda channel: f"{channel.response}: {channel.description} [J]"
    if channel.kind == "held"
    else f"{channel.response}: rate of {channel.description} [W]",
)


@dataclass(frozen=True, eq=False)
class Step(Compared):
    """What contacts do over one time step of a host's simulator; ``(...)`` is the shape that the arguments share.

    Steps are equal where all their arrays are, NaN taken as equal to NaN.
    """

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
    array = _arguments.real_array(name, value).astype(np.float64, copy=False)
    if width is None:
        return array, array.shape
    if array.ndim == 0 or array.shape[-1] != width:
        raise InvalidInput(f"{name}: shape {array.shape} is not allowed: the last axis must have {width} components")
    return array, array.shape[:-1]


def _phases(value: npt.ArrayLike) -> tuple[npt.NDArray[np.int8], tuple[int, ...]]:
    """The numbers of phases, checked."""
    array = _arguments.real_array("phase", value)
    # Whatever is no phase, NaN as well, is outside of what is right.
    if array.size and not (array.min() >= FLIGHT and array.max() <= RECOVERING):
        _refuse_phase(array, ~((array >= FLIGHT) & (array <= RECOVERING)))
    phases = array.astype(np.int8, copy=False)
    if array.dtype.kind == "f" and not np.array_equal(phases, array):
        _refuse_phase(array, phases != array)
    return phases, array.shape


def _refuse_phase(array: npt.NDArray[Any], wrong: npt.NDArray[np.bool_]) -> None:
    first = np.unravel_index(int(np.argmax(wrong)), array.shape)
    index = tuple(int(i) for i in first)
    where = "" if not index else f" at index {index[0] if len(index) == 1 else index}"
    names = ", ".join(f"{i} {name}" for i, name in enumerate(PHASES))
    raise InvalidInput(f"phase: {array[first]}{where} is not allowed: must be one of {names}")


# The arrays of a response, in the order of its fields: name, type, and components of each contact, None for numbers.
# Those of the bristle are as many as the law has states.
_STATES = -1
_FLOAT, _PHASE = np.dtype(np.float64), np.dtype(np.int8)
_COLUMNS: tuple[tuple[str, np.dtype[Any], int | None], ...] = tuple(
    (
        field.name,
        _PHASE if field.name == "phase" else _FLOAT,
        {"friction_force": 2, "bristle_rate": _STATES}.get(field.name),
    )
    for field in fields(Response)
)


def _flat_outputs(out: Response, shape: tuple[int, ...], states: int) -> list[npt.NDArray[Any]]:
    """The arrays of ``out``, flat, each checked to be one that can be written as it is."""
    if not isinstance(out, Response):
        raise TypeError(f"out: a Response, as evaluate() returns it, is wanted, not {_arguments.described(out)}")
    arrays = []
    for name, dtype, width in _COLUMNS:
        array = getattr(out, name)
        wanted = shape if width is None else (*shape, states if width == _STATES else width)
        if (
            type(array) is not np.ndarray
            or array.shape != wanted
            or array.dtype != dtype
            or not array.flags.carray  # contiguous, aligned and writeable
        ):
            _refuse_output(out, name, wanted, dtype, shape, states)
        arrays.append(array.reshape(-1))
    return arrays


def _refuse_output(
    out: Response, name: str, wanted: tuple[int, ...], dtype: np.dtype[Any], shape: tuple[int, ...], states: int
) -> None:
    """Says what is wrong with one array of ``out``."""
    array = getattr(out, name)
    must = f"must be a numpy.ndarray of {dtype}, shape {wanted}, contiguous (C order) and writeable"
    if not isinstance(array, np.ndarray):
        raise InvalidInput(f"out.{name}: {_arguments.described(array)} is not allowed: {must}")
    if type(array) is not np.ndarray:
        raise InvalidInput(
            f"out.{name}: {type(array).__name__}, a kind of array of its own, is not allowed: {must}; its plain array "
            "is numpy.asarray of it"
        )
    if array.dtype != dtype:
        order = {">": ", big-endian", "<": ", little-endian"}.get(array.dtype.byteorder, "")
        raise InvalidInput(f"out.{name}: an array of {array.dtype.newbyteorder('=')}{order} is not allowed: {must}")
    if array.shape != wanted:
        shapes = [np.shape(getattr(out, other))[: None if width is None else -1] for other, _, width in _COLUMNS]
        theirs = shapes[0]
        if theirs != shape and all(other == theirs for other in shapes):
            raise InvalidInput(
                f"out: is for contacts of shape {theirs}, the arguments are for contacts of shape {shape}: "
                f"out.{name} has shape {array.shape} and must have {wanted}"
            )
        law = f"; the friction law has {states} states" if name == "bristle_rate" else ""
        raise InvalidInput(f"out.{name}: shape {array.shape} is not allowed: must be {wanted}{law}")
    if not array.flags.writeable:
        raise InvalidInput(f"out.{name}: a read-only array is not allowed: {must}")
    if not array.flags.c_contiguous:
        raise InvalidInput(f"out.{name}: an array that is not contiguous is not allowed: {must}")
    raise InvalidInput(f"out.{name}: an array that is not aligned in memory is not allowed: {must}, aligned")


def _allocate(shape: tuple[int, ...], widths: tuple[int | None, ...]) -> list[Floats]:
    """New arrays for contacts of a shape. MemoryError says how many they are."""
    try:
        return [np.empty(shape if width is None else (*shape, width)) for width in widths]
    except (MemoryError, ValueError):
        raise _too_many(shape, sum(1 if width is None else width for width in widths)) from None


def _too_many(shape: tuple[int, ...], numbers: int) -> MemoryError:
    count = math.prod(shape)
    size = 8 * count * numbers / 2**30
    return MemoryError(
        f"{count:.3g} contacts were asked for, of shape {shape}: at {8 * numbers} bytes for each they need {size:.3g} "
        "GiB, more memory than there is"
    )


class ContactLaw:
    """A normal law and a friction law, composed: the whole contact law of one sphere, or of a million.

    It holds no state: the bristle u belongs to the caller. Friction laws that have internal states in its place
    (Dahl's, LuGre and others) take those, :attr:`states` numbers for each contact, wherever a bristle is asked for.

    A contact one of whose numbers is NaN or infinite gives NaN in every array of floats, and FLIGHT as its phase; the
    contacts beside it are not touched by that. A depth of minus infinity is the exception: it is free flight, far above
    the ground. Laws are equal where their parameters are; they can be pickled, copied and used as keys.

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

    __slots__ = ("_impact_speed", "_law")

    def __init__(
        self, normal: Any, friction: Any = None, *, impact_speed: float | None = None
    ) -> None:
        normal = laws._law("normal", normal, "Normal")
        friction = laws._friction_or_none("friction", friction)
        if impact_speed is not None:
            impact_speed = _arguments.number("impact_speed", impact_speed, "m/s", at_least=0)
        self._impact_speed = impact_speed
        self._law = _core.ContactLaw(normal, friction, impact_speed)

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

    @property
    def impact_speed(self) -> float | None:
        """dz/dt at touchdown [m/s] as it was given, or None."""
        return self._impact_speed

    def _parts(self) -> tuple[Any, Any, float | None]:
        return self.normal, self.friction, self.impact_speed

    def __repr__(self) -> str:
        speed = "" if self.impact_speed is None else f", impact_speed={self.impact_speed!r}"
        return f"ContactLaw(normal={self.normal!r}, friction={self.friction!r}{speed})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ContactLaw):
            return NotImplemented
        return self._parts() == other._parts()

    def __hash__(self) -> int:
        return hash(self._parts())

    def __reduce__(self) -> tuple[object, ...]:
        return _contact_law, (type(self), *self._parts())

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
            As it was, shape (...), each 0, 1, 2 or 3. Only friction laws whose force jumps look at it; the others
            decide the phase here.
        out
            A response for contacts of the same shape and law, as :meth:`evaluate` made it, whose arrays are written
            and which is returned: for loops that allocate nothing. Its arrays are plain NumPy arrays of float64 (the
            phase int8), contiguous and writeable, which share no memory with each other or with the arguments;
            ``out.phase`` alone may be the argument ``phase`` too.

        Raises
        ------
        InvalidInput
            Where the shapes do not fit together, a phase is none, or an array of ``out`` cannot be written.
        TypeError
            Where something else than real numbers is given, or ``out`` is no Response.
        """
        flat, shape = self._flatten(depth, depth_rate, slip_velocity, bristle, phase)
        states = self.states
        if out is None:
            force, friction, rate, *rest = _allocate(shape, (None, 2, states, *[None] * len(_channels.TABLE)))
            out = Response(np.empty(shape, np.int8), force, friction, rate, *rest)
        self._law.evaluate(*flat, *_flat_outputs(out, shape, states))
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
        are exact; slipping is integrated by an L-stable method with sub-steps. Under ``azad-featherstone-passive`` the
        ground that joins the patch in ``dt`` joins at the step's end, and in flight u becomes zero; a loop of your own on
        :meth:`evaluate` sets it to zero in flight itself.

        A simulator with semi-implicit steps takes its forces from :meth:`evaluate`, moves its velocities, and then the
        bristles with the new ones by this, as it moves its positions. The mean force is for motions that are
        prescribed: taken in place of that of :meth:`evaluate` it comes half a step late, which a stiff contact does
        not forgive.

        What the ground does along its normal is held over the host's step all the same, and an impact is over in a few
        milliseconds: held over 0.1 ms the paper's ball rebounds with a restitution of 0.602, over 0.5 ms of 0.594, over
        1 ms of 1.43, where 0.603 is right. Steps should be a thirtieth of an impact, or shorter.
        :class:`footfall.ContactSet` has no such limit.

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
            Where the shapes do not fit together, a phase is none, or ``dt`` or ``tolerance`` is out of range.
        TooExpensive
            Where a contact slides so far over ``dt`` that it needs more sub-steps than are taken, a million under laws
            with internal states; the message has its index, counted over the flattened contacts.
        TypeError
            Where something else than real numbers is given.
        """
        dt = _arguments.number("dt", dt, "s", above=0)
        tolerance = _arguments.number("tolerance", tolerance, at_least=1e-12, at_most=1e-2)
        flat, shape = self._flatten(depth, depth_rate, slip_velocity, bristle, phase)
        force, friction, new_bristle, damper, clutch = _allocate(shape, (None, 2, self.states, None, None))
        step = Step(np.empty(shape, np.int8), force, friction, new_bristle, damper, clutch)
        self._law.step(*flat, dt, tolerance, *(array.reshape(-1) for array in vars(step).values()))
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
        operands: list[tuple[npt.NDArray[Any], tuple[int, ...], int | None]] = [
            (*_operand(name, value, width), width)
            for name, value, width in (
                ("depth", depth, None),
                ("depth_rate", depth_rate, None),
                ("slip_velocity", slip_velocity, 2),
                ("bristle", bristle, self.states),
            )
        ]
        operands.append((_NEW, (), None) if phase is None else (*_phases(phase), None))
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
            spread = math.prod(contacts) != 1 and contacts != shape
            try:
                if spread:
                    array = np.broadcast_to(array, shape if width is None else (*shape, width))
                array = np.ascontiguousarray(array)
            except (MemoryError, ValueError):
                raise _too_many(shape, width or 1) from None
            flat.append((array if array.flags.aligned else array.copy()).reshape(-1))
        return flat, shape


#: The phase that contacts are taken to come from by default.
_NEW = np.array(FLIGHT, np.int8)


def _contact_law(kind: type[ContactLaw], normal: Any, friction: Any, impact_speed: float | None) -> ContactLaw:
    """What a pickled or copied contact law is made from."""
    return kind(normal, friction, impact_speed=impact_speed)

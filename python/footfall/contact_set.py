"""Contacts in the loop of a simulator of your own, which steps at a millisecond or two."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from footfall import _arguments, _channels, _core
from footfall._values import Compared
from footfall.contact import ContactLaw, _phases
from footfall.errors import InvalidInput

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class HostEvent:
    """Something that happened to a contact inside a step."""

    time: float
    """Since the step's start [s]."""
    contact: int
    kind: str
    """touchdown, stick, slip, separation or recovered."""


@dataclass(frozen=True, eq=False)
class HostEnergy(Compared):
    """The account of one step [J].

    It has an array of shape (n,) for each channel: what a contact holds at the step's end, and what the others have
    taken within the step. ``held + taken + unpaid + contact_work - held_before`` is the residual.
    """

    held_before: float
    """What springs and bristles held at the start, at the depth and the velocity that were given."""
    contact_work: float
    """Of the contact forces on the bodies, in their motion against the ground."""
    ground_work: float
    """Of the contact forces on the bodies, in the ground's own motion."""
    residual: float
    """What the account misses."""
    scale: float
    """What the residual and the tolerance are relative to."""
    unresolved_loss: float
    """What an implicit end of the step has taken and no channel accounts for; 0 where all was resolved."""
    if TYPE_CHECKING:

        def __init__(self, *numbers: Any, **named: Any) -> None: ...
        def __getattr__(self, channel: str) -> Floats: ...
    else:
        __annotations__.update({channel.name: "Floats" for channel in _channels.TABLE})

    def _sum(self, *kinds: str) -> float:
        return float(sum(getattr(self, c.name).sum() for c in _channels.TABLE if c.kind in kinds))

    @property
    def held(self) -> float:
        """By all contacts at the step's end [J]."""
        return self._sum("held")

    @property
    def taken(self) -> float:
        """By dampers and clutches within the step, and what no force paid for [J]."""
        return self._sum("taken", "unpaid")


_channels.list_in_docstring(HostEnergy, lambda channel: f"{channel.name}: {channel.description}")


@dataclass(frozen=True, eq=False)
class HostStep(Compared):
    """What the contacts do over one step of a host. Vectors are in each contact's frame; they act on the body."""

    impulse: Floats
    """Integral of the force [N s], shape (n, 3)."""
    double_impulse: Floats
    """Integral of the impulse so far [N s^2], shape (n, 3)."""
    angular_impulse: Floats
    """Integral of the torques that laws give: rolling, rolling, spin [N m s], shape (n, 3)."""
    states: Floats
    """Of the laws of all contacts at the step's end, one after another."""
    phase: npt.NDArray[np.int8]
    """At the step's end: index into ``footfall.PHASES``, shape (n,)."""
    events: tuple[HostEvent, ...]
    """Inside the step, in order of time."""
    energy: HostEnergy
    unresolved_time: float
    """At the end of the step, taken by one implicit step [s]; 0: all was resolved."""
    evaluations: int
    """Of the contacts' equations."""


class ContactSet:
    """Contacts in the loop of a simulator of your own, their host.

    A force that is held over a step of a millisecond makes energy. A set integrates the contacts' own equations inside
    the step, with the host's effective mass and free acceleration frozen: touchdown, stick, slip and lift-off are
    located within it. The host gets the impulse of each contact, and the double impulse, which its positions need. With
    the velocities u, the mass matrix M and J from u to the velocities of the contact points::

        u += dt * a_free + M^-1 J^T impulse
        q += dt * u_before + dt**2 / 2 * a_free + M^-1 J^T double_impulse

    Each contact has a frame of its own: two tangents, which you choose, and the ground's normal. A set can be copied
    and pickled; the same states, phases and arguments give the same step, bit for bit.

    Parameters
    ----------
    laws
        A :class:`ContactLaw` for each contact. Its ``impact_speed`` does not matter: impacts are seen.
    tolerance
        Relative to the energy of motion and springs in the step, from 1e-13 to 1e-2.
    max_evaluations
        Of the contacts' equations in one step. A step that needs more ends with one implicit step over the rest, and
        says so (``unresolved_time``).

    Raises
    ------
    InvalidInput
        Where there is no law, or an option is out of its range.

    Examples
    --------
    A mass of 1 kg that falls on its one contact point:

    >>> law = ContactLaw("azad-featherstone:stiffness=8.5e6,damping=3.1e3")
    >>> contacts = ContactSet([law])
    >>> step = contacts.step(1e-3, depth=[-5e-4], velocity=[[0, 0, -1]], free_acceleration=[[0, 0, -9.81]],
    ...                      delassus=np.eye(3))
    >>> step.events[0].kind, round(step.events[0].time, 6)
    ('touchdown', 0.000499)
    """

    __slots__ = ("_laws", "_max_evaluations", "_set", "_tolerance")

    def __init__(
        self, laws: Iterable[ContactLaw], *, tolerance: float = 1e-6, max_evaluations: int = 20_000
    ) -> None:
        if isinstance(laws, (str, bytes)) or not isinstance(laws, Iterable):
            said = _arguments.described(laws)
            raise TypeError(f"laws: a ContactLaw for each contact is wanted, in a list, not {said}")
        self._laws = tuple(laws)
        for i, law in enumerate(self._laws):
            if not isinstance(law, ContactLaw):
                raise TypeError(f"laws[{i}]: a ContactLaw is wanted, not {_arguments.described(law)}")
        self._tolerance = _arguments.number("tolerance", tolerance, at_least=1e-13, at_most=1e-2)
        self._max_evaluations = _arguments.integer("max_evaluations", max_evaluations, 1, 2**62)
        self._set = _core.ContactSet(
            [(law.normal, law.friction) for law in self._laws], self._tolerance, self._max_evaluations
        )

    def __len__(self) -> int:
        """How many contacts."""
        return len(self._laws)

    @property
    def laws(self) -> tuple[ContactLaw, ...]:
        """Of each contact."""
        return self._laws

    @property
    def states(self) -> Floats:
        """Of the laws of all contacts, one after another."""
        return np.asarray(self._set.states)

    @property
    def phase(self) -> npt.NDArray[np.int8]:
        """Index into ``footfall.PHASES``, shape (n,)."""
        return np.asarray(self._set.phase)

    @property
    def bristle(self) -> Floats:
        """u [m], or what a law has to show in its place, in each contact's frame, shape (n, 2)."""
        return np.asarray(self._set.bristle)

    def restore(self, states: npt.ArrayLike, phase: npt.ArrayLike) -> None:
        """Goes back to states and phases that a step, or the set, had. InvalidInput where they are not this set's."""
        phases, shape = _phases(phase)
        if len(shape) != 1:
            raise InvalidInput(f"phase: shape {shape} is not allowed: must be ({len(self)},)")
        self._set.restore(_flat("states", states), np.ascontiguousarray(phases))

    def reset(self) -> None:
        """As a new set: in flight, with bristles at rest."""
        self._set.reset()

    def step(
        self,
        dt: float,
        depth: npt.ArrayLike,
        velocity: npt.ArrayLike,
        free_acceleration: npt.ArrayLike,
        delassus: npt.ArrayLike,
        *,
        ground_velocity: npt.ArrayLike | None = None,
        frame_spin: npt.ArrayLike | None = None,
        radius: npt.ArrayLike | None = None,
        spin: npt.ArrayLike | None = None,
        rolling: npt.ArrayLike | None = None,
    ) -> HostStep:
        """Advances the n contacts over one step of the host.

        Parameters
        ----------
        dt
            [s], >= 0.
        depth
            z [m] at the start, > 0 in the ground, shape (n,); minus infinity is far above it.
        velocity
            Of the contact points against the ground [m/s], shape (n, 3), the third component along the normal, > 0 away
            from the ground.
        free_acceleration
            What ``velocity`` would change by without the contacts, J a + dJ/dt u [m/s^2], shape (n, 3).
        delassus
            J M^-1 J^T [1/kg], shape (3n, 3n), symmetric. It may be singular.
        ground_velocity
            [m/s], shape (n, 3), for ``energy.ground_work``.
        frame_spin
            How fast each frame turns about its normal [rad/s], shape (n,): bristles keep still in the ground.
        radius, spin, rolling
            Of the spheres [m], shape (n,), about the normal [rad/s], shape (n,), and in the plane [rad/s], shape
            (n, 2): for laws whose force depends on how a sphere turns.

        Raises
        ------
        InvalidInput
            Where a size is wrong or a number cannot be used; nothing has changed then.
        TypeError
            Where something else than real numbers is given.
        """
        dt = _arguments.number("dt", dt, "s", at_least=0)
        n = len(self)
        given = [
            _shaped("depth", depth, (n,)),
            _shaped("velocity", velocity, (n, 3)),
            _shaped("free_acceleration", free_acceleration, (n, 3)),
            _shaped("delassus", delassus, (3 * n, 3 * n)),
        ]
        optional = [
            None if value is None else _shaped(name, value, shape)
            for name, value, shape in (
                ("ground_velocity", ground_velocity, (n, 3)),
                ("frame_spin", frame_spin, (n,)),
                ("radius", radius, (n,)),
                ("spin", spin, (n,)),
                ("rolling", rolling, (n, 2)),
            )
        ]
        impulse, double_impulse, angular_impulse, states, phase, events, channels, *account, left, evaluations = (
            self._set.step(dt, *given, *optional)
        )
        return HostStep(
            impulse.reshape(n, 3),
            double_impulse.reshape(n, 3),
            angular_impulse.reshape(n, 3),
            states,
            phase,
            tuple(HostEvent(*event) for event in events),
            HostEnergy(*account, *channels),
            left,
            evaluations,
        )

    def __repr__(self) -> str:
        return f"ContactSet({len(self)} contacts, tolerance={self._tolerance:g})"

    def __reduce__(self) -> tuple[object, ...]:
        return _contact_set, (type(self), self._laws, self._tolerance, self._max_evaluations, self.states, self.phase)


def _flat(name: str, value: npt.ArrayLike) -> Floats:
    array = np.ascontiguousarray(_arguments.real_array(name, value), dtype=np.float64)
    return array.reshape(-1)


def _shaped(name: str, value: npt.ArrayLike, shape: tuple[int, ...]) -> Floats:
    array = _arguments.real_array(name, value)
    if array.shape != shape:
        raise InvalidInput(f"{name}: shape {array.shape} is not allowed: must be {shape}")
    return _flat(name, array)


def _contact_set(
    kind: type[ContactSet],
    laws: tuple[ContactLaw, ...],
    tolerance: float,
    max_evaluations: int,
    states: Floats,
    phase: npt.NDArray[np.int8],
) -> ContactSet:
    """What a pickled or copied set is made from."""
    contacts = kind(laws, tolerance=tolerance, max_evaluations=max_evaluations)
    contacts.restore(states, phase)
    return contacts

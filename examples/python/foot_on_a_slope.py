"""A simulator of your own, in NumPy alone, with the contacts of footfall at 1 ms.

A foot of four spheres strikes a slope heel first, slaps down and comes to rest. The simulator is a rigid body in
semi-implicit steps of a millisecond, the step that many robot simulators take; the first impact lasts few of them. What
the contacts do inside a step is `contacts.step`'s. Beside it stands the same scenario as footfall's own solver runs it.
"""

import copy

import numpy as np

import footfall

mass, inertia = 1.2, np.diag([1.57e-3, 5.65e-3, 6.5e-3])
centers = np.array([[-0.08, 0.04, -0.03], [-0.08, -0.04, -0.03], [0.12, 0.04, -0.03], [0.12, -0.04, -0.03]])
radius, slope, dt, end = 0.015, 0.2, 1e-3, 0.3
law = footfall.ContactLaw(
    footfall.laws.AzadFeatherstoneNormal(stiffness=1e6, damping=400),
    footfall.laws.AzadFeatherstoneFriction(stiffness=1.5e6, damping=400, coefficient=0.6, viscous=0.1),
)
start = {"position": [0.0, 0.0, 0.08], "velocity": [0.3, 0.15, -0.3]}
pitch = -0.26  # toes up [rad]

# The ground's frame at every contact: two tangents and the normal, as rows.
frame = np.array([[np.cos(slope), 0, -np.sin(slope)], [0, 1, 0], [np.sin(slope), 0, np.cos(slope)]])
normal, gravity = frame[2], np.array([0, 0, -9.81])
CHANNELS = ("normal_damper", "tangential_damper", "clutch", "stiffness_change")


def cross(v):
    """The matrix of v x."""
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def turned(R, angles):
    """The rotation R, turned further by a vector of angles."""
    angle = np.linalg.norm(angles)
    if angle == 0:
        return R
    k = cross(angles / angle)
    return (np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k) @ R


class Foot:
    def __init__(self, x, v, R, L):
        self.x, self.v, self.R, self.L = x, v, R, L  # L: the angular momentum

    def seen_by_contacts(self):
        """J, M^-1, velocity and free acceleration of the foot, then what the contacts are to know."""
        arms = centers @ self.R.T
        inverse = np.zeros((6, 6))
        inverse[:3, :3] = np.eye(3) / mass
        inverse[3:, 3:] = self.R @ np.linalg.inv(inertia) @ self.R.T
        omega = inverse[3:, 3:] @ self.L
        alpha = -inverse[3:, 3:] @ np.cross(omega, self.L)
        J = np.vstack([frame @ np.hstack([np.eye(3), -cross(arm - radius * normal)]) for arm in arms])
        own, free = np.concatenate([self.v, omega]), np.concatenate([gravity, alpha])
        # The point that touches stays at the bottom: of its arm, only the sphere's centre turns with the foot.
        turning = np.concatenate([frame @ np.cross(omega, np.cross(omega, arm)) for arm in arms])
        depth = radius - (self.x + arms) @ normal
        return J, inverse, own, free, depth, (J @ own).reshape(4, 3), (J @ free + turning).reshape(4, 3)

    def moved(self, seen, velocity, impulse, double_impulse):
        """This foot one semi-implicit step later, under the impulses of the contacts; `velocity` is v and omega."""
        J, inverse, _, free, *_ = seen
        push, shift = J.T @ impulse.ravel(), inverse @ J.T @ double_impulse.ravel()
        way = dt * velocity + 0.5 * dt**2 * free + shift
        v = self.v + dt * gravity + push[:3] / mass
        return Foot(self.x + way[:3], v, turned(self.R, way[3:]), self.L + push[3:])

    def halfway_to(self, other):
        turn = self.R.T @ other.R
        angles = 0.25 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
        return Foot(
            (self.x + other.x) / 2, (self.v + other.v) / 2, turned(self.R, self.R @ angles), (self.L + other.L) / 2
        )

    def energy(self):
        omega = self.R @ np.linalg.inv(inertia) @ self.R.T @ self.L
        return 0.5 * mass * self.v @ self.v + 0.5 * omega @ self.L - mass * gravity @ self.x


def simulate(passes):
    """The foot at the end, what the contacts took by channel, and what the account misses."""
    contacts = footfall.ContactSet([law] * 4)
    foot = Foot(np.array(start["position"]), np.array(start["velocity"]), turned(np.eye(3), [0, pitch, 0]), np.zeros(3))
    at_start, taken = foot.energy(), dict.fromkeys(CHANNELS, 0.0)
    for _ in range(round(end / dt)):
        seen = foot.seen_by_contacts()
        J, inverse, own, _, depth, velocity, acceleration = seen
        if passes == 2:  # a trial step tells the matrices at the middle; the contacts start where they are all the same
            trial = copy.copy(contacts).step(dt, depth, velocity, acceleration, J @ inverse @ J.T)
            middle = foot.halfway_to(foot.moved(seen, own, trial.impulse, trial.double_impulse))
            seen = middle.seen_by_contacts()
            J, inverse, *_, acceleration = seen
        step = contacts.step(dt, depth, velocity, acceleration, J @ inverse @ J.T)
        foot = foot.moved(seen, own, step.impulse, step.double_impulse)
        for channel in taken:
            taken[channel] += getattr(step.energy, channel).sum()
    return foot, taken, foot.energy() + step.energy.held + sum(taken.values()) - at_start


exact = footfall.run(
    {
        "time": {"end": end},
        "body": {
            "mass": mass,
            "inertia": np.diag(inertia).tolist(),
            "spheres": [{"radius": radius, "center": c.tolist()} for c in centers],
            "initial": start | {"rotation": {"axis": [0, 1, 0], "angle": pitch}},
        },
        "ground": {"slope": slope},
        "contact": {
            "normal": {"law": "azad-featherstone", "stiffness": 1e6, "damping": 400},
            "friction": {
                "law": "azad-featherstone", "stiffness": 1.5e6, "damping": 400, "coefficient": 0.6, "viscous": 0.1,
            },
        },
    }
)
(once, one, lost_once), (twice, two, lost_twice) = simulate(passes=1), simulate(passes=2)
print(f"{f'at {1e3 * dt:g} ms':20}  one pass  two passes   exact")
print(f"{'x':18}{1e3 * once.x[0]:12.3f}{1e3 * twice.x[0]:12.3f}{1e3 * exact.final.position[0]:12.3f} mm")
for channel in CHANNELS:
    right = getattr(exact.energy, channel)
    print(f"{channel:18}{1e3 * one[channel]:12.3f}{1e3 * two[channel]:12.3f}{1e3 * right:12.3f} mJ")
print(f"{'account misses':18}{1e3 * lost_once:12.3f}{1e3 * lost_twice:12.3f}{0:12.3f} mJ")

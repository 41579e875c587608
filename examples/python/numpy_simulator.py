"""A simulator of your own, in NumPy alone, with the contact law of footfall.

Balls slide onto level ground and friction makes them roll. The simulator is a few lines of semi-implicit Euler at 1 ms,
the step that many robot simulators take: forces from the state that is, then the velocities, then with the new
velocities what they move, the bristles among it. An explicit step of the bristle would be unstable there, since K_t/D_t
times the step is 4; `law.step` is not.
"""

import numpy as np

import footfall

law = footfall.ContactLaw(
    footfall.laws.AzadFeatherstoneNormal(stiffness=8.5e6, damping=3.1e3),
    footfall.laws.AzadFeatherstoneFriction(stiffness=12.75e6, damping=3.1e3, coefficient=0.2, viscous=0.1),
)
mass, radius, gravity = 0.154, 0.0165, 9.81
inertia = 2 / 5 * mass * radius**2
dt, end = 1e-3, 0.5

# A hundred balls at once, thrown in every direction; each rests on the ground at the depth where the spring bears it.
count = 100
angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
position = np.zeros((count, 3))
position[:, 2] = radius - (mass * gravity / 8.5e6) ** (2 / 3)
velocity = np.column_stack([0.5 * np.cos(angle), 0.5 * np.sin(angle), np.zeros(count)])
spin = np.zeros((count, 3))
bristle = np.zeros((count, 2))
damper = np.zeros(count)
clutch = np.zeros(count)



def slip_velocity():
    """Of the bottom point: v + omega x (0, 0, -radius)."""
    return velocity[:, :2] + radius * np.column_stack([-spin[:, 1], spin[:, 0]])


for _ in range(round(end / dt)):
    depth, depth_rate = radius - position[:, 2], -velocity[:, 2]
    contact = law.evaluate(depth, depth_rate, slip_velocity(), bristle)
    force = np.column_stack([contact.friction_force, contact.normal_force])
    velocity += dt * (force / mass - [0, 0, gravity])
    spin += dt * radius / inertia * np.column_stack([force[:, 1], -force[:, 0], np.zeros(count)])
    position += dt * velocity
    step = law.step(bristle, depth, depth_rate, slip_velocity(), dt)
    bristle = step.bristle
    damper += step.tangential_damper
    clutch += step.clutch

speed = np.linalg.norm(velocity[:, :2], axis=1) / 0.5
print(f"{count} balls roll at speed {speed.mean():.4f} of the initial; 5/7 is {5 / 7:.4f}")
print(f"phases at the end: {sorted({footfall.PHASES[phase] for phase in step.phase})}")
lost = 0.5 * mass * 0.5**2 * (1 - 5 / 7)
print(f"clutch and damper took {1e3 * (clutch + damper).mean():.3f} mJ; the motion lost {1e3 * lost:.3f} mJ")

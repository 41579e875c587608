"""One evaluation of the contact law for a million contacts: from NumPy, against the loop in C++ on the same arrays.

    python python/bench/bench_law.py

Both run in this process, in turns, in processor time; the target is a ratio of at most 1.2. The loop is compiled here
with the flags of the library, so a C++ compiler and Eigen are needed. `law.step` is measured too: its error and cost.
"""

from __future__ import annotations

import argparse
import ctypes
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import footfall

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PARAMETERS = (8.5e6, 3.1e3, 12.75e6, 3.1e3, 0.2, 0.1)
TARGET = 1.2


def compiled_loop(folder: Path) -> ctypes._NamedFuncPointer:
    library = folder / "loop.so"
    flags = "-std=c++20 -O3 -DNDEBUG -fPIC -ffp-contract=off -fno-math-errno -shared".split()
    includes = [f"-I{ROOT / 'include'}", "-I/usr/include/eigen3"]
    subprocess.run(["g++", *flags, *includes, str(HERE / "loop.cpp"), "-o", str(library)], check=True)
    return ctypes.CDLL(str(library)).evaluate


def pointer(array: np.ndarray) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


def print_step(law: footfall.ContactLaw) -> None:
    """The error and cost of a bristle's step over 1 ms, against one at the tightest tolerance."""
    random = np.random.default_rng(2010)
    count = 20_000
    where = (
        random.uniform(-5e-5, 5e-5, (count, 2)),
        random.uniform(0, 1e-3, count),
        random.uniform(-1, 1, count),
        random.uniform(-0.5, 0.5, (count, 2)),
    )
    exact = law.step(*where, 1e-3, tolerance=1e-11)
    loaded = exact.normal_force > 0
    size = np.linalg.norm(exact.friction_force[loaded], axis=1)
    print("\nlaw.step over 1 ms, every phase at random; error of the mean friction force, relative to it\n")
    print(f"{'tolerance':>12}{'largest':>12}{'median':>12}{'cost':>12}")
    for tolerance in (1e-2, 1e-3, 1e-4, 1e-6, 1e-8):
        start = time.process_time()
        step = law.step(*where, 1e-3, tolerance=tolerance)
        seconds = time.process_time() - start
        error = np.linalg.norm((step.friction_force - exact.friction_force)[loaded], axis=1) / size
        print(f"{tolerance:>12.0e}{error.max():>12.1e}{np.median(error):>12.1e}{1e6 * seconds / count:>9.2f} us")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--contacts", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=31)
    arguments = parser.parse_args()
    count = arguments.contacts

    random = np.random.default_rng(2010)
    depth = random.uniform(-1e-3, 1e-3, count)
    rate = random.uniform(-1, 1, count)
    slip = random.uniform(-0.5, 0.5, (count, 2))
    bristle = random.uniform(-5e-5, 5e-5, (count, 2))
    K_n, D_n, K_t, D_t, mu, C_V = PARAMETERS
    law = footfall.ContactLaw(
        footfall.laws.AzadFeatherstoneNormal(stiffness=K_n, damping=D_n),
        footfall.laws.AzadFeatherstoneFriction(stiffness=K_t, damping=D_t, coefficient=mu, viscous=C_V),
    )
    out = law.evaluate(depth, rate, slip, bristle)
    by_loop = law.evaluate(-depth, rate, slip, bristle)
    parameters = np.array(PARAMETERS)

    with tempfile.TemporaryDirectory() as folder:
        loop = compiled_loop(Path(folder))
        inputs = [pointer(a) for a in (parameters, depth, rate, slip, bristle)]
        outputs = [pointer(a) for a in vars(by_loop).values()]

        def into_new_arrays() -> None:
            new = [np.empty_like(a) for a in vars(out).values()]
            loop(ctypes.c_size_t(count), *inputs, *[pointer(a) for a in new])

        ways = {
            "C++ loop": lambda: loop(ctypes.c_size_t(count), *inputs, *outputs),
            "law.evaluate, out=": lambda: law.evaluate(depth, rate, slip, bristle, out=out),
            "C++ loop, new arrays": into_new_arrays,
            "law.evaluate, new arrays": lambda: law.evaluate(depth, rate, slip, bristle),
        }
        times: dict[str, list[float]] = {name: [] for name in ways}
        for _ in range(arguments.rounds):
            for name, way in ways.items():
                start = time.process_time()
                way()
                times[name].append(time.process_time() - start)

    for name, theirs in vars(by_loop).items():
        np.testing.assert_array_equal(theirs, getattr(out, name))
    medians = {name: statistics.median(seconds) for name, seconds in times.items()}
    base = medians["C++ loop"]
    print(f"{count} contacts, every phase at random, forces and powers; medians of {arguments.rounds} rounds\n")
    for name, median in medians.items():
        print(f"{name:<28}{1e9 * median / count:8.1f} ns{median / base:8.2f}")
    print_step(law)
    ratios = (
        medians["law.evaluate, out="] / base,
        medians["law.evaluate, new arrays"] / medians["C++ loop, new arrays"],
    )
    print(f"\nratios to the loop over the same arrays: {ratios[0]:.2f}, new arrays {ratios[1]:.2f}; at most {TARGET}")
    return max(ratios) > TARGET


if __name__ == "__main__":
    sys.exit(main())

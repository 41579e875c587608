#!/usr/bin/env python3
"""Add the example laws to a clean clone as docs/adding-a-law.md says, each by one file, one include and one line of the
list, and see that all else follows: the library and the command line build, each law runs by its name with its account
closed, and the tests of all laws hold for it.

The clone is of the last commit; what is not committed is not checked.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
REGISTRY = pathlib.Path("include/footfall/law/registry.hpp")
LARGEST_RESIDUAL = 1e-8  # of the energy, at the tolerance of 1e-10
TESTS = "*LawTest*:*RateFriction*:EveryFrictionLaw*:LawParameters*"


@dataclasses.dataclass
class Example:
    file: str  # in examples/laws
    kind: str  # normal or friction
    type: str
    name: str  # in a scenario
    keys: str


EXAMPLES = (
    Example("andersson.hpp", "friction", "AnderssonFriction", "andersson",
            "static_coefficient = 0.3\nkinetic_coefficient = 0.2\nstribeck_velocity = 0.05\nrounding_speed = '1 mm/s'"),
    Example("bouc_wen.hpp", "friction", "BoucWenFriction", "bouc-wen",
            "stiffness = 1.5e4\nkinetic_coefficient = 0.2\nreversal_loss = 0.5"),
    Example("contensou.hpp", "friction", "ContensouFriction", "contensou", "coefficient = 0.2\nrounding_speed = '1 mm/s'"),
    Example("standard_linear_solid.hpp", "normal", "StandardLinearSolidNormal", "standard-linear-solid",
            "stiffness = '1 N/µm'\nfading_stiffness = '1 N/µm'\nrelaxation_time = '0.5 ms'"),
)
USUAL = {
    "normal": "law = 'azad-featherstone'\nstiffness = 8.5e6\ndamping = 3.1e3",
    "friction": "law = 'azad-featherstone'\nstiffness = 12.75e6\ndamping = 3.1e3\ncoefficient = 0.2\nviscous = 0.1",
}
SCENARIO = """
[time]
end = 0.15
[solver]
tolerance = 1e-10
[body]
mass = '154 g'
inertia = 'solid-sphere'
[[body.spheres]]
radius = '1.65 cm'
[body.initial]
position = [0, 0, '2.65 cm']
velocity = [0.5, 0, 0]
angular_velocity = [0, 0, 20]
[contact.normal]
{normal}
[contact.friction]
{friction}
"""


def run(*command, **options):
    return subprocess.run([str(part) for part in command], check=True, **options)


def add(clone, law):
    """One file, one include, one line of the list."""
    target = f"footfall/law/{law.kind}/{law.file}"
    (clone / "include" / target).write_bytes((clone / "examples/laws" / law.file).read_bytes())
    registry = clone / REGISTRY
    text = registry.read_text()
    include = f'#include "footfall/law/{law.kind}/'
    last = text.rindex(include)
    end = text.index("\n", last) + 1
    text = text[:end] + f'#include "{target}"\n' + text[end:]
    listed = f"using {law.kind.capitalize()}LawOver = std::variant<\n"
    start = text.index(listed) + len(listed)
    end = text.index("\n>;", start)
    # Before the last law, so that no other line needs a comma.
    last = text.rindex("\n", start, end) + 1
    text = text[:last] + f"    {law.type}<S>,\n" + text[last:]
    registry.write_text(text)


def check_lines(clone):
    """The registry has two more lines for each law, and nothing else has changed."""
    changed = run("git", "-C", clone, "diff", "--numstat", stdout=subprocess.PIPE, text=True).stdout.split()
    if changed != [str(2 * len(EXAMPLES)), "0", str(REGISTRY)]:
        raise SystemExit(f"adding {len(EXAMPLES)} laws changed more than two lines each of {REGISTRY}: {changed}")


def check_run(footfall, law, folder):
    """The law runs by its name, and each of its parameters is known to help, schema and output."""
    parts = dict(USUAL, **{law.kind: f"law = '{law.name}'\n{law.keys}"})
    scenario = folder / f"{law.name}.toml"
    scenario.write_text(SCENARIO.format(**parts))
    result = json.loads(run(footfall, "run", scenario, "--json", stdout=subprocess.PIPE).stdout)
    residual = abs(result["energy"]["max_residual"])
    if not residual <= LARGEST_RESIDUAL:
        raise SystemExit(f"{law.name}: the account of the run is off by {residual} of the energy")
    if len(result["impacts"]) < 2:
        raise SystemExit(f"{law.name}: the ball does not bounce")
    known = json.loads(run(footfall, "laws", "--json", stdout=subprocess.PIPE).stdout)[law.kind]
    keys = {p["key"] for entry in known if entry["name"] == law.name for p in entry["parameters"]}
    given = {line.split(" = ")[0] for line in law.keys.splitlines()}
    schema = run(footfall, "schema", stdout=subprocess.PIPE, text=True).stdout
    if not given <= keys or f'"{law.name}"' not in schema:
        raise SystemExit(f"{law.name}: laws or schema do not have it with the keys {sorted(given)}")
    print(f"{law.name}: {len(result['impacts'])} impacts, account off by {residual:.1e}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--jobs", default=str(os.cpu_count() or 2))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="footfall-laws-") as name:
        clone = pathlib.Path(name) / "clone"
        run("git", "clone", "--quiet", "--no-hardlinks", ROOT, clone)
        for law in EXAMPLES:
            add(clone, law)
        check_lines(clone)
        build = clone / "build"
        # The quickest to compile: nothing here is timed.
        environment = dict(os.environ, CCACHE_BASEDIR=str(clone), CCACHE_NOHASHDIR="1")
        run("cmake", "-S", clone, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0",
            "-DFOOTFALL_BUILD_TESTS=ON", "-DFOOTFALL_BUILD_BENCHMARKS=OFF", "-DFOOTFALL_WARNINGS_AS_ERRORS=ON",
            env=environment, stdout=subprocess.DEVNULL)
        run("cmake", "--build", build, "-j", arguments.jobs, "--target", "footfall_cli", "test_law", env=environment)
        for law in EXAMPLES:
            check_run(build / "footfall", law, pathlib.Path(name))
        done = subprocess.run([str(build / "tests/test_law"), f"--gtest_filter={TESTS}", "--gtest_brief=1"],
                              env=dict(os.environ, RC_PARAMS="seed=2010"), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
        passed = re.search(r"\[  PASSED  \] (\d+) tests?", done.stdout)
        if done.returncode or not passed:
            print(done.stdout)
            raise SystemExit("the tests of all laws do not hold for one that is added")
        print(f"{passed[1]} tests of all laws hold for them")
    return 0


if __name__ == "__main__":
    sys.exit(main())

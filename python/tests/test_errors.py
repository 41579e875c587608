"""Errors are Python's, with the message of the command line; Ctrl-C ends a long run."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import footfall
from conftest import SCENARIOS, footfall_command


def long_run() -> dict:
    """One that would take minutes."""
    scenario = footfall.Scenario.load(SCENARIOS["rolling-sphere"]).to_dict()
    scenario["time"] = {"end": 1e5, "sample": 0}
    scenario["solver"] = {"max_evaluations": 1e15}
    return scenario


def test_a_bad_scenario_says_what_the_command_line_says(command: str, tmp_path: Path) -> None:
    file = tmp_path / "bad.toml"
    text = SCENARIOS["rolling-sphere"].read_text().replace('"154 g"', "-1").replace("coefficient =", "coeficient =")
    file.write_text(text)
    done = footfall_command(command, "run", file)
    assert done.returncode == 2
    with pytest.raises(footfall.ScenarioError) as caught:
        footfall.run(file)
    assert done.stderr.strip() == f"footfall: {caught.value}"
    assert isinstance(caught.value, footfall.InvalidInput) and isinstance(caught.value, ValueError)
    assert [problem.message.split(":")[0] for problem in caught.value.problems] == ["body.mass", "contact.friction"]
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value) and again.problems == caught.value.problems


def test_a_bad_option_says_what_the_command_line_says(command: str) -> None:
    file = SCENARIOS["rolling-sphere"]
    done = footfall_command(command, "run", file, "--tolerance", "2")
    with pytest.raises(footfall.InvalidInput, match="tolerance is 2; it must be from 1e-14 to 1e-3"):
        footfall.run(file, tolerance=2)
    assert done.stderr.startswith("footfall: --tolerance: '2' is not allowed: must be from 1e-14 to 1e-3")


def test_too_expensive_says_what_the_command_line_says(command: str, tmp_path: Path) -> None:
    file = tmp_path / "dear.toml"
    file.write_text(SCENARIOS["rolling-sphere"].read_text().replace("[solver]", "[solver]\nmax_evaluations = 1000"))
    done = footfall_command(command, "run", file)
    assert done.returncode == 1
    with pytest.raises(footfall.TooExpensive) as caught:
        footfall.run(file)
    assert done.stderr.strip() == f"footfall: {caught.value}"
    assert isinstance(caught.value, RuntimeError)


def test_a_missing_file_says_what_the_command_line_says(command: str) -> None:
    done = footfall_command(command, "run", "missing.toml")
    said = "cannot read missing.toml: "
    with pytest.raises(FileNotFoundError, match=f"^{said}there is no such file"):
        footfall.run("missing.toml")
    assert done.stderr.startswith(f"footfall: {said}")


def test_a_dict_is_checked_as_a_file_is() -> None:
    scenario = footfall.Scenario.load(SCENARIOS["rolling-sphere"]).to_dict()
    scenario["body"]["mas"] = scenario["body"].pop("mass")
    with pytest.raises(footfall.ScenarioError, match="unknown key 'mas': did you mean 'mass'"):
        footfall.run(scenario)


@pytest.mark.parametrize("value", [None, 1j, {1, 2}, object()])
def test_a_value_that_toml_does_not_have_is_named(value: object) -> None:
    with pytest.raises(footfall.InvalidInput, match=r"body\.spheres\[0\]\.radius: .* is not allowed"):
        footfall.run({"body": {"spheres": [{"radius": value}]}})


def test_what_is_no_scenario_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="a path, a dict or a Scenario is wanted, not int"):
        footfall.run(3)  # type: ignore[arg-type]


def test_ctrl_c_ends_a_run() -> None:
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        footfall.run(long_run())
    assert time.monotonic() - started < 10
    # Nothing is left behind.
    assert footfall.run(SCENARIOS["single-impact"]).impacts


PAPER = "azad-featherstone:stiffness=8.5e6,damping=3.1e3"
FRICTION = "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2,viscous=0.1"


def long_fit() -> None:
    speeds = np.linspace(0.1, 5, 2000)
    data = pd.DataFrame({"speed": speeds, "restitution": 0.9 - 0.1 * speeds})
    footfall.studies.fit(data, "azad-featherstone:stiffness=8.5e6,damping=?", mass=0.154, starts=10_000)


LONG_STUDIES = {
    "restitution": lambda: footfall.studies.restitution(PAPER, 0.154, np.geomspace(0.01, 10, 1_000_000)),
    "oblique": lambda: footfall.studies.oblique(
        PAPER, FRICTION, 0.154, 0.0165, angles=np.linspace(0, 1.5, 1_000_000), speed=1.0
    ),
    "drive": lambda: footfall.studies.drive(
        {
            "rig": {
                "end": 1e4,
                "sample": 100.0,
                "max_evaluations": 1e9,
                "load": [{"shape": "constant", "value": "10 N"}],
                "displacement": [{"shape": "sine", "amplitude": "1 mm", "frequency": "10 Hz"}],
            },
            "contact": {
                "normal": {"law": "hertz", "stiffness": 8.5e6},
                "friction": {"law": "dahl", "stiffness": 1e5, "coefficient": 0.2},
            },
        }
    ),
    "fit": long_fit,
}


@pytest.mark.parametrize("study", LONG_STUDIES)
def test_ctrl_c_ends_a_study(study: str) -> None:
    ctrl_c = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    started = time.monotonic()
    ctrl_c.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            LONG_STUDIES[study]()
    finally:
        ctrl_c.cancel()
    assert 0.4 < time.monotonic() - started < 10


def test_ctrl_c_ends_a_step_of_very_many_contacts(paper_law: footfall.ContactLaw) -> None:
    count = 20_000_000
    slip = np.broadcast_to([0.5, 0.3], (count, 2))
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            paper_law.step([0.0, 1e-4], 1e-3, 0.0, slip[:1_000_000], 1e-3)


def test_other_threads_go_on_during_a_run() -> None:
    stop = threading.Event()
    ticks = 0

    def tick() -> None:
        nonlocal ticks
        while not stop.is_set():
            ticks += 1
            time.sleep(0.001)

    def progress(_: float) -> bool:
        return ticks < 50

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        with pytest.raises(footfall.Interrupted, match="scenario: interrupted"):
            footfall.run(long_run(), progress=progress)
    finally:
        stop.set()
        thread.join()


def test_progress_sees_time_go_by_and_its_errors_come_out() -> None:
    seen: list[float] = []

    def watch(time: float) -> None:
        seen.append(time)
        if len(seen) == 5:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        footfall.run(long_run(), progress=watch)
    assert seen == sorted(seen) and seen[-1] > 0


def test_numpys_false_ends_a_run_and_no_answer_does_not() -> None:
    with pytest.raises(footfall.Interrupted):
        footfall.run(long_run(), progress=lambda _: np.False_)
    answers = iter([None, 0, "", 1, np.True_, True])
    with pytest.raises(StopIteration):
        footfall.run(long_run(), progress=lambda _: next(answers))


def test_too_much_for_memory_says_how_much_it_was(paper_law: footfall.ContactLaw) -> None:
    depth, rate = np.broadcast_to(1e-3, (2**20, 1)), np.broadcast_to(0.0, (2**40,))
    for call in (paper_law.evaluate, lambda *rest: paper_law.step(None, *rest, 1e-3)):
        with pytest.raises(MemoryError, match=r"1\.15e\+18 contacts were asked for, of shape \(1048576, 10995"):
            call(depth, rate, [0, 0])


MEMORY = """
import resource, footfall
tables = footfall.Scenario.load("rolling-sphere").to_dict()
tables["time"] = {"end": 1.0, "sample": 1e-7}
footfall._core.run
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 2**28, used + 2**28))
footfall.run(tables)
"""


def test_a_run_too_long_for_memory_says_so_and_what_to_do() -> None:
    done = subprocess.run([sys.executable, "-c", MEMORY], capture_output=True, text=True, check=False, timeout=120)
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith(("MemoryError: ", "footfall.errors.TooExpensive: ")), done.stderr
    assert "scenario: the" in last and "memory" in last and "sample" in last

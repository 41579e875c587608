"""Runs in files: named scenarios, what is no run, and many threads at once."""

from __future__ import annotations

import os
import pickle
import stat
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import footfall
from conftest import SCENARIOS, footfall_command
from footfall import studies


@pytest.fixture(scope="module")
def impact() -> footfall.Run:
    return footfall.run("single-impact")


@pytest.fixture
def saved(impact: footfall.Run, tmp_path: Path) -> Path:
    return impact.save(tmp_path / "run.nc")


# Scenarios by name --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", sorted(SCENARIOS))
def test_a_shipped_scenario_is_found_by_its_name(name: str) -> None:
    assert footfall.Scenario.load(name) == footfall.Scenario.load(SCENARIOS[name])


def test_a_run_by_name_is_that_of_the_file(impact: footfall.Run) -> None:
    assert footfall.run("single-impact") == footfall.run(SCENARIOS["single-impact"]) == impact


def test_a_file_comes_before_a_shipped_scenario(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rolling-sphere").write_text(SCENARIOS["single-impact"].read_text())
    assert footfall.Scenario.load("rolling-sphere").title == footfall.Scenario.load(SCENARIOS["single-impact"]).title
    (tmp_path / "slope-stick").mkdir()
    with pytest.raises(IsADirectoryError, match="slope-stick"):
        footfall.run("slope-stick")
    os.symlink("nowhere", tmp_path / "slope-slide")
    with pytest.raises(FileNotFoundError, match="slope-slide"):
        footfall.run("slope-slide")


def test_a_name_that_is_neither_gets_the_nearest(command: str) -> None:
    for given in ("roling-sphere", "rolling-sphere.toml", "scenarios/rolling-sphere.toml"):
        said = rf"cannot read {given}: there is no such file, .*: did you mean 'rolling-sphere'\?"
        with pytest.raises(FileNotFoundError, match=said) as caught:
            footfall.run(given)
        assert caught.value.errno == 2
    with pytest.raises(FileNotFoundError) as caught:
        footfall.run("something-else-altogether")
    assert "did you mean" not in str(caught.value)


def test_a_file_whose_name_is_no_utf_8_is_read_and_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    name, missing, wrong = (os.fsdecode(bytes([byte]) + b".toml") for byte in (0xFF, 0xFE, 0xFD))
    Path(name).write_bytes(SCENARIOS["single-impact"].read_bytes())
    Path(wrong).write_text("a = 1\n")
    scenario = footfall.Scenario.load(name)
    assert scenario.name == "\\xff.toml" and pickle.loads(pickle.dumps(scenario)) == scenario
    with pytest.raises(footfall.InvalidInput, match=r"^\\xff\.toml: .*tolerance"):
        footfall.run(name, tolerance=1)
    with pytest.raises(FileNotFoundError, match=r"cannot read \\xfe\.toml: there is no such file"):
        footfall.run(missing)
    for call in (footfall.run, studies.drive, lambda file: studies.fit(file, "hertz:stiffness=?")):
        with pytest.raises(footfall.ScenarioError, match=r"^\\xfd\.toml:"):
            call(wrong)
    for call in (footfall.run(scenario).save, footfall.open):
        with pytest.raises(footfall.InvalidInput, match=r"path: .*fc\.nc is not allowed: .* UTF-8"):
            call(os.fsdecode(b"\xfc.nc"))


# Files that are no run ----------------------------------------------------------------------------------------------


def test_save_writes_what_the_command_writes(command: str, saved: Path, impact: footfall.Run, tmp_path: Path) -> None:
    by_command = tmp_path / "command.nc"
    assert footfall_command(command, "run", SCENARIOS["single-impact"], "-q", "-o", by_command).returncode == 0
    assert footfall.open(saved) == footfall.open(by_command) == impact
    assert footfall_command(command, "run", SCENARIOS["single-impact"], "-q", "-o", by_command).returncode == 0
    umask = os.umask(0)
    os.umask(umask)
    assert stat.S_IMODE(saved.stat().st_mode) == 0o666 & ~umask
    assert [file.name for file in tmp_path.iterdir() if file.name.endswith(".part")] == []


def test_save_replaces_a_file_whole_or_not_at_all(saved: Path, rolling: footfall.Run, tmp_path: Path) -> None:
    link = tmp_path / "link.nc"
    link.symlink_to(saved.name)
    assert rolling.save(str(link)) == link and link.is_symlink()
    assert footfall.open(saved) == rolling
    for wrong, kind in ((tmp_path / "no" / "a.nc", FileNotFoundError), (tmp_path, IsADirectoryError)):
        with pytest.raises(kind, match=f"cannot write {wrong}"):
            rolling.save(wrong)
    with pytest.raises(footfall.InvalidInput, match="/dev/null"):
        rolling.save("/dev/null")
    before = saved.read_bytes()
    broken = footfall.Run(rolling.dataset.assign_attrs(wrong={"a": 1}))
    with pytest.raises(TypeError):
        broken.save(saved)
    assert saved.read_bytes() == before and {file.name for file in tmp_path.iterdir()} == {"run.nc", "link.nc"}


def test_save_keeps_the_mode_of_what_it_replaces(saved: Path, impact: footfall.Run) -> None:
    saved.chmod(0o640)
    impact.save(saved)
    assert stat.S_IMODE(saved.stat().st_mode) == 0o640


def test_save_replaces_no_stream_and_follows_no_link_to_nothing(impact: footfall.Run, tmp_path: Path) -> None:
    with (tmp_path / "log.txt").open("w") as log:
        (tmp_path / "stream").symlink_to(f"/proc/self/fd/{log.fileno()}")
        with pytest.raises(OSError, match="open stream of a program"):
            impact.save(tmp_path / "stream")
    (tmp_path / "dangling").symlink_to("nowhere")
    with pytest.raises(FileNotFoundError, match="leads to no file"):
        impact.save(tmp_path / "dangling")
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(OSError, match="leads back to itself"):
        impact.save(tmp_path / "loop")


def test_a_name_is_no_home_folder(saved: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(saved.parent)
    monkeypatch.setenv("HOME", str(saved.parent / "elsewhere"))
    (saved.parent / "~").mkdir()
    saved.rename(saved.parent / "~" / "run.nc")
    assert footfall.open("~/run.nc").title


_INTERRUPTED = """
import os, signal, sys, threading
import footfall
run = footfall.run("single-impact")
run.save("a.nc")
threading.Timer(float(sys.argv[1]), lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    while True:
        run.save("a.nc")
        footfall.open("a.nc")
except KeyboardInterrupt:
    footfall.open("a.nc")  # no lock is left behind
    for thread in threading.enumerate():
        if thread.name == "footfall-netcdf":
            thread.join()  # an interrupt just when it began does not wait for it
    print(sorted(os.listdir(".")))
"""


@pytest.mark.parametrize("after", [0.05, 0.1, 0.2])
def test_ctrl_c_while_it_saves_ends_it_and_leaves_nothing(tmp_path: Path, after: float) -> None:
    ended = subprocess.run(
        [sys.executable, "-c", _INTERRUPTED, str(after)], cwd=tmp_path, capture_output=True, text=True, timeout=60
    )
    assert ended.stdout == "['a.nc']\n", ended.stderr


def test_what_cannot_be_read_says_so(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"cannot read .*missing\.nc: No such file") as caught:
        footfall.open(tmp_path / "missing.nc")
    assert caught.value.errno == 2
    with pytest.raises(IsADirectoryError, match="cannot read .*: Is a directory"):
        footfall.open(tmp_path)
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(footfall.InvalidInput, match="pipe"):
        footfall.open(tmp_path / "pipe")


@pytest.mark.parametrize(
    ("content", "said"),
    [(b"", "is empty"), (b"text\n", "is not a NetCDF file"), (bytes(100_000), "is not a NetCDF file"),
     (b"\x89HDF\r\n\x1a\n", "damaged or only a part"), (b"CDF\x01", "damaged or only a part"),
     (b"CDF\x05" + bytes(1000), "")],
    ids=["empty", "text", "zeros", "only a signature", "only a classic signature", "a classic file of zeros"],
)  # fmt: skip
def test_what_is_no_netcdf_file_is_refused(tmp_path: Path, content: bytes, said: str) -> None:
    file = tmp_path / "wrong.nc"
    file.write_bytes(content)
    with pytest.raises(footfall.InvalidInput, match=rf"wrong\.nc: .*{said}") as caught:
        footfall.open(file)
    assert "HDF" not in str(caught.value) and "Errno" not in str(caught.value)


def test_a_part_of_a_run_is_refused(saved: Path, tmp_path: Path) -> None:
    whole = saved.read_bytes()
    part = tmp_path / "part.nc"
    for share in np.linspace(0, 1, 23)[:-1]:
        part.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(footfall.InvalidInput, match=r"part\.nc: "):
            footfall.open(part)


def test_another_netcdf_file_is_no_run(impact: footfall.Run, tmp_path: Path) -> None:
    file = tmp_path / "other.nc"
    bare = impact.dataset.copy()
    bare.attrs = {"footfall_version": "1", "title": "a"}
    others = {
        "the attribute 'footfall_version' is missing": xr.Dataset({"a": 1}),
        "the attribute 'scenario' is missing": bare,
        "the variable 'depth' is missing": impact.dataset.drop_vars("depth"),
        "the variable 'event_kind' is missing": impact.dataset.drop_vars("event_kind"),
        "the variable 'depth' is not one over": impact.dataset.assign(depth=("time", impact.dataset["time"].values)),
        "it has no sample": impact.dataset.isel(time=slice(0)),
    }
    for said, dataset in others.items():
        dataset.to_netcdf(file)
        with pytest.raises(footfall.InvalidInput, match=f"other.nc: is not a run of footfall: {said}"):
            footfall.open(file)


# Threads ------------------------------------------------------------------------------------------------------------

# In a process of its own: what threads break in the NetCDF library ends the interpreter.
HAMMER = """
import sys, time
from concurrent.futures import ThreadPoolExecutor
import footfall

folder, seconds = sys.argv[1], float(sys.argv[2])
run = footfall.run("single-impact")
run.save(f"{folder}/shared.nc")
end = time.monotonic() + seconds

def work(worker):
    rounds = 0
    while time.monotonic() < end:
        own = f"{folder}/{worker}.nc"
        run.save(own)
        assert footfall.open(own) == run
        run.save(f"{folder}/shared.nc")
        assert footfall.open(f"{folder}/shared.nc") == run
        rounds += 1
    return rounds

with ThreadPoolExecutor(8) as pool:
    print(sum(pool.map(work, range(8))))
"""


def test_eight_threads_open_and_save_at_once(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", HAMMER, str(tmp_path), "3"], capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) >= 1


def test_runs_in_many_threads_are_those_of_one(impact: footfall.Run) -> None:
    with ThreadPoolExecutor(8) as pool:
        for run in pool.map(lambda _: footfall.run("single-impact"), range(16)):
            assert run == impact

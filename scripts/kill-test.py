#!/usr/bin/env python3
"""Kills footfall while it writes, makes its calls fail, and looks at what is left.

Every command that writes files is run with and without older files in their places, and ended by SIGKILL, SIGTERM or
SIGINT at a random moment, by a signal or an error (ENOSPC, EIO, EINTR) exactly at one of the calls that change files
(scripts/kill-test-faults.c, compiled here), or by a limit of the files' size. What must hold after each: every output is
the whole older file or the whole new one, the tables of a run are all old or all new, inputs and other files are as they
were, the exit code is a documented one, and the next write removes what was left over.
"""

import argparse
import errno
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLES = ("samples.csv", "events.csv", "impacts.csv")
NORMAL = "azad-featherstone:stiffness=8.5e6,damping=3.1e3"
FRICTION = "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2"
SCENARIO = f"""title = "Killed"
[time]
end = 0.6
sample = 1e-4
[solver]
tolerance = 1e-6
[body]
mass = "154 g"
inertia = "solid-sphere"
[[body.spheres]]
radius = "1.65 cm"
[body.initial]
position = [0, 0, 0.10]
[contact.normal]
law = "azad-featherstone"
stiffness = 8.5e6
damping = 3.1e3
"""
RIG = """[rig]
end = 1
load = [{ shape = "constant", value = "10 N" }]
displacement = [{ shape = "table", file = "path.csv", time = "t", column = "x", direction = 0 }]
[contact.normal]
law = "hertz"
stiffness = 1e8
[contact.friction]
law = "dahl"
stiffness = 1e4
coefficient = 0.4
"""
INPUTS = {
    "a.toml": SCENARIO,
    "rig.toml": RIG,
    "path.csv": "t,x\n0,0\n0.5,1e-4\n1,-1e-4\n",
    "rebounds.csv": "angle,tangential_restitution\n10,0.7\n30,0.6\n50,0.65\n70,0.8\n",
    "bounces.csv": "speed [m/s],restitution\n0.5,0.83\n1,0.76\n2,0.66\n4,0.55\n",
}
OBLIQUE = ("oblique --radius 2.5mm --density 4000 --speed 3.9 --angles 5..85:5 --tolerance 1e-6 --normal "
           "azad-featherstone:stiffness=2.675e10,damping=700 --friction "
           "azad-featherstone:stiffness=4.01e10,damping=700,coefficient=0.092").split()
# Arguments, files that are written, folder of tables.
COMMANDS = {
    "run -o": ("run a.toml -q -o run.nc".split(), ["run.nc"], None),
    "run --csv": ("run a.toml -q --csv tables".split(), [], "tables"),
    "run -o --csv": ("run a.toml -q -o run.nc --csv tables".split(), ["run.nc"], "tables"),
    "restitution": (["restitution", "--mass", "154 g", "--points", "20", "--normal", NORMAL, "--csv", "e.csv"],
                    ["e.csv"], None),
    "drive": ("drive rig.toml --csv loop.csv".split(), ["loop.csv"], None),
    "oblique": ([*OBLIQUE, "--csv", "o.csv", "--history", "h.csv"], ["o.csv", "h.csv"], None),
    "oblique --fit": ([*OBLIQUE, "--fit", "rebounds.csv", "--vary", "friction.coefficient", "--csv", "f.csv"],
                      ["f.csv"], None),
    "fit": (["fit", "bounces.csv", "--mass", "154 g", "--normal",
             "azad-featherstone:stiffness=8.5e6,damping=?", "--csv", "fit.csv"], ["fit.csv"], None),
}
# What is at the place of the tables before.
FOLDERS = ("missing", "tables", "tables and a file", "tables and a folder")
CODES = {signal.SIGKILL: {0, -9}, signal.SIGTERM: {0, 143}, signal.SIGINT: {0, 130}}


class Violation(Exception):
    pass


class Test:
    def __init__(self, footfall, work, rng):
        self.footfall, self.work, self.rng = footfall, work, rng
        self.counts = {}
        self.faults = self.compile_faults()
        self.golden, self.calls, self.seconds = {}, {}, {}

    def compile_faults(self):
        compiler = shutil.which(os.environ.get("CC", "cc")) or shutil.which("gcc")
        if not compiler:
            print("skipped: faults at single calls (there is no C compiler)")
            return None
        made = self.work / "faults.so"
        subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", made, ROOT / "scripts/kill-test-faults.c", "-ldl"],
                       check=True)
        return made

    def start(self, arguments, folder, environment=None, limit=None):
        def prepare():
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        return subprocess.Popen([self.footfall, *arguments], cwd=folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, env={**os.environ, **(environment or {})}, preexec_fn=prepare)

    def make(self, name, older, kind):
        """A folder with the inputs, and with what is in the places of the outputs."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.work))
        for file, content in INPUTS.items():
            (folder / file).write_text(content)
        _, files, tables = COMMANDS[name]
        if older:
            for file in files:
                (folder / file).write_text("older " + file)
        if tables and kind != "missing":
            (folder / tables).mkdir()
            for table in TABLES:
                (folder / tables / table).write_text("older " + table)
            if kind == "tables and a file":
                (folder / tables / "notes.txt").write_text("notes")
            if kind == "tables and a folder":
                (folder / tables / "more").mkdir()
                (folder / tables / "more" / "notes.txt").write_text("notes")
        return folder

    def learn(self):
        """What each command writes, how long it takes, and at how many calls it can be hit."""
        for name, (arguments, files, tables) in COMMANDS.items():
            for kind in FOLDERS if tables else ("missing",):
                folder = self.make(name, True, kind)
                count = self.work / "count"
                environment = {"LD_PRELOAD": str(self.faults), "FAULT_COUNT": str(count)} if self.faults else {}
                began = time.monotonic()
                process = self.start(arguments, folder, environment)
                _, said = process.communicate()
                if process.returncode != 0:
                    raise Violation(f"{name} fails without a fault: {said.decode()}")
                self.seconds[name] = time.monotonic() - began
                self.calls[name, kind] = int(count.read_text()) if self.faults else 0
                self.golden[name] = {file: (folder / file).read_bytes() for file in files}
                if tables:
                    self.golden[name] |= {table: (folder / tables / table).read_bytes() for table in TABLES}
                shutil.rmtree(folder)

    def check(self, name, folder, older, kind, codes, code, said):
        arguments, files, tables = COMMANDS[name]
        if code not in codes:
            raise Violation(f"exit code {code}, not one of {sorted(codes)}: {said.decode(errors='replace').strip()}")
        for word in (b"terminate called", b"std::", b"filesystem error", b"NetCDF:"):
            if word in said:
                raise Violation(f"says {said.decode(errors='replace').strip()}")
        # Whatever is written next into these folders sweeps them.
        sweeps = ["sweep.csv"] + ([f"{tables}/sweep.csv"] if tables and (folder / tables).exists() else [])
        for sweep in sweeps:
            done = self.start(["restitution", "--mass", "1", "--points", "2", "--normal", NORMAL, "--csv", sweep], folder)
            _, told = done.communicate()
            if done.returncode != 0:
                raise Violation(f"the next write fails: {told.decode()}")
            (folder / sweep).unlink()
        golden = self.golden[name]
        expected = set(INPUTS)
        for file in files:
            there = (folder / file).read_bytes() if (folder / file).exists() else None
            old = b"older " + file.encode() if older else None
            if there not in (old, golden[file]) or (code == 0 and there != golden[file]):
                raise Violation(f"{file} is neither the older nor the new one" if code else f"{file} was not written")
            if there is not None:
                expected.add(file)
        if tables:
            have = {t: (folder / tables / t).read_bytes() if (folder / tables / t).exists() else None for t in TABLES}
            old = {t: b"older " + t.encode() if kind != "missing" else None for t in TABLES}
            new = {t: golden[t] for t in TABLES}
            if have != new and (have != old or code == 0):
                state = {t: "old" if have[t] == old[t] else "new" if have[t] == new[t] else "neither" for t in TABLES}
                raise Violation(f"the tables are mixed: {state}")
            neighbours = {"tables and a file": {"notes.txt"}, "tables and a folder": {"more"}}.get(kind, set())
            if (folder / tables).exists():
                expected.add(tables)
                names = {entry.name for entry in (folder / tables).iterdir()}
                wanted = neighbours | {t for t in TABLES if have[t] is not None}
                if names != wanted:
                    raise Violation(f"in {tables}: {sorted(names)}, not {sorted(wanted)}")
            for notes in ("notes.txt", "more/notes.txt"):
                if notes.split("/")[0] in neighbours and (folder / tables / notes).read_text() != "notes":
                    raise Violation(f"{notes} has changed")
        names = {entry.name for entry in folder.iterdir()}
        if names != expected:
            raise Violation(f"left over or gone: {sorted(names ^ expected)}")
        for file, content in INPUTS.items():
            if (folder / file).read_text() != content:
                raise Violation(f"the input {file} has changed")

    def one(self, name, older, kind, how, codes, environment=None, limit=None, stop=None):
        folder = self.make(name, older, kind)
        what = f"{name}, {'over older files' if older else 'no older files'}, folder: {kind}, {how}"
        try:
            process = self.start(COMMANDS[name][0], folder, environment, limit)
            if stop:
                sent, after = stop
                time.sleep(after)
                process.send_signal(sent)
                began = time.monotonic()
            _, said = process.communicate(timeout=60)
            if stop and time.monotonic() - began > 1:
                raise Violation(f"took {time.monotonic() - began:.1f} s to end")
            self.check(name, folder, older, kind, codes, process.returncode, said)
        except Violation as violation:
            print(f"VIOLATION: {what}: {violation}")
            self.counts["violations"] = self.counts.get("violations", 0) + 1
        key = how.split(" at ")[0]
        self.counts[key] = self.counts.get(key, 0) + 1
        shutil.rmtree(folder)

    def draw(self):
        name = self.rng.choice(list(COMMANDS))
        kind = self.rng.choice(FOLDERS) if COMMANDS[name][2] else "missing"
        return name, self.rng.random() < 0.7, kind

    def at_call(self, name, older, kind, number, fault):
        environment = {"LD_PRELOAD": str(self.faults), "FAULT_AT": str(number)}
        if isinstance(fault, signal.Signals):
            environment |= {"FAULT_SIGNAL": str(int(fault))}
            self.one(name, older, kind, f"{fault.name} at call {number}", CODES[fault], environment)
        else:
            environment |= {"FAULT_ERRNO": str(fault)}
            self.one(name, older, kind, f"{errno.errorcode[fault]} at call {number}", {0, 1, 2}, environment)

    def random_kill(self):
        name, older, kind = self.draw()
        ended = self.rng.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGINT))
        after = self.rng.uniform(0, 1.1 * self.seconds[name])
        # Before the program has looked after signals it ends as any does.
        self.one(name, older, kind, f"{ended.name} at {1e3 * after:.0f} ms", CODES[ended] | {-ended}, stop=(ended, after))

    def random_fault(self):
        name, older, kind = self.draw()
        fault = self.rng.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGINT, errno.ENOSPC, errno.EIO, errno.EINTR))
        self.at_call(name, older, kind, self.rng.randint(1, self.calls[name, kind]), fault)

    def full_disk(self):
        name, older, kind = self.draw()
        limit = self.rng.randrange(0, max(len(content) for content in self.golden[name].values()) - 1)
        self.one(name, older, kind, f"full disk at {limit} bytes", {1}, limit=limit)

    def folder_gone(self):
        """The folder of the outputs is removed while the program runs: it says so and does not crash."""
        folder = self.make("run -o", False, "missing")
        (folder / "out").mkdir()
        process = self.start(["run", "a.toml", "-q", "-o", "out/run.nc", "--csv", "out/tables"], folder)
        time.sleep(self.rng.uniform(0, self.seconds["run -o"]))
        shutil.rmtree(folder / "out", ignore_errors=True)
        _, said = process.communicate(timeout=60)
        if process.returncode not in (0, 1) or b"terminate" in said:
            print(f"VIOLATION: folder removed meanwhile: exit code {process.returncode}: {said.decode()}")
            self.counts["violations"] = self.counts.get("violations", 0) + 1
        self.counts["folder removed"] = self.counts.get("folder removed", 0) + 1
        shutil.rmtree(folder)

    def every_call(self):
        """SIGKILL, an error and SIGTERM at each call of what has the most to lose."""
        for kind in FOLDERS:
            for number in range(1, self.calls["run -o --csv", kind] + 1):
                for fault in (signal.SIGKILL, errno.EIO, signal.SIGTERM):
                    self.at_call("run -o --csv", True, kind, number, fault)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--footfall", type=pathlib.Path, default=ROOT / "build/footfall")
    parser.add_argument("--kills", type=int, default=200, help="random kills and faults")
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--every", action="store_true", help="and one at every call of run -o --csv")
    arguments = parser.parse_args()
    seed = arguments.seed if arguments.seed is not None else random.SystemRandom().randrange(2**32)
    print(f"seed {seed}")
    # A shell that starts this in the background ignores Ctrl-C for it; the program would go on doing so.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    with tempfile.TemporaryDirectory(prefix="footfall-kill-test-") as work:
        test = Test(arguments.footfall.resolve(), pathlib.Path(work), random.Random(seed))
        try:
            test.learn()
        except Violation as violation:
            sys.exit(f"VIOLATION: {violation}")
        kinds = [test.random_kill, test.random_fault if test.faults else test.random_kill, test.random_kill,
                 test.random_fault if test.faults else test.random_kill, test.full_disk, test.folder_gone]
        for number in range(arguments.kills):
            kinds[number % len(kinds)]()
        if arguments.every and test.faults:
            test.every_call()
        violations = test.counts.pop("violations", 0)
        print(", ".join(f"{count} {what}" for what, count in sorted(test.counts.items())))
        print(f"kill test: {sum(test.counts.values())} ends, {violations} violations (seed {seed})")
        sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Compares what two builds of footfall say of every shipped scenario and rig, to the last bit.

    scripts/same-results.py OLD_FOOTFALL NEW_FOOTFALL

What may differ: wall_seconds; version; stick_time of an impact and the warnings of a rig, which are new; and the time of
an event that the old program put before the event that it follows, which the new one puts at the same time.
"""

import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOT_COMPARED = ("wall_seconds", "version")
ADDED = ("stick_time", "warnings")


def output(footfall, command, file):
    done = subprocess.run([footfall, command, str(file), "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{footfall} {command} {file}: exit code {done.returncode}: {done.stderr.strip()}")
    # Numbers stay the text that they are: no two numbers with different texts are the same to the last bit.
    return json.loads(done.stdout, parse_float=str, parse_int=str)


def raised_times(old):
    """Puts every event of an old run at the time of the event before it, where it was earlier."""
    events = old.get("events", [])
    times = [event["time"] for event in events]
    for before, event in zip(events, events[1:]):
        if float(event["time"]) < float(before["time"]):
            event["time"] = before["time"]
    for impact in old.get("impacts", []):
        for key in ("touchdown", "separation", "recovered"):
            for event, time in zip(events, times):
                if impact[key] == time and event["sphere"] == impact["sphere"]:
                    impact[key] = event["time"]
    return sum(event["time"] != time for event, time in zip(events, times))


def differences(old, new, path=""):
    """Yields a line for each difference that is not allowed."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in [*old, *(key for key in new if key not in old)]:
            where = f"{path}.{key}" if path else key
            if key in NOT_COMPARED:
                continue
            if key not in new:
                yield f"{where} is gone"
            elif key not in old:
                if key not in ADDED:
                    yield f"{where} is new"
            else:
                yield from differences(old[key], new[key], where)
    elif isinstance(old, list) and isinstance(new, list):
        if len(old) != len(new):
            yield f"{path}: {len(old)} became {len(new)}"
        for i, (a, b) in enumerate(zip(old, new)):
            yield from differences(a, b, f"{path}[{i}]")
    elif old != new:
        yield f"{path}: {old} became {new}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("old", help="a build of footfall")
    parser.add_argument("new", help="another")
    arguments = parser.parse_args()
    files = [("run", file) for file in sorted((ROOT / "scenarios").glob("*.toml"))]
    files += [("drive", file) for file in sorted((ROOT / "scenarios/rigs").glob("*.toml"))]
    same = 0
    for command, file in files:
        old, new = output(arguments.old, command, file), output(arguments.new, command, file)
        raised = raised_times(old) if command == "run" else 0
        found = list(differences(old, new))
        same += not found
        note = f" ({raised} event{'s' * (raised != 1)} put in order)" if raised else ""
        print(f"{'DIFFERENT' if found else 'same':<10} {file.relative_to(ROOT)}{note}")
        for line in found[:10]:
            print(f"           {line}")
        if len(found) > 10:
            print(f"           ... and {len(found) - 10} more")
    print(f"\n{same} of {len(files)} give the same results")
    return 0 if same == len(files) else 1


if __name__ == "__main__":
    sys.exit(main())

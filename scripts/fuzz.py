#!/usr/bin/env python3
"""Feeds the command line broken and odd inputs, and checks that it stays a program.

    scripts/fuzz.py --footfall build/footfall --inputs 5000 --seed 1

Scenarios, rigs and tables of the repository, and tables made here, are mutated with their structure in view: values
huge, tiny, not finite, of another type or unit; keys dropped, repeated, renamed, nested; laws exchanged; texts spliced,
cut, with other bytes. Command lines get odd values. Whatever comes in:

    - the program ends by itself, in time and memory, by no signal, with exit code 0, 1 or 2;
    - what it prints as JSON is JSON, every number in it finite, the events in the order of time;
    - what it says of an error is in its own words, not a library's, and names the file that is wrong;
    - text is UTF-8.

Input number N of a seed is the same in every run. Inputs that fail are kept in --keep, each with its command.
Needs nothing but Python.
"""

import argparse
import collections
import concurrent.futures
import json
import math
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Words of libraries and of C++, none of which a user should meet.
FOREIGN = re.compile(
    r"toml(::|\+\+)|[Ww]hile parsing|\bboost\b|std::|basic_string|vector::|_M_|filesystem error|\bsto[dif]\b|bad_alloc"
    r"|bad_variant|bad_optional|nlohmann|json\.exception|parse_error|\b[Cc]eres\b|google|\.(cc|cpp|hpp|inl):\d|NetCDF: |\bHDF5?\b"
    r"|\bEigen\b|terminate called|what\(\)|Sanitizer|[Aa]ssert|fmt::|0x[0-9a-f]{8}|end-of-file|std_|nullptr|\bNULL\b"
)

# What a number may be changed into.
NUMBERS = (
    "0 -0.0 1 -1 1e-308 5e-324 1e308 -1e308 1e-12 1e12 1e30 1e100 -1e100 nan inf -inf +inf -nan 9223372036854775807"
    " -9223372036854775808 2147483648 0.1 1e-6 3.14159 1_000 0x10 0b1 0o7 1e400 1.5.2 1,5 .5 5. 007 1e true false"
).split()
UNITS = (
    "m cm mm km µm um nm s ms us h kg g mg t N kN mN Pa GPa MPa rad deg rpm J N/m N/m^1.5 N*s/m N·s/m m/s km/h m/s^2"
    " kg*m^2 kg m^2 in ft lb % 1 m^ m^1e9 m^-1 /s m//s m*m*m*m*m*m*m kPA Gpa °C K banana"
).split(" ")
LAWS = ["coulomb", "Linear"]  # and those that the command line knows, asked in main
NORMAL_TEXTS = (
    "azad-featherstone:stiffness=8.5e6,damping=3.1e3",
    "hunt-crossley:stiffness=8.5e6,damping=3.1e6",
    "hertz:stiffness=8.5e6",
    "linear:stiffness=1e5,damping=10",
    "falcon:stiffness=1e6,damping=1e3,exponent=1",
    "tsuji:stiffness=8.5e6,damping=0.2",
)
FIT_TEXTS = (
    "azad-featherstone:stiffness=8.5e6,damping=?",
    "azad-featherstone:stiffness=?,damping=?",
    "hunt-crossley:stiffness=?1e6,damping=?1..1e8",
    "linear:stiffness=?,damping=?",
    "hertz:stiffness=?",
    "falcon:stiffness=1e6,damping=?,exponent=?",
)
FRICTION_TEXTS = (
    "azad-featherstone:stiffness=12.75e6,damping=3.1e3,coefficient=0.2,viscous=0.1",
    "linear:stiffness=1e5,damping=1,coefficient=0.3",
    "none",
)


class Input:
    """One command line with its files, and what has been done to them."""

    def __init__(self, kind, folder):
        self.kind, self.folder = kind, folder
        self.arguments = []
        self.file = None
        self.json = True

    def write(self, name, data):
        self.file = self.folder / name
        self.file.write_bytes(data)
        return str(self.file)


# Texts ---------------------------------------------------------------------------------------------------------------

PAIR = re.compile(r"^(\s*)([\w.-]+)(\s*=\s*)(.*)$")  # no pattern that goes back over long values


def odd_number(rng):
    if rng.random() < 0.6:
        return rng.choice(NUMBERS)
    return f"{rng.choice(['', '-'])}{rng.random() * 10:.3g}e{rng.randint(-320, 320)}"


def odd_value(rng, old):
    choice = rng.randrange(18)
    bare = old.strip().strip("\"'")
    number = re.match(r"[-+0-9.eE]+", bare)
    if choice <= 2:
        return odd_number(rng)
    if (choice == 3 or choice > 11) and number:  # the same, scaled: stays within what is allowed more often
        try:
            return repr(float(number[0]) * 10 ** rng.uniform(-4, 4))
        except ValueError:
            return "1"
    if choice in (4, 5):
        return f'"{number[0] if number and rng.random() < 0.7 else odd_number(rng)} {rng.choice(UNITS)}"'
    if choice == 6:
        return rng.choice(['""', '"x"', "[]", "{}", "[1, 2, 3]", "[[1,0,0],[0,1,0],[0,0,1]]", "[0, 0, 0]", "[1e308, 1e308, 0]",
                           "true", "2020-01-01", "12:30:00", '"nan m"', '"\\u0000"', "'\x7f'", '"é µ ·"'])
    if choice == 7:
        return f'"{rng.choice(LAWS)}"'
    if choice == 8:
        return "[" * rng.choice([1, 40, 3000]) + old + "]" * rng.choice([0, 1, 40, 3000])
    if choice == 9:
        return '"' + rng.choice(["a", "é", " ", "\\\\"]) * rng.choice([10, 1000, 200000]) + '"'
    if choice == 10 and old.strip().startswith("["):
        return "[" + ", ".join(odd_number(rng) for _ in range(rng.choice([1, 2, 3, 3, 3, 4, 100]))) + "]"
    return old[: rng.randint(0, len(old))] + rng.choice(["", '"', "'", "]", ",", "#", "=", "\\"])


def mutate_lines(rng, text, others):
    """One change to a TOML text that keeps most of its structure."""
    lines = text.split("\n")
    pairs = [i for i, line in enumerate(lines) if PAIR.match(line)]
    heads = [i for i, line in enumerate(lines) if line.lstrip().startswith("[")]
    choice = rng.randrange(14)
    if pairs and choice <= 5:
        i = rng.choice(pairs)
        indent, key, equals, value = PAIR.match(lines[i]).groups()
        lines[i] = f"{indent}{key}{equals}{odd_value(rng, value)}"
    elif pairs and choice == 6:
        del lines[rng.choice(pairs)]
    elif pairs and choice == 7:
        lines.insert(rng.randint(0, len(lines)), lines[rng.choice(pairs)])
    elif pairs and choice == 8:
        i = rng.choice(pairs)
        indent, key, equals, value = PAIR.match(lines[i]).groups()
        letters = list(key)
        letters[rng.randrange(len(letters))] = rng.choice("abcxyz_-.0 é\"'=")
        key = rng.choice(["".join(letters), key * 3, ".".join([key] * rng.choice([2, 30, 2000])), key.upper(), f'"{key}"'])
        lines[i] = f"{indent}{key}{equals}{value}"
    elif heads and choice == 9:
        i = rng.choice(heads)
        name = lines[i].strip().strip("[]")
        lines[i] = rng.choice([f"[{name}]", f"[[{name}]]", f"[{name}.{name}]", f"[{name}", f"{name}]", "[]", "", f"[{name}] x",
                               "[" + ".".join([name] * 500) + "]"])
    elif heads and choice == 10:  # a whole table once more, or gone
        i = rng.choice(heads)
        end = next((h for h in heads if h > i), len(lines))
        block = lines[i:end]
        if rng.random() < 0.5:
            lines[i:end] = []
        else:
            lines[end:end] = block * rng.choice([1, 1, 3, 30])
    elif choice == 11:
        other = rng.choice(others).split("\n")
        a, b = sorted(rng.randint(0, len(other)) for _ in range(2))
        cut = rng.randint(0, len(lines))
        lines[cut:cut] = other[a:b]
    elif choice == 12:
        for i in pairs:  # another law throughout
            if lines[i].lstrip().startswith("law") and rng.random() < 0.7:
                lines[i] = f'law = "{rng.choice(LAWS)}"'
    else:
        rng.shuffle(lines) if rng.random() < 0.2 else lines.reverse() if rng.random() < 0.1 else lines.append("x = 1")
    return "\n".join(lines)


def mutate_bytes(rng, data):
    """One change that knows nothing of structure."""
    data = bytearray(data)
    choice = rng.randrange(6)
    at = rng.randint(0, len(data))
    if choice == 0:
        del data[at:]
    elif choice == 1 and data:
        for _ in range(rng.choice([1, 3, 30])):
            data[rng.randrange(len(data))] = rng.randrange(256)
    elif choice == 2:
        data[at:at] = bytes(rng.randrange(256) for _ in range(rng.choice([1, 4, 200])))
    elif choice == 3:
        end = min(len(data), at + rng.choice([1, 10, 200]))
        data[at:at] = data[at:end] * rng.choice([1, 10, 300])
    elif choice == 4:
        del data[at : at + rng.choice([1, 5, 50])]
    else:
        text = data.decode("utf-8", "replace")
        data = bytearray(rng.choice([b"\xef\xbb\xbf" + bytes(data), text.encode("utf-16"), text.replace("\n", "\r\n").encode(),
                                     text.replace("\n", "\r").encode(), text.encode("latin-1", "replace"), b"", b"\0" * 1000]))
    return bytes(data)


def mutate_toml(rng, text, others):
    for _ in range(rng.choice([0, 1, 1, 1, 1, 2, 3, 6])):
        text = mutate_lines(rng, text, others)
    data = text.encode("utf-8", "replace")
    return mutate_bytes(rng, data) if rng.random() < 0.15 else data


def with_short_runs(text, table, evaluations):
    """The text with a budget that ends a run in a moment, where it has none yet."""
    text = re.sub(r"(?m)^max_evaluations.*$", "", text)
    line = f"max_evaluations = {evaluations}"
    if re.search(rf"(?m)^\[{table}\]", text):
        return re.sub(rf"(?m)^\[{table}\].*$", lambda head: f"{head[0]}\n{line}", text, count=1)
    return f"{text}\n[{table}]\n{line}\n"


# Tables --------------------------------------------------------------------------------------------------------------


def made_table(rng):
    """A table of measurements as somebody may have it: returns its text and the options that suit it."""
    rows = rng.choice([0, 2, 5, 20, 20, 60])
    kind = rng.randrange(4)
    if kind == 0:
        head, columns = ["speed", "restitution"], [(0.1 + 0.1 * i, 1 - 0.02 * i) for i in range(rows)]
        options = ["--mass", "154 g"]
    elif kind == 1:
        head = ["indentation", "force"]
        columns = [(1e-6 * i, 8.5e6 * (1e-6 * i) ** 1.5) for i in range(rows)]
        options = ["--quasistatic"]
    elif kind == 2:
        head = ["indentation", "rate", "force"]
        columns = [(1e-6 * i, 0.1, 8.5e6 * (1e-6 * i) ** 1.5) for i in range(rows)]
        options = []
    else:
        head = ["time", "force"]
        columns = [(1e-5 * i, 100 * math.sin(math.pi * i / max(rows, 1))) for i in range(rows)]
        options = ["--mass", "154 g", "--speed", "1 m/s"]
    units = {"speed": ["m/s", "mm/s", "km/h", ""], "restitution": ["1", "", "%"], "indentation": ["m", "mm", "um", "µm", ""],
             "rate": ["m/s", ""], "force": ["N", "kN", "mN", ""], "time": ["s", "ms", "us", ""]}
    brackets = rng.choice(["[]", "[]", "[]", "()"])
    cells = [[f"{name} {brackets[0]}{unit}{brackets[1]}" if (unit := rng.choice(units[name])) else name for name in head]]
    if rng.random() < 0.2:
        cells[0].append(rng.choice(["sigma", "sigma [N]", "note", "", head[0]]))
    for row in columns:
        noise = [value * (1 + 0.02 * rng.gauss(0, 1)) for value in row]
        cells.append([f"{value:.6g}" for value in noise] + ["0.01"] * (len(cells[0]) - len(row)))
    for _ in range(rng.choice([0, 0, 0, 1, 1, 3])):  # what happens to cells
        row = rng.choice(cells)
        row[rng.randrange(len(row))] = rng.choice(
            ["", "nan", "NaN", "NA", "inf", "-inf", "-1", "0", "1e308", "-1e308", "1e-320", "1e400", "x", '"1"', "1,5", "1 000", "--",
             "1 mm", "é", "#", "'", '"', "1e", "1;2", "\t"])
    if rng.random() < 0.1:
        del rng.choice(cells)[0]
    separator = rng.choice([",", ",", ",", ";", "\t", " ", ", "])
    quote = rng.choice(["", "", "", '"', "'"])
    text = "\n".join(separator.join(f"{quote}{cell}{quote}" for cell in row) for row in cells) + "\n"
    if separator != "," and rng.random() < 0.3:
        text = text.replace(".", ",")
    return text, options


# Kinds of input ------------------------------------------------------------------------------------------------------


class Sources:
    def __init__(self):
        self.scenarios = [p.read_text() for p in sorted((ROOT / "scenarios").glob("*.toml"))]
        self.rigs = [p.read_text() for p in sorted((ROOT / "scenarios/rigs").glob("*.toml"))]
        self.tables = [p.read_bytes() for p in sorted((ROOT / "data").rglob("*.csv"))]
        self.texts = self.scenarios + self.rigs


def run_input(rng, sources, folder):
    made = Input("run", folder)
    text = with_short_runs(rng.choice(sources.scenarios), "solver", rng.choice([2000, 10000, 30000]))
    file = made.write("scenario.toml", mutate_toml(rng, text, sources.texts))
    made.arguments = ["run", file, "--json"]
    if rng.random() < 0.15:
        made.arguments += ["-o", str(folder / "out.nc")]
    if rng.random() < 0.15:
        made.arguments += ["--csv", str(folder / "out")]
    if rng.random() < 0.1:
        made.arguments.remove("--json")
        made.json = False
    return made


def drive_input(rng, sources, folder):
    made = Input("drive", folder)
    text = with_short_runs(rng.choice(sources.rigs), "rig", rng.choice([2000, 10000]))
    if rng.random() < 0.3:  # a path from a table
        (folder / "path.csv").write_bytes(mutated_table(rng, sources)[0])
        text += '\n[[rig.load]]\nshape = "table"\nfile = "path.csv"\ncolumn = "force"\n'
    file = made.write("rig.toml", mutate_toml(rng, text, sources.texts))
    made.arguments = ["drive", file, "--json"]
    if rng.random() < 0.2:
        made.arguments += ["--csv", str(folder / "out.csv")]
    return made


def mutated_table(rng, sources):
    if rng.random() < 0.7:
        text, options = made_table(rng)
        data = text.encode(rng.choice(["utf-8"] * 4 + ["latin-1", "utf-16", "utf-8-sig"]), "replace")
    else:
        data, options = rng.choice(sources.tables), ["--mass", "154 g"]
    if rng.random() < 0.3:
        data = mutate_bytes(rng, data)
    return data, options


def fit_input(rng, sources, folder):
    made = Input("fit", folder)
    data, options = mutated_table(rng, sources)
    file = made.write("table.csv", data)
    made.arguments = ["fit", file, "--json", "--starts", rng.choice(["1", "2"]), *options]
    for _ in range(rng.choice([1, 1, 2])):
        made.arguments += ["--normal", rng.choice(FIT_TEXTS)]
    if rng.random() < 0.2:
        made.arguments += ["--loss", rng.choice(["huber", "cauchy"])]
    return made


def oblique_input(rng, sources, folder):
    made = Input("oblique", folder)
    rows = rng.choice([1, 2, 4])
    head = [rng.choice(["angle", "angle [deg]", "angle [rad]", "spin"]), rng.choice(["spin_after", "rebound_angle", "impulse_ratio"])]
    cells = [head] + [[str(10 + 20 * i), str(round(10 * rng.random(), 3))] for i in range(rows)]
    if rng.random() < 0.6:
        rng.choice(cells)[rng.randrange(2)] = rng.choice(["", "nan", "inf", "1e308", "-90", "90", "x", "1,5", "1;2", '"3"'])
    data = "\n".join(rng.choice([",", ",", ";"]).join(row) for row in cells).encode()
    file = made.write("measured.csv", mutate_bytes(rng, data) if rng.random() < 0.3 else data)
    made.arguments = ["oblique", "--radius", "2.5mm", "--density", "4000", "--speed", "3.9", "--json", "--tolerance", "1e-6",
                      "--normal", "azad-featherstone:stiffness=2.675e10,damping=700", "--friction",
                      "azad-featherstone:stiffness=4.01e10,damping=700,coefficient=0.092",
                      "--fit", file, "--vary", "friction.coefficient"]
    return made


def odd_option(rng, value):
    choice = rng.randrange(6)
    if choice == 0:
        return odd_number(rng)
    if choice == 1:
        return f"{odd_number(rng)} {rng.choice(UNITS)}"
    if choice == 2:
        return value[: rng.randint(0, len(value))]
    if choice == 3:
        letters = list(value)
        letters[rng.randrange(len(letters))] = rng.choice("abc=,:.?0-+ é")
        return "".join(letters)
    if choice == 4:
        return value * rng.choice([2, 100])
    return re.sub(r"[-+0-9.]+(e[-+]?\d+)?", lambda _: odd_number(rng), value, count=1)


def options_input(rng, _sources, folder):
    made = Input("options", folder)
    normal = rng.choice(NORMAL_TEXTS)
    commands = (
        ["restitution", "--mass", "154 g", "--normal", normal, "--points", "3", "--json"],
        ["restitution", "--mass", "154 g", "--normal", normal, "--from", "0.1", "--to", "1", "--points", "2", "--linear", "--json"],
        ["restitution", "--figure", "2", "--points", "2", "--json"],
        ["material", "--sphere", "steel", "--ground", "brass", "--radius", "1.27 cm", "--restitution", "0.6", "--speed", "1 m/s",
         "--json"],
        ["material", "--sphere", "E=210GPa,nu=0.3", "--ground", "steel", "--radius", "1 cm", "--json"],
        ["oblique", "--radius", "2.5mm", "--density", "4000", "--speed", "3.9", "--angles", "5..45:20", "--spins", "0,10",
         "--normal", "azad-featherstone:stiffness=2.675e10,damping=700", "--friction", rng.choice(FRICTION_TEXTS),
         "--tolerance", "1e-6", "--json"],
        ["run", str(ROOT / "scenarios/single-impact.toml"), "--tolerance", "1e-6", "--json"],
        ["drive", str(ROOT / "scenarios/rigs/breakaway.toml"), "--tolerance", "1e-6", "--friction", rng.choice(FRICTION_TEXTS), "--json"],
        ["laws", "--json"],
        ["schema"],
    )
    arguments = list(rng.choice(commands))
    values = [i for i in range(1, len(arguments)) if not arguments[i].startswith("--")]
    for _ in range(rng.choice([1, 1, 2])):
        if values and rng.random() < 0.9:
            i = rng.choice(values)
            arguments[i] = odd_option(rng, arguments[i]) or "0"
        else:
            arguments.insert(rng.randint(0, len(arguments)), rng.choice(["--", "-", "", "x", "--json", "--version", "--points", "-o", "-x"]))
    made.arguments = [argument.replace("\0", "") for argument in arguments]
    made.json = False  # an odd command line may ask for something else
    return made


KINDS = ((run_input, 45), (drive_input, 15), (fit_input, 18), (oblique_input, 7), (options_input, 15))


# Checks --------------------------------------------------------------------------------------------------------------


def finite(value):
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, dict):
        return all(map(finite, value.values()))
    if isinstance(value, list):
        return all(map(finite, value))
    return True


def in_order(document):
    """Whether all events are in the order of time."""
    if not isinstance(document, dict):
        return True
    times = [event["time"] for event in document.get("events", [])]
    return times == sorted(times) and all(map(in_order, document.get("runs", [])))


def not_json(word):
    raise ValueError(f"{word} is not JSON")


def wrong_with(made, done, limit):
    """What a finished command did that it must not; None where it did nothing of the kind."""
    if done is None:
        return f"does nothing and does not end in {20 * limit} s"
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return f"still at work after {limit} s"
    if done.returncode not in (0, 1, 2):
        return f"exit code {done.returncode}"
    try:
        out, err = done.stdout.decode(), done.stderr.decode()
    except UnicodeDecodeError:
        return "prints what is not UTF-8"
    if done.returncode != 0 and not err.startswith("footfall: "):
        return "an error that does not say so"
    if foreign := FOREIGN.search(re.sub(r"'[^'\n]*'|\"[^\"\n]*\"", "", err)):
        return f"says '{foreign[0]}'"
    if len(err) > 100_000:
        return f"an error of {len(err)} bytes"
    if done.returncode == 2 and made.kind in ("run", "drive") and made.file.name not in err:
        return "wrong input that names no file"
    if done.returncode == 2 and made.kind in ("fit", "oblique") and made.file.name not in err and "--" not in err and "=?" not in err:
        return "wrong input that names neither file, option nor parameter"
    if done.returncode == 0 and made.json:
        try:
            document = json.loads(out, parse_constant=not_json)
        except ValueError as error:
            return f"prints no JSON: {error}"
        if not finite(document):
            return "prints a number that is not finite"
        if made.kind in ("run", "drive") and not in_order(document):
            return "prints events that are not in the order of time"
    if done.returncode != 0 and out.strip():
        return "prints results and fails"
    return None


def one(number, seed, footfall, sources, scratch, limit):
    rng = random.Random(f"{seed}:{number}")
    folder = scratch / str(number)
    folder.mkdir()
    make = rng.choices([kind for kind, _ in KINDS], [weight for _, weight in KINDS])[0]
    made = make(rng, sources, folder)
    started = time.monotonic()
    try:
        # Processor time is what counts; on a busy machine the clock runs on meanwhile.
        done = subprocess.run(
            [footfall, *made.arguments], capture_output=True, stdin=subprocess.DEVNULL, timeout=20 * limit, cwd=folder, check=False,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)),
        )
    except subprocess.TimeoutExpired:
        done = None
    except (ValueError, OSError):  # no command line at all: a zero byte, too long
        shutil.rmtree(folder)
        return number, made, None, None, 0.0
    seconds = time.monotonic() - started
    return number, made, done, wrong_with(made, done, limit), seconds


def keep(keep_in, seed, number, made, done, wrong):
    target = keep_in / f"{seed}-{number}"
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(made.folder, target)
    said = done.stderr.decode("utf-8", "replace")[:4000] if done else ""
    command = " ".join(repr(str(a).replace(str(made.folder), ".")) for a in made.arguments)
    (target / "what").write_text(f"{wrong}\n\nfootfall {command}\n\n{said}\n", errors="replace")
    return target


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--footfall", type=pathlib.Path, default=ROOT / "build/footfall")
    parser.add_argument("--inputs", type=int, default=5000)
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("--seed", default="2010")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=int, default=30, help="of processor time that an input may take")
    parser.add_argument("--memory", type=float, default=3, help="that a command may have, GB; 0: any")
    parser.add_argument("--keep", type=pathlib.Path, default=ROOT / "build/fuzz", help="where inputs that fail are left")
    arguments = parser.parse_args()
    footfall = str(arguments.footfall.resolve())
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if arguments.memory:
        most = int(arguments.memory * 1e9)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))  # the commands inherit it

    known = json.loads(subprocess.run([footfall, "laws", "--json"], capture_output=True, check=True).stdout)
    LAWS.extend(law["name"] for kind in ("normal", "friction") for law in known[kind])
    sources = Sources()
    counts = collections.defaultdict(collections.Counter)
    failures, slowest = [], (0.0, 0)
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        scratch = pathlib.Path(name)
        numbers = range(arguments.first, arguments.first + arguments.inputs)
        for number, made, done, wrong, seconds in pool.map(
            lambda n: one(n, arguments.seed, footfall, sources, scratch, arguments.seconds), numbers
        ):
            code = done.returncode if done else "none"
            counts[made.kind][code] += 1
            slowest = max(slowest, (seconds, number))
            if wrong:
                where = keep(arguments.keep, arguments.seed, number, made, done, wrong)
                failures.append(wrong)
                print(f"input {number} ({made.kind}): {wrong}: {where}", flush=True)
            shutil.rmtree(made.folder, ignore_errors=True)

    codes = sorted({code for kind in counts.values() for code in kind}, key=str)
    print(f"\nseed {arguments.seed}, {arguments.inputs} inputs; slowest {slowest[0]:.1f} s (input {slowest[1]})\n")
    print(f"{'kind':<10}" + "".join(f"{f'exit {code}':>10}" for code in codes))
    for kind, row in sorted(counts.items()):
        print(f"{kind:<10}" + "".join(f"{row[code]:>10}" for code in codes))
    print(f"\n{arguments.inputs - len(failures)} inputs passed, {len(failures)} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Runs the examples in README.md and docs/*.md, so that what a reader copies works.

The word after the language of a fenced block says what is done with it; a block without one is left alone.

    ```sh run           run by bash, as from the repository's root but in a scratch folder
    ```text output      what the block before it that is run prints; `...` stands for anything
    ```python run       run by the Python of --python, which has the package, in the same scratch folder
    ```cpp run          a whole program, compiled against the installed package and run
    ```cpp FILE         the text of FILE, a path from the root, without its header comment
    ```toml scenario    a scenario that `footfall run` accepts
    ```toml FILE        the text of FILE, without its header comment
    ```json output      like text output

Every law that the command line knows must have its place in README.md, docs/theory.md and docs/scenario.md, and every
header of a law in docs/reference/cpp.md.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^(?P<indent> *)```(?P<language>\w*)(?: +(?P<mark>\S+))? *$")

CMAKE = """cmake_minimum_required(VERSION 3.22)
project(example CXX)
find_package(footfall REQUIRED)
add_executable(example example.cpp)
target_link_libraries(example PRIVATE footfall::footfall)
"""


class Wrong(Exception):
    """An example that does not do what the document says."""


def blocks(file):
    """Yields (line number, language, mark, text) of every fenced block."""
    opened = None
    lines = file.read_text().splitlines()
    for number, line in enumerate(lines, 1):
        if opened is None:
            if match := FENCE.match(line):
                opened = number, match, []
        elif line.strip() == "```":
            start, match, body = opened
            yield start, match["language"], match["mark"], "\n".join(body) + "\n"
            opened = None
        else:
            opened[2].append(line[len(opened[1]["indent"]) :])
    if opened is not None:
        raise SystemExit(f"{file}:{opened[0]}: a fenced block that does not end")


def shell(command, folder, environment, timeout=600):
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", command],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=timeout,
        check=False,
    )
    if done.returncode != 0:
        raise Wrong(f"exited with {done.returncode}:\n{done.stdout}")
    return done.stdout


def same_output(expected, printed):
    pattern = re.escape(expected.strip()).replace(re.escape("..."), ".*")
    return re.fullmatch(pattern, printed.strip(), re.DOTALL) is not None


def without_header(text):
    """The file without the comment that it opens with."""
    lines = text.splitlines()
    while lines and (lines[0].startswith(("//", "#!", "# ")) or lines[0] == "#" or not lines[0].strip()):
        lines.pop(0)
    return "\n".join(lines)


class Runner:
    def __init__(self, build, python, scratch):
        self.build = build
        self.python = python
        self.scratch = scratch
        self.environment = dict(os.environ, PATH=f"{build}:{os.environ['PATH']}")
        self.prefix = None
        self.printed = None
        # What a reader has at hand at the repository's root; what they make stays in the scratch folder.
        for name in ("README.md", "data", "docs", "examples", "scenarios"):
            (scratch / name).symlink_to(ROOT / name)
        (scratch / "build").mkdir()
        (scratch / "build" / "footfall").symlink_to(build / "footfall")

    def check(self, language, mark, text):
        """Returns whether the block was one to check; raises Wrong."""
        if mark is None:
            return False
        if language == "sh" and mark == "run":
            self.printed = shell(text, self.scratch, self.environment)
        elif language == "python" and mark == "run":
            if not self.python.is_file():
                raise Wrong(f"there is no {self.python} to run it; make python-test makes it")
            (self.scratch / "example.py").write_text(text)
            self.printed = shell(f"'{self.python}' example.py", self.scratch, self.environment)
        elif mark == "output":
            if self.printed is None:
                raise Wrong("there is nothing that is run before it")
            if not same_output(text, self.printed):
                raise Wrong(f"the command before it prints:\n{self.printed}")
        elif language == "cpp" and mark == "run":
            self.compile_and_run(text)
        elif language == "toml" and mark == "scenario":
            with tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "scenario.toml").write_text(text)
                shell("footfall run scenario.toml --json", folder, self.environment)
        elif "/" in mark or "." in mark:
            file = ROOT / mark
            if not file.is_file():
                raise Wrong(f"there is no file {mark}")
            if without_header(file.read_text()).strip() != without_header(text).strip():
                raise Wrong(f"differs from {mark}")
        else:
            raise Wrong(f"'{mark}' after '{language}' is no mark; see scripts/check-docs.py")
        return True

    def compile_and_run(self, text):
        if self.prefix is None:
            self.prefix = self.scratch / "installed"
            shell(f"cmake --install '{self.build}' --prefix '{self.prefix}'", ROOT, self.environment)
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "CMakeLists.txt").write_text(CMAKE)
            (pathlib.Path(folder) / "example.cpp").write_text(text)
            shell(
                f"cmake -S . -B build -DCMAKE_PREFIX_PATH='{self.prefix}' -DCMAKE_BUILD_TYPE=Release\n"
                "cmake --build build",
                folder,
                self.environment,
            )
            self.printed = shell(f"'{folder}/build/example'", self.scratch, self.environment)


def missing_laws(build):
    """What no document says of a law, a line each."""
    known = json.loads(subprocess.run([build / "footfall", "laws", "--json"], capture_output=True, check=True).stdout)
    names = sorted({law["name"] for kind in known.values() for law in kind} - {"none"})
    places = {"README.md": "`{}`", "docs/theory.md": "`{}`", "docs/scenario.md": '"{}"'}
    for file, form in places.items():
        text = (ROOT / file).read_text()
        for name in names:
            if form.format(name) not in text:
                yield f"{file}: says nothing of the law {form.format(name)}; see docs/adding-a-law.md"
    listed = (ROOT / "docs/reference/cpp.md").read_text()
    headers = (ROOT / "include/footfall").glob("law/*/*.hpp")
    for header in sorted(str(h.relative_to(ROOT / "include/footfall")) for h in headers):
        if header not in listed:
            yield f"docs/reference/cpp.md: does not list `{header}`; see docs/adding-a-law.md"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build", type=pathlib.Path, help="folder that footfall is built in")
    parser.add_argument(
        "--python", type=pathlib.Path, help="Python with the package; python-venv/bin/python in the build folder"
    )
    parser.add_argument("files", nargs="*", type=pathlib.Path, help="documents; README.md and docs/*.md where none is given")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    python = arguments.python.absolute() if arguments.python else build / "python-venv/bin/python"
    files = arguments.files or [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]

    checked = wrong = 0
    if not arguments.files:
        for line in missing_laws(build):
            wrong += 1
            print(line)
    for file in files:
        with tempfile.TemporaryDirectory() as scratch:
            runner = Runner(build, python, pathlib.Path(scratch))
            for line, language, mark, text in blocks(file):
                try:
                    checked += runner.check(language, mark, text)
                except (Wrong, subprocess.TimeoutExpired) as error:
                    checked += 1
                    wrong += 1
                    print(f"{file}:{line}: {error}")
    print(f"docs: {checked} examples checked, {wrong} wrong")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())

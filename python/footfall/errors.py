"""The exceptions of footfall. Their messages are those of the command line."""

from __future__ import annotations

from typing import NamedTuple


class InvalidInput(ValueError):
    """A value that cannot be used: the message names it and says what is allowed."""


class Problem(NamedTuple):
    """One thing that is wrong in a scenario, and where. Lines and columns count from 1."""

    line: int
    column: int
    message: str


class ScenarioError(InvalidInput):
    """Everything that is wrong in a scenario, one line ``NAME:LINE:COLUMN: message`` for each problem.

    For a scenario given as a dict the lines are those of :func:`footfall.to_toml`.
    """

    problems: list[Problem]
    """At least one, in the order of the text."""

    def __init__(self, message: str, problems: list[tuple[int, int, str]] | None = None) -> None:
        super().__init__(message)
        self.problems = [Problem(*problem) for problem in problems or []]

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), [tuple(problem) for problem in self.problems])


class TooExpensive(RuntimeError):
    """A run would need, or has needed, more evaluations or memory than ``solver.max_evaluations`` or
    ``solver.max_memory`` allows."""


class Interrupted(RuntimeError):
    """The caller's ``progress`` returned False."""

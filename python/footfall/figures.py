"""The figures of one run, as files.

    python -m footfall.figures RUN.nc OUT/             the whole run
    python -m footfall.figures RUN.nc OUT/ --impact    its first impact, for runs with samples close together

draws what ``footfall run SCENARIO -o RUN.nc`` has written, with the functions of :mod:`footfall.plot`. The compiled
extension is not needed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from footfall import _arguments
from footfall.errors import InvalidInput
from footfall.results import Run, open

try:
    from footfall import plot
except ImportError as error:
    if __name__ != "__main__":
        raise
    raise SystemExit(f"error: {error}") from None

import matplotlib.pyplot as plt  # after footfall.plot, which says how to install it


@dataclass(frozen=True)
class Drawing:
    """One file."""

    name: str
    """Of the file, without its ending."""
    caption: str
    draw: Callable[[Any, Run], object]
    """Draws on what ``plt.subplots`` gives for ``panels``."""
    size: tuple[float, float]
    """[inch]"""
    panels: int = 1
    """One above the other."""


def _sideways(run: Run) -> Any:
    """The horizontal axis along which the body goes further."""
    way = np.ptp(run.dataset["position"].values[:, :2], axis=0)
    return "y" if way[1] > way[0] else "x"


def _around_impact(run: Run) -> plot.Window:
    first = run.impacts[0]
    end = first.recovered or float(run.dataset["time"][-1])
    return first.touchdown - 0.05 * (end - first.touchdown), end + 0.05 * (end - first.touchdown)


def _forces(panels: Any, run: Run) -> None:
    above, below = panels
    sphere = run.impacts[0].sphere
    plot.contact_force(above, run, sphere=sphere, impact=0)
    plot.contact_force(below, run, component=_sideways(run), sphere=sphere, impact=0)
    # The legend and the label below it serve both.
    below.get_legend().remove()
    above.set_xlabel("")


WHOLE = (
    Drawing("trajectory", "the path of the centre of mass",
            lambda axes, run: plot.trajectory(axes, run, horizontal=_sideways(run)), (6.4, 3.2)),
    Drawing("height", "the height of the lowest point", plot.height, (6.4, 3.0)),
    Drawing("energy", "where every joule is: bands that add up to a flat line", plot.energy, (7.2, 3.8)),
    Drawing("residual", "what the account of energy does not explain", plot.residual, (6.4, 3.0)),
)  # fmt: skip

IMPACT = (
    Drawing("impact-filmstrip", "the body through its first impact, forces as arrows",
            lambda axes, run: plot.filmstrip(axes, run, horizontal=_sideways(run)), (9.0, 1.9)),
    Drawing("impact-forces", "normal force and friction, with the phases of the contact", _forces, (6.4, 5.0), 2),
    Drawing("impact-loop", "normal force against indentation",
            lambda axes, run: plot.force_indentation(axes, run, sphere=run.impacts[0].sphere, impact=0), (4.8, 3.6)),
    Drawing("impact-energy", "what springs, dampers and the clutch do meanwhile",
            lambda axes, run: plot.energy(axes, run, window=_around_impact(run)), (7.2, 3.8)),
)  # fmt: skip


def make(run: Run, out: Path, drawings: Sequence[Drawing] = WHOLE) -> list[tuple[Path, str]]:
    """Draws a run into the folder ``out`` and gives the files, each with its caption.

    Raises InvalidInput where drawings of an impact are wanted and nothing touches the ground, OSError where the folder
    or a file cannot be written.
    """
    if not isinstance(run, Run):
        said = _arguments.described(run)
        raise TypeError(f"run: a run is wanted, as footfall.run and footfall.open give it, not {said}")
    if not isinstance(drawings, (list, tuple)) or not all(isinstance(drawing, Drawing) for drawing in drawings):
        raise TypeError("drawings: Drawings are wanted, such as figures.WHOLE or figures.IMPACT")
    if drawings is IMPACT and not run.impacts:
        raise InvalidInput("run: has no impact to draw")
    out = _arguments.folder("out", out)
    made = []
    for drawing in drawings:
        with plt.rc_context(plot.STYLE):
            figure, axes = plt.subplots(drawing.panels, 1, figsize=drawing.size, layout="constrained", sharex=True)
            drawing.draw(axes, run)
            file = out / f"{drawing.name}.png"
            figure.savefig(file)
            plt.close(figure)
        made.append((file, drawing.caption))
    return made


def main(arguments: Sequence[str] | None = None) -> int:
    """The command ``python -m footfall.figures RUN.nc OUT/``."""
    parser = argparse.ArgumentParser(prog="python -m footfall.figures", description="Draws the figures of a run.")
    parser.add_argument("run", type=Path, metavar="RUN.nc", help="what footfall run -o has written")
    parser.add_argument("out", type=Path, metavar="OUT", help="folder for the figures")
    parser.add_argument("--impact", action="store_true", help="draw the first impact, not the whole run")
    given = parser.parse_args(arguments)
    plt.switch_backend("Agg")
    try:
        made = make(open(given.run), given.out, IMPACT if given.impact else WHOLE)
    except (InvalidInput, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    width = max(len(str(file)) for file, _ in made)
    for file, caption in made:
        print(f"  {file!s:{width}}  {caption}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

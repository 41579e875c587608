"""What the tests of the package share. They run against the installed wheel, from a folder outside the source tree."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import footfall

SCENARIOS = footfall.shipped_scenarios()


@pytest.fixture(scope="session")
def rolling() -> footfall.Run:
    return footfall.run(SCENARIOS["rolling-sphere"])


@pytest.fixture(scope="session")
def foot() -> footfall.Run:
    return footfall.run(SCENARIOS["foot-heel-first"])


@pytest.fixture(scope="session")
def command() -> str:
    """The command that was installed with the package."""
    found = shutil.which("footfall", path=str(Path(sys.executable).parent))
    assert found, "the wheel has put no command beside its Python"
    return found


@pytest.fixture
def paper_law() -> footfall.ContactLaw:
    return footfall.ContactLaw(
        footfall.laws.AzadFeatherstoneNormal(stiffness=8.5e6, damping=3.1e3),
        footfall.laws.AzadFeatherstoneFriction(stiffness=12.75e6, damping=3.1e3, coefficient=0.2, viscous=0.1),
    )


def footfall_command(command: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([command, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=300)

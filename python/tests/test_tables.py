"""Tables of measurements from Python: the same reader as the command line's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import footfall
from footfall import studies

LAW = "azad-featherstone:stiffness=8.5e6,damping=?"
CURVE = "v_in [mm/s];COR;remark\n100;0,779;\n400;0,72;\n1000;0,66;good\n"


def write(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    file = folder / "lab.csv"
    file.write_bytes(text.encode(encoding))
    return file


def test_a_laboratorys_table_is_read_and_what_was_made_of_it_is_said(tmp_path: Path) -> None:
    fit = studies.fit(write(tmp_path, CURVE), LAW, mass=0.154)
    np.testing.assert_array_equal(fit.dataset["speed"], [0.1, 0.4, 1.0])
    assert fit.notes == [
        "Read: speed in mm/s from 'v_in [mm/s]', restitution from 'COR'.",
        "Columns that are not used: remark.",
        "Decimal commas.",
    ]
    assert fit.warnings == []
    assert fit.notes[0] in fit.report


def test_a_data_frame_is_read_by_the_same_rules() -> None:
    table = pd.DataFrame({"v_in [mm/s]": [100, 400, 1000.0], "COR": [0.779, 0.72, 0.66], "no": [1, 2, 3]})
    fit = studies.fit(table, LAW, mass=0.154)
    np.testing.assert_array_equal(fit.dataset["speed"], [0.1, 0.4, 1.0])
    assert "Columns that are not used: no." in fit.notes


def test_the_caller_says_which_column_and_which_rows(tmp_path: Path) -> None:
    file = write(tmp_path, "ball,U,ratio\n1,7,0.9\n2,100,0.779\n2,1000,0.66\n")
    fit = studies.fit(
        file, LAW, mass=0.154, columns={"speed": "U [mm/s]", "restitution": "ratio"}, where={"ball": 2}
    )
    np.testing.assert_array_equal(fit.dataset["speed"], [0.1, 1.0])


def test_bad_rows_are_errors_that_name_the_argument_that_leaves_them_out(tmp_path: Path) -> None:
    file = write(tmp_path, CURVE + "2000;x;\n")
    with pytest.raises(footfall.ScenarioError, match=r"lab.csv:5:6: restitution is 'x'.*\nskip_bad_rows=True"):
        studies.fit(file, LAW, mass=0.154)
    fit = studies.fit(file, LAW, mass=0.154, skip_bad_rows=True)
    assert "1 of 4 rows could not be used and were left out: line 5." in fit.notes


def test_depths_in_metres_without_a_unit_are_a_python_warning(tmp_path: Path) -> None:
    file = write(tmp_path, "indentation,force\n20,1\n40,3\n60,5\n")
    with pytest.warns(UserWarning, match="column 'indentation' has no unit") as caught:
        fit = studies.fit(file, "hertz:stiffness=?", quasistatic=True)
    assert len(fit.warnings) == 1
    assert caught[0].filename == __file__


def test_heights_and_bounces_stand_for_restitution(tmp_path: Path) -> None:
    file = write(tmp_path, "drop_height,rebound_height\n1,0.64\n0.5,0.32\n")
    fit = studies.fit(file, LAW, mass=0.154, gravity=10)
    np.testing.assert_allclose(fit.dataset["speed"], np.sqrt([20, 10]))
    np.testing.assert_allclose(fit.dataset["restitution"], 0.8)


def test_wrong_arguments_are_named(tmp_path: Path) -> None:
    file = write(tmp_path, CURVE)
    with pytest.raises(footfall.InvalidInput, match="unknown quantity 'sped': did you mean 'speed'"):
        studies.fit(file, LAW, mass=0.154, columns={"sped": "U"})
    with pytest.raises(TypeError, match="columns: a dict of texts is wanted"):
        studies.fit(file, LAW, mass=0.154, columns="speed=U")  # type: ignore[arg-type]
    with pytest.raises(footfall.InvalidInput, match="kind"):
        studies.fit(file, LAW, mass=0.154, kind="force")  # type: ignore[arg-type]
    with pytest.raises(footfall.InvalidInput, match="gravity"):
        studies.fit(file, LAW, mass=0.154, gravity=0)


def test_a_rigs_path_in_millimetres_is_converted(tmp_path: Path) -> None:
    (tmp_path / "path.csv").write_text("time [s],position [mm]\n0,0\n1,1\n2,1\n3,0\n4,0\n")
    (tmp_path / "rig.toml").write_text(
        '[rig]\nend = "4 s"\n[[rig.load]]\nshape = "constant"\nvalue = "10 N"\n'
        '[[rig.displacement]]\nshape = "table"\nfile = "path.csv"\ncolumn = "position [mm]"\n'
        '[contact.normal]\nlaw = "hertz"\nstiffness = 1e8\n'
        '[contact.friction]\nlaw = "linear"\nstiffness = 1e5\ndamping = 10\ncoefficient = 0.2\n'
    )
    run = studies.drive(tmp_path / "rig.toml")
    # 2 N over 2 mm, but for what the bristle holds.
    assert float(run["dragging_work"].values.ravel()[-1]) == pytest.approx(3.9e-3, rel=1e-2)

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import pytest

from statorhom.errors import InputFileError
from statorhom.study import load_study

PAPER = Path(__file__).resolve().parents[2] / "measurements" / "van-der-giet-550w"
CASES = Path(__file__).resolve().parents[2].parent / "shared" / "cases"


def test_reads_everything_that_the_study_names(folder: Any) -> None:
    files = load_study(folder.study)
    assert files.geometry_path == folder.geometry
    assert files.geometry.core.length_mm == 80.5
    assert list(files.tables) == ["stack-free"]
    assert [mode.frequency_hz for mode in files.tables["stack-free"].modes] == [1432.0, 1766.0]


def test_survives_the_way_to_another_process(folder: Any) -> None:
    files = load_study(str(folder.study))
    assert pickle.loads(pickle.dumps(files)) == files


@pytest.mark.parametrize(
    ("file", "old", "new", "blamed", "fragments"),
    [
        (
            "study.toml",
            "mass_kg = 3.08",
            "mass_kgs = 3.08",
            "study.toml",
            ["stages[stack]", 'unknown key "mass_kgs"', 'did you mean "mass_kg"?'],
        ),
        (
            "study.toml",
            "mass_kg = 3.08",
            "mass_kg = -3.08",
            "study.toml",
            ["stages[stack].mass_kg", "greater than 0", "-3.08", "correct the number"],
        ),
        (
            "study.toml",
            "mass_kg = 3.08",
            "mass_kg = nan",
            "study.toml",
            ["stages[stack].mass_kg", "finite number", "nan", "type the number"],
        ),
        (
            "study.toml",
            "mass_kg = 3.08",
            'mass_kg = "3.08"',
            "study.toml",
            ["stages[stack].mass_kg", 'must be a number, but is "3.08"', "without quotes"],
        ),
        (
            "study.toml",
            "mass_kg = 3.08\n",
            "",
            "study.toml",
            ["stages[stack].mass_kg", "is missing", "add this key"],
        ),
        (
            "study.toml",
            '"ring.toml"',
            '"../gone.toml"',
            "study.toml",
            ["geometry", "there is no file", "gone.toml", "correct the path"],
        ),
        (
            "study.toml",
            '"modes.csv"',
            '"modes-typo.csv"',
            "study.toml",
            ["stages[stack].tests[stack-free].modal_table", "modes-typo.csv", "correct the path"],
        ),
        (
            "study.toml",
            '"wound.uff"',
            '"missing.uff"',
            "study.toml",
            ["stages[wound].tests[wound-clamped].frf", "missing.uff", "correct the path"],
        ),
        (
            "study.toml",
            'modal_table = "modes.csv"',
            'modal_table = "modes.csv"\nhold_out = [3]',
            "study.toml",
            ["stages[stack].tests[stack-free].hold_out", "no mode 3", 'use "1", "2"'],
        ),
        (
            "study.toml",
            "schema = 1\n",
            "schema = 1\nschema = 1\n",
            "study.toml",
            ["is not valid TOML", "line 2", "correct that line"],
        ),
        (
            "study.toml",
            "chains = 2",
            "chain = 2",
            "study.toml",
            ["stages[stack].identify", 'unknown key "chain"', 'did you mean "chains"?'],
        ),
        (
            "ring.toml",
            "tooth_width_mm",
            "tooth_with_mm",
            "ring.toml",
            ["slots", 'unknown key "tooth_with_mm"', 'did you mean "tooth_width_mm"?'],
        ),
        (
            "ring.toml",
            "[winding]\noverhang_length_mm = 25.0\n",
            "",
            "study.toml",
            ["stages[wound]", "no [winding]", "add [winding]"],
        ),
        (
            "modes.csv",
            "frequency_hz",
            "f_hz",
            "modes.csv",
            ["line 2", 'unknown column "f_hz"', "frequency_hz"],
        ),
        (
            "modes.csv",
            "1432",
            "nan",
            "modes.csv",
            ["line 3, column frequency_hz", '"nan" is not a number', "type a number"],
        ),
    ],
)
def test_bad_input_is_one_line_that_names_file_and_remedy(
    folder: Any, file: str, old: str, new: str, blamed: str, fragments: list[str]
) -> None:
    folder.edit(file, old, new)
    with pytest.raises(InputFileError) as caught:
        load_study(folder.study)
    message = str(caught.value)
    assert message.startswith(f"{folder.root / blamed}: ")
    assert "\n" not in message
    for fragment in fragments:
        assert fragment in message


def test_missing_study_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputFileError, match=r"study\.toml: there is no such file; correct the path"):
        load_study(tmp_path / "study.toml")


def test_folder_instead_of_study_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputFileError, match="is a folder; name the file in it"):
        load_study(tmp_path)


def test_mass_alone_needs_no_dimensions(folder: Any) -> None:
    """Framed and complete machine may be weighed without a frame in the geometry file."""
    text = folder.study.read_text(encoding="utf-8")
    framed = '\n[[stages]]\nname = "framed"\nkind = "framed"\nmass_kg = 4.9\n'
    folder.study.write_text(text + framed, encoding="utf-8")
    files = load_study(folder.study)
    assert files.geometry.frame is None
    assert files.study.stages[-1].mass_kg == 4.9


@pytest.mark.parametrize("name", ["study.toml", "study-orthotropy.toml"])
def test_papers_study_holds_all_printed_modes(name: str) -> None:
    files = load_study(PAPER / name)
    assert [stage.mass_kg for stage in files.study.stages] == [3.08, 4.36, 4.41, 4.90, 8.64]
    assert {test: [mode.frequency_hz for mode in table.modes] for test, table in files.tables.items()} == {
        "stack-free": [1432, 1766, 3770, 6148, 6550],
        "stack-clamped": [384, 1033, 3227, 3794, 4438, 5244, 6163],
        "wound-free": [1255, 1731, 3071, 6063],
        "wound-clamped": [316, 998],
        "impregnated-free": [1170, 3502],
        "impregnated-clamped": [280, 798, 849, 1401],
    }


def test_papers_table_is_typed_with_damping_and_modal_constants() -> None:
    tables = load_study(PAPER / "study.toml").tables
    printed = {
        test: [(m.loss_factor, m.modal_constant_per_kg, m.modal_constant_phase_deg) for m in table.modes]
        for test, table in tables.items()
    }
    assert printed == {
        "stack-free": [
            (0.006, 0.5556, -12),
            (0.007, 0.0196, -19),
            (0.004, 0.0666, 84),
            (0.008, 0.4998, 165),
            (0.010, 0.0199, 96),
        ],
        "stack-clamped": [
            (0.020, 0.0618, -21),
            (0.024, 0.3821, -34),
            (0.038, 0.2131, -30),
            (0.028, 0.0464, -102),
            (0.052, 0.2041, -160),
            (0.074, 0.1036, -92),
            (0.066, 0.7188, -172),
        ],
        "wound-free": [
            (0.048, 0.2125, -32),
            (0.084, 0.0182, -38),
            (0.246, 0.0344, 41),
            (0.180, 0.6607, -140),
        ],
        "wound-clamped": [(0.030, 0.034, -31), (0.076, 0.246, -73)],
        "impregnated-free": [(0.0513, 0.3639, -15), (0.050, 0.153, -23)],
        "impregnated-clamped": [
            (0.042, 0.0626, -28),
            (0.045, 0.1472, 14),
            (0.048, 0.1113, -47),
            (0.055, 0.2070, -2),
        ],
    }
    labelled = [(test, m.row, m.order, m.axial) for test, t in tables.items() for m in t.modes if m.order]
    # the paper says r = 2 of the stack's first mode, and fits the impregnated stator "by the same procedure"
    assert labelled == [("stack-free", 1, 2, 0), ("impregnated-free", 1, 2, 0)]


@pytest.mark.skipif(not CASES.is_dir(), reason="the shared development cases are not beside the repository")
def test_development_cases_are_read() -> None:
    studies = sorted(CASES.glob("*/study*.toml"))
    assert studies
    for path in studies:
        files = load_study(path)
        assert files.study.stages[0].kind == "stack"

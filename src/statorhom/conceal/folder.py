"""The concealed study on disk: study, geometry, recordings, and the truth in a folder of its own."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from statorhom.conceal.measure_case import Measured
from statorhom.conceal.truth import Case
from statorhom.errors import ResultsError
from statorhom.recordings.dof import Dof
from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.writer import write_uff
from statorhom.study.atomic import write_text
from statorhom.study.message import one_line
from statorhom.study.toml_text import toml_text

STUDY, GEOMETRY = "study.toml", "geometry.toml"
TRUTH = Path("sealed") / "truth.json"
# keys of a test that say where its data are; they are written anew
_DATA_KEYS = (
    "modal_table",
    "frf",
    "hits",
    "hold_out",
    "sample_rate_hz",
    "hammer_mm",
    "response_mm",
    "direction",
)
_WAV_KEYS = ("force_full_scale_n", "acceleration_full_scale_m_s2")


def check_empty(folder: Path) -> None:
    """Refuse to write between other files.

    Raises
    ------
    ResultsError
        If the folder holds something.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ResultsError(
            one_line(f"{folder}: is not an empty folder; delete it or choose another one with --out")
        )


def write_folder(folder: Path, case: Case, tests: Sequence[Measured], truth: str) -> Path:
    """Write everything; the study comes last, so that a folder with one is complete.

    Parameters
    ----------
    folder : to write to.
    case, tests : the truth and its measurements.
    truth : text of truth.json.

    Returns
    -------
    Path
        The study.

    Raises
    ------
    ResultsError
        Where something cannot be written.
    """
    write_text(folder / TRUTH, truth)
    write_text(folder / GEOMETRY, toml_text(case.geometry_file))
    stages = [dict(stage) for stage in case.study["stages"]]
    for stage in stages:
        stage["tests"] = [dict(test) for test in stage.get("tests", [])]
    for measured in tests:
        keys = stages[measured.stage]["tests"][measured.test]
        name = _data_name(keys["name"], measured.table is not None)
        _write_data(folder / name, measured)
        stages[measured.stage]["tests"][measured.test] = _test_keys(keys, name, measured.table is not None)
    study = {**case.study, "geometry": GEOMETRY, "stages": stages}
    path = folder / STUDY
    write_text(path, toml_text(study))
    return path


def _data_name(test: str, is_table: bool) -> str:
    return f"{test}.csv" if is_table else f"{test}.uff"


def _test_keys(keys: dict[str, Any], name: str, is_table: bool) -> dict[str, Any]:
    kept = {key: value for key, value in keys.items() if key not in (*_DATA_KEYS, *_WAV_KEYS)}
    return {**kept, ("modal_table" if is_table else "frf"): name}


def _write_data(path: Path, measured: Measured) -> None:
    if measured.table is not None:
        write_text(path, measured.table)
        return
    frfs = measured.recording
    assert frfs is not None, "a test without a table has a recording"
    every: dict[int, Dof] = {dof.node: dof for dof in (*frfs.responses, *frfs.references)}
    nodes = tuple(Node(n, dof.position) for n, dof in every.items() if dof.position is not None)
    write_uff(path, Recording(os.path.splitext(path.name)[0], frf_sets=(frfs,), nodes=nodes))

"""Modal tables and shapes of the tests that a study gives as recordings.

Extraction takes seconds to minutes, so that its results are kept beside those of the fit and used again while files
and keys stay as they are.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from statorhom.errors import InputFileError
from statorhom.extraction.measured_modes import MeasuredModes, measured_modes
from statorhom.extraction.modal_table_text import modal_table, table_text
from statorhom.identify.processes.announce import Announce, silent
from statorhom.modes.measured_shape import MeasuredShape
from statorhom.modes.point_shape import PointShape, TestShapes
from statorhom.recordings.placement import Placement
from statorhom.study.atomic import write_bytes, write_text
from statorhom.study.frozen_map import FrozenMap
from statorhom.study.message import input_error
from statorhom.study.modal_table import ModalTable, read_modal_table
from statorhom.study.modal_tests import ModalTestKeys
from statorhom.study.study import StudyFiles

FORMAT = 4  # of what is kept: a change of method makes it stale
FOLDER = "recordings"
_DAMAGED = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, InputFileError)


@dataclass(frozen=True)
class RecordedStudy:
    """A study whose recordings have become modal tables.

    Attributes
    ----------
    files : StudyFiles
        With the tables of all tests of the stages that were asked for.
    shapes : mapping
        Test → measured shapes by row of its table: around an axis, or at the points of a plate or a wing; empty
        where points and directions are not known.
    """

    files: StudyFiles
    shapes: Mapping[str, TestShapes] = field(default_factory=dict)


def with_recorded_tables(
    files: StudyFiles, folder: Path, last: int | None = None, announce: Announce = silent
) -> RecordedStudy:
    """Extract the modes of the tests that have recordings.

    Parameters
    ----------
    files : the study.
    folder : of the results; tables and shapes are kept in its folder `recordings`.
    last : number of the last stage that is needed; None for all.
    announce : told what begins.

    Raises
    ------
    StatorhomError
        Where recordings cannot be read or hold no modes.
    """
    tests = _without_tables(files, last)
    if not tests:
        return RecordedStudy(files)
    done = announce("modal extraction", len(tests))
    tables, shapes = dict(files.tables), {}
    for number, test in enumerate(tests, start=1):
        tables[test.name], shapes[test.name] = _recorded(files, test, folder / FOLDER)
        _check_held_out(files, test, tables[test.name])
        done(number)
    return RecordedStudy(replace(files, tables=FrozenMap(tables)), shapes)


def has_recordings(files: StudyFiles) -> bool:
    """Whether modes must be extracted before anything is fitted."""
    return bool(_without_tables(files, None))


def _without_tables(files: StudyFiles, last: int | None) -> list[ModalTestKeys]:
    stages = files.study.stages[: None if last is None else last + 1]
    return [test for stage in stages for test in stage.tests if test.name not in files.tables]


def _recorded(files: StudyFiles, test: ModalTestKeys, folder: Path) -> tuple[ModalTable, TestShapes]:
    paths = [files.path.parent / name for name in test.paths]
    table, shapes = folder / f"{test.name}.csv", folder / f"{test.name}.npz"
    digest = _digest(test, paths)
    try:
        return _kept(table, shapes, digest)
    except _DAMAGED:
        pass  # not there, stale or damaged: all the same
    with threadpool_limits(limits=1, user_api="blas"):
        measured = measured_modes(paths, Placement.of_test(test))
    if not measured.modes:
        names = ", ".join(test.paths)
        raise input_error(
            files.path, f"tests[{test.name}]", f"{names}: no mode stands out of the noise", "repeat the test"
        )
    write_text(table, table_text(modal_table(measured, table), measured.remarks))
    write_bytes(shapes, _shape_bytes(measured, digest))
    return _kept(table, shapes, digest)


def _kept(table: Path, shapes: Path, digest: str) -> tuple[ModalTable, TestShapes]:
    known, remarks = _read_shapes(shapes, digest)
    return replace(read_modal_table(table), remarks=remarks), known


def _digest(test: ModalTestKeys, paths: list[Path]) -> str:
    total = hashlib.sha256(f"{FORMAT} {Placement.of_test(test)}".encode())
    for path in paths:
        with path.open("rb") as file:
            total.update(hashlib.file_digest(file, "sha256").digest())
    return total.hexdigest()


def _shape_bytes(measured: MeasuredModes, digest: str) -> bytes:
    shapes = [one.shape for one in measured.modes if one.shape is not None]
    content: dict[str, np.ndarray] = {
        "digest": np.array(digest),
        "remarks": np.array(measured.remarks, dtype=str),
    }
    if len(shapes) == len(measured.modes):
        first = shapes[0]
        content |= {"radius": np.array(first.radius_m), "z": first.z_m, "angles": first.angles_rad}
        content["motion"] = np.stack([shape.motion for shape in shapes])
        content["sd"] = np.stack([shape.sd for shape in shapes])
    elif not shapes:
        content |= _at_points(measured)
    buffer = io.BytesIO()
    np.savez(buffer, **content)  # type: ignore[arg-type]
    return buffer.getvalue()


def _at_points(measured: MeasuredModes) -> dict[str, np.ndarray]:
    """Positions, directions and values where every sensor has a place."""
    points = measured.extraction.points
    placed = [(p.position, p.direction) for p in points if p.position is not None and p.direction is not None]
    if len(placed) < len(points):
        return {}
    positions, directions = (np.array(column, dtype=float) for column in zip(*placed, strict=True))
    values = np.stack([one.mode.shape for one in measured.modes])
    return {"positions": positions, "directions": directions, "values": values}


def _read_shapes(path: Path, digest: str) -> tuple[TestShapes, tuple[str, ...]]:
    with np.load(path, allow_pickle=False) as content:
        if str(content["digest"]) != digest:
            raise ValueError("of other recordings")
        remarks = tuple(str(remark) for remark in content["remarks"])
        if "values" in content:
            at = content["positions"], content["directions"]
            return tuple(PointShape(*at, values) for values in content["values"]), remarks
        if "motion" not in content:
            return (), remarks
        place = float(content["radius"]), content["z"], content["angles"]
        shapes = tuple(
            MeasuredShape(*place, motion, sd)
            for motion, sd in zip(content["motion"], content["sd"], strict=True)
        )
        return shapes, remarks


def _check_held_out(files: StudyFiles, test: ModalTestKeys, table: ModalTable) -> None:
    labels = [mode.label for mode in table.modes]
    for number in test.hold_out:
        if str(number) not in labels:
            raise input_error(
                files.path,
                f"tests[{test.name}].hold_out",
                f"the recordings show no mode {number}",
                f"use 1 … {len(labels)}, in the order of frequency",
            )

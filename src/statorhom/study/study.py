"""A study with all files that it names."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from statorhom.study.frozen_map import FrozenMap
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.message import input_error, quoted
from statorhom.study.modal_table import ModalTable, read_modal_table
from statorhom.study.modal_tests import ModalTestKeys
from statorhom.study.nearest import hint
from statorhom.study.object_file import STATOR, ObjectFile, read_object, stator_file
from statorhom.study.regions import COUPON
from statorhom.study.stages import StageKeys
from statorhom.study.study_file import StudyFile, read_study_file
from statorhom.study.wing_file import WingFile

# The lamination needs no section of its own: [core] describes it.
_SECTION_OF: Mapping[str, str] = FrozenMap({"winding": "winding", "frame": "frame", "machine": "machine"})


@dataclass(frozen=True)
class StudyFiles:
    """Everything that a user wrote down for one study.

    Attributes
    ----------
    path : Path
        The study file.
    study : StudyFile
    drawing : GeometryFile or that of a coupon
        What the geometry file describes.
    geometry_path : Path
    tables : mapping of str to ModalTable
        The modal table of every test that has one, by the test's name.
    """

    path: Path
    study: StudyFile
    drawing: ObjectFile
    geometry_path: Path
    tables: Mapping[str, ModalTable]

    @property
    def geometry(self) -> GeometryFile:
        """The stator's geometry file.

        Raises
        ------
        InputFileError
            If the study is of another object.
        """
        return stator_file(self.drawing, self.geometry_path)


def load_study(path: str | os.PathLike[str]) -> StudyFiles:
    """Read a study and its geometry and modal tables, and check that its recordings exist.

    Parameters
    ----------
    path : path
        The study file.

    Returns
    -------
    StudyFiles

    Raises
    ------
    InputFileError
        One line with file, key and remedy for the first fault found.
    """
    path = Path(path)
    study = read_study_file(path)
    geometry_path = _existing(path, "geometry", study.geometry)
    drawing = read_object(geometry_path)
    _check_kind(path, study, drawing, geometry_path)
    if isinstance(drawing, GeometryFile):
        _check_sections(path, study, drawing, geometry_path)
    tables: dict[str, ModalTable] = {}
    for stage in study.stages:
        for test in stage.tests:
            table = _read_test(path, f"stages[{stage.name}].tests[{test.name}]", test)
            if table is not None:
                tables[test.name] = table
    return StudyFiles(path, study, drawing, geometry_path, FrozenMap(tables))


def _existing(study_path: Path, where: str, typed: str) -> Path:
    path = study_path.parent / typed
    if not os.path.isfile(path):
        raise input_error(
            study_path,
            where,
            f"there is no file {path}",
            "correct the path (relative to the study's folder) or put the file there",
        )
    return path


def _check_kind(path: Path, study: StudyFile, drawing: ObjectFile, geometry_path: Path) -> None:
    """A stator has steps of fabrication, a coupon one stage whose region is the coupon."""
    stage = study.stages[0]
    if (stage.kind == COUPON) != (drawing.kind != STATOR):
        raise input_error(
            path,
            f"stages[{stage.name}].kind",
            f"is {stage.kind}, but {geometry_path} describes a {drawing.kind}",
            "a coupon's one stage has kind = \"coupon\", a stator's stages those of its fabrication",
        )
    if stage.kind == COUPON:
        _check_coupon_regions(path, stage, drawing, geometry_path)


def _check_coupon_regions(path: Path, stage: StageKeys, drawing: ObjectFile, geometry_path: Path) -> None:
    """A coupon's region is named after its kind; a wing's are its materials, and each needs a symmetry."""
    of_wing = isinstance(drawing, WingFile)
    needed = drawing.wing.materials if isinstance(drawing, WingFile) else (drawing.kind,)
    table = f"stages[{stage.name}].model"
    home = f"{table}.wing" if of_wing else table
    for region in stage.model.declared:
        if region not in needed:
            where = home if region in stage.model.wing else table
            what = f"a wing of {', '.join(needed)}" if of_wing else f"a {drawing.kind}"
            remedy = hint(region, needed) if of_wing else f"declare {drawing.kind} instead"
            raise input_error(path, f"{where}.{region}", f"{geometry_path} describes {what}", remedy)
    for region in needed:
        if region not in stage.model.declared:
            raise input_error(
                path,
                f"{home}.{region}",
                f"is missing, but {geometry_path} has it",
                'declare it "isotropic" or of another symmetry',
            )


def _check_sections(path: Path, study: StudyFile, geometry: GeometryFile, geometry_path: Path) -> None:
    """A mass alone needs no dimensions, a test does."""
    for index, stage in enumerate(study.stages):
        needed = [_SECTION_OF[region] for region in study.regions(index) if region in _SECTION_OF]
        for section in needed if stage.tests else ():
            if getattr(geometry, section) is None:
                raise input_error(
                    path,
                    f"stages[{stage.name}]",
                    f"has tests, but {geometry_path} has no [{section}] that this stage needs",
                    f"add [{section}] to the geometry file or delete the tests",
                )


def _read_test(study_path: Path, where: str, test: ModalTestKeys) -> ModalTable | None:
    key = "modal_table" if test.modal_table is not None else "frf" if test.frf is not None else "hits"
    paths = [_existing(study_path, f"{where}.{key}", typed) for typed in test.paths]
    if key != "modal_table":
        return None
    table = read_modal_table(paths[0])
    labels = [mode.label for mode in table.modes]
    for number in test.hold_out:
        if str(number) not in labels:
            raise input_error(
                study_path,
                f"{where}.hold_out",
                f"{paths[0]} has no mode {number}",
                f"use {', '.join(quoted(label) for label in labels)} (column mode, else the row)",
            )
    return table

"""Diagnose a study into a folder."""

from __future__ import annotations

from pathlib import Path

from statorhom.diagnose.diagnosis import diagnose
from statorhom.diagnose.recorded import measured_tests
from statorhom.geometry.stator import stator_geometry
from statorhom.identify.announce import Announce, silent
from statorhom.identify.settings import Settings
from statorhom.results.diagnosis import Details, Diagnosis, write_diagnosis
from statorhom.results.files import check_folder
from statorhom.study.study import StudyFiles


def diagnose_study(
    files: StudyFiles, folder: Path, settings: Settings, announce: Announce = silent
) -> tuple[Diagnosis, Details]:
    """Read what was measured, diagnose it and write diagnosis.json.

    Raises
    ------
    StatorhomError
        If files, masses or tests do not allow it.
    """
    check_folder(folder)
    geometry = stator_geometry(files.geometry, files.geometry_path)
    files, tests = measured_tests(files, folder, announce)
    diagnosis, details = diagnose(files, geometry, tests, settings, announce)
    write_diagnosis(diagnosis, details, folder)
    return diagnosis, details

"""Diagnose a study into a folder."""

from __future__ import annotations

from pathlib import Path

from statorhom.diagnose.apply import write_amended
from statorhom.diagnose.diagnosis import diagnose
from statorhom.diagnose.recorded import measured_tests
from statorhom.geometry.stator import stator_geometry
from statorhom.identify.announce import Announce, silent
from statorhom.identify.settings import Settings
from statorhom.results.diagnosis import Details, Diagnosis, write_diagnosis
from statorhom.results.files import check_folder
from statorhom.study.study import StudyFiles


def diagnose_study(
    files: StudyFiles,
    folder: Path,
    settings: Settings,
    announce: Announce = silent,
    *,
    apply: bool = False,
) -> tuple[Diagnosis, Details]:
    """Read what was measured, diagnose it and write diagnosis.json.

    Parameters
    ----------
    apply : also write the amended study where an effect was named.

    Raises
    ------
    StatorhomError
        If files, masses or tests do not allow it.
    """
    check_folder(folder)
    geometry = stator_geometry(files.geometry, files.geometry_path)
    files, tests = measured_tests(files, folder, announce, settings.jobs)
    diagnosis, details, actions = diagnose(files, geometry, tests, settings, announce)
    write_diagnosis(diagnosis, details, folder)
    if apply and actions:
        write_amended(files, actions, folder)
    return diagnosis, details

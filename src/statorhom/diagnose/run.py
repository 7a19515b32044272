"""Diagnose a study into a folder."""

from __future__ import annotations

from pathlib import Path

from statorhom.diagnose.apply import check_not_the_study, write_amended
from statorhom.diagnose.diagnosis import diagnose
from statorhom.diagnose.measured.recorded import measured_tests
from statorhom.diagnose.refit_chain import with_refitted_chain
from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.processes.announce import Announce, silent
from statorhom.identify.stages.settings import Settings
from statorhom.results.diagnosis import Details, Diagnosis, write_diagnosis
from statorhom.results.files import check_folder, earlier_stages
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
    apply : where an effect was named, also write the amended study and identify the chain without and with it.

    Raises
    ------
    StatorhomError
        If files, masses or tests do not allow it.
    """
    check_folder(folder)
    earlier_stages(folder, files.study.name)  # results of another study are refused before any work
    if apply:
        check_not_the_study(files, folder)
    geometry = object_geometry(files.drawing, files.geometry_path)
    measured, tests = measured_tests(files, folder, announce, settings.jobs)
    diagnosis, details, named = diagnose(measured, geometry, tests, settings, announce)
    write_diagnosis(diagnosis, details, folder)
    if apply and named:
        amended = write_amended(measured, named, folder)
        details = with_refitted_chain(details, files, amended, folder, settings, announce)
        write_diagnosis(diagnosis, details, folder)
    return diagnosis, details

"""What the tests of a study measured: tables as typed, recordings as extracted and kept."""

from __future__ import annotations

from pathlib import Path

from statorhom.diagnose.measured import MeasuredTest
from statorhom.identify.announce import Announce, silent
from statorhom.study.study import StudyFiles


def measured_tests(
    files: StudyFiles, folder: Path, announce: Announce = silent
) -> tuple[StudyFiles, dict[str, MeasuredTest]]:
    """The study with tables of all tests, and its tests by name."""
    del folder, announce
    found = {}
    for number, stage in enumerate(files.study.stages):
        for test in stage.tests:
            modes = tuple(sorted(files.tables[test.name].modes, key=lambda m: m.frequency_hz))
            found[test.name] = MeasuredTest(number, test.name, test.support, modes)
    return files, found

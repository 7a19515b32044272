"""One-line messages about recordings, in the words of all input files."""

from __future__ import annotations

from os import PathLike

from statorhom.errors import RecordingError
from statorhom.study.message import input_error


def recording_error(path: str | PathLike[str], where: str, problem: str, remedy: str) -> RecordingError:
    """The error to raise for one fault of a recording: ``file: where: problem; remedy``."""
    return RecordingError(str(input_error(path, where, problem, remedy)))

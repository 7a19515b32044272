"""Read an input file as text, or say in one line why that is not possible."""

from __future__ import annotations

import os
from pathlib import Path

from statorhom.study.message import input_error


def read_text(path: Path) -> str:
    """Contents of a UTF-8 file (a byte order mark is dropped).

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        Line ends are plain ``\\n``.

    Raises
    ------
    InputFileError
        Where the file is missing, a folder, not readable or not UTF-8.
    """
    if os.path.isdir(path):
        raise input_error(path, "", "is a folder", "name the file in it")
    if not os.path.isfile(path):
        raise input_error(path, "", "there is no such file", "correct the path or create the file")
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise input_error(
            path, f"byte {error.start + 1}", "is not text in UTF-8", "save the file with the encoding UTF-8"
        ) from None
    except OSError as error:
        reason = error.strerror or "unknown reason"
        raise input_error(path, "", f"cannot be read ({reason})", "check its permissions") from None
    return text.replace("\r\n", "\n").replace("\r", "\n")

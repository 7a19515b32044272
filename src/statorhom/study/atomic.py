"""Results are written whole or not at all: a temporary file of the same folder takes the name at the end."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from statorhom.errors import ResultsError
from statorhom.study.message import one_line


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text atomically; see `write_bytes`."""
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file atomically; its folder is made where it is missing.

    Parameters
    ----------
    path : Path
        The file; an existing one is replaced only when the new one is complete.
    content : bytes
        What it shall hold.

    Raises
    ------
    ResultsError
        Where the folder or file cannot be written; an existing file is then untouched.
    """
    temporary = path.parent / f".{secrets.token_hex(8)}.tmp"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(temporary, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ResultsError(
            one_line(
                f"{path}: cannot be written ({reason}); check the folder, its permissions and the space left"
            )
        ) from None
    finally:
        _remove(temporary)


def _remove(temporary: Path) -> None:
    try:
        temporary.unlink(missing_ok=True)
    except OSError:
        # the reason it could not be written is what the user needs to know, not that it cannot be removed
        return

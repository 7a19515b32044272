"""Write results.json atomically and read it back."""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from statorhom.errors import ResultsError
from statorhom.results.schema import Results, StageResult
from statorhom.study.atomic import write_text
from statorhom.study.message import one_line

NAME = "results.json"


def write_results(results: Results, folder: Path) -> Path:
    """Write results.json into a folder, made where missing; the old file stays until the new one is whole.

    Raises
    ------
    ResultsError
        Where it cannot be written.
    """
    path = folder / NAME
    write_text(path, results.model_dump_json(indent=1, by_alias=True) + "\n")
    return path


def read_results(folder: Path) -> Results:
    """Read a folder's results.json.

    Raises
    ------
    ResultsError
        If it is missing or damaged.
    """
    path = folder / NAME
    try:
        return Results.model_validate_json(path.read_bytes())
    except FileNotFoundError:
        raise ResultsError(
            f"{path}: there is no such file; run `statorhom run STUDY --out {folder}` first"
        ) from None
    except OSError as error:
        raise ResultsError(f"{path}: cannot be read ({error.strerror}); check the folder") from None
    except ValidationError as error:
        first = error.errors()[0]
        key = ".".join(str(part) for part in first["loc"]) or "the file"
        raise ResultsError(
            one_line(f"{path}: {key}: {first['msg']}; delete the file and run the study again")
        ) from None


def earlier_stages(folder: Path, study: str) -> tuple[StageResult, ...]:
    """Stages of a study that a folder holds already; none where it has no results.json.

    Raises
    ------
    ResultsError
        If they are damaged or of another study: they are the user's to delete.
    """
    if not (folder / NAME).exists():
        return ()
    found = read_results(folder)
    if found.study != study:
        raise ResultsError(
            one_line(
                f"{folder / NAME}: belongs to the study {found.study!r}, not to {study!r}; choose another --out"
            )
        )
    return found.stages


def check_folder(folder: Path) -> None:
    """Refuse, before any work, a folder that cannot hold results; it is made where missing.

    Raises
    ------
    ResultsError
        If it is a file or cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise ResultsError(f"{folder}: is a file; name a folder for the results") from None
    except OSError as error:
        raise ResultsError(
            f"{folder}: cannot be made ({error.strerror}); name another folder for the results"
        ) from None

"""TOML files: parsed, validated, and every fault told in one line."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from statorhom.study.message import input_error, one_line
from statorhom.study.text_file import read_text
from statorhom.study.validation_message import first_fault

Model = TypeVar("Model", bound=BaseModel)


def read_toml(path: Path, model: type[Model]) -> Model:
    """Read a TOML file into a pydantic model.

    Parameters
    ----------
    path : Path
        The file.
    model : type
        A frozen pydantic model that forbids unknown keys.

    Returns
    -------
    model instance

    Raises
    ------
    InputFileError
        One line with file, key and remedy, where the file is missing, no TOML or breaks the model.
    """
    return validated(path, parsed_toml(path), model)


def validated(path: Path, table: dict[str, Any], model: type[Model]) -> Model:
    """The contents of a file as a pydantic model.

    Raises
    ------
    InputFileError
        One line with file, key and remedy, where the table breaks the model.
    """
    try:
        return model.model_validate(table)
    except ValidationError as error:
        where, problem, remedy = first_fault(error, table)
        raise input_error(path, where, problem, remedy) from None


def parsed_toml(path: Path) -> dict[str, Any]:
    """The contents of a TOML file.

    Raises
    ------
    InputFileError
        Where the file is missing or no TOML.
    """
    try:
        return tomllib.loads(read_text(path))
    except ValueError as error:
        # TOMLDecodeError is a ValueError, and so is what int() says of thousands of digits
        problem = f"is not valid TOML ({one_line(str(error))})"
        raise input_error(path, "", problem, "correct that line; text needs quotes") from None
    except RecursionError:
        raise input_error(path, "", "is nested too deeply", "use plain tables") from None

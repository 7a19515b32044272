"""Geometry files of all kinds: what is tested is a stator unless the file says otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from statorhom.study.coupon_file import BeamFile, CouponFile, PlateFile, TubeFile
from statorhom.study.geometry_file import STATORS_ONLY, GeometryFile
from statorhom.study.message import input_error, quoted
from statorhom.study.nearest import hint
from statorhom.study.toml_file import parsed_toml, validated
from statorhom.study.wing_file import WingFile

ObjectFile = GeometryFile | CouponFile | WingFile

STATOR = "stator"
TUBE = "tube"
KINDS: Mapping[
    str, type[GeometryFile] | type[PlateFile] | type[BeamFile] | type[TubeFile] | type[WingFile]
] = MappingProxyType(
    {STATOR: GeometryFile, "plate": PlateFile, "beam": BeamFile, TUBE: TubeFile, "wing": WingFile}
)


def read_object(path: Path) -> ObjectFile:
    """Read a geometry file of any kind.

    Parameters
    ----------
    path : Path
        The TOML file.

    Raises
    ------
    InputFileError
        One line with file, key and remedy.
    """
    table = parsed_toml(path)
    return validated(path, table, KINDS[_kind(path, table)])


def stator_file(file: ObjectFile, path: Path) -> GeometryFile:
    """A geometry file that must be a stator's.

    Raises
    ------
    InputFileError
        If it is of another kind.
    """
    if isinstance(file, GeometryFile):
        return file
    raise input_error(
        path,
        "kind",
        f"a {file.kind} is no stator, and this works on stators only",
        STATORS_ONLY,
    )


def _kind(path: Path, table: Mapping[str, Any]) -> str:
    kind = table.get("kind", STATOR)
    if isinstance(kind, str) and kind in KINDS:
        return kind
    remedy = hint(kind, KINDS) if isinstance(kind, str) else f"use {' or '.join(KINDS)}"
    raise input_error(path, "kind", f"{quoted(kind)} is not one of {', '.join(KINDS)}", remedy)

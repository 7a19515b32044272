"""The amended study: what was found, written into a copy of the study as far as study files can say it."""

from __future__ import annotations

import csv
import io
import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from statorhom.errors import ResultsError
from statorhom.physics.action import Action
from statorhom.study.atomic import write_text
from statorhom.study.study import StudyFiles

Toml = dict[str, Any]


def write_amended(files: StudyFiles, actions: Sequence[Action], folder: Path) -> Path:
    """Write study.toml, and the geometry or tables that change, into a folder.

    Raises
    ------
    ResultsError
        If a study file has no key for what was found.
    """
    study = tomllib.loads(files.path.read_text(encoding="utf-8"))
    _relocate(study, files.path.parent, folder)
    changed = [_amend(study, files, action, folder) for action in actions]
    if not any(changed):
        raise ResultsError(
            f"{files.path}: study files have no key for the effect that was found; diagnosis.json describes it"
        )
    path = folder / "study.toml"
    write_text(path, toml_text(study))
    return path


def _relocate(study: Toml, origin: Path, folder: Path) -> None:
    def moved(name: str) -> str:
        return Path(os.path.relpath(origin / name, folder)).as_posix()

    study["geometry"] = moved(study["geometry"])
    for stage in study["stages"]:
        for test in stage.get("tests", ()):
            for key in ("modal_table", "frf"):
                if key in test:
                    test[key] = moved(test[key])
            if "hits" in test:
                hits = test["hits"]
                test["hits"] = moved(hits) if isinstance(hits, str) else [moved(h) for h in hits]


def _amend(study: Toml, files: StudyFiles, action: Action, folder: Path) -> bool:
    for stage in study["stages"]:
        if stage["name"] in action.masses:
            stage["mass_kg"] = action.masses[stage["name"]]
        own = {r: s for r, s in action.symmetries.items() if r in stage.get("model", {})}
        if own:
            stage["model"] |= own
    for support in study.get("supports", ()):
        if support["name"] in action.supports:
            support.update(action.supports[support["name"]].model_dump(mode="json", exclude_none=True))
    if action.dimensions:
        study["geometry"] = _geometry(files, action.dimensions, folder)
    for (test, label), (order, axial) in action.names.items():
        _relabel(study, files, (test, label), (order, axial), folder)
    said = (action.masses, action.symmetries, action.supports, action.dimensions, action.names)
    return any(said)


def _geometry(files: StudyFiles, dimensions: Mapping[str, float], folder: Path) -> str:
    table = tomllib.loads(files.geometry_path.read_text(encoding="utf-8"))
    for key, value in dimensions.items():
        section, name = key.split(".")
        table[section][name] = value
    write_text(folder / "geometry.toml", toml_text(table))
    return "geometry.toml"


def _relabel(
    study: Toml, files: StudyFiles, place: tuple[str, str], name: tuple[int, int], folder: Path
) -> None:
    test, label = place
    table = files.tables[test]
    text = table.path.read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    rows = list(csv.DictReader(lines, skipinitialspace=True))
    for row, mode in zip(rows, table.modes, strict=True):
        if mode.label == label:
            row["order"], row["axial"] = str(name[0]), str(name[1])
    buffer = io.StringIO()
    writer = csv.DictWriter(buffer, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(folder / f"{test}.csv", buffer.getvalue())
    for stage in study["stages"]:
        for one in stage.get("tests", ()):
            if one["name"] == test:
                one["modal_table"] = f"{test}.csv"


def toml_text(table: Toml, prefix: str = "") -> str:
    """TOML of plain values, tables and arrays of tables."""
    values, tables, arrays = [], [], []
    for key, value in table.items():
        if isinstance(value, dict):
            tables.append((key, value))
        elif isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
            arrays.append((key, value))
        else:
            values.append(f"{key} = {_value(value)}")
    parts = ["\n".join(values)] if values else []
    for key, value in tables:
        parts.append(f"[{prefix}{key}]\n{toml_text(value, f'{prefix}{key}.')}")
    for key, rows in arrays:
        parts += [f"[[{prefix}{key}]]\n{toml_text(row, f'{prefix}{key}.')}" for row in rows]
    return "\n".join(part.rstrip("\n") + "\n" for part in parts)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_value(v) for v in value)}]"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        kept = "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped)
        return f'"{kept}"'
    return repr(value)

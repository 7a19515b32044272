"""The amended study: what was found, written into a copy of the study."""

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
from statorhom.physics.declared import DeclaredEffect, effect_table
from statorhom.study.atomic import write_text
from statorhom.study.message import one_line
from statorhom.study.study import StudyFiles
from statorhom.study.toml_text import toml_text

Toml = dict[str, Any]


def write_amended(files: StudyFiles, named: Sequence[DeclaredEffect], folder: Path) -> Path:
    """Write study.toml, and the geometry or tables that change, into a folder.

    What a study's own keys can say is corrected there; the rest stands in ``[[stages.effects]]``.
    """
    study = tomllib.loads(files.path.read_text(encoding="utf-8"))
    _relocate(study, files.path.parent, folder)
    for effect in named:
        if not _amend(study, files, effect.action, folder):
            _declare(study, effect)
    path = folder / "study.toml"
    write_text(path, toml_text(study))
    return path


def check_not_the_study(files: StudyFiles, folder: Path) -> None:
    """Refuse to write the amended study over the study itself.

    Raises
    ------
    ResultsError
        If the results folder is the study's own.
    """
    if folder.resolve() == files.path.parent.resolve():
        raise ResultsError(
            one_line(
                f"{folder}: is the study's own folder; choose another --out, for --apply writes study.toml there"
            )
        )


def _declare(study: Toml, effect: DeclaredEffect) -> None:
    for stage in study["stages"]:
        if stage["name"] == effect.candidate.stage:
            table = effect_table(effect.candidate, effect.values)
            rounded = {k: float(f"{v:.6g}") if isinstance(v, float) else v for k, v in table.items()}
            stage["effects"] = [*stage.get("effects", ()), rounded]


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
            _forget(stage, own)
    for support in study.get("supports", ()):
        if support["name"] in action.supports:
            support.update(action.supports[support["name"]].model_dump(mode="json", exclude_none=True))
    if action.dimensions:
        study["geometry"] = _geometry(files, action.dimensions, folder)
    for (test, label), (order, axial) in action.names.items():
        _relabel(study, files, (test, label), (order, axial), folder)
    said = (action.masses, action.symmetries, action.supports, action.dimensions, action.names)
    return any(said)


def _forget(stage: Toml, regions: Mapping[str, str]) -> None:
    """Constants of the former symmetry that were prescribed or expected have no meaning any more."""
    for said in stage.get("identify", {}).values():
        if isinstance(said, dict):
            for region in regions:
                said.pop(region, None)


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

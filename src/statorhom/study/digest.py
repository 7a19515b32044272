"""A fingerprint of everything in a user's files that the results of a stage depend on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from statorhom.study.stages import StageKeys
from statorhom.study.study import StudyFiles


def stage_digest(files: StudyFiles, stage_index: int, extra: Mapping[str, Any]) -> str:
    """Digest of the inputs of a stage; equal digests mean that earlier results still hold.

    Parameters
    ----------
    files : StudyFiles
        The study.
    stage_index : int
        Stages up to this one count, later ones do not.
    extra : mapping
        What else decides the results and JSON can hold: the seed, settings of the mesh.

    Returns
    -------
    str
        SHA-256 in hexadecimal. Names of study and geometry, comments and layout of the files do not enter.
    """
    stages = files.study.stages[: stage_index + 1]
    used = {test.support for stage in stages for test in stage.tests}
    content = {
        "geometry": files.drawing.model_dump(mode="json", exclude={"name"}),
        "supports": [
            support.model_dump(mode="json") for support in files.study.supports if support.name in used
        ],
        "stages": [_stage(files, stage) for stage in stages],
        "extra": dict(extra),
    }
    text = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode("utf-8")).hexdigest()


def _stage(files: StudyFiles, stage: StageKeys) -> dict[str, Any]:
    recordings = [path for test in stage.tests if test.modal_table is None for path in test.paths]
    return {
        "keys": stage.model_dump(mode="json"),
        "tables": {
            test.name: [asdict(mode) for mode in files.tables[test.name].modes]
            for test in stage.tests
            if test.name in files.tables
        },
        "recordings": {name: _content_digest(files, name) for name in recordings},
    }


def _content_digest(files: StudyFiles, name: str) -> str:
    with open(files.path.parent / name, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()

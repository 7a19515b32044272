"""Make a study with a concealed effect."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from statorhom.conceal.detectability import detectability
from statorhom.conceal.folder import check_empty, write_folder
from statorhom.conceal.identified import identified_materials
from statorhom.conceal.library import hidden_effect
from statorhom.conceal.measure_case import measure_case
from statorhom.conceal.place_effect import with_effect
from statorhom.conceal.start import start_case
from statorhom.conceal.truth import Case
from statorhom.conceal.truth_file import truth_text
from statorhom.mesh import MeshDensity
from statorhom.study.geometry_file import read_geometry
from statorhom.study.message import input_error
from statorhom.study.study_file import StudyFile, read_study_file


@dataclass(frozen=True)
class Wish:
    """An effect to conceal.

    Parameters
    ----------
    effect : its name; "none" for nothing.
    given : values of its parameters.
    strength : 0 … 1; None: drawn.
    stage, test : where; None: the first place that it fits.
    """

    effect: str
    given: Mapping[str, float] = field(default_factory=dict)
    strength: float | None = None
    stage: str | None = None
    test: str | None = None


def conceal_study(
    path: Path,
    wishes: Sequence[Wish],
    out: Path | None = None,
    *,
    seed: int = 1,
    tables: bool | None = None,
    wide: bool = False,
    materials: Path | None = None,
    only: tuple[int, int] | None = None,
    verdict: str | None = None,
    density: MeshDensity | None = None,
) -> tuple[Path, Case]:
    """Write a study whose recordings hide effects.

    Parameters
    ----------
    path : a study; its geometry, steps, weights' uncertainty, declared materials, supports and tests are taken, its
        data are not.
    wishes : what to conceal.
    out : an empty or missing folder; None: beside the study.
    seed : equal seeds give equal files.
    tables : write modal tables (True) or FRFs (False) for all tests; None: as the study has them.
    wide : draw the true constants from all that is typical, far from where a fit starts.
    materials : folder of results whose identified materials are the true ones; None: they are drawn.
    only : the one mode (r, n) that tables list; None: all that are usual.
    verdict : the right one where the data do not suffice for the best one ("ambiguous").
    density : of the true stator's mesh; None: what is usual of the step.

    Returns
    -------
    study, case : path of the new study, and what is true.

    Raises
    ------
    StatorhomError
        Where the study, its geometry, the effect or the folder do not allow it.
    """
    study = read_study_file(path)
    _refuse_declared(path, study)
    folder = path.parent / f"{study.name}-concealed" if out is None else out
    check_empty(folder)
    geometry = read_geometry(path.parent / study.geometry)
    rng = np.random.default_rng(seed)
    known = None if materials is None else identified_materials(materials)
    named = study.model_copy(update={"name": folder.name[:60]})  # what it was called may tell too much
    case = start_case(path, named, geometry, rng, tables=tables, wide=wide, known=known)
    if only is not None:
        case = _limited(case, only)
    for wish in wishes:
        effect = hidden_effect(wish.effect)
        if effect is not None:
            case = with_effect(
                case,
                effect,
                rng,
                given=wish.given,
                strength=wish.strength,
                stage=wish.stage,
                test=wish.test,
            )
    case, tests = measure_case(case, rng, density)
    found = detectability(case, tests, density)
    text = truth_text(folder.name, case, tests, found, verdict or case.verdict)
    return write_folder(folder, case, tests, text), case


def _refuse_declared(path: Path, study: StudyFile) -> None:
    for stage in study.stages:
        if stage.effects:
            raise input_error(
                path,
                f"stages[{stage.name}].effects",
                "a truth has no declared effects",
                "delete them and use --effect",
            )


def _limited(case: Case, only: tuple[int, int]) -> Case:
    for s, stage in enumerate(case.stages):
        for t in range(len(stage.tests)):
            case = case.with_test(s, t, only=only)
    return case

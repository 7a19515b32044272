"""truth.json: what is true, in the form of the development cases."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from statorhom.conceal.listed import resolved
from statorhom.conceal.measure_case import Measured
from statorhom.conceal.scatter import scatter_json
from statorhom.conceal.truth import Case, TrueMaterial


def truth_text(
    name: str, case: Case, tests: Sequence[Measured], detectability: Mapping[str, Any], verdict: str
) -> str:
    """Contents of truth.json.

    Parameters
    ----------
    name : of the case.
    case, tests : the truth and its measurements.
    detectability : see `statorhom.conceal.detectability`.
    verdict : the right one.
    """
    content = {
        "schema": 1,
        "case": name,
        "verdict": verdict,
        "effects": [finding.as_json() for finding in case.findings],
        "materials": _materials(case),
        "modes": [mode for test in tests for mode in _modes(case, test)],
        "masses": _masses(case),
        "detectability": dict(detectability),
        "scatter": scatter_json(case.stages[0].scatter),
        "tables": {_name(case, t): _table(t) for t in tests if t.table is not None},
        "meshes": [{"test": _name(case, t), "dof": t.ritz.ground.mesh.full_dof} for t in tests],
    }
    return json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _name(case: Case, measured: Measured) -> str:
    return case.stages[measured.stage].tests[measured.test].name


def _materials(case: Case) -> dict[str, Any]:
    """By region; a region that changes has an entry per stage."""
    found: dict[str, Any] = {}
    for stage in case.stages:
        for region, material in stage.materials.items():
            entry = _material(material)
            if region == "overhang" and material == stage.materials["winding"]:
                continue
            is_new = region == "lamination" and region not in found
            key = region if is_new else f"{region} ({stage.keys.name})"
            if entry not in found.values():
                found[key] = entry
    return found


def _material(material: TrueMaterial) -> dict[str, Any]:
    return {
        "symmetry": material.symmetry,
        **material.constants,
        "density_kg_m3": material.density,
        "loss_factor": material.loss_factor,
    }


def _modes(case: Case, measured: Measured) -> list[dict[str, Any]]:
    return [
        {
            "test": _name(case, measured),
            "frequency_hz": round(mode.frequency_hz, 3),
            "order": mode.order,
            "axial": mode.axial,
            "kind": mode.kind,
            "loss_factor": round(mode.loss_factor, 5),
        }
        for mode in measured.modes
    ]


def _masses(case: Case) -> dict[str, Any]:
    wrong = {
        f.stage: f.parameters["value"]
        for f in case.findings
        if f.effect == "wrong_input" and f.parameters.get("input") == "mass_kg"
    }
    return {
        stage.keys.name: {
            "true_kg": stage.scale_kg,
            "scale_reading_kg": wrong.get(stage.keys.name, keys["mass_kg"]),
            "in_study_kg": keys["mass_kg"],
        }
        for stage, keys in zip(case.stages, case.study["stages"], strict=True)
    }


def _table(measured: Measured) -> dict[str, Any]:
    seen = resolved(measured.modes)
    names = {(mode.order, mode.axial) for mode in measured.listed}
    dropped = sorted({(m.order, m.axial) for m in seen} - names, key=str)
    return {"listed": len(measured.listed), "visible": len(seen), "dropped": [list(d) for d in dropped]}

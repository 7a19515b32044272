"""The sheets slide on each other, but the engineer believes in an isotropic stack."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding, TrueMaterial


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (
        Drawn("G_rz_pa", 62e9, 4e9, "log", is_strength=True),
        Drawn("E_z_share", 0.35, 0.7),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    own = place.true_stage.materials["lamination"]
    in_plane = own.constants.get("E_p_pa", own.constants.get("E_pa", own.constants.get("E_r_pa")))
    assert in_plane is not None
    shear = values["G_rz_pa"]
    constants = {
        "E_p_pa": in_plane,
        # sheets that slide are soft along z too
        "E_z_pa": min(values["E_z_share"] * in_plane, 6.0 * shear),
        "nu_p": float(rng.uniform(0.27, 0.30)),
        "nu_pz": float(rng.uniform(0.24, 0.28)),
        "G_rz_pa": shear,
    }
    soft = TrueMaterial("transversely_isotropic", constants, own.density, own.loss_factor)
    case = place.case
    for index, stage in enumerate(case.stages):
        case = case.with_stage(index, materials={**stage.materials, "lamination": soft})
        declared = case.study["stages"][index].get("model", {})
        if index == 0 or "lamination" in declared:
            case = case.with_stage_keys(index, model={**declared, "lamination": "isotropic"})
    parameters = {"G_rz_pa": shear, "E_z_pa": constants["E_z_pa"]}
    return case.with_finding(Finding("interlaminar_shear", place.true_stage.keys.name, parameters))


def _fits(place: Place) -> bool:
    return place.stage == next(i for i, s in enumerate(place.case.stages) if s.tests)


EFFECT = HiddenEffect("interlaminar_shear", _parameters, _apply, _fits)

"""True materials that are those which a study identified, instead of drawn ones."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from statorhom.conceal.truth import TrueMaterial
from statorhom.materials.symmetry import constant_names
from statorhom.results.files import read_results
from statorhom.results.schema import RegionResult

Known = Mapping[tuple[str, str], TrueMaterial]


def identified_materials(folder: Path) -> Known:
    """(stage, region) → material, of all regions that results.json knows completely.

    Raises
    ------
    ResultsError
        If it is missing or damaged.
    """
    found = {}
    for stage in read_results(folder).stages:
        for region, result in stage.regions.items():
            material = _material(result)
            if material is not None:
                found[stage.name, region] = material
    return found


def _material(result: RegionResult) -> TrueMaterial | None:
    if result.symmetry is None or result.density_kg_m3 is None or result.loss_factor is None:
        return None
    names = constant_names(result.symmetry)
    if not set(names) <= set(result.engineering):
        return None
    constants = {name: result.engineering[name].value for name in names}
    return TrueMaterial(result.symmetry, constants, result.density_kg_m3, result.loss_factor.value)

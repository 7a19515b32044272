"""Features of the weights: what is known of the densities of the regions that the tested steps add."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.stages.dimension_response import changed_geometry, step_of
from statorhom.diagnose.stages.masses import KNOWN, stage_densities
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.materials.density import REGION_OF_STEP
from statorhom.physics.action import Action


def density_features(
    study: StudyModel, values: Mapping[str, float], actions: Sequence[Action]
) -> list[Feature]:
    """One feature for every step that adds a region of which a density is usual.

    Parameters
    ----------
    study : the model.
    values : constants by name, weights among them.
    actions : of the effects; those that correct weights and dimensions change densities.

    Raises
    ------
    MassError
        If a step loses mass.
    """
    corrected: dict[str, float] = {}
    dimensions: dict[str, float] = {}
    for action in actions:
        corrected |= dict(action.masses)
        dimensions |= dict(action.dimensions)
    masses = study.masses(values, corrected)
    changed = changed_geometry(study, dimensions) if dimensions else None
    found = []
    for stage in study.stages:
        kind = stage.setup.keys.kind
        if kind not in KNOWN:
            continue
        region, (mean, sd) = REGION_OF_STEP[kind], KNOWN[kind]
        volumes = (
            study.volumes(stage.setup) if changed is None else step_of(study, stage, changed).exact_volumes()
        )
        density = stage_densities(study.files, masses, stage.setup.index, volumes)
        if region in density:
            found.append(Feature("density", "", None, density[region], mean, sd))
    return found

"""Materials that cover a stage's prior, for its reduced basis."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.special import ndtr, ndtri
from scipy.stats import qmc

from statorhom.errors import MaterialError
from statorhom.identify.parameters import ParameterSpace
from statorhom.identify.stage_basis import rounded_up
from statorhom.identify.stage_materials import StageMaterials
from statorhom.model.affine import Material, Materials

# densities are rounded up to powers of the step in these units: no border lies among those of steel
DENSITY_STEP, DENSITY_UNIT = 1.1, 1000.0
REACH = 2.5  # standard deviations of the prior to either side, per coordinate


def training_materials(space: ParameterSpace, materials: StageMaterials, count: int) -> list[Materials]:
    """The prior mean first, then low-discrepancy draws of the prior; impossible materials are left out.

    Draws, not a uniform cover of a box: most of a box in five dimensions is corners that nobody believes in, and
    a basis for them is twice as large. Densities are the same in all, rounded: a basis is right for every density, and
    machines that differ by their weights alone share one. They are rounded up: the heavier, the more modes lie in
    the band.

    Parameters
    ----------
    space : its prior, cut at `REACH`, and its limits.
    materials : how constants become materials.
    count : number of points to try, a power of two.
    """
    found = [_of_round_densities(materials.of(space.values(space.start)))]
    densities = {region: m.density for region, m in found[0].items()}
    if space.dimension == 0:
        return found
    unit = qmc.Sobol(space.dimension, seed=0).random(count)
    tail = ndtr(-REACH)
    normal = ndtri(tail + (1 - 2 * tail) * unit)
    points = space.prior_mean + normal @ np.linalg.cholesky(space.prior_covariance).T
    for point in space.bounds.clip(points):
        try:
            drawn = materials.of(space.values(point))
        except MaterialError:
            continue
        found.append(_with_densities(drawn, densities))
    return found


def _of_round_densities(materials: Materials) -> Materials:
    rounded = {
        region: DENSITY_UNIT * rounded_up(m.density / DENSITY_UNIT, DENSITY_STEP)
        for region, m in materials.items()
    }
    return _with_densities(materials, rounded)


def _with_densities(materials: Materials, densities: Mapping[str, float]) -> Materials:
    """The materials with other densities; regions that share a material share the new one."""
    made = {id(m): Material(m.hooke, densities[r]) for r, m in materials.items()}
    return {r: made[id(m)] for r, m in materials.items()}

"""Materials that cover a stage's prior, for its reduced basis."""

from __future__ import annotations

import numpy as np
from scipy.special import ndtr, ndtri
from scipy.stats import qmc

from statorhom.errors import MaterialError
from statorhom.identify.parameters import ParameterSpace
from statorhom.identify.stage_materials import StageMaterials
from statorhom.model.affine import Materials

REACH = 2.5  # standard deviations of the prior to either side, per coordinate


def training_materials(space: ParameterSpace, materials: StageMaterials, count: int) -> list[Materials]:
    """The prior mean first, then low-discrepancy draws of the prior; impossible materials are left out.

    Draws, not a uniform cover of a box: most of a box in five dimensions is corners that nobody believes in, and
    a basis for them is twice as large.

    Parameters
    ----------
    space : its prior, cut at `REACH`, and its limits.
    materials : how constants become materials.
    count : number of points to try, a power of two.
    """
    found = [materials.of(space.values(space.start))]
    if space.dimension == 0:
        return found
    unit = qmc.Sobol(space.dimension, seed=0).random(count)
    tail = ndtr(-REACH)
    normal = ndtri(tail + (1 - 2 * tail) * unit)
    points = space.prior_mean + normal @ np.linalg.cholesky(space.prior_covariance).T
    for point in space.bounds.clip(points):
        try:
            found.append(materials.of(space.values(point)))
        except MaterialError:
            continue
    return found

"""Materials that a stage's reduced basis is made for: those of its prior, or those around what a search found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from scipy.special import ndtr, ndtri
from scipy.stats import qmc

from statorhom.errors import MaterialError
from statorhom.identify.bases.stage_basis import rounded_up
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.residuals.stage_problem import StageProblem
from statorhom.identify.stages.stage_materials import StageMaterials
from statorhom.model.affine import Material, Materials

# densities are rounded up to powers of the step in these units: no border lies among those of steel
DENSITY_STEP, DENSITY_UNIT = 1.1, 1000.0
REACH = 2.5  # standard deviations of the prior to either side, per coordinate
# the same of what the search leaves open around an optimum, and by how much its frequencies may be wrong
NEAR, SEARCHED_SD = 1.5, 0.01


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
    points = space.prior_mean + _normal_draws(space.dimension, count, REACH) @ _root(space.prior_covariance)
    drawn = _possible(space, materials, points)
    return [*found, *(_with_densities(d, densities) for d in drawn)]


def neighbouring_materials(
    problem: StageProblem, optima: Sequence[np.ndarray], count: int
) -> list[Materials]:
    """What fits almost as well as one of the optima, the best optimum first: where a polish may still go.

    Drawn from the Laplace approximation of the problem with what the search's basis and mesh may be wrong by.

    Parameters
    ----------
    problem : its solver is good enough for derivatives.
    optima : (d,) each, the best first.
    count : number of draws around each, a power of two.
    """
    normal = _normal_draws(problem.space.dimension, count, NEAR)
    blurred = replace(problem, discrepancy=SEARCHED_SD)
    points = [np.asarray(optima)]
    for x in optima:
        jacobian = blurred.smooth_at(x).jacobian(x)
        points.append(x + normal @ _root(np.linalg.inv(jacobian.T @ jacobian)))
    return _possible(problem.space, problem.materials, np.vstack(points))


def _normal_draws(dimension: int, count: int, reach: float) -> np.ndarray:
    """Low-discrepancy draws of standard normal coordinates, cut at ±`reach`: (count, dimension)."""
    unit = qmc.Sobol(dimension, seed=0).random(count) if dimension else np.empty((count, 0))
    tail = ndtr(-reach)
    return np.asarray(ndtri(tail + (1 - 2 * tail) * unit))


def _root(covariance: np.ndarray) -> np.ndarray:
    """R with RᵀR = covariance."""
    return np.asarray(np.linalg.cholesky(covariance).T)


def _possible(space: ParameterSpace, materials: StageMaterials, points: np.ndarray) -> list[Materials]:
    found = []
    for point in space.bounds.clip(points):
        try:
            found.append(materials.of(space.values(point)))
        except MaterialError:
            continue
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

"""Search by response surface: design, surfaces, gate, NSGA-II, and the starts of the polish that follow from them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.inference.optima import distinct_optima
from statorhom.identify.inference.polish import polish
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.residuals.model_error import ModelError
from statorhom.identify.surface.design import DESIGNS, Design, latin_hypercube
from statorhom.identify.surface.experiments import Experiments
from statorhom.identify.surface.gate import Gated, check_smallest, gated_surfaces
from statorhom.identify.surface.gaussian_process import fit_gaussian_process
from statorhom.identify.surface.mode_surfaces import FitSurface, ModeSurfaces
from statorhom.identify.surface.nsga2 import ParetoFront, pareto_front
from statorhom.identify.surface.polynomial import coefficient_count, fit_polynomial
from statorhom.identify.surface.surface_problem import SurfaceProblem
from statorhom.model.convergence import ModeKey
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.response_surface import SurfaceKeys

JUDGED = 5  # points of the design that come nearest to the measurement and say which mode is which
MOST_PAIRINGS = 3
STARTS = 4  # points of a front that are polished, and optima that are followed up
HOPELESS = 16.0  # squared distance of an optimum to the best one; the surfaces are as coarse as a search is
NO_ERROR = ModelError()

Keys = tuple[ModeKey | None, ...]


@dataclass(frozen=True, eq=False)
class SurfaceSearch:
    """What the search found.

    Parameters
    ----------
    problem : on the surfaces, in the space of the search.
    gate : surfaces and their trials.
    front : of the pairing that fits best.
    names : modes that the front's objectives are about, None for a measured mode without a partner.
    optima : coordinates (d,) in the space of the search, the best first.
    solves : of the full model.
    evaluations : of the surfaces by NSGA-II.
    """

    problem: SurfaceProblem
    gate: Gated
    front: ParetoFront
    names: Keys
    optima: tuple[Array, ...]
    solves: int
    evaluations: int

    def problem_over(self, space: ParameterSpace) -> SurfaceProblem:
        """The problem on the surfaces in a space with more coordinates, which they do not feel."""
        return replace(self.problem, space=space)

    def starts(self, space: ParameterSpace) -> list[Array]:
        """The optima in such a space."""
        return [space.internal(self.problem.space.values(x)) for x in self.optima]

    @property
    def at_limits(self) -> tuple[str, ...]:
        """Constants that the front's best point has at the end of their range: a prior would draw them inwards."""
        best = int(np.argmin(np.sum(self.front.objectives**2, axis=1)))
        return self.problem.surfaces.cube.on_face(self.front.points[best])


def search_surface(
    experiments: Experiments,
    measured: Sequence[MeasuredMode],
    keys: SurfaceKeys,
    *,
    evaluations: int,
    seed: int,
    error: ModelError = NO_ERROR,
) -> SurfaceSearch:
    """Search the box of an experiment's cube.

    Parameters
    ----------
    experiments : the full model over the cube.
    measured : modes to meet.
    keys : of the study.
    evaluations : of the surfaces.
    seed : of design and NSGA-II.
    error : what declared effects do to the modes.

    Raises
    ------
    IdentificationError
        If no constants are free, or a design cannot determine its surface.
    MissingDependencyError
        If a library of the extra `surface` is not installed.
    """
    if experiments.cube.dimension == 0:
        raise IdentificationError("response surface: all constants are fixed; there is nothing to search")
    gate = gated_surfaces(
        experiments,
        _design(keys),
        _fit(keys, seed),
        lambda surfaces, points: _wanted(_problem(surfaces, experiments, measured, error), points),
        limit=keys.largest_error_percent / 100.0,
        most_points=keys.most_points,
        least_points=_least_points(keys, experiments.cube.dimension),
        seed=seed,
    )
    problem = _problem(gate.surfaces, experiments, measured, error)
    pairings = _pairings(problem, list(gate.points))
    share = evaluations // len(pairings)
    fronts = [
        pareto_front(
            partial(problem.objectives, keys=pairing),
            experiments.cube.dimension,
            len(measured),
            evaluations=share,
            seed=seed,
        )
        for pairing in pairings
    ]
    starts = [experiments.cube.internal(p) for front in fronts for p in _best_of(front)]
    coarse = problem.coarse()
    optima = distinct_optima([polish(coarse, x) for x in starts])
    hopeful = tuple(o.x for o in optima[:STARTS] if o.value < optima[0].value + HOPELESS)
    best = int(np.argmin([min(np.sum(front.objectives**2, axis=1)) for front in fronts]))
    spent = sum(front.evaluations for front in fronts)
    return SurfaceSearch(problem, gate, fronts[best], pairings[best], hopeful, experiments.solves, spent)


def check_points(keys: SurfaceKeys, dimension: int) -> None:
    """Refuse a smallest design with fewer points than the surface has coefficients.

    Raises
    ------
    IdentificationError
        With both numbers.
    """
    check_smallest(_design(keys), dimension, keys.most_points, _least_points(keys, dimension))


def _design(keys: SurfaceKeys) -> Design:
    return partial(latin_hypercube, first=keys.points) if keys.points else DESIGNS[keys.design]


def _fit(keys: SurfaceKeys, seed: int) -> FitSurface:
    if keys.surface == "gaussian_process":
        return partial(fit_gaussian_process, seed=seed)
    return partial(fit_polynomial, degree=keys.degree)


def _least_points(keys: SurfaceKeys, dimension: int) -> int:
    """Number of coefficients that the design must determine."""
    plane = 1 if keys.surface == "gaussian_process" else keys.degree or 1
    return coefficient_count(dimension, plane)


def _problem(
    surfaces: ModeSurfaces, experiments: Experiments, measured: Sequence[MeasuredMode], error: ModelError
) -> SurfaceProblem:
    return SurfaceProblem(
        experiments.cube.space,
        experiments.materials,
        surfaces,  # type: ignore[arg-type]
        tuple(measured),
        error,
        surfaces=surfaces,
    )


def _wanted(problem: SurfaceProblem, points: Sequence[Array]) -> frozenset[ModeKey]:
    return frozenset(key for pairing in _pairings(problem, points) for key in pairing if key is not None)


def _pairings(problem: SurfaceProblem, points: Sequence[Array]) -> list[Keys]:
    """Which mode is which at the points that come nearest to the measurement; those that differ, the nearest first."""
    coarse = problem.coarse()
    cube = problem.surfaces.cube
    internal = [cube.internal(point) for point in points]
    order = np.argsort([coarse(x) for x in internal], kind="stable")
    found = dict.fromkeys(problem.pairing(problem.simulated(internal[i])) for i in order[:JUDGED])
    return list(found)[:MOST_PAIRINGS]


def _best_of(front: ParetoFront) -> Array:
    """The points with the least sum of squares, and the best one of every objective."""
    total = np.argsort(np.sum(front.objectives**2, axis=1), kind="stable")[:STARTS]
    single = np.argmin(front.objectives, axis=0)
    return front.points[list(dict.fromkeys([*total.tolist(), *single.tolist()]))[: 2 * STARTS]]

"""The gate: surfaces must predict points that they were not fitted to, else the design is enlarged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.surface.design import MOST_POINTS, Design, latin_hypercube_of
from statorhom.identify.surface.experiments import Experiments, Solved
from statorhom.identify.surface.mode_surfaces import FitSurface, ModeSurfaces, fit_surfaces
from statorhom.model.convergence import ModeKey

CHECK_SEED = 7919  # of the points that no surface is fitted to
CHECKS_PER_COORDINATE, LEAST_CHECKS = 5, 8

Wanted = Callable[[ModeSurfaces, Sequence[Array]], frozenset[ModeKey]]
"""Names of the modes that must be predicted, judged at the points of the design."""


@dataclass(frozen=True)
class GateRound:
    """One design and how well its surfaces predict.

    Parameters
    ----------
    points : of the design.
    errors : mode → largest relative error at the check points.
    """

    points: int
    errors: dict[ModeKey, float]

    @property
    def largest(self) -> float:
        """Over all modes that must be predicted."""
        return max(self.errors.values(), default=float("inf"))


@dataclass(frozen=True)
class Gated:
    """Surfaces with their trials.

    Parameters
    ----------
    surfaces : the last ones.
    rounds : designs in the order of their size; the last one passed, or no more points were allowed.
    checks : points that no surface was fitted to.
    passed : whether the last one met the limit.
    points, solved : the last design.
    """

    surfaces: ModeSurfaces
    rounds: tuple[GateRound, ...]
    checks: int
    passed: bool
    points: Array
    solved: list[Solved | None]


def gated_surfaces(
    experiments: Experiments,
    design: Design,
    fit: FitSurface,
    wanted: Wanted,
    *,
    limit: float,
    most_points: int,
    least_points: int,
    seed: int,
) -> Gated:
    """Enlarge the design until its surfaces predict.

    Parameters
    ----------
    experiments : solves the full model.
    design, fit : how points are placed, and what is fitted to them.
    wanted : modes that must be predicted.
    limit : largest relative error allowed.
    most_points : no design may have more.
    least_points : no design may have fewer: the surface has as many coefficients.
    seed : of random designs.

    Raises
    ------
    IdentificationError
        If the smallest design is too large already, or has fewer points than the surface has coefficients.
    """
    dimension = experiments.cube.dimension
    check_smallest(design, dimension, most_points, least_points, seed)
    count = max(LEAST_CHECKS, CHECKS_PER_COORDINATE * dimension)
    checks = latin_hypercube_of(dimension, count, seed + CHECK_SEED)
    known = experiments.at(checks)
    rounds: list[GateRound] = []
    found: Gated | None = None
    for size in range(16):
        points = _points(design, dimension, size, seed, most_points)
        if points is None:
            break
        solved = experiments.at(points)
        surfaces = fit_surfaces(experiments.cube, points, solved, fit)
        errors = surfaces.largest_errors(checks, known)
        needed = wanted(surfaces, list(points))
        rounds.append(GateRound(len(points), {key: errors[key] for key in surfaces.keys if key in needed}))
        passed = rounds[-1].largest <= limit
        found = Gated(surfaces, tuple(rounds), sum(k is not None for k in known), passed, points, solved)
        if passed:
            break
    if found is None:
        raise IdentificationError(
            f"response surface: the smallest design of {dimension} constants has over {most_points} points; fix or "
            "tie constants, choose another design or raise most_points"
        )
    return found


def check_smallest(design: Design, dimension: int, most: int, least: int, seed: int = 0) -> None:
    """Refuse a design whose first points are fewer than the surface's coefficients.

    Raises
    ------
    IdentificationError
        With both numbers.
    """
    points = _points(design, dimension, 0, seed, most)
    if points is not None and len(points) < least:
        raise IdentificationError(
            f"response surface: a design of {len(points)} points cannot determine a surface of {least} coefficients; "
            "raise points, choose another design or lower degree"
        )


def _points(design: Design, dimension: int, size: int, seed: int, most: int) -> Array | None:
    try:
        points = design(dimension, size, seed)
    except IdentificationError:
        return None
    return points if len(points) <= min(most, MOST_POINTS) else None

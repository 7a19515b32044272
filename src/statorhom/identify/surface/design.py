"""Designs of experiments: points of the cube [−1, 1]^d at which the full model is solved.

Every design has sizes 0, 1, 2, … so that it can be enlarged; those of the full factorial and of the sparse grid are
nested, so that what was solved is not solved again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from scipy.stats import qmc

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.surface.optional import optional

MOST_POINTS = 4096  # of one design: beyond, nobody waits for the solves
MOST_SPREAD = 64  # points that are spread more evenly than chance does
DIGITS = 12  # of a point that are kept, so that nested designs share theirs exactly

Design = Callable[[int, int, int], Array]
"""Takes dimension, size and seed; returns (n, d)."""


def full_factorial(dimension: int, size: int, seed: int = 0) -> Array:  # noqa: ARG001
    """All combinations of 2^(size+1) + 1 equidistant levels per coordinate: 3, 5, 9, …"""
    levels = 2 ** (size + 1) + 1
    _check_count(levels**dimension, "full factorial")
    axis = np.linspace(-1.0, 1.0, levels)
    grid = np.meshgrid(*[axis] * dimension, indexing="ij")
    return np.stack([g.ravel() for g in grid], axis=1)


def latin_hypercube(dimension: int, size: int, seed: int = 0, first: int | None = None) -> Array:
    """`latin_hypercube_of` with `first` points, twice as many at every size.

    Without it, half as many again as a cubic polynomial has coefficients.
    """
    cubic = (dimension + 1) * (dimension + 2) * (dimension + 3) // 6
    count = ((3 * cubic + 1) // 2 if first is None else first) * 2**size
    _check_count(count, "latin hypercube")
    return latin_hypercube_of(dimension, count, seed + size)


def latin_hypercube_of(dimension: int, count: int, seed: int) -> Array:
    """As many points, one in every layer of every coordinate (McKay, Beckman and Conover, Technometrics 21, 1979)."""
    # exchanging entries until the points are spread evenly takes longer the more there are, and gains less
    spread = "random-cd" if count <= MOST_SPREAD else None
    sampler = qmc.LatinHypercube(dimension, seed=np.random.default_rng(seed), optimization=spread)
    return np.asarray(2.0 * sampler.random(count) - 1.0)


def sparse_grid(dimension: int, size: int, seed: int = 0) -> Array:  # noqa: ARG001
    """Smolyak's grid of nested Clenshaw-Curtis rules (S. A. Smolyak, 1963), by chaospy; level 2 + size.

    Raises
    ------
    MissingDependencyError
        If chaospy is not installed.
    """
    chaospy = optional("chaospy", "chaospy", "a sparse grid")
    box = chaospy.J(*[chaospy.Uniform(-1.0, 1.0) for _ in range(dimension)])
    nodes, _ = chaospy.generate_quadrature(2 + size, box, rule="clenshaw_curtis", sparse=True, growth=True)
    points = np.unique(np.round(np.atleast_2d(nodes).T, DIGITS), axis=0)
    _check_count(len(points), "sparse grid")
    return points


DESIGNS: Mapping[str, Design] = MappingProxyType(
    {"full_factorial": full_factorial, "latin_hypercube": latin_hypercube, "sparse_grid": sparse_grid}
)


def _check_count(count: int, name: str) -> None:
    if count > MOST_POINTS:
        raise IdentificationError(
            f"{name}: {count} points are more than {MOST_POINTS}; fix or tie constants, or choose another design"
        )

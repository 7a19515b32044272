"""Response surfaces by Gaussian processes (kriging) about a plane, by scikit-learn."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

from statorhom.identify.parameters.bounds import Array
from statorhom.identify.surface.optional import optional
from statorhom.identify.surface.polynomial import PolynomialSurface, fit_polynomial

SCALES = (0.2, 50.0)  # of correlation lengths; the cube's edge is 2
RESTARTS = 2
NUGGET = 1e-10  # solves are exact but for the eigensolver's tolerance


@dataclass(frozen=True, eq=False)
class GaussianProcessSurface:
    """Several responses over the cube: a plane, and a process that interpolates what it leaves.

    Parameters
    ----------
    plane : polynomial of degree 1.
    process : fitted regressor of the remainders, one kernel for all responses.
    count : of points.
    """

    plane: PolynomialSurface
    process: Any
    count: int

    def __call__(self, points: Array) -> Array:
        """Responses (n, m) at points (n, d)."""
        points = np.atleast_2d(points)
        plane = self.plane(points)
        return plane + np.asarray(self.process.predict(points)).reshape(plane.shape)

    @property
    def description(self) -> str:
        """What it is, for the report."""
        return f"Gaussian process on {self.count} points"


def fit_gaussian_process(points: Array, responses: Array, seed: int = 0) -> GaussianProcessSurface:
    """Maximum likelihood of one length per coordinate and one amplitude (Rasmussen and Williams 2006).

    Parameters
    ----------
    points : (n, d) in [−1, 1]^d, at least d + 1.
    responses : (n, m).
    seed : of the restarts.

    Raises
    ------
    MissingDependencyError
        If scikit-learn is not installed.
    IdentificationError
        If there are fewer points than a plane has coefficients.
    """
    gaussian = optional("sklearn.gaussian_process", "scikit-learn", "a Gaussian process")
    exceptions = optional("sklearn.exceptions", "scikit-learn", "a Gaussian process")
    plane = fit_polynomial(points, responses, 1)
    rest = responses - plane(points)
    kernels = gaussian.kernels
    kernel = kernels.ConstantKernel(1.0, (1e-4, 1e4)) * kernels.RBF(np.ones(points.shape[1]), SCALES)
    process = gaussian.GaussianProcessRegressor(
        kernel, alpha=NUGGET, n_restarts_optimizer=RESTARTS, normalize_y=True, random_state=seed
    )
    with warnings.catch_warnings():
        # a length at the end of its range says that the response is straight along this coordinate
        warnings.simplefilter("ignore", exceptions.ConvergenceWarning)
        process.fit(points, rest)
    return GaussianProcessSurface(plane, process, len(points))

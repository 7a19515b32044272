"""Joint Gaussian prior of several coordinates: what an earlier step has learnt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array, read_only


@dataclass(frozen=True, eq=False)
class PriorBlock:
    """Mean and covariance, in internal coordinates, that replace the standard normal prior.

    Parameters
    ----------
    names : tuple of str
        Constants whose coordinates the block describes (leaders of ties, none of them fixed).
    mean : array, shape (k,)
    covariance : array, shape (k, k)

    Raises
    ------
    IdentificationError
        Where the covariance is not symmetric and positive definite, or shapes disagree.
    """

    names: tuple[str, ...]
    mean: Array
    covariance: Array

    def __post_init__(self) -> None:
        count = len(self.names)
        object.__setattr__(self, "mean", read_only(self.mean))
        object.__setattr__(self, "covariance", read_only(self.covariance))
        if self.mean.shape != (count,) or self.covariance.shape != (count, count):
            raise IdentificationError(
                f"prior block of {', '.join(self.names)}: give {count} means and a {count} x {count} matrix"
            )
        if not _is_covariance(self.covariance):
            raise IdentificationError(
                f"prior block of {', '.join(self.names)}: the covariance is not symmetric positive definite; "
                "drop constants that repeat each other"
            )


def _is_covariance(matrix: Array) -> bool:
    if not np.all(np.isfinite(matrix)) or not np.allclose(matrix, matrix.T, rtol=1e-8, atol=0.0):
        return False
    try:
        np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        return False
    return True

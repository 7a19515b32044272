"""What is minimized: residuals of the data and of the prior, as a vector and as a number."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from statorhom.identify.inference.finite_differences import jacobian
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.parameters.parameter_space import ParameterSpace


class Problem(ABC):
    """A least-squares problem in internal coordinates; objects must be picklable.

    The value of a point is ‖data residuals‖² + ‖prior residuals‖² = −2 ln posterior, up to a
    constant, when every residual is divided by its standard deviation.
    """

    space: ParameterSpace

    @abstractmethod
    def data_residuals(self, x: Array) -> Array:
        """Return the weighted residuals at `x`, always of the same length.

        At points where the model does not exist return non-finite numbers: they are never accepted.
        """

    def data_jacobian(self, x: Array) -> Array:
        """Return the derivative of `data_residuals`; central differences unless overridden."""
        return jacobian(self.data_residuals, x, self.space.bounds)

    def smooth_at(self, x: Array) -> Problem:  # noqa: ARG002
        """Return the smooth problem that coincides with this one around `x`.

        Override it where discrete choices (which mode is which) hide in the residuals: the result
        holds them as they are at `x`. The polish differentiates this problem only.
        """
        return self

    @property
    def log_normalization(self) -> float:
        """−Σ ln(σ √(2π)) of the data: matters only between models with other data or other σ."""
        return 0.0

    def residuals(self, x: Array) -> Array:
        """Return data and prior residuals in one vector."""
        return np.concatenate([self.data_residuals(x), self.space.prior_residuals(x)])

    def jacobian(self, x: Array) -> Array:
        """Return the derivative of `residuals`."""
        return np.vstack([self.data_jacobian(x), self.space.prior_jacobian])

    def __call__(self, x: Array) -> float:
        """Return the value to be minimized, infinite where the model does not exist."""
        residuals = self.residuals(x)
        value = float(residuals @ residuals)
        return value if np.isfinite(value) else float("inf")


@dataclass(frozen=True, eq=False)
class FunctionProblem(Problem):
    """A problem made of plain functions.

    Parameters
    ----------
    space : ParameterSpace
    function : callable
        Weighted data residuals at x.
    derivative : callable or None
        Their derivative at x, shape (number of residuals, d).
    """

    space: ParameterSpace
    function: Callable[[Array], Array]
    derivative: Callable[[Array], Array] | None = None

    def data_residuals(self, x: Array) -> Array:
        """Return the function's residuals at `x`."""
        return self.function(x)

    def data_jacobian(self, x: Array) -> Array:
        """Return the given derivative, or central differences."""
        return super().data_jacobian(x) if self.derivative is None else self.derivative(x)

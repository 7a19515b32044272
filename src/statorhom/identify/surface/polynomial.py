"""Polynomial response surfaces by least squares."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.polynomial.legendre import legvander

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array, read_only

HIGHEST_DEGREE = 6
CROWDED = 0.8  # coefficients per point beyond which leaving one out says nothing


@dataclass(frozen=True, eq=False)
class PolynomialSurface:
    """Several responses over the cube [−1, 1]^d, in products of Legendre polynomials.

    Parameters
    ----------
    exponents : (c, d) degree of every factor of every term.
    coefficients : (c, m) of the m responses.
    degree : of the whole.
    """

    exponents: np.ndarray
    coefficients: Array
    degree: int

    def __call__(self, points: Array) -> Array:
        """Responses (n, m) at points (n, d)."""
        return _terms(self.exponents, np.atleast_2d(points)) @ self.coefficients

    @property
    def description(self) -> str:
        """What it is, for the report."""
        return f"polynomial of degree {self.degree}, {len(self.exponents)} coefficients"


def fit_polynomial(points: Array, responses: Array, degree: int | None = None) -> PolynomialSurface:
    """Least squares of a polynomial of full degree.

    Parameters
    ----------
    points : (n, d) in [−1, 1]^d.
    responses : (n, m).
    degree : of the polynomial; None for the one that best predicts each point from the others.

    Raises
    ------
    IdentificationError
        If there are fewer points than coefficients.
    """
    if degree is not None:
        return _fitted(points, responses, degree)
    count, dimension = points.shape
    allowed = [p for p in range(1, HIGHEST_DEGREE + 1) if coefficient_count(dimension, p) <= CROWDED * count]
    if not allowed:
        return _fitted(points, responses, 1)
    return _fitted(points, responses, min(allowed, key=lambda p: _left_out_error(points, responses, p)))


def coefficient_count(dimension: int, degree: int) -> int:
    """Number of terms of full degree, (d + p)! / (d! p!)."""
    return len(_exponents(dimension, degree))


def _fitted(points: Array, responses: Array, degree: int) -> PolynomialSurface:
    exponents = _exponents(points.shape[1], degree)
    if len(points) < len(exponents):
        raise IdentificationError(
            f"response surface: a design of {len(points)} points cannot determine the {len(exponents)} coefficients "
            f"of a polynomial of degree {degree}; enlarge the design or lower the degree"
        )
    terms = _terms(exponents, points)
    coefficients, _, rank, _ = np.linalg.lstsq(terms, responses, rcond=None)
    if rank < len(exponents):
        raise IdentificationError(
            f"response surface: the design's {len(points)} points lie so that only {rank} of the {len(exponents)} "
            f"coefficients of a polynomial of degree {degree} are determined; enlarge the design or lower the degree"
        )
    return PolynomialSurface(exponents, read_only(coefficients), degree)


def _left_out_error(points: Array, responses: Array, degree: int) -> float:
    """Root mean square error at each point from the others: the residual over 1 − its leverage (Allen 1974)."""
    terms = _terms(_exponents(points.shape[1], degree), points)
    q, r = np.linalg.qr(terms)
    if np.abs(np.diag(r)).min() < 1e-9 * np.abs(np.diag(r)).max():
        return np.inf  # levels too few for this degree
    residuals = responses - q @ (q.T @ responses)
    free = 1.0 - np.einsum("ij,ij->i", q, q)
    if free.min() < 1e-9:
        return np.inf
    return float(np.sqrt(np.mean((residuals / free[:, None]) ** 2)))


def _exponents(dimension: int, degree: int) -> np.ndarray:
    found = []
    for total in range(degree + 1):
        for chosen in combinations_with_replacement(range(dimension), total):
            found.append([chosen.count(k) for k in range(dimension)])
    return np.array(found, dtype=int).reshape(-1, dimension)


def _terms(exponents: np.ndarray, points: Array) -> Array:
    legendre = legvander(points, int(exponents.max(initial=0)))  # (n, d, degree + 1)
    coordinates = np.arange(points.shape[1])
    return np.asarray(np.prod(legendre[:, coordinates, exponents], axis=2))

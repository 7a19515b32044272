"""A field over a plan form as products of Legendre polynomials along the span and across the chord."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from numpy.polynomial import legendre

from statorhom.modes.plan_form.frame import PlanForm

FloatArray = npt.NDArray[np.float64]

_MOST_ALONG, _MOST_ACROSS = 10, 6  # highest degrees
_FILLED = 0.6  # terms per point at most
_SAME = 0.02  # positions closer than this part of the half span are one station
_RCOND = 1e-3
_FINE = np.linspace(-1.0, 1.0, 401)
_CLEAR = 0.1  # of its largest value: what a function must reach on both sides of a node


@dataclass(frozen=True)
class WaveFunction:
    """One factor of a product, −1 … 1.

    Attributes
    ----------
    coefficients : array
        Of Legendre polynomials.
    """

    coefficients: FloatArray

    @property
    def nodes(self) -> int:
        """Sign changes from end to end; those within the noise do not count."""
        values = legendre.legval(_FINE, self.coefficients)
        clear = values[np.abs(values) > _CLEAR * np.abs(values).max()]
        return int(np.count_nonzero(np.diff(np.sign(clear))))

    @property
    def even_share(self) -> float:
        """Part of the power that is symmetric about the middle, 0 … 1."""
        powers = self.coefficients**2 / (2 * np.arange(len(self.coefficients)) + 1)
        return float(powers[::2].sum() / powers.sum())


@dataclass(frozen=True)
class FieldWaves:
    """The strongest product f(span) · g(chord) in a field over the plan form.

    Attributes
    ----------
    along, across : WaveFunction
        f and g.
    share : float
        Part of the expansion's mean square that the product has, 0 … 1.
    explained : float
        Part of the field's mean square that the expansion is expected to give at further points, at most 1.
    resolved : bool
        Whether the points tell as many nodes as there are.
    """

    along: WaveFunction
    across: WaveFunction
    share: float
    explained: float
    resolved: bool


def field_waves(form: PlanForm, values: FloatArray) -> FieldWaves:
    """Least-squares expansion of a real field, shape (points,), as far as the points can tell it.

    A bending shape is f(span), a torsional one f(span) · chord; the products come from the singular values of the
    orthonormal expansion's table of coefficients.
    """
    stations = _stations(form.along), 1 if form.is_line else _stations(form.across)
    coefficients, norms, misfit = min(_expansions(form, values, stations), key=lambda one: one[2])
    left, singular, right = np.linalg.svd(coefficients)
    found = WaveFunction(left[:, 0] * norms[:, 0]), WaveFunction(right[0] * norms[0])
    return FieldWaves(
        *found,
        float(singular[0] ** 2 / np.sum(singular**2)),
        1 - misfit / max(float(np.mean(values**2)), np.finfo(float).tiny),
        all(one.nodes < max(count - 1, 1) for one, count in zip(found, stations, strict=True)),
    )


def _expansions(
    form: PlanForm, values: FloatArray, stations: tuple[int, int]
) -> Iterator[tuple[FloatArray, FloatArray, float]]:
    """Coefficients (along, across), norms of the polynomials, and the mean square to be expected at further points.

    Generalized cross-validation (Golub, Heath & Wahba 1979) charges an expansion for its terms, so noise between
    the points does not choose the degrees.
    """
    for along in range(min(_MOST_ALONG, stations[0] - 1) + 1):
        for across in range(min(_MOST_ACROSS, stations[1] - 1) + 1):
            terms = (along + 1) * (across + 1)
            if terms > max(_FILLED * len(values), 2):
                continue
            norms: FloatArray = np.sqrt(np.outer(2 * np.arange(along + 1) + 1, 2 * np.arange(across + 1) + 1))
            columns = legendre.legvander2d(form.along, form.across, (along, across)) * norms.ravel()
            found = np.asarray(np.linalg.lstsq(columns, values, rcond=_RCOND)[0], dtype=np.float64)
            left = float(np.mean((values - columns @ found) ** 2))
            expected = left / (1 - terms / (len(values) + 1)) ** 2
            yield found.reshape(along + 1, across + 1), norms, expected


def _stations(positions: FloatArray) -> int:
    """Different positions, those that scatter less than the tolerance taken as one."""
    ordered = np.sort(positions)
    count, last = 1, ordered[0]
    for position in ordered[1:]:
        if position - last > _SAME:
            count, last = count + 1, position
    return count

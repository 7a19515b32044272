"""Modes of a window of lines, and the linear least squares over shapes and residual terms at given poles.

Model of the receptance between point k and reference j, with structural damping (equation [7] of the
stator's paper without its misprints): Σ_m φ_mk L_mj / (s_m(1 + δ_mg)² − ω²) + residual terms of every
reference, s_m = ω_m²(1 + iη_m), with the shift δ of set-up g, which is a point or a reference.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

RANK = 1e-12
"""Eigenvalues of scaled normal matrices below this are zero."""

_SAFE_PIVOT = 1e-8
_MANY_POINTS = (
    16  # from which on products of all pairs of columns are cheaper than weighted columns per point
)


@dataclass(frozen=True)
class Window:
    """Data of a window: receptances of all points, references and lines, scaled.

    Attributes
    ----------
    squared : array, shape (lines · bin,)
        ω² over `unit`.
    values, weights : arrays, shape (points, references, lines)
        Receptances, means over bins of neighbouring lines, and their inverse variances; weight 0 where
        nothing was measured. The model is averaged over the same lines, so that bins cost no accuracy.
    unit : float
        (rad/s)² of one unit of `squared`.
    terms : int
        Residual terms of each reference: 1/ω², 1, ω² (in this order of need).
    quiet : bool
        Whether the noise is so low that not it but the linear model limits what is explained.
    """

    squared: FloatArray
    values: ComplexArray
    weights: FloatArray
    unit: float
    terms: int = 3
    quiet: bool = False

    @property
    def bin(self) -> int:
        """Lines of a bin."""
        return len(self.squared) // self.values.shape[-1]

    @property
    def omega(self) -> FloatArray:
        """Angular frequencies over the root of `unit`, ascending."""
        root: FloatArray = np.sqrt(self.squared)
        return root

    def binned(self, curves: ComplexArray) -> ComplexArray:
        """Curves over `squared`, averaged over the bins."""
        if self.bin == 1:
            return curves
        # a product: NumPy's mean of so few lines at a time takes six times as long
        lines = curves.reshape(*curves.shape[:-1], self.values.shape[-1], self.bin)
        mean: ComplexArray = lines @ np.full(self.bin, 1.0 / self.bin)
        return mean


@dataclass(frozen=True)
class Modes:
    """Poles and participations, in a window's units.

    Attributes
    ----------
    poles : complex array, shape (modes,)
    parts : complex array, shape (modes, references)
        Participations, the largest component of each equal to 1.
    shift : complex array, shape (points or 1, modes, references or 1)
        Relative shift of every pole from set-up to set-up, its imaginary part that of the damping; zero for
        poles that all FRFs share.
    """

    poles: ComplexArray
    parts: ComplexArray
    shift: ComplexArray

    def __len__(self) -> int:
        return len(self.poles)

    @property
    def loss_factors(self) -> FloatArray:
        """Half-power bandwidths over the frequencies, shape (modes,)."""
        loss: FloatArray = self.poles.imag / self.poles.real
        return loss

    @property
    def moving(self) -> npt.NDArray[np.bool_]:
        """Modes whose poles differ from set-up to set-up, shape (modes,)."""
        moving: npt.NDArray[np.bool_] = np.any(self.shift != 0, axis=(0, 2))
        return moving

    def of(self, chosen: npt.ArrayLike) -> Modes:
        """Some of the modes, by number or mask."""
        rows = np.asarray(chosen)
        rows = rows if rows.dtype == bool else rows.astype(int)
        return Modes(self.poles[rows], self.parts[rows], self.shift[:, rows])

    def without(self, index: int) -> Modes:
        return self.of(np.delete(np.arange(len(self)), index))

    def joined(self, other: Modes) -> Modes:
        """These modes and further ones."""
        shape = np.broadcast_shapes(self.shift[:, :1].shape, other.shift[:, :1].shape)
        shifts = [np.broadcast_to(one.shift, (shape[0], len(one), shape[2])) for one in (self, other)]
        return Modes(
            np.concatenate([self.poles, other.poles]),
            np.concatenate([self.parts, other.parts]),
            np.concatenate(shifts, axis=1),
        )


def steady_modes(poles: ComplexArray, parts: ComplexArray) -> Modes:
    """Modes whose poles all FRFs share; participations are scaled."""
    scaled = np.array([unit_part(part) for part in parts], dtype=complex).reshape(len(poles), parts.shape[-1])
    return Modes(np.asarray(poles, dtype=complex), scaled, np.zeros((1, len(poles), 1), dtype=complex))


@dataclass(frozen=True)
class Linear:
    """Eliminated unknowns at given poles and what the fit needs of them.

    Attributes
    ----------
    chi2 : array, shape (points,)
        Σ |residual|²/variance.
    coefficients : complex array, shape (points, columns)
        Of the columns (modes, neighbours, residual terms), which were scaled to unit norm.
    inverse : complex array, shape (points, columns, columns)
        Their covariance.
    norms : array, shape (points, columns)
    correlation : float
        Integrated autocorrelation of the weighted residuals along the lines, at least 1: about 1 for noise,
        more where the model misses something smooth.
    """

    chi2: FloatArray
    coefficients: ComplexArray
    inverse: ComplexArray
    norms: FloatArray
    correlation: float = 1.0

    @property
    def unscaled(self) -> ComplexArray:
        """Coefficients of the columns as they are, shape (points, columns): of modes, their shapes."""
        return self.coefficients / self.norms


def unit_part(part: ComplexArray) -> ComplexArray:
    """Participation scaled to 1 at its largest component."""
    scaled: ComplexArray = part / part[np.argmax(np.abs(part))]
    return scaled


def columns(window: Window, modes: Modes, neighbours: Modes | None) -> ComplexArray:
    """Columns of the linear problem, shape (1 or points, columns, references, lines)."""
    x = window.squared
    references = window.values.shape[1]
    every = [modal_columns(window, modes)]
    if neighbours is not None and len(neighbours):
        every.append(modal_columns(window, neighbours))
    middle = float(x[len(x) // 2])
    span = float(x[-1] - x[0])
    rows = [np.ones_like(x), middle / x, (x - middle) / span][: window.terms]
    residual = np.zeros((1, references * window.terms, references, window.values.shape[-1]), dtype=complex)
    for j in range(references):
        residual[0, j * window.terms : (j + 1) * window.terms, j] = window.binned(
            np.array(rows, dtype=complex)
        )
    every.append(residual)
    points = max(len(part) for part in every)
    return np.concatenate([np.broadcast_to(p, (points, *p.shape[1:])) for p in every], axis=1)


def modal_columns(window: Window, modes: Modes, power: int = 1) -> ComplexArray:
    """L/(s − ω²)^power of every mode, shape (1 or points, modes, references, lines)."""
    poles = modes.poles[None, :, None]
    if modes.moving.any():
        poles = poles * (1 + modes.shift) ** 2
    # a reciprocal's power is several times cheaper than a negative power
    reciprocal = (poles[..., None] - window.squared) ** -1
    curve = window.binned(reciprocal**power)
    result: ComplexArray = modes.parts[None, :, :, None] * curve
    return result


def weighted_products(weights: FloatArray, a: ComplexArray, b: ComplexArray) -> ComplexArray:
    """Σ w a* b over the data, shape (points, columns of a, columns of b).

    Parameters
    ----------
    weights : array, shape (points, data)
    a, b : complex arrays, shape (1 or points, columns, data)
    """
    if len(a) > 1 or len(b) > 1 or len(weights) < _MANY_POINTS:
        product: ComplexArray = (a.conj() * weights[:, None]) @ b.transpose(0, 2, 1)
        return product
    # columns that all points share: one product of real matrices for all points
    pairs = (a[0].conj()[:, None] * b[0][None]).reshape(-1, a.shape[-1])
    return _summed(weights, pairs).reshape(len(weights), a.shape[1], b.shape[1])


def weighted_gram(weights: FloatArray, a: ComplexArray) -> ComplexArray:
    """Σ w a* a over the data, shape (points, columns, columns): as `weighted_products`, but half of it is computed."""
    if len(a) > 1 or len(weights) < _MANY_POINTS:
        return weighted_products(weights, a, a)
    i, j = np.triu_indices(a.shape[1])
    upper = _summed(weights, a[0].conj()[i] * a[0][j])
    gram = np.empty((len(weights), a.shape[1], a.shape[1]), dtype=complex)
    gram[:, j, i] = upper.conj()
    gram[:, i, j] = upper
    return gram


def _summed(weights: FloatArray, pairs: ComplexArray) -> ComplexArray:
    """Σ w p over the data, shape (points, pairs), by products of real matrices."""
    return np.asarray(weights @ pairs.real.T + 1j * (weights @ pairs.imag.T))


def solve_linear(window: Window, phi: ComplexArray) -> Linear:
    """Least squares over the columns at every point."""
    points = len(window.values)
    flat = phi.reshape(len(phi), phi.shape[1], -1)
    weights = window.weights.reshape(points, -1)
    values = window.values.reshape(points, -1)
    gram = weighted_gram(weights, flat)
    right = projected(flat, weights * values)
    diagonal = np.sqrt(np.maximum(np.einsum("kcc->kc", gram).real, np.finfo(float).tiny))
    gram = gram / (diagonal[:, :, None] * diagonal[:, None, :])
    inverse = hermitian_inverse(gram)
    scaled = right / diagonal
    coefficients = np.einsum("kab,kb->ka", inverse, scaled)
    energy = np.sum(weights * np.abs(values) ** 2, axis=1)
    chi2 = energy - np.einsum("ka,ka->k", scaled.conj(), coefficients).real
    return Linear(np.maximum(chi2, 0.0), coefficients, inverse, diagonal)


def hermitian_inverse(matrices: ComplexArray) -> ComplexArray:
    """Inverses of matrices with unit diagonal; pseudo-inverses where one is near singular, which take longer."""
    try:
        pivots = np.einsum("kcc->kc", np.linalg.cholesky(matrices)).real
    except np.linalg.LinAlgError:
        pivots = np.zeros(1)
    if np.min(pivots, initial=1.0) ** 2 > _SAFE_PIVOT:
        return np.asarray(np.linalg.inv(matrices))
    return np.asarray(np.linalg.pinv(matrices, rcond=RANK, hermitian=True))


def projected(flat: ComplexArray, values: ComplexArray) -> ComplexArray:
    """Inner products of every point's values with the columns, shape (points, columns)."""
    if len(flat) == 1:
        return np.asarray(values @ flat[0].conj().T)
    # the values are conjugated, for the columns of all points take long to copy
    return np.asarray((flat @ values.conj()[:, :, None])[..., 0].conj())


def fitted(coefficients: ComplexArray, flat: ComplexArray) -> ComplexArray:
    """Sum of the columns, shape (points, data)."""
    if len(flat) == 1:
        return np.asarray(coefficients @ flat[0])
    return np.asarray((coefficients[:, None] @ flat)[:, 0])


def free_parts(modes: Modes) -> npt.NDArray[np.int_]:
    """(mode, reference) of every participation that is not the fixed 1."""
    fixed = np.argmax(np.abs(modes.parts), axis=1)
    pairs = [(m, j) for m in range(len(modes)) for j in range(modes.parts.shape[1]) if j != fixed[m]]
    return np.array(pairs, dtype=int).reshape(-1, 2)

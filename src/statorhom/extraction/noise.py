"""Noise level of FRFs: from repeats or coherence where known, else from how the lines scatter locally.

Neighbouring lines lie on a smooth curve; what a local parabola leaves is noise (local polynomial method,
Pintelon & Schoukens 2012, §7.2). A resonance narrower than the stencil leaves more than noise, so the level
relative to the magnitude is taken as a median over a block of lines that is much wider than the stencil.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.extraction.point_grid import PointGrid

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_HALF_STENCIL = 3
_DEGREE = 2
_BLOCK = 60  # lines of one median
_FLOOR_QUANTILE = 0.02
LEAST_MODEL_ERROR = 0.002
"""Part of the magnitude that no linear model explains: structures and sensors are not linear beyond it."""

_LEAST_RELATIVE = 1e-9  # keeps weights finite for data without noise


def noise_sd(grid: PointGrid) -> FloatArray:
    """Standard deviation of the complex noise of every receptance, shape (points, references, lines) (m/N)."""
    magnitude = np.abs(grid.receptance)
    if len(grid.repeats) > 2:
        return _from_repeats(grid)
    if grid.relative_sd is not None and np.isfinite(grid.relative_sd[grid.measured]).all():
        least = _LEAST_RELATIVE * magnitude.max(axis=-1, keepdims=True)
        known: FloatArray = np.maximum(grid.relative_sd * magnitude, least)
        return known
    weight = grid.omega**2
    acceleration = grid.receptance * weight
    sd: FloatArray = _local(acceleration) / weight
    return sd


def expected_sd(grid: PointGrid, noise: FloatArray) -> FloatArray:
    """Standard deviation of what a modal model may miss: noise, or what no real structure and sensor keep to."""
    sd: FloatArray = np.maximum(noise, LEAST_MODEL_ERROR * np.abs(grid.receptance))
    return sd


def _local(values: ComplexArray) -> FloatArray:
    smooth, variance = _local_polynomial(values)
    power = np.abs(smooth) ** 2
    least = _LEAST_RELATIVE**2 * power.max(axis=-1, keepdims=True) + np.finfo(float).tiny
    # variance = a² · power + floor: a² from the stronger half of the lines, the floor from the quietest blocks
    strong = power >= np.median(power, axis=-1, keepdims=True)
    ratio = np.where(strong, variance / np.maximum(power, least), np.nan)
    proportional = np.nanmedian(ratio, axis=-1, keepdims=True) / _MEDIAN_RATIO
    floor = np.quantile(_blocks(variance), _FLOOR_QUANTILE, axis=-1)[..., None]
    expected = proportional * power + floor + least
    sd: FloatArray = np.sqrt(_spread(_blocks(variance / expected), values.shape[-1]) * expected + least)
    return sd


def _from_repeats(grid: PointGrid) -> FloatArray:
    """Spread of the repeats, smoothed over lines in proportion to the magnitude."""
    stack = np.array(grid.repeats)
    count = np.maximum(np.isfinite(stack).sum(axis=0), 1)
    deviation = np.where(np.isfinite(stack), stack - grid.receptance, 0.0)
    variance = np.sum(np.abs(deviation) ** 2, axis=0) / np.maximum(count - 1, 1) / count
    kernel = np.ones(2 * _HALF_STENCIL + 1) / (2 * _HALF_STENCIL + 1)
    smooth = np.apply_along_axis(
        lambda row: np.convolve(np.pad(row, _HALF_STENCIL, "edge"), kernel, "valid"), -1, variance
    )
    least = (_LEAST_RELATIVE * np.abs(grid.receptance).max(axis=-1, keepdims=True)) ** 2
    sd: FloatArray = np.sqrt(smooth + least + np.finfo(float).tiny)
    return sd


def _local_polynomial(values: ComplexArray) -> tuple[ComplexArray, FloatArray]:
    """Value and residual variance of a parabola through the lines around each line."""
    width = 2 * _HALF_STENCIL + 1
    basis = np.vander(np.linspace(-1.0, 1.0, width), _DEGREE + 1)
    q, _ = np.linalg.qr(basis)
    projector = np.eye(width) - q @ q.T
    centre = (q @ q.T)[_HALF_STENCIL]
    padded = np.pad(values, [(0, 0)] * (values.ndim - 1) + [(_HALF_STENCIL, _HALF_STENCIL)], mode="edge")
    smooth = np.zeros(values.shape, dtype=complex)
    variance = np.zeros(values.shape)
    lines = values.shape[-1]
    shifted = [padded[..., i : i + lines] for i in range(width)]
    for weight, part in zip(centre, shifted, strict=True):
        smooth += weight * part
    # an orthonormal basis of the residual space: its coordinates are independent noise
    rest = np.linalg.svd(projector)[0][:, : width - _DEGREE - 1]
    for column in rest.T:
        coordinate = np.zeros(values.shape, dtype=complex)
        for weight, part in zip(column, shifted, strict=True):
            coordinate += weight * part
        variance += np.abs(coordinate) ** 2
    variance /= rest.shape[1]
    edge = _HALF_STENCIL
    variance[..., :edge], variance[..., -edge:] = (
        variance[..., edge : edge + 1],
        variance[..., -edge - 1 : -edge],
    )
    return smooth, variance


def _blocks(values: FloatArray) -> FloatArray:
    """Medians over blocks of lines, shape (…, blocks)."""
    count = max(1, values.shape[-1] // _BLOCK)
    parts = np.array_split(values, count, axis=-1)
    return np.stack([np.median(part, axis=-1) for part in parts], axis=-1) / _MEDIAN_RATIO


def _spread(blocks: FloatArray, lines: int) -> FloatArray:
    """Block values carried over to the lines, linearly between the blocks' middles."""
    count = blocks.shape[-1]
    position = (np.arange(lines) + 0.5) * count / lines - 0.5
    low = np.clip(np.floor(position).astype(int), 0, count - 1)
    high = np.minimum(low + 1, count - 1)
    share = np.clip(position - low, 0.0, 1.0)
    spread: FloatArray = blocks[..., low] * (1 - share) + blocks[..., high] * share
    return spread


# the mean of 4 complex squares is χ² with 8 real degrees of freedom over 8; its median lies lower than its mean
_MEDIAN_RATIO = 7.3441 / 8.0

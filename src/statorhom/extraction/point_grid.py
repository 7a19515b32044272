"""FRFs sorted into a grid of points and references, whichever of the two the test moved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from statorhom.errors import ExtractionError
from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int_]

_FEWEST_LINES = 20
_SAME_LINES = 1e-6  # of the spacing


@dataclass(frozen=True)
class PointGrid:
    """Receptances between the points of a shape and the few references that all of them share.

    By reciprocity it does not matter whether the accelerometer or the hammer roved: the side with more
    places carries the shape.

    Attributes
    ----------
    omega : array, shape (lines,)
        Angular frequencies (rad/s), ascending, above 0.
    points, references : tuple of Dof
        Places of the shape and of the participation.
    receptance : complex array, shape (points, references, lines)
        Mean of what was measured (m/N); 0 where a pair was not.
    measured : bool array, shape (points, references, lines)
        Where a finite value exists.
    repeats : list of complex arrays, shape (points, references, lines)
        The single measurements behind the mean, NaN where missing; one entry where nothing was repeated.
    relative_sd : array, shape (points, references, lines), or None
        Standard deviation over magnitude of the mean, where the recording tells it.
    hammer_roved : bool
        Whether the points are those of the force.
    cells : int array, shape (FRFs, 2)
        Point and reference of every FRF, set after set.
    """

    omega: FloatArray
    points: tuple[Dof, ...]
    references: tuple[Dof, ...]
    receptance: ComplexArray
    measured: npt.NDArray[np.bool_]
    repeats: tuple[ComplexArray, ...]
    relative_sd: FloatArray | None
    hammer_roved: bool
    cells: IntArray

    def at(self, rows: Sequence[int]) -> PointGrid:
        """The same at some of the points."""
        chosen = list(rows)
        number = {row: i for i, row in enumerate(chosen)}
        return replace(
            self,
            points=tuple(self.points[row] for row in chosen),
            receptance=self.receptance[chosen],
            measured=self.measured[chosen],
            repeats=tuple(one[chosen] for one in self.repeats),
            relative_sd=None if self.relative_sd is None else self.relative_sd[chosen],
            cells=np.array([(number[a], b) for a, b in self.cells.tolist() if a in number], dtype=int),
        )


def point_grid(frf_sets: Sequence[FrfSet], band_hz: tuple[float, float] | None = None) -> PointGrid:
    """Sort the FRFs of one test, and its repeats, into one grid.

    Raises
    ------
    ExtractionError
        When the sets lie on different frequency axes or the band holds too few lines.
    """
    source = frf_sets[0].source or "the recording"
    axis = frf_sets[0].frequency_hz
    lines = _lines(axis, band_hz, source)
    for other in frf_sets[1:]:
        if other.frequency_hz.shape != axis.shape or not np.allclose(
            other.frequency_hz, axis, rtol=0.0, atol=_SAME_LINES * float(np.median(np.diff(axis)))
        ):
            raise ExtractionError(
                f"{other.source or source}: its frequency axis differs from that of {source}"
            )
    pairs = [pair for one in frf_sets for pair in zip(one.responses, one.references, strict=True)]
    if not pairs:
        raise ExtractionError(f"{source}: holds no FRFs to extract modes from")
    swapped = len({b for _, b in pairs}) > len({a for a, _ in pairs})
    points, point_of = _numbered([pair[swapped] for pair in pairs])
    references, reference_of = _numbered([pair[not swapped] for pair in pairs])
    values = np.concatenate([one.receptance[:, lines] for one in frf_sets])
    cells = np.stack([point_of, reference_of], axis=1)
    layers = _layers(values, cells, (len(points), len(references)))
    measured = np.any([np.isfinite(layer) for layer in layers], axis=0)
    if not measured.any():
        raise ExtractionError(f"{source}: no finite value in the band")
    count = np.maximum(np.sum([np.isfinite(layer) for layer in layers], axis=0), 1)
    mean = np.sum([np.nan_to_num(layer) for layer in layers], axis=0) / count
    return PointGrid(
        2 * np.pi * axis[lines],
        points,
        references,
        mean,
        measured,
        tuple(layers),
        _relative_sd(frf_sets, lines, cells, count),
        swapped,
        cells,
    )


def _lines(axis: FloatArray, band_hz: tuple[float, float] | None, source: str) -> npt.NDArray[np.bool_]:
    low, high = band_hz or (0.0, np.inf)
    lines = (axis > 0) & (axis >= low) & (axis <= high)
    if lines.sum() < _FEWEST_LINES:
        raise ExtractionError(
            f"{source}: {int(lines.sum())} frequency lines lie in the band, modal extraction needs {_FEWEST_LINES}"
        )
    return lines


def _numbered(dofs: list[Dof]) -> tuple[tuple[Dof, ...], IntArray]:
    unique = tuple(dict.fromkeys(dofs))
    number = {dof: i for i, dof in enumerate(unique)}
    return unique, np.array([number[dof] for dof in dofs], dtype=int)


def _layers(values: ComplexArray, cells: IntArray, shape: tuple[int, int]) -> list[ComplexArray]:
    """Measurements of every cell, the first ones in the first layer, repeats in further ones."""
    depth: dict[tuple[int, int], int] = {}
    layers: list[ComplexArray] = []
    for row, cell in zip(values, map(tuple, cells.tolist()), strict=True):
        layer = depth.get(cell, 0)
        depth[cell] = layer + 1
        if layer == len(layers):
            layers.append(np.full((*shape, values.shape[1]), np.nan, dtype=complex))
        layers[layer][cell] = row
    return layers


def _relative_sd(
    frf_sets: Sequence[FrfSet], lines: npt.NDArray[np.bool_], cells: IntArray, count: IntArray
) -> FloatArray | None:
    if any(one.relative_sd is None for one in frf_sets):
        return None
    square = np.zeros(count.shape)
    rows = np.concatenate([one.relative_sd[:, lines] for one in frf_sets if one.relative_sd is not None])
    for row, (point, reference) in zip(rows, cells, strict=True):
        square[point, reference] += row**2
    sd: FloatArray = np.sqrt(square) / count
    return sd

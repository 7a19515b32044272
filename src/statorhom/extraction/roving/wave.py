"""The wave that a mode's residues form around the circumference, and how a sensor moves with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.roving.rings import Rings
from statorhom.modes.axial_motion import axial_lever
from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_HIGHEST_DEGREE = 3  # of the polynomial along the axis
_LEVEL = 0.6  # of an outer plane's, what an inner plane moves in modes that keep their sign along the axis


@dataclass(frozen=True, eq=False)
class Wave:
    """Order of a mode and the squared mass-normalised amplitude with which a sensor moves at each plane (1/kg)."""

    order: int
    mobility: FloatArray


def wave(residues: ComplexArray, rings: Rings, references: Sequence[Dof]) -> Wave:
    """From the residues of one mode (1/kg), both halves of a doublet together, shape (points, references).

    The wave at the hammer's own place is φ_h²; both halves move a sensor, for it turns them.
    """
    values = residues.real * rings.signs[:, None]
    order = int(np.argmax(order_energies(residues, rings).sum(axis=0)))
    coefficients = _fitted(values, rings, order)
    rows = [_mobility(coefficients[..., j], one, rings, order) for j, one in enumerate(references)]
    # what the hammers see of the mode weighs
    weight = np.sum(values**2, axis=0)
    return Wave(order, np.average(rows, axis=0, weights=weight))


def order_energies(residues: ComplexArray, rings: Rings) -> FloatArray:
    """Energy of every circumferential order in every plane, shape (planes, orders), of residues as in `wave`."""
    values = residues.real * rings.signs[:, None]
    energies = []
    for order in range(rings.highest_order + 1):
        planes = zip(rings.members, _fitted(values, rings, order), strict=True)
        energies.append([float(np.sum((_around(rings, rows, order) @ one) ** 2)) for rows, one in planes])
    return np.array(energies).T


def _around(rings: Rings, rows: npt.NDArray[np.int_], order: int) -> FloatArray:
    phase = order * rings.angles_rad[rows]
    return np.stack([np.cos(phase), np.sin(phase)], axis=1)


def _fitted(values: FloatArray, rings: Rings, order: int) -> FloatArray:
    """Cosine and sine amplitudes, shape (planes, 2, references)."""
    return np.array(
        [np.linalg.lstsq(_around(rings, rows, order), values[rows], rcond=None)[0] for rows in rings.members]
    )


def _mobility(coefficients: FloatArray, hammer: Dof, rings: Rings, order: int) -> FloatArray:
    """Radial and axial φ² at every plane from one hammer's wave, shape (planes, 2)."""
    assert hammer.position is not None and hammer.angle is not None
    at = np.array([np.cos(order * hammer.angle), np.sin(order * hammer.angle)])
    middle, span = rings.heights_m.mean(), float(np.ptp(rings.heights_m))
    place = (rings.heights_m - middle) / span
    along = np.polyfit(place, coefficients @ at, min(_HIGHEST_DEGREE, len(place) - 1))
    square = max(abs(float(np.polyval(along, (hammer.position[2] - middle) / span))), np.finfo(float).tiny)
    radial = (coefficients @ at) ** 2
    slope = np.polyval(np.polyder(along), place) / span
    # only whether the mode changes its sign between the ends matters to the lever
    level = len(place) < 3 or radial[1:-1].mean() > _LEVEL * radial[[0, -1]].mean()
    lever = axial_lever(order, 0 if level else 1, rings.radius_m).length_m
    return np.asarray((radial + (slope * lever) ** 2) / square)

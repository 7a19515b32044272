"""Modes of all harmonics at a few materials of a cell: what their bases begin with.

Harmonics that are solved together share their factorizations, so that a material costs a fraction of what it costs one
harmonic after the other. Where these materials are not enough, a harmonic goes on by itself.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import AffineModel
from statorhom.model.cyclic.half_pitch import half_pitches
from statorhom.model.cyclic.modes import modes_of
from statorhom.model.harmonic import Harmonic
from statorhom.model.local_basis import BEYOND
from statorhom.model.material_cells import features, material_cells
from statorhom.model.material_span import MaterialPoint
from statorhom.model.pitch_parts import pitch_parts

REACH = 1.2  # beyond the band, that most problems show what comes next

# number of a training material → its λ (k,) and mass-normalised vectors (m, k)
Snapshots = Mapping[int, tuple[np.ndarray, np.ndarray]]


def common_snapshots(
    model: AffineModel[HalfPitchMesh],
    spaces: Sequence[Harmonic],
    training: Sequence[MaterialPoint],
    regions: Sequence[str],
    highest_hz: float,
    count: int,
) -> tuple[Snapshots, ...]:
    """Modes of the band and the next ones above it, at those of a cell's materials that are most unlike.

    Parameters
    ----------
    model : of the half pitch.
    spaces : the problems.
    training : materials of the cell.
    regions : in the order of the materials' arrays.
    highest_hz : upper end of the band.
    count : of the materials that are solved.

    Returns
    -------
    Per problem what was found; a material above whose band no mode was seen is left out.
    """
    parts, top = pitch_parts(model.mesh), (2 * np.pi * highest_hz) ** 2
    found: tuple[dict[int, tuple[np.ndarray, np.ndarray]], ...] = tuple({} for _ in spaces)
    for number in _most_unlike(training, count):
        pitches = half_pitches(parts, *_matrices(model, training[number], regions))
        solved = modes_of(pitches, spaces, REACH * highest_hz)
        for known, (values, vectors) in zip(found, solved, strict=True):
            wanted = int((values <= top).sum()) + BEYOND
            if len(values) >= wanted:
                known[number] = values[:wanted], vectors[:, :wanted]
    return found


def _most_unlike(training: Sequence[MaterialPoint], count: int) -> list[int]:
    described = np.array([features(point) for point in training])
    return material_cells(described, 0.0, min(count, len(training)))[1]


def _matrices(
    model: AffineModel[HalfPitchMesh], point: MaterialPoint, regions: Sequence[str]
) -> tuple[sp.csr_array, sp.csr_array]:
    """K and M of the half pitch."""
    entries = {r: hooke for r, hooke in zip(regions, point.hooke, strict=True) if r in model.stiffness}
    mass = model.mass_data(dict(zip(regions, point.density.tolist(), strict=True)))
    return model.pattern.matrix(model.stiffness_data(entries)), model.pattern.matrix(mass)

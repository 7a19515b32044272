"""Where the declared model fails: the constitutive-relation error of measured shapes over the stator (physics.md §7).

Of every measured mode that motion u is sought which meets the measured points within their noise and obeys the model as
well as it can: what is left of the balance, K_s d = (K - ω²M) u with K_s = K + σM, is minimal in dᵀK_s d. Where the
energy of d lies, the model is wrong or the load of something unknown acts. Sensors on the outer surface smear it: the
map ranks places, it does not decide.

All this happens in the modes of the symmetric stator, where K and M are diagonal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.measured_test import MeasuredShapes, MeasuredTest
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.broken.basis import SymmetricBasis, symmetric_basis
from statorhom.model.broken.cells import cells
from statorhom.model.broken.named_response import columns_of
from statorhom.model.broken.pieces import elements_in
from statorhom.model.convergence import ModeKey
from statorhom.model.surface import surface_points
from statorhom.physics.pieces import region_pieces
from statorhom.study.study_file import FREE

NOISE = 0.01  # of a shape's root mean square, to which measured points are met: sensors stand a little off their places
MARGIN = 3.0  # modes reach this much higher than the band: the response to a local cause has many
LEAST_ANGLES, HEIGHTS = 24, 10  # cells of the map
SWEEPS = 60  # of the bisection of the weight


@dataclass(frozen=True, eq=False)
class ErrorMap:
    """Error of one test's modes over the stator.

    Parameters
    ----------
    stage, test : whose.
    angles_rad, z_m : (a + 1,), (h + 1,) borders of the cells.
    regions : region → (a, h) error energy of all modes; the whole sums to one.
    error : of the modes together, relative to their energy.
    modes : that were used.
    """

    stage: str
    test: str
    angles_rad: np.ndarray
    z_m: np.ndarray
    regions: Mapping[str, np.ndarray]
    error: float
    modes: tuple[ModeKey, ...]


def error_maps(base: Refit) -> tuple[ErrorMap, ...]:
    """Maps of all free tests whose shapes were measured, at the declared model's optimum."""
    found = []
    for stage in base.hypothesis.study.stages:
        for test in stage.tests:
            if test.shapes is None or test.support != FREE:
                continue
            basis = symmetric_basis(
                stage.model, stage.reference, stage.ring.highest_hz, margin=MARGIN, certified=False
            )
            squares = _squares(base, stage, test, basis)
            if squares:
                found.append(_map(stage, test, test.shapes, squares, basis))
    return tuple(found)


def _squares(
    base: Refit, stage: StageModel, test: MeasuredTest, basis: SymmetricBasis
) -> dict[str, tuple[ModeKey, float]]:
    """Label of a mode → its name and its ω² as the basis's mesh and materials would have it (rad²/s²)."""
    h = base.hypothesis
    assert h.held is not None
    _, told = h.all_features(base.z)
    predicted = told[stage.name][1][test.name]
    found = {}
    for mode, key in zip(test.modes, h.held[test.name], strict=True):
        if not isinstance(key, tuple) or key not in predicted or key not in stage.reference_keys:
            continue
        own = stage.reference_keys[key]
        place = columns_of(basis, stage.ring.problems[own.problem].space, own.frequency_hz)
        if place is not None:
            off = np.log(mode.frequency_hz) - predicted[key].log_f
            found[mode.label] = key, place.eigenvalue * float(np.exp(2 * off))
    return found


def _map(
    stage: StageModel,
    test: MeasuredTest,
    shapes: MeasuredShapes,
    squares: Mapping[str, tuple[ModeKey, float]],
    basis: SymmetricBasis,
) -> ErrorMap:
    mesh = stage.model.mesh
    z, theta = (a.ravel() for a in np.meshgrid(shapes.z_m, shapes.angles_rad, indexing="ij"))
    rows = basis.waves.at_points(surface_points(mesh, theta, z))[0::3]  # radial
    fields, energies, modes = [], [], []
    for label, radial in zip(shapes.labels, shapes.radial, strict=True):
        if label in squares:
            key, square = squares[label]
            d, energy = constitutive_error(basis, rows, radial.ravel(), square)
            fields.append(d)
            energies.append(energy)
            modes.append(key)
    weights = 1 / np.sqrt(np.array(energies))
    scaled = np.array(fields).T * weights  # every mode's energy counts as one
    count = int(LEAST_ANGLES * max(1, round(mesh.slots / LEAST_ANGLES)))
    angles, heights = np.linspace(0, 2 * np.pi, count + 1), _heights(stage)
    regions = {r: _energy(stage, basis, r, scaled, angles, heights) for r in mesh.regions}
    total = sum(float(part.sum()) for part in regions.values())
    shares = {r: part / max(total, np.finfo(float).tiny) for r, part in regions.items()}
    return ErrorMap(
        stage.name, test.name, angles, heights, shares, total / len(modes), tuple(dict.fromkeys(modes))
    )


def constitutive_error(
    basis: SymmetricBasis, rows: np.ndarray, measured: np.ndarray, square: float
) -> tuple[np.ndarray, float]:
    """The residual field d and the motion's energy ½ uᵀK_s u.

    Parameters
    ----------
    basis : modes of the model.
    rows : (p, coordinates) measured displacements of the basis's coordinates.
    measured : (p,) NaN where not measured.
    square : ω² (rad²/s²).

    Returns
    -------
    d, energy : (coordinates,) of the basis, in the scale of `measured`, and ½ uᵀK_s u.
    """
    known = np.isfinite(measured)
    rows, data = rows[known], measured[known]
    stiff = basis.values + basis.shift
    # dᵀK_s d = Σ w q²; at the resonance itself a mode costs next to nothing
    w = (basis.values - square) ** 2 / stiff + 1e-9 * square
    gram = (rows / w) @ rows.T
    values, vectors = np.linalg.eigh(gram)
    values = np.maximum(values, 0.0)
    part = vectors.T @ data
    aim = NOISE**2 * float(data @ data)
    low, high = -60.0, 60.0  # ln of the weight over the largest value
    for _ in range(SWEEPS):
        middle = (low + high) / 2
        weight = values[-1] * np.exp(middle)
        misfit = float(np.sum((weight / (values + weight) * part) ** 2))
        low, high = (middle, high) if misfit < aim else (low, middle)
    weight = values[-1] * np.exp(low)
    q = (rows.T @ (vectors @ (part / (values + weight)))) / w
    return (basis.values - square) / stiff * q, 0.5 * float(q @ (stiff * q))


def _heights(stage: StageModel) -> np.ndarray:
    z = stage.model.mesh.nodes[:, 2]
    return np.linspace(float(z.min()), float(z.max()), HEIGHTS + 1)


def _energy(
    stage: StageModel,
    basis: SymmetricBasis,
    region: str,
    fields: np.ndarray,
    angles: np.ndarray,
    heights: np.ndarray,
) -> np.ndarray:
    """½ dᵀK_e d of a region's elements, summed over fields into the cells (a, h)."""
    mesh = stage.model.mesh
    pieces = region_pieces(mesh, region, stage.reference[region])
    place = cells(mesh, elements_in(mesh, (region,)))
    used, own = pieces.alone()
    energy = np.zeros((len(pieces), 2 * mesh.slots))
    for column in fields.T:
        motion = basis.waves.in_copies(used, column[:, None])[..., 0]  # (2 N, d)
        u = motion[:, own.dofs]  # (2 N, e, q)
        energy += 0.5 * np.einsum(
            "ceq,ceq->ec", np.einsum("ceq,eqr->cer", u, pieces.matrices, optimize=True), u
        )
    return binned(energy, place.angles, place.z, angles, heights)


def binned(
    energy: np.ndarray, spans: np.ndarray, z: np.ndarray, angles: np.ndarray, heights: np.ndarray
) -> np.ndarray:
    """Energies (e, copies) of elements with angular spans (e, copies, 2) and heights (e, 2) in cells (a, h)."""
    total = np.zeros((len(angles) - 1, len(heights) - 1))
    along = _shares(z, heights)
    middle = spans.mean(axis=2) % (2 * np.pi)
    half = np.abs(spans[..., 1] - spans[..., 0]) / 2
    for turn in (-2 * np.pi, 0.0, 2 * np.pi):
        low, high = middle - half + turn, middle + half + turn
        around = _shares(np.stack([low, high], axis=-1).reshape(-1, 2), angles).reshape(*energy.shape, -1)
        total += np.einsum("ec,eca,eh->ah", energy, around, along)
    return total


def _shares(spans: np.ndarray, borders: np.ndarray) -> np.ndarray:
    """Share (s, b) of spans (s, 2) in each of the intervals between borders."""
    low, high = spans[:, :1], spans[:, 1:]
    inside = np.minimum(high, borders[None, 1:]) - np.maximum(low, borders[None, :-1])
    return np.asarray(np.maximum(inside, 0.0) / np.maximum(high - low, np.finfo(float).tiny))


def most_wrong(found: Sequence[ErrorMap]) -> list[tuple[str, str, float]]:
    """Stage, region and share of the error, the largest share first."""
    rows = [(m.stage, r, float(part.sum())) for m in found for r, part in m.regions.items()]
    return sorted(rows, key=lambda row: -row[2])

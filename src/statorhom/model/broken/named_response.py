"""What a broken symmetry makes of the symmetric stator's named modes: shifts, and complex splits of doublets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.solve import BrokenModes
from statorhom.model.harmonic import Harmonic

LEAST = 0.2  # share of a doublet's plane that its two modes must keep to be called its own
# Modes so near (of ln f) that have so much of a doublet's plane may be called by its name as well as its own: hardly
# from the first share on, surely from the second.
NEAR, MIXED, SURELY = 0.08, 0.15, 0.35


@dataclass(frozen=True)
class Columns:
    """Where a symmetric mode stands among a basis's coordinates; `sine` is None for single modes."""

    cosine: int
    sine: int | None
    eigenvalue: float

    @property
    def numbers(self) -> list[int]:
        """Of its coordinates: two for a doublet."""
        return [self.cosine] if self.sine is None else [self.cosine, self.sine]


@dataclass(frozen=True, eq=False)
class Response:
    """Of one named mode.

    Parameters
    ----------
    shift : change of ln f of the doublet's mean λ.
    split : complex split b_r over the mean λ (`statorhom.modes.doublets.complex_split`).
    other_axial : count of node planes that it may show as well as its own.
    profile : (heights,) its order's radial motion along the axis; None where nobody asked.
    blur : relative standard deviation of what is called by its name, where that is a mixture of modes of several names.
    """

    shift: float
    split: complex
    other_axial: int | None = None
    profile: np.ndarray | None = None
    blur: float = 0.0


def columns_of(basis: SymmetricBasis, space: Harmonic, frequency_hz: float) -> Columns | None:
    """The basis's mode of a harmonic problem that is nearest to a frequency; None where the basis lacks the problem."""
    value = (2 * np.pi * frequency_hz) ** 2
    for problem, place in zip(basis.problems, basis.places, strict=True):
        if problem.sector.space.kind != space.kind:
            continue
        nearest = int(np.argmin(np.abs(problem.values - value)))
        sine = place[True].start + nearest if True in place and False in place else None
        first = place[False] if False in place else place[True]
        return Columns(first.start + nearest, sine, float(problem.values[nearest]))
    return None


@dataclass(frozen=True, eq=False)
class NearestPair:
    """The broken modes that have most of a named one.

    Parameters
    ----------
    modes : (k,) their numbers, by ascending frequency.
    rotation : (k, k) nearest orthonormal coordinates of the named modes in their plane.
    """

    modes: np.ndarray
    rotation: np.ndarray


def nearest_pair(modes: BrokenModes, place: Columns) -> NearestPair | None:
    """Broken modes of a named one; None where it can no longer be told among them."""
    numbers = place.numbers
    parts = modes.participation[numbers]
    weight = np.sum(parts**2, axis=0)
    chosen = np.sort(np.argsort(-weight)[: len(numbers)])
    if len(chosen) < len(numbers) or weight[chosen].min() < LEAST:
        return None
    left, _, right = np.linalg.svd(parts[:, chosen])
    return NearestPair(chosen, left @ right)


def named_response(modes: BrokenModes, place: Columns) -> Response | None:
    """Response of a named mode; None where it can no longer be told among the broken ones."""
    pair = nearest_pair(modes, place)
    return None if pair is None else response_of(modes, place, pair)


def response_of(modes: BrokenModes, place: Columns, pair: NearestPair) -> Response:
    """Response of a named mode whose broken modes are known."""
    values, blur = modes.eigenvalues[pair.modes], blur_of(modes, place, pair)
    if len(values) == 1:
        return Response(0.5 * float(np.log(values[0] / place.eigenvalue)), 0j, blur=blur)
    effective = pair.rotation @ np.diag(values) @ pair.rotation.T
    mean = float(values.mean())
    split = complex(effective[0, 0] - effective[1, 1], 2 * effective[0, 1]) / mean
    return Response(0.5 * float(np.log(mean / place.eigenvalue)), split, blur=blur)


def blur_of(modes: BrokenModes, place: Columns, pair: NearestPair) -> float:
    """Root mean square distance (of ln f) of other modes that have much of a named one; none where it is hardly mixed.

    Two modes of different orders that a lump brings together are half of each name, and which one is called by which
    depends on what of them the measuring points see.
    """
    away = 0.5 * np.log(np.maximum(modes.eigenvalues, 1.0) / modes.eigenvalues[pair.modes].mean())
    others = np.abs(away) < NEAR
    others[pair.modes] = False
    parts = np.sum(modes.participation[place.numbers][:, others] ** 2, axis=0)
    sure = np.clip((parts.sum() - MIXED) / (SURELY - MIXED), 0.0, 1.0)
    # without a jump, at which refits would stumble
    return float(sure**2 * (3.0 - 2.0 * sure) * np.sqrt(parts @ away[others] ** 2))

"""The half pitch's matrices split into what all harmonics share and the slot's plane, where they differ.

With the tooth's plane symmetric the real part of û moves (coordinates a), with it antisymmetric the imaginary part
(coordinates b); on the slot's plane û = e^{iφ} (y_r, i y_θ, y_z), φ = h π / N. So the problem of harmonic h is

    [ Z_aa           Z_as D₁                ]
    [         Z_bb   Z_bs D₂                ]      D₁ = Re, D₂ = Im of e^{iφ} (1, i, 1)
    [ D₁ Z_sa D₂ Z_sb   D₁ Z_ss D₁ + D₂ Z_ss D₂ ]

for Z = K, M or K - λM: the blocks do not depend on h, D₁ and D₂ are diagonal.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from statorhom.model.harmonic import Harmonic, plane_phases, slot_phase
from statorhom.model.pitch_parts import PitchPart


@dataclass(frozen=True, eq=False)
class HalfPitch:
    """K and M of one axial parity.

    Parameters
    ----------
    part : whose displacements these are.
    K, M : (n, n) of the displacements that carry coordinates.
    a, b, s : their numbers among those: real part, imaginary part, slot's plane.
    """

    part: PitchPart
    K: sp.csr_array
    M: sp.csr_array
    a: np.ndarray
    b: np.ndarray
    s: np.ndarray

    @property
    def sizes(self) -> tuple[int, int, int]:
        """Numbers of coordinates a, b and s."""
        return len(self.a), len(self.b), len(self.s)

    @property
    def dofs(self) -> np.ndarray:
        """(n,) displacements of the half pitch that carry coordinates, ascending."""
        return _used(self.part)

    def stiffened(self, matrix: sp.csr_array) -> HalfPitch:
        """With a matrix of the half pitch (3 n, 3 n) added to K."""
        used = self.dofs
        return replace(self, K=sp.csr_array(self.K + self.part.fold(matrix)[used][:, used]))


def half_pitches(parts: Iterable[PitchPart], K: sp.csr_array, M: sp.csr_array) -> tuple[HalfPitch, ...]:
    """Fold the half pitch's matrices K and M (3 n, 3 n) for every part."""
    return tuple(half_pitch(part, K, M) for part in parts)


def half_pitch(part: PitchPart, K: sp.csr_array, M: sp.csr_array) -> HalfPitch:
    """Fold the half pitch's matrices K and M (3 n, 3 n)."""
    used = _used(part)
    turns = part.tooth % 3 == 1
    a = np.sort(np.r_[part.inner, part.tooth[~turns]])
    b = np.sort(np.r_[part.inner, part.tooth[turns]])
    places = (np.searchsorted(used, dofs) for dofs in (a, b, part.slot))
    matrices = (sp.csr_array(part.fold(m)[used][:, used]) for m in (K, M))
    return HalfPitch(part, *matrices, *places)


def _used(part: PitchPart) -> np.ndarray:
    """Displacements that carry coordinates, ascending."""
    return np.sort(np.r_[part.inner, part.tooth, part.slot])


@dataclass(frozen=True, eq=False)
class Phases:
    """What tells the problems of some harmonics of one part apart; they stand side by side in arrays (n, p).

    Parameters
    ----------
    spaces : the p problems.
    first, second : (s, p) D₁ and D₂, zero for coordinates that a singlet's problem has not.
    present : (a + b + s, p) which coordinates each problem has.
    """

    spaces: tuple[Harmonic, ...]
    first: np.ndarray
    second: np.ndarray
    present: np.ndarray

    def take(self, chosen: np.ndarray) -> Phases:
        """Some of the problems."""
        spaces = tuple(self.spaces[i] for i in chosen)
        return Phases(spaces, self.first[:, chosen], self.second[:, chosen], self.present[:, chosen])


def phases(pitch: HalfPitch, spaces: tuple[Harmonic, ...]) -> Phases:
    """Of problems of this part."""
    slot = pitch.part.slot
    turns = np.array([plane_phases(slot, slot_phase(h.order, h.slots)) for h in spaces]).T
    has_a = np.array([h.parity != "odd" for h in spaces])
    has_b = np.array([h.parity != "even" for h in spaces])
    first, second = turns.real * has_a, turns.imag * has_b
    a, b, _ = pitch.sizes
    present = np.vstack([np.tile(has_a, (a, 1)), np.tile(has_b, (b, 1)), (first != 0) | (second != 0)])
    return Phases(spaces, first, second, present)


def columns(pitch: HalfPitch, space: Harmonic) -> np.ndarray:
    """Which of the coordinates a, b, s is each coordinate y of the problem's `Harmonic`, (m,)."""
    part, (count_a, count_b, _) = pitch.part, pitch.sizes
    turns = part.tooth % 3 == 1
    # where inner and tooth displacements stand among a and b
    dofs_a = np.sort(np.r_[part.inner, part.tooth[~turns]])
    dofs_b = np.sort(np.r_[part.inner, part.tooth[turns]])
    real, imaginary = np.searchsorted(dofs_a, part.inner), count_a + np.searchsorted(dofs_b, part.inner)
    tooth = np.empty(len(part.tooth), dtype=int)
    tooth[~turns] = np.searchsorted(dofs_a, part.tooth[~turns])
    tooth[turns] = count_a + np.searchsorted(dofs_b, part.tooth[turns])
    slot = count_a + count_b + np.arange(len(part.slot))
    if space.parity == "pair":
        return np.concatenate([real, imaginary, tooth, slot])
    phase = plane_phases(part.slot, slot_phase(space.order, space.slots))
    if space.parity == "even":
        return np.concatenate([real, tooth[~turns], slot[phase.real != 0]])
    return np.concatenate([imaginary, tooth[turns], slot[phase.imag != 0]])

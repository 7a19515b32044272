"""Static responses of all harmonics to unit loads on the same displacements: solved once for all of them.

What a load within the half pitch moves while the slot's plane is held does not depend on the harmonic, Z = K + σM:
E = Z_xx⁻¹ e for either family x of coordinates. What does is the motion S of the slot's plane, by the condensed S_h
(`statorhom.model.cyclic.condensed`), and with X_x = Z_xx⁻¹ Z_xs the responses R of a harmonic are

    S = S_h⁻¹ (e_s - D₁ X_aᵀ e_a - D₂ X_bᵀ e_b),    R_a = E_a - X_a D₁ S,    R_b = E_b - X_b D₂ S,    R_s = S

Their flexibility eᵀR and inertia RᵀMR follow from small matrices that all harmonics share, and none is written out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from statorhom.model.cyclic.condensed import Eliminated
from statorhom.model.cyclic.half_pitch import HalfPitch
from statorhom.model.cyclic.problem import CyclicProblem, Shifted


@dataclass(frozen=True, eq=False)
class LoadedFamily:
    """One of the two families of coordinates within the half pitch, x, under unit loads on l of them.

    Parameters
    ----------
    places : (l,) the loaded ones among the x, ascending.
    held : (x, l) E, responses while the slot's plane is held.
    by_slot : (x, s) X, what a unit motion of the slot's plane takes back.
    own, coupled, inertia : (l, l), (l, s) and (s, s) mass products of the responses, of these with the motions [X; -1]
        of the slot's plane, and of these.
    """

    places: np.ndarray
    held: np.ndarray
    by_slot: np.ndarray
    own: np.ndarray
    coupled: np.ndarray
    inertia: np.ndarray

    @property
    def flexibility(self) -> np.ndarray:
        """(l, l) motion of the loaded coordinates while the slot's plane is held."""
        return np.asarray(self.held[self.places])

    @property
    def condensed(self) -> np.ndarray:
        """(s, l) of the loads on the slot's plane."""
        return np.asarray(self.by_slot[self.places].T)


@dataclass(frozen=True, eq=False)
class UnitLoads:
    """On some displacements, for all problems of one part.

    Parameters
    ----------
    shifted : K + σM of the part.
    displacements : of the half pitch, by their numbers, ascending.
    """

    shifted: Shifted
    displacements: np.ndarray

    @cached_property
    def families(self) -> tuple[LoadedFamily, LoadedFamily]:
        """The coordinates a and b."""
        pitch = self.shifted.pitch
        real, imaginary = (
            _loaded(pitch, family, eliminated, self.displacements)
            for family, eliminated in zip((pitch.a, pitch.b), self.shifted.families, strict=True)
        )
        return real, imaginary


def _loaded(
    pitch: HalfPitch, family: np.ndarray, eliminated: Eliminated, displacements: np.ndarray
) -> LoadedFamily:
    places = np.flatnonzero(np.isin(pitch.dofs[family], displacements))
    loads = np.zeros((len(family), len(places)))
    loads[places, np.arange(len(places))] = 1.0
    held, by_slot = eliminated.lu.solve(loads), eliminated.responses
    motions = np.zeros((pitch.M.shape[0], len(pitch.s)))
    motions[family], motions[pitch.s] = by_slot, -np.eye(len(pitch.s))
    rows = pitch.M[family]
    forces = pitch.M @ motions
    return LoadedFamily(
        places,
        held,
        by_slot,
        held.T @ (rows[:, family] @ held),
        held.T @ forces[family],
        motions.T @ forces,
    )


class _Part(NamedTuple):
    """Which of a problem's loads act on a family, which of its unit loads they are, and how its plane turns (D)."""

    which: np.ndarray
    places: np.ndarray
    family: LoadedFamily
    turn: np.ndarray


@dataclass(frozen=True, eq=False)
class LoadedProblem:
    """One harmonic's problem under unit loads on some of its coordinates.

    Parameters
    ----------
    problem : of the harmonic.
    unit : loads of its part.
    loaded : (s,) the coordinates, each of a displacement of `unit`.
    """

    problem: CyclicProblem
    unit: UnitLoads
    loaded: np.ndarray

    @cached_property
    def flexibility(self) -> np.ndarray:
        """(s, s) motion of the loaded coordinates."""
        found = self._half.T @ self._half
        for which, places, family, _ in self._parts:
            found[np.ix_(which, which)] += family.flexibility[np.ix_(places, places)]
        return found / self.problem.space.copies

    @cached_property
    def inertia(self) -> np.ndarray:
        """(s, s) mass products of the responses."""
        found = np.zeros((len(self.loaded), len(self.loaded)))
        for which, places, family, turn in self._parts:
            slot = turn * self._slot
            found += slot.T @ family.inertia @ slot
            cross = family.coupled[places] @ slot
            found[which] -= cross
            found[:, which] -= cross.T
            found[np.ix_(which, which)] += family.own[np.ix_(places, places)]
        return found / self.problem.space.copies

    @cached_property
    def responses(self) -> np.ndarray:
        """(m, s) R."""
        blocks = []
        for which, places, family, turn in self._parts:
            block = -family.by_slot @ (turn * self._slot)
            block[:, which] += family.held[:, places]
            blocks.append(block)
        return np.asarray(self.problem.chosen([*blocks, self._slot]) / self.problem.space.copies)

    def against(self, forces: np.ndarray) -> np.ndarray:
        """Work (k, s) of forces (m, k) on the responses."""
        *inner, slot = self.problem.split(forces)
        found = slot.T @ self._slot
        for own, (which, places, family, turn) in zip(inner, self._parts, strict=True):
            found -= (turn * (family.by_slot.T @ own)).T @ self._slot
            found[:, which] += own.T @ family.held[:, places]
        return np.asarray(found / self.problem.space.copies)

    @cached_property
    def _columns(self) -> np.ndarray:
        """(s,) of the loaded coordinates among a, b and the slot's plane."""
        return self.problem.columns[self.loaded]

    @cached_property
    def _parts(self) -> tuple[_Part, ...]:
        """Of either family."""
        found, start = [], 0
        families = zip(self.unit.families, self.problem.turns, self.unit.shifted.pitch.sizes, strict=False)
        for family, turn, size in families:
            which = np.flatnonzero((self._columns >= start) & (self._columns < start + size))
            places = np.searchsorted(family.places, self._columns[which] - start)
            found.append(_Part(which, places, family, turn))
            start += size
        return tuple(found)

    @property
    def _rest(self) -> np.ndarray:
        """(slot's plane, s) the loads, condensed on the slot's plane."""
        first, second, slot = self.unit.shifted.pitch.sizes
        rest = np.zeros((slot, len(self.loaded)))
        for which, places, family, turn in self._parts:
            rest[:, which] = -turn * family.condensed[:, places]
        on_slot = np.flatnonzero(self._columns >= first + second)
        rest[self._columns[on_slot] - first - second, on_slot] = 1.0
        return rest

    @cached_property
    def _half(self) -> np.ndarray:
        """(slot's plane, s) the same by the root of S_h⁻¹."""
        return np.asarray(self.problem.factors.root[0] @ self._rest)

    @cached_property
    def _slot(self) -> np.ndarray:
        """(slot's plane, s) S."""
        return np.asarray(self.problem.factors.root[0].T @ self._half)

"""What a broken symmetry makes of the symmetric stator's named modes: shifts, and complex splits of doublets."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.mixed_names import able_of, ways_of
from statorhom.model.broken.solve import BrokenModes
from statorhom.model.harmonic import Harmonic

_K = TypeVar("_K", bound=Hashable)

LEAST = 0.2  # share of a doublet's plane that its two modes must keep to be called its own
NEAR = 0.08  # of ln f: up to which modes that are mixed may be called by each other's names


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


@dataclass(frozen=True)
class Way:
    """What a named mode is if other broken modes are called by its name; `shift` and `split` as of `Response`."""

    shift: float
    split: complex
    chance: float


@dataclass(frozen=True, eq=False)
class Response:
    """Of one named mode.

    Parameters
    ----------
    shift : change of ln f of the doublet's mean λ.
    split : complex split b_r over the mean λ (`statorhom.modes.doublets.complex_split`).
    other_axial : count of node planes that it may show as well as its own.
    profile : (heights,) its order's radial motion along the axis; None where nobody asked.
    chance : that the modes which have most of it are those that are called by its name.
    ways : the others, where modes are mixtures of several names.
    lines : every mode that may be called by the name, alone.
    """

    shift: float
    split: complex
    other_axial: int | None = None
    profile: np.ndarray | None = None
    chance: float = 1.0
    ways: tuple[Way, ...] = ()
    lines: tuple[Way, ...] = ()


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
    return NearestPair(chosen, nearest_rotation(parts[:, chosen]))


def nearest_rotation(parts: np.ndarray) -> np.ndarray:
    """Nearest orthonormal matrix (k, k) to named modes' parts (k, k) in broken ones."""
    left, _, right = np.linalg.svd(parts)
    return np.asarray(left @ right)


def named_response(modes: BrokenModes, place: Columns) -> Response | None:
    """Response of a named mode; None where it can no longer be told among the broken ones."""
    pair = nearest_pair(modes, place)
    return None if pair is None else response_of(modes, place, pair)


def response_of(
    modes: BrokenModes, place: Columns, pair: NearestPair, shares: np.ndarray | None = None
) -> Response:
    """Response of a named mode whose broken modes are known, with those that may be called by its name instead.

    Parameters
    ----------
    shares : (modes,) of the name in what is seen of every broken mode; by default in its mass.
    """
    if shares is None:
        shares = np.sum(modes.participation[place.numbers] ** 2, axis=0)
    able = able_of(shares, _near(modes, pair))
    own, *others = ways_of(able, pair.modes)
    shift, split = _seen(modes, place, own.modes)
    ways = tuple(Way(*_seen(modes, place, other.modes), other.chance) for other in others)
    lines = tuple(Way(*_seen(modes, place, np.array([number])), chance) for number, chance in able.items())
    return Response(shift, split, chance=own.chance, ways=ways, lines=lines)


def seen_shares(modes: BrokenModes, places: Mapping[_K, Columns], seen: np.ndarray) -> dict[_K, np.ndarray]:
    """(modes,) share of every named mode in what is seen of the broken ones.

    Parameters
    ----------
    places : of the named modes.
    seen : (coordinates,) mean square radial motion of the surface by a unit of each: a mode is called by what of it is
        seen, and the surface hardly moves in one across the sheets.
    """
    motion = seen[:, None] * modes.participation**2
    whole = np.maximum(motion.sum(axis=0), np.finfo(float).tiny)
    return {key: motion[place.numbers].sum(axis=0) / whole for key, place in places.items()}


def _seen(modes: BrokenModes, place: Columns, chosen: np.ndarray) -> tuple[float, complex]:
    """Shift and split of a named mode if these broken modes are what is called by its name."""
    values = modes.eigenvalues[chosen]
    mean = float(values.mean())
    shift = 0.5 * float(np.log(mean / place.eigenvalue))
    if len(chosen) == 1:
        return shift, 0j
    rotation = nearest_rotation(modes.participation[place.numbers][:, chosen])
    effective = rotation @ np.diag(values) @ rotation.T
    return shift, complex(effective[0, 0] - effective[1, 1], 2 * effective[0, 1]) / mean


def _near(modes: BrokenModes, pair: NearestPair) -> np.ndarray:
    """Numbers of the broken modes that are no farther away than such as mix."""
    away = 0.5 * np.log(np.maximum(modes.eigenvalues, 1.0) / modes.eigenvalues[pair.modes].mean())
    return np.union1d(pair.modes, np.flatnonzero(np.abs(away) < NEAR))

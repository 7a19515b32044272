"""Which broken modes are called by a name: where an effect brings modes together, each is a mixture of several names.

A heavy lump makes of (1, 1) and (4, 1) modes that are half of each. Which one is called by which name depends on what
of them the measuring points see; their frequencies do not. So there are several sharp answers, each with a chance, and
no blurred one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

SURE = 2  # power: a mode of which six tenths are one name's and four another's is called by the first 7 times of 10
LEAST = 0.02  # chance, below which a mode is not called by a name, nor are several of them at once
DOUBT = 1e-4  # share of another name that every mode has: nothing is quite certain
MISSED = 0.1  # chance that a line is not found: of three that are called alike any two may be a doublet's
MOST = 5  # modes that may be called by one name


@dataclass(frozen=True, eq=False)
class Called:
    """Broken modes that are called by a name.

    Parameters
    ----------
    modes : their numbers, ascending.
    chance : of that.
    """

    modes: np.ndarray
    chance: float


def ways_of(able: Mapping[int, float], usual: np.ndarray) -> list[Called]:
    """Ways in which broken modes may be called by a name, the usual one first; their chances add up to one.

    Parameters
    ----------
    able : broken modes that may be called by it, each with its chance (`able_of`).
    usual : (k,) numbers of those that have most of it, as many as it has modes.
    """
    able = dict(able) | {int(n): able.get(int(n), LEAST) for n in usual}
    most = len(usual)
    ways = [tuple(sorted(usual.tolist())), *_some(able, most)]
    found = {some: _together(able, some, MISSED if len(some) == most else 0.0) for some in ways}
    whole = sum(found.values())
    kept = [(some, chance / whole) for some, chance in found.items()]
    return [Called(np.array(some), c) for i, (some, c) in enumerate(kept) if i == 0 or c > LEAST]


def able_of(shares: np.ndarray, near: np.ndarray) -> dict[int, float]:
    """Broken modes that may be called by a name, each with its chance.

    Parameters
    ----------
    shares : (modes,) of the name in every broken mode.
    near : numbers of the broken modes that are near enough.
    """
    chances = chances_of(shares[near])
    likeliest = near[np.argsort(-chances)[:MOST]]
    return {int(n): float(c) for n, c in zip(near, chances, strict=True) if n in likeliest and c > LEAST}


def chances_of(shares: np.ndarray) -> np.ndarray:
    """That modes with these shares of a name are called by it, and not by the names of what else they are of."""
    own, other = np.clip(shares, 0.0, 1.0) ** SURE, np.clip(1.0 - shares, DOUBT, 1.0) ** SURE
    return np.asarray(own / (own + other))


def _some(able: dict[int, float], most: int) -> Iterator[tuple[int, ...]]:
    """Choices of one mode up to `most`: a doublet's other line may be called otherwise."""
    for count in range(1, most + 1):
        yield from combinations(sorted(able), count)


def _together(able: dict[int, float], chosen: tuple[int, ...], missed: float) -> float:
    """Chance that these and no others are found by the name, of which a line is missed by another chance."""
    return float(np.prod([c if n in chosen else 1.0 - (1.0 - missed) * c for n, c in able.items()]))

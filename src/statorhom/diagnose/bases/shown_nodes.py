"""How many node planes a mode of the broken stator shows.

What breaks the symmetry about the core's middle mixes modes of one order with other counts of node planes. A mode whose
own surface hardly moves is then seen, and counted, by what it has of one that moves more.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.model.broken.named_response import Columns
from statorhom.model.broken.solve import BrokenModes
from statorhom.model.convergence import ModeKey
from statorhom.model.stator_mode import StatorMode

PART = 0.5  # of the mean square motion of its own count from which on another one may be what is counted


def shown_nodes(
    modes: BrokenModes, columns: Mapping[ModeKey, Columns], named: Mapping[ModeKey, StatorMode]
) -> dict[ModeKey, int]:
    """Counts of node planes that modes may show as well as their own.

    Parameters
    ----------
    columns : places of the named modes among the broken ones' coordinates.
    named : the symmetric stator's modes.
    """
    found: dict[ModeKey, int] = {}
    if modes.participation.shape[1] == 0:
        return found  # none in the band
    for order in {key[0] for key in columns}:
        keys = [key for key in columns if key[0] == order]
        # mean square part of every named mode of the order in every broken one, (keys, modes)
        parts = np.array([_mean_square(modes, columns[key]) for key in keys])
        visible = np.array([named[key].visibility if key in named else 0.0 for key in keys])
        for part, key in zip(parts, keys, strict=True):
            chosen = np.argsort(-part)[: len(columns[key].numbers)]
            seen: dict[int, float] = {}
            for its, share in zip(keys, (visible * parts[:, chosen].mean(axis=1)).tolist(), strict=True):
                seen[its[1]] = seen.get(its[1], 0.0) + share
            mine = seen.pop(key[1], 0.0)
            other = max(seen, key=seen.__getitem__, default=None)
            if other is not None and seen[other] > PART * mine:
                found[key] = other
    return found


def _mean_square(modes: BrokenModes, place: Columns) -> np.ndarray:
    """Of a named mode's products by mass with the broken ones, (modes,)."""
    return np.asarray(np.mean(modes.participation[place.numbers] ** 2, axis=0))

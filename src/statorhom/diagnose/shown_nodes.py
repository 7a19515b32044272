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
    own = {key: _own(modes, place) for key, place in columns.items()}
    found = {}
    for key, chosen in own.items():
        seen: dict[int, float] = {}
        for its, place in columns.items():
            if its[0] == key[0] and its in named:
                share = np.mean(modes.participation[place.numbers][:, chosen] ** 2)
                seen[its[1]] = seen.get(its[1], 0.0) + float(share) * named[its].visibility
        mine = seen.pop(key[1], 0.0)
        other = max(seen, key=seen.__getitem__, default=None)
        if other is not None and seen[other] > PART * mine:
            found[key] = other
    return found


def _own(modes: BrokenModes, place: Columns) -> np.ndarray:
    """Numbers of the broken modes that have most of a named one."""
    weight = np.sum(modes.participation[place.numbers] ** 2, axis=0)
    return np.argsort(-weight)[: len(place.numbers)]

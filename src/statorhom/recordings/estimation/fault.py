"""What is wrong with a hit, in one sentence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

FaultKind = Literal[
    "no_hit",  # the force holds no pulse
    "short",  # the record is much shorter than the others
    "double_hit",  # a second pulse after contact ended
    "overload",  # a channel was clipped
    "leakage",  # the response had not decayed when the record ended
    "weak",  # far weaker than the other hits, or a response that does not move
    "bandwidth",  # the force does not reach up to the frequencies that were asked for
    "noisy_force",  # the force's noise is not small beside its pulse
]
"""Kinds of faults."""

NEVER_USED: frozenset[FaultKind] = frozenset({"no_hit", "short"})
"""Hits that hold no FRF."""

LEFT_OUT: frozenset[FaultKind] = frozenset({"double_hit", "overload"})
"""Hits that an average is better without, unless the user keeps them."""


@dataclass(frozen=True)
class Fault:
    """A fault of a hit.

    Attributes
    ----------
    hit : int
        Number of the hit.
    channel : int or None
        Row of the accelerations; None where the force or the whole hit is meant.
    kind : FaultKind
    statement : str
        One sentence that names file, hit and channel and says what was seen.
    """

    hit: int
    channel: int | None
    kind: FaultKind
    statement: str

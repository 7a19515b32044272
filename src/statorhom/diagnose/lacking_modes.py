"""Modes that were measured and that the declared model has nowhere near.

A scan compares modes with their partners. Where the model is so far off that many find none, the rest may fit well
enough, and nothing but their number tells that something is missing.
"""

from __future__ import annotations

from statorhom.diagnose.refit import Refit

MANY, PART = 3, 0.2  # named modes without a partner, in all and of all: one or two may be images of others


def lacks_modes(base: Refit) -> bool:
    """Whether so many named modes of free tests have no partner that it is no accident."""
    found = [f for f in base.hypothesis.features(base.z) if f.kind == "frequency"]
    lost = sum(f.stray for f in found)
    return lost >= max(MANY, PART * len(found))

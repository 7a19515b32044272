"""Modes that were measured and that the declared model has nowhere near.

A scan compares modes with their partners. Where the model is so far off that many find none, the rest may fit well
enough, and nothing but their number tells that something is missing.
"""

from __future__ import annotations

from collections import Counter

from statorhom.diagnose.fits.refit import Refit

# Named modes of a test without a partner, in number and of all: one or two may be images of others.
MANY, PART = 3, 0.2


def lacks_modes(base: Refit) -> bool:
    """Whether so many named modes of a free test have no partner that it is no accident."""
    found = [f for f in base.hypothesis.features(base.z) if f.kind == "frequency"]
    modes = Counter(f.test for f in found)
    lost = Counter(f.test for f in found if f.stray)
    return any(number >= max(MANY, PART * modes[test]) for test, number in lost.items())

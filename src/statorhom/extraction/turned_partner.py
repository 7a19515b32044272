"""The other mode of a doublet that a roving sensor turns.

A sensor's mass turns a doublet until one mode has its antinode at the sensor and moves, and the other one its
node there and stays. What the FRFs show of the mode that stays is no shape: every set-up sees another one.
It has the name of the mode that moves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from statorhom.extraction.extraction import ExtractedMode

_ABOVE = 2.0  # of the moving mode's largest shift up, that its partner may lie above it


def turned_partners(
    modes: Sequence[ExtractedMode], names: Mapping[int, tuple[int, int | None]]
) -> dict[int, tuple[int, int | None]]:
    """Names of modes that stay just above one that moves from point to point, by number.

    Parameters
    ----------
    modes : sequence of ExtractedMode
    names : number of a mode → (r, n)
    """
    found = {}
    for m, mode in enumerate(modes):
        if mode.shift is None or len(mode.shift) == 1 or names.get(m, (0, None))[0] < 1:
            continue
        bandwidth = mode.bandwidth_hz / mode.frequency_hz
        reach = _ABOVE * max(float(mode.shift.real.max()), bandwidth)
        for other, steady in enumerate(modes):
            above = steady.frequency_hz / mode.frequency_hz - 1
            if steady.shift is None and 0 < above < reach:
                found[other] = names[m]
    return found

"""The other mode of a doublet that a roving sensor turns.

A sensor's mass turns a doublet until one mode has its antinode at the sensor and moves, and the other one its
node there and stays. What the FRFs show of the mode that stays is no shape: every set-up sees another one.
It has the name of the mode that moves.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from statorhom.extraction.extraction import ExtractedMode

_ABOVE = 2.0  # of the moving mode's largest shift up, that its partner may lie above it
_WIDE = 0.02  # relative: no sensor moves a mode so far that a broader resonance than this tells its partner


def turned_partners(
    modes: Sequence[ExtractedMode],
    names: Mapping[int, tuple[int, int | None]],
    clear: Collection[int] = (),
) -> dict[int, tuple[int, int | None]]:
    """Names of modes that stay just above one that moves from point to point, by number.

    Parameters
    ----------
    modes : sequence of ExtractedMode
    names : number of a mode → (r, n)
    clear : numbers of the modes whose own shape leaves no doubt about its order.
    """
    found = {}
    for m, mode in enumerate(modes):
        if mode.shift is None or len(mode.shift) == 1 or names.get(m, (0, None))[0] < 1:
            continue
        bandwidth = min(mode.bandwidth_hz / mode.frequency_hz, _WIDE)
        reach = _ABOVE * max(float(mode.shift.real.max()), bandwidth)
        for other, steady in enumerate(modes):
            above = steady.frequency_hz / mode.frequency_hz - 1
            other_order = other in clear and names[other][0] != names[m][0]
            if steady.shift is None and 0 < above < reach and not other_order:
                found[other] = names[m]
    return found

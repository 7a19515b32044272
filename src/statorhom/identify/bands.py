"""Which harmonics a stage's measured modes can live in."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.model.affine import AffineModel, Materials
from statorhom.model.free_modes import solve_free
from statorhom.study.modal_table import MeasuredMode

MARGIN = 1.6  # the softest and the stiffest materials of the prior move modes in and out of the band
LEAST_VISIBLE = 0.05
ENOUGH = 16  # modes of a harmonic among which its visible ones begin to show

Names = set[tuple[int, int | None]]


def highest_hz(modes: Sequence[MeasuredMode]) -> float:
    """Highest measured frequency."""
    return max(mode.frequency_hz for mode in modes)


def mode_names(
    model: AffineModel, materials: Materials, modes: Sequence[MeasuredMode], margin: float = MARGIN
) -> Names:
    """Names (r, n) that the modes have or may have; n None where it is open.

    Labelled modes live in the harmonic of their label. One that has no label may be any visible mode of the band:
    the orders whose lowest visible mode at typical materials lies in it.

    Parameters
    ----------
    model, materials : to look for the orders with.
    modes : measured modes.
    margin : how far beyond the highest unlabelled mode, as a part of its frequency.
    """
    names: Names = {(m.order, m.axial) for m in modes if m.order is not None}
    unlabelled = [m for m in modes if m.order is None]
    if unlabelled:
        names |= {
            (order, None) for order in _visible_orders(model, materials, margin * highest_hz(unlabelled))
        }
    return names


def _visible_orders(model: AffineModel, materials: Materials, top_hz: float) -> list[int]:
    solution = solve_free(model, materials, top_hz, most=ENOUGH)
    visible = {solution.harmonics[m.problem].order for m in solution.modes if m.visibility > LEAST_VISIBLE}
    found = []
    for order in range(model.mesh.slots // 2 + 1):
        if order in visible:
            found.append(order)
        elif order > 2:
            break  # beyond the ovalling order, visible modes rise with the order
    return found

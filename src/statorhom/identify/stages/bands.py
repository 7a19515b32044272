"""Which harmonics a stage's measured modes can live in."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.mesh.hex_mesh import HalfPitchMesh, PartMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.free_modes import solve_free
from statorhom.model.harmonic import problems_of
from statorhom.model.problems import orders_of, spaces_of
from statorhom.model.space import Space
from statorhom.study.modal_table import MeasuredMode

MARGIN = 1.6  # the softest and the stiffest materials of the prior move modes in and out of the band
LEAST_VISIBLE = 0.05
ENOUGH = 16  # modes of a harmonic among which its visible ones begin to show

Names = set[tuple[int, int | None]]


def highest_hz(modes: Sequence[MeasuredMode]) -> float:
    """Highest measured frequency."""
    return max(mode.frequency_hz for mode in modes)


def mode_names(
    model: AffineModel[PartMesh],
    materials: Materials,
    modes: Sequence[MeasuredMode],
    margin: float = MARGIN,
) -> Names:
    """Names (r, n) that the modes have or may have; n None where it is open.

    Labelled modes live in the harmonic of their label. One that has no label may be any visible mode of the band:
    the orders whose lowest visible mode at typical materials lies in it. A body with mirror planes has few problems,
    and modes of any band live in all of them.

    Parameters
    ----------
    model, materials : to look for the orders with.
    modes : measured modes.
    margin : how far beyond the highest unlabelled mode, as a part of its frequency.
    """
    if not isinstance(model.mesh, HalfPitchMesh):
        return {(order, None) for order in orders_of(model.mesh)}
    names: Names = {(m.order, m.axial) for m in modes if m.order is not None}
    unlabelled = [m for m in modes if m.order is None]
    if unlabelled:
        names |= {
            (order, None) for order in _visible_orders(model, materials, margin * highest_hz(unlabelled))
        }
    return names


def named_spaces(mesh: PartMesh, names: Names) -> Sequence[Space]:
    """The problems that hold the modes of some names."""
    if isinstance(mesh, HalfPitchMesh):
        return problems_of(mesh, names)
    return [space for order in sorted({r for r, _ in names}) for space in spaces_of(mesh, order)]


def _visible_orders(model: AffineModel[PartMesh], materials: Materials, top_hz: float) -> list[int]:
    solution = solve_free(model, materials, top_hz, most=ENOUGH)
    visible = {solution.harmonics[m.problem].order for m in solution.modes if m.visibility > LEAST_VISIBLE}
    found = []
    for order in orders_of(model.mesh):
        if order in visible:
            found.append(order)
        elif order > 2:
            break  # beyond the ovalling order, visible modes rise with the order
    return found

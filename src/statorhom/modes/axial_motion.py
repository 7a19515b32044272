"""Axial motion of a stator's outer surface in its radial modes, where only the radial motion was measured.

A ring that bends without stretching moves radially as A(z) cos rθ, tangentially as −A(z)/r sin rθ, and axially as
−ℓ A'(z) cos rθ. Where the middle surface of the yoke does not shear, ℓ = R_m/r² + h/2 on the outer surface, with
the middle radius R_m and the thickness h of the yoke (Love's inextensional displacements, Treatise, 1927,
§ 321, with the section's rotation added).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

_HALF_YOKE, _HALF_YOKE_SD = 0.10, 0.03  # of the outer radius: usual half thickness of a yoke
# Compared with full models of three slotted cores (36, 48, 54 slots), G_rz 3 … 43 GPa:
_UNSHEARED_SD = 0.08  # relative: modes (r ≥ 2, 1) of cores that are stiff in shear
_UNKNOWN_SD = 0.25  # relative: nothing tells whether the sheets slide
_WARPED, _WARPED_SD = 0.145, 0.02  # of the radius: other n, where E_z hinders the warping; r matters no more
_BEAM, _BEAM_SD = 0.15, 0.15  # of the radius: r = 1, where shear and bending mix
_STIFF = 1.0  # f(r, 1)/f(r, 0) from which on sheets do not slide


@dataclass(frozen=True)
class AxialLever:
    """Axial motion of the outer surface over the slope of its radial motion, at the same angle.

    Attributes
    ----------
    length_m, sd_m : float
        ℓ and its standard deviation (m); infinite where sheets slide: such a stack is near the resonance of
        its own axial motion, which may be several times larger.
    """

    length_m: float
    sd_m: float


def axial_lever(order: int, axial: int, radius_m: float, slides: bool | None = None) -> AxialLever:
    """Axial motion of a radial mode (r, n) on the surface of a given radius.

    Parameters
    ----------
    slides : bool or None
        Whether the stack is soft in shear, see `sheets_slide`; None where unknown.
    """
    if order < 2:
        return AxialLever(_BEAM * radius_m, _BEAM_SD * radius_m)
    if axial != 1:
        return AxialLever(_WARPED * radius_m, _WARPED_SD * radius_m)
    length = (1 - _HALF_YOKE) / order**2 + _HALF_YOKE
    if slides:
        return AxialLever(length * radius_m, math.inf)
    thickness = _HALF_YOKE_SD * (1 - 1 / order**2)
    model = (_UNKNOWN_SD if slides is None else _UNSHEARED_SD) * length
    return AxialLever(length * radius_m, math.hypot(thickness, model) * radius_m)


def sheets_slide(frequency_hz: Mapping[tuple[int, int], float]) -> bool | None:
    """Whether antisymmetric modes lie as low as symmetric ones, which only a stack soft in shear has.

    Parameters
    ----------
    frequency_hz : (r, n) → frequency.

    Returns
    -------
    bool or None
        None where no order r ≥ 2 has both modes.
    """
    ratios = [
        frequency_hz[(order, 1)] / frequency
        for (order, axial), frequency in frequency_hz.items()
        if axial == 0 and order >= 2 and (order, 1) in frequency_hz
    ]
    return min(ratios) < _STIFF if ratios else None

"""Shear modulus across round fibres, for which two estimates are in use."""

from __future__ import annotations

import math
from collections.abc import Callable

from statorhom.materials.homogenization.hill_moduli import HillModuli

TransverseShear = Callable[[HillModuli, HillModuli, float], float]


def mori_tanaka(fibre: HillModuli, matrix: HillModuli, fraction: float) -> float:
    """Estimate G_T as if each fibre felt the mean strain of the matrix.

    G_T = G_m + f / [1/(G_f − G_m) + (1−f)(k_m + 2G_m) / (2G_m(k_m + G_m))]; for fibres stiffer than the
    matrix it is Hashin and Rosen's lower bound (J. Appl. Mech. 31, 1964, 223–232).

    Parameters
    ----------
    fibre, matrix : HillModuli
        Only k and G_T count.
    fraction : float
        Share f of the fibres in the volume, 0 … 1.

    Returns
    -------
    float
        G_T in Pa.
    """
    g, k = matrix.G_T_pa, matrix.k_pa
    contrast = fibre.G_T_pa - g
    constraint = (1.0 - fraction) * (k + 2.0 * g) / (2.0 * g * (k + g))
    return g + fraction * contrast / (1.0 + contrast * constraint)


def self_consistent(fibre: HillModuli, matrix: HillModuli, fraction: float) -> float:
    """Estimate G_T by a fibre in its sheath of matrix in the composite sought (generalized self-consistent).

    The positive root of A x² + 2B x + C = 0, x = G_T/G_m (R. M. Christensen and K. H. Lo, J. Mech.
    Phys. Solids 27, 1979, 315–330, with the correction of 1986); it exceeds `mori_tanaka` where stiff
    fibres are packed densely.

    Parameters
    ----------
    fibre, matrix : HillModuli
        Only k and G_T count.
    fraction : float
        Share f of the fibres in the volume, 0 … 1.

    Returns
    -------
    float
        G_T in Pa.
    """
    a, b, c = _christensen_lo(fibre.G_T_pa / matrix.G_T_pa, _kappa(fibre), _kappa(matrix), fraction)
    # A < 0 < C: of the two roots this one is positive
    return matrix.G_T_pa * -(b + math.sqrt(b * b - a * c)) / a


def _kappa(phase: HillModuli) -> float:
    """Kolosov's 3 − 4ν of plane strain, 1 + 2 G_T/k; a void may have any."""
    return 1.0 + 2.0 * phase.G_T_pa / phase.k_pa if phase.k_pa > 0.0 else 1.0


def _christensen_lo(ratio: float, eta_f: float, eta_m: float, f: float) -> tuple[float, float, float]:
    """Coefficients A, B, C for the ratio G_f/G_m, Kolosov's constants and the fibre fraction."""
    common = 3.0 * f * (1.0 - f) ** 2 * (ratio - 1.0) * (ratio + eta_f)
    mismatch = (ratio * eta_m - eta_f) * f**3
    dilute = ratio * eta_m + (ratio - 1.0) * f + 1.0
    a = common + (ratio * eta_m + eta_f * eta_m - mismatch) * (
        f * eta_m * (ratio - 1.0) - (ratio * eta_m + 1.0)
    )
    b = (
        -common
        + 0.5 * dilute * ((eta_m - 1.0) * (ratio + eta_f) - 2.0 * mismatch)
        + 0.5 * f * (eta_m + 1.0) * (ratio - 1.0) * (ratio + eta_f + mismatch)
    )
    c = common + dilute * (ratio + eta_f + mismatch)
    return a, b, c

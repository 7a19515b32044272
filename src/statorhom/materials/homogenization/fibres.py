"""Parallel round fibres in a matrix (Hashin and Rosen 1964, Hill 1964)."""

from __future__ import annotations

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.hill_moduli import HillModuli
from statorhom.materials.homogenization.transverse_shear import TransverseShear, mori_tanaka
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic


def embed(
    fibre: HillModuli,
    matrix: HillModuli,
    fraction: float,
    transverse_shear: TransverseShear = mori_tanaka,
) -> HillModuli:
    """Homogenize fibres in a matrix; composites can be nested.

    Composite cylinders: E_L, ν_L, k and G_L are exact for them (Z. Hashin and B. W. Rosen,
    J. Appl. Mech. 31, 1964; R. Hill, J. Mech. Phys. Solids 12, 1964, 199–212; for phases that are
    themselves transversely isotropic Z. Hashin, J. Appl. Mech. 46, 1979, 543–550). The formulas are
    arranged so that equal phases and voids as fibres need no special case.

    Parameters
    ----------
    fibre, matrix : HillModuli
        The matrix must not be a void.
    fraction : float
        Share f of the fibres in the volume, 0 … 1.
    transverse_shear : callable
        The estimate of G_T, see `transverse_shear`.

    Raises
    ------
    MaterialError
        The fraction lies outside 0 … 1, or the matrix is a void.
    """
    if not 0.0 <= fraction <= 1.0:
        raise MaterialError(f"fibres: their volume fraction must lie in 0 … 1, is {fraction:.6g}")
    if min(matrix.k_pa, matrix.G_T_pa, matrix.G_L_pa, matrix.E_L_pa) <= 0.0:
        raise MaterialError("fibres: the matrix must have stiffness, a void holds nothing together")
    f, m = fraction, 1.0 - fraction
    k_f, k_m, g_m = fibre.k_pa, matrix.k_pa, matrix.G_T_pa
    # k_f k_m (m/k_f + f/k_m + 1/G_m): D of the textbook, free of the division by k_f
    kkd = m * k_m + f * k_f + k_f * k_m / g_m
    delta_nu, delta_k = fibre.nu_l - matrix.nu_l, k_f - k_m
    return HillModuli(
        E_L_pa=f * fibre.E_L_pa + m * matrix.E_L_pa + 4.0 * f * m * delta_nu**2 * k_f * k_m / kkd,
        nu_l=f * fibre.nu_l + m * matrix.nu_l + f * m * delta_nu * delta_k / kkd,
        k_pa=k_m + f * delta_k / (1.0 + delta_k * m / (k_m + g_m)),
        G_T_pa=transverse_shear(fibre, matrix, fraction),
        G_L_pa=_longitudinal_shear(fibre.G_L_pa, matrix.G_L_pa, fraction),
    )


def homogenize_fibres(
    fibre: Isotropic | TransverselyIsotropic,
    matrix: Isotropic | TransverselyIsotropic,
    fraction: float,
    transverse_shear: TransverseShear = mori_tanaka,
) -> TransverselyIsotropic:
    """Return the equivalent material of parallel fibres along z in a matrix, by `embed`.

    Raises
    ------
    MaterialError
        The fraction lies outside 0 … 1.
    """
    return embed(HillModuli.of(fibre), HillModuli.of(matrix), fraction, transverse_shear).engineering()


def _longitudinal_shear(g_f: float, g_m: float, fraction: float) -> float:
    """G_L = G_m [G_f (1+f) + G_m (1−f)] / [G_f (1−f) + G_m (1+f)]."""
    m, p = 1.0 - fraction, 1.0 + fraction
    return g_m * (g_f * p + g_m * m) / (g_f * m + g_m * p)

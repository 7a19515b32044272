from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from material_strategies import isotropic

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.fibres import embed, homogenize_fibres
from statorhom.materials.homogenization.hill_moduli import VOID, HillModuli
from statorhom.materials.homogenization.transverse_shear import self_consistent
from statorhom.materials.isotropic import Isotropic

COPPER = Isotropic(120e9, 0.34)
PHASE = isotropic(lowest_nu=0.0)
FRACTION = st.floats(0.0, 1.0)


@pytest.mark.parametrize(
    ("resin", "in_gpa", "tolerance"),
    [
        (Isotropic(3e9, 0.35), (49.8, 6.61, 2.48), 1.5e-3),
        (Isotropic(0.1e9, 0.45), (48.1, 0.27, 0.08), 5e-3),
    ],
)
def test_copper_in_resin_gives_the_published_figures(resin, in_gpa, tolerance):
    winding = homogenize_fibres(COPPER, resin, 0.40)
    found = np.array([winding.E_z_pa, winding.E_p_pa, winding.G_rz_pa]) / 1e9
    assert found == pytest.approx(in_gpa, rel=tolerance)


def textbook(fibre, matrix, f):
    """Hashin and Hill's formulas as they are printed."""
    m = 1.0 - f
    k_f, k_m = (phase.E_pa / (2.0 * (1.0 + phase.nu) * (1.0 - 2.0 * phase.nu)) for phase in (fibre, matrix))
    g_f, g_m = fibre.shear_modulus_pa, matrix.shear_modulus_pa
    d = m / k_f + f / k_m + 1.0 / g_m
    delta = fibre.nu - matrix.nu
    return HillModuli(
        E_L_pa=f * fibre.E_pa + m * matrix.E_pa + 4.0 * f * m * delta**2 / d,
        nu_l=f * fibre.nu + m * matrix.nu + f * m * delta * (1.0 / k_m - 1.0 / k_f) / d,
        k_pa=k_m + f / (1.0 / (k_f - k_m) + m / (k_m + g_m)),
        G_T_pa=g_m + f / (1.0 / (g_f - g_m) + m * (k_m + 2.0 * g_m) / (2.0 * g_m * (k_m + g_m))),
        G_L_pa=g_m * (g_f * (1.0 + f) + g_m * m) / (g_f * m + g_m * (1.0 + f)),
    )


@settings(deadline=None)
@given(st.floats(20e9, 200e9), st.floats(0.2, 0.4), st.floats(0.1e9, 10e9), st.floats(0.2, 0.45), FRACTION)
def test_the_rearranged_formulas_are_the_printed_ones(e_f, nu_f, e_m, nu_m, fraction):
    fibre, matrix = Isotropic(e_f, nu_f), Isotropic(e_m, nu_m)
    found = embed(HillModuli.of(fibre), HillModuli.of(matrix), fraction)
    printed = textbook(fibre, matrix, fraction)
    for name in ("E_L_pa", "nu_l", "k_pa", "G_T_pa", "G_L_pa"):
        assert getattr(found, name) == pytest.approx(getattr(printed, name), rel=1e-8)


@settings(deadline=None)
@given(PHASE, PHASE, FRACTION)
def test_the_limits_are_the_phases(fibre, matrix, fraction):
    for composite, phase in (
        (homogenize_fibres(fibre, matrix, 0.0), matrix),
        (homogenize_fibres(fibre, matrix, 1.0), fibre),
        (homogenize_fibres(matrix, matrix, fraction), matrix),
    ):
        expected = phase.hooke().matrix
        assert composite.hooke().matrix == pytest.approx(expected, rel=1e-6, abs=1e-7 * expected.max())


@settings(deadline=None)
@given(PHASE, PHASE, FRACTION, st.sampled_from([None, self_consistent]))
def test_the_stiffness_lies_between_reuss_and_voigt(fibre, matrix, fraction, estimate):
    chosen = {} if estimate is None else {"transverse_shear": estimate}
    found = homogenize_fibres(fibre, matrix, fraction, **chosen).hooke()
    stiff, soft = fibre.hooke(), matrix.hooke()
    voigt = fraction * stiff.matrix + (1.0 - fraction) * soft.matrix
    reuss = fraction * stiff.compliance + (1.0 - fraction) * soft.compliance
    assert np.linalg.eigvalsh(voigt - found.matrix).min() >= -1e-7 * voigt.max()
    assert np.linalg.eigvalsh(reuss - found.compliance).min() >= -1e-7 * reuss.max()


def test_void_channels_are_the_limit_of_ever_softer_fibres():
    resin = HillModuli.of(Isotropic(3e9, 0.35))
    channels = embed(VOID, resin, 0.4)
    soft = embed(HillModuli.of(Isotropic(1.0, 0.1)), resin, 0.4)
    for name in ("E_L_pa", "nu_l", "k_pa", "G_T_pa", "G_L_pa"):
        assert getattr(channels, name) == pytest.approx(getattr(soft, name), rel=1e-6)
    assert channels.E_L_pa == pytest.approx(0.6 * 3e9)
    assert channels.nu_l == pytest.approx(0.35)


def test_what_holds_nothing_together_is_refused():
    resin = HillModuli.of(Isotropic(3e9, 0.35))
    with pytest.raises(MaterialError, match="the matrix must have stiffness"):
        embed(resin, VOID, 0.4)
    with pytest.raises(MaterialError, match="the matrix must have stiffness"):
        embed(resin, replace(resin, G_L_pa=0.0), 0.4)
    with pytest.raises(MaterialError, match=r"volume fraction must lie in 0 … 1, is 1\.2"):
        homogenize_fibres(COPPER, Isotropic(3e9, 0.35), 1.2)

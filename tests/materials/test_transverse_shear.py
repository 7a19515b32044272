import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.materials.homogenization.hill_moduli import VOID, HillModuli
from statorhom.materials.homogenization.transverse_shear import mori_tanaka, self_consistent
from statorhom.materials.isotropic import Isotropic

PHASE = st.builds(
    lambda exponent, nu: HillModuli.of(Isotropic(10.0**exponent, nu)),
    st.floats(8.0, 10.5),
    st.floats(0.0, 0.45),
)
COPPER, RESIN = HillModuli.of(Isotropic(120e9, 0.34)), HillModuli.of(Isotropic(3e9, 0.35))
ESTIMATES = pytest.mark.parametrize("estimate", [mori_tanaka, self_consistent])


def michell(radius, shear, kappa):
    """Columns: u_r, u_θ, σ_rr, σ_rθ of the stress functions r², r⁴, r⁻², 1 times cos 2θ (plane strain)."""
    r = radius
    displacements = np.array(
        [
            [-2.0 * r, (kappa - 3.0) * r**3, 2.0 * r**-3, (kappa + 1.0) / r],
            [2.0 * r, (kappa + 3.0) * r**3, 2.0 * r**-3, -(kappa - 1.0) / r],
        ]
    )
    stresses = np.array(
        [[-2.0, 0.0, -6.0 * r**-4, -4.0 * r**-2], [2.0, 6.0 * r**2, -6.0 * r**-4, -2.0 * r**-2]]
    )
    return np.vstack([displacements / (2.0 * shear), stresses])


def scattered(fibre, matrix, fraction, effective_shear):
    """Share of the 1/r field that a sheathed fibre sends into the medium around it, under remote shear.

    Christensen and Lo's condition is that it sends none.
    """

    def kappa(phase):
        return 1.0 + 2.0 * phase.G_T_pa / phase.k_pa

    inner = np.sqrt(fraction)
    core = michell(inner, fibre.G_T_pa, kappa(fibre))[:, :2]
    sheath_inside = michell(inner, matrix.G_T_pa, kappa(matrix))
    sheath_outside = michell(1.0, matrix.G_T_pa, kappa(matrix))
    medium = michell(1.0, effective_shear, 2.0)
    system = np.block(
        [[core, -sheath_inside, np.zeros((4, 2))], [np.zeros((4, 2)), sheath_outside, -medium[:, 2:]]]
    )
    remote = np.concatenate([np.zeros(4), medium[:, 0]])
    scale = np.array([1.0 / matrix.G_T_pa] * 2 + [1.0] * 2 + [1.0 / matrix.G_T_pa] * 2 + [1.0] * 2)
    return np.linalg.solve(system / scale[:, None], remote / scale)[-1]


@settings(deadline=None)
@given(PHASE, PHASE, st.floats(0.05, 0.95))
def test_a_sheathed_fibre_is_invisible_in_the_self_consistent_medium(fibre, matrix, fraction):
    found = self_consistent(fibre, matrix, fraction)
    assert scattered(fibre, matrix, fraction, found) == pytest.approx(0.0, abs=1e-6)
    if abs(fibre.G_T_pa / matrix.G_T_pa - 1.0) > 0.5:
        assert abs(scattered(fibre, matrix, fraction, 1.1 * found)) > 1e-3


@ESTIMATES
@settings(deadline=None)
@given(fibre=PHASE, matrix=PHASE)
def test_the_limits_are_the_phases(estimate, fibre, matrix):
    assert estimate(fibre, matrix, 0.0) == pytest.approx(matrix.G_T_pa, rel=1e-9)
    assert estimate(fibre, matrix, 1.0) == pytest.approx(fibre.G_T_pa, rel=1e-6)
    assert estimate(matrix, matrix, 0.4) == pytest.approx(matrix.G_T_pa, rel=1e-9)


@ESTIMATES
@settings(deadline=None)
@given(fibre=PHASE, matrix=PHASE, fraction=st.floats(0.0, 1.0))
def test_it_lies_between_reuss_and_voigt(estimate, fibre, matrix, fraction):
    voigt = fraction * fibre.G_T_pa + (1.0 - fraction) * matrix.G_T_pa
    reuss = 1.0 / (fraction / fibre.G_T_pa + (1.0 - fraction) / matrix.G_T_pa)
    assert reuss * (1.0 - 1e-6) <= estimate(fibre, matrix, fraction) <= voigt * (1.0 + 1e-6)


def test_stiff_fibres_stiffen_more_in_the_self_consistent_estimate():
    assert self_consistent(COPPER, RESIN, 0.6) > 1.05 * mori_tanaka(COPPER, RESIN, 0.6)
    # dilute fibres do not feel each other: the estimates differ in the second order only
    assert self_consistent(COPPER, RESIN, 1e-4) == pytest.approx(mori_tanaka(COPPER, RESIN, 1e-4), rel=1e-6)


@ESTIMATES
def test_channels_soften(estimate):
    half = estimate(VOID, RESIN, 0.5)
    assert 0.0 < half < 0.5 * RESIN.G_T_pa
    nearly_void = HillModuli.of(Isotropic(1.0, 0.2))
    assert estimate(nearly_void, RESIN, 0.5) == pytest.approx(half, rel=1e-6)


@ESTIMATES
@settings(deadline=None)
@given(matrix=PHASE, fraction=st.floats(0.0, 0.9), more=st.floats(0.01, 0.09))
def test_more_channels_are_softer(estimate, matrix, fraction, more):
    assert estimate(VOID, matrix, fraction + more) < estimate(VOID, matrix, fraction)

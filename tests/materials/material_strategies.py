"""Physically possible materials for the property tests, stiff and soft, nearly isotropic and far from it."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic

MODULI = st.floats(6.0, 12.0).map(lambda exponent: 10.0**exponent)


def isotropic(lowest_nu=-0.9):
    return st.builds(Isotropic, E_pa=MODULI, nu=st.floats(lowest_nu, 0.49))


@st.composite
def transversely_isotropic(draw):
    """Draw nu_pz as a share of the largest one that keeps the energy positive."""
    along, across, shear = draw(MODULI), draw(MODULI), draw(MODULI)
    nu_p = draw(st.floats(-0.9, 0.9))
    largest = np.sqrt((1.0 - nu_p) / 2.0 * across / along)
    return TransverselyIsotropic(across, along, nu_p, draw(st.floats(-0.95, 0.95)) * largest, shear)


@st.composite
def orthotropic(draw):
    """Draw a correlation matrix for the normal block of the compliance, so that it is positive definite."""
    factor = np.array([draw(st.floats(-1.0, 1.0)) for _ in range(6)]).reshape(2, 3)
    gram = factor.T @ factor + 0.1 * np.eye(3)
    spread = np.sqrt(np.diag(gram))
    correlation = gram / np.outer(spread, spread)
    moduli = [draw(MODULI) for _ in range(6)]

    def nu(i, j):
        return -correlation[i, j] * np.sqrt(moduli[i] / moduli[j])

    return Orthotropic(*moduli[:3], nu(0, 1), nu(0, 2), nu(1, 2), *moduli[3:])


def any_hooke():
    return st.one_of(isotropic(), transversely_isotropic(), orthotropic()).map(
        lambda material: material.hooke()
    )


@st.composite
def rotations(draw):
    """Draw a rotation from its quaternion."""
    q = np.array([draw(st.floats(-1.0, 1.0)) for _ in range(3)] + [draw(st.floats(0.1, 1.0))])
    x, y, z, w = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )

"""A small wound stator whose winding's stiffness is known to a factor: what reduced bases are tested on."""

from functools import cache

import numpy as np
from small_stators import STACK, stator_mesh

from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.mesh import MeshDensity, uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.eigen import modes_below
from statorhom.model.harmonic import harmonic_spaces
from statorhom.model.reduced import material_box, reduce_harmonic

TOP_HZ = 5000.0
CENTRE = np.log([2.0, 11.0, 0.9])  # E_p, E_z, G_rz of the winding in GPa
SPREAD = np.array([0.6, 0.5, 0.6])  # of their logarithms
TOLERANCE = 3e-4


def winding(z, density=3100.0):
    """Materials of a wound stator whose winding lies `z` standard deviations from the middle, (3,)."""
    e_p, e_z, g = 1e9 * np.exp(CENTRE + SPREAD * z)
    made = Material(TransverselyIsotropic(e_p, e_z, 0.33, 0.03, g).hooke(), density)
    return {"lamination": STACK, "winding": made, "overhang": made}


def draws(count, seed, widened=1.0):
    """Materials of the box."""
    z = np.random.default_rng(seed).standard_normal((count, 3))
    return [winding(widened * row) for row in np.clip(z, -2.0, 2.0)]


@cache
def wound():
    """Affine model of the stator."""
    cells = dict(uniform(1).cells) | {"core": 2, "yoke": 1, "overhang": 1, "radial": 1}
    return assemble(stator_mesh(8, ("stack", "wound"), MeshDensity(cells)))


@cache
def box():
    """The box in a few cells of several rooms."""
    training = [winding(np.zeros(3)), *draws(192, 1, 1.2)]
    return material_box(training, wound().mesh.regions, most=6, room_radius=0.7)


@cache
def space():
    """A harmonic of doublets."""
    return harmonic_spaces(wound().mesh, 2)[0]


@cache
def reduced():
    """The harmonic in its reduced bases."""
    return reduce_harmonic(wound(), space(), box(), TOP_HZ, TOLERANCE)


def full_modes(materials, harmonic=None, highest_hz=TOP_HZ):
    """Eigenpairs of the full model in one harmonic."""
    chosen = space() if harmonic is None else harmonic
    K, M = wound().stiffness_matrix(materials), wound().mass_matrix(materials)
    return modes_below(chosen.project(K), chosen.project(M), highest_hz)

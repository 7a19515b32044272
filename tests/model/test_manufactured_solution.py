"""Elastostatics of a ring sector with a displacement that was chosen first: the load follows from it."""

import numpy as np
import pytest
import scipy.sparse as sp
from small_stators import ORTHOTROPIC, ring_mesh

from statorhom.model.affine import Material, assemble
from statorhom.model.assembly import element_geometry, strain_matrix
from statorhom.model.eigen import factorize
from statorhom.model.element import gauss_table

INNER, OUTER, LENGTH = 0.04, 0.06, 0.03
C = ORTHOTROPIC.hooke().matrix
# component = radial · circumferential · axial factor, each with its derivative; lengths in units of 0.01 m
A = 100.0
FACTORS = [
    (
        (lambda r: np.sin(0.8 * A * r), lambda r: 0.8 * A * np.cos(0.8 * A * r)),
        (lambda t: np.cos(2 * t), lambda t: -2 * np.sin(2 * t)),
        (lambda z: np.exp(0.3 * A * z), lambda z: 0.3 * A * np.exp(0.3 * A * z)),
    ),
    (
        (lambda r: (A * r) ** 2 / 20, lambda r: A * A * r / 10),
        (lambda t: np.sin(3 * t), lambda t: 3 * np.cos(3 * t)),
        (lambda z: np.cos(0.9 * A * z), lambda z: -0.9 * A * np.sin(0.9 * A * z)),
    ),
    (
        (lambda r: np.cos(0.5 * A * r), lambda r: -0.5 * A * np.sin(0.5 * A * r)),
        (lambda t: np.exp(-t), lambda t: -np.exp(-t)),
        (lambda z: np.sin(0.7 * A * z), lambda z: 0.7 * A * np.cos(0.7 * A * z)),
    ),
]


def displacement(r, t, z):
    return np.stack([f[0](r) * g[0](t) * h[0](z) for f, g, h in FACTORS])


def strain(r, t, z):
    value = displacement(r, t, z)
    d_r, d_t, d_z = (
        np.stack([f[a == 0](r) * g[a == 1](t) * h[a == 2](z) for f, g, h in FACTORS]) for a in range(3)
    )
    return np.stack(
        [
            d_r[0],
            (d_t[1] + value[0]) / r,
            d_z[2],
            d_z[1] + d_t[2] / r,
            d_z[0] + d_r[2],
            d_t[0] / r + d_r[1] - value[1] / r,
        ]
    )


def stress(r, t, z):
    return np.einsum("ij,j...->i...", C, strain(r, t, z))


def body_force(r, t, z):
    """Minus the divergence of the stress; derivatives by a complex step, exact to rounding."""
    step = 1e-30
    s = stress(r, t, z)
    d_r = stress(r + 1j * step, t, z).imag / step
    d_t = stress(r, t + 1j * step, z).imag / step
    d_z = stress(r, t, z + 1j * step).imag / step
    return -np.stack(
        [
            d_r[0] + d_t[5] / r + d_z[4] + (s[0] - s[1]) / r,
            d_r[5] + d_t[1] / r + d_z[3] + 2 * s[5] / r,
            d_r[4] + d_t[3] / r + d_z[2] + s[4] / r,
        ]
    )


class Sector:
    """A quarter of a ring on whose whole boundary the displacement is prescribed."""

    def __init__(self, cells):
        self.mesh = ring_mesh(
            2e3 * OUTER, 2e3 * INNER, 1e3 * LENGTH, radial=cells, axial=cells, sectors=4, tangential=2 * cells
        )
        nodes = self.mesh.nodes[self.mesh.elements]
        self.table = gauss_table(7)
        self.geometry = element_geometry(nodes, self.table)
        position = np.einsum("qa,eai->eqi", self.table.values, nodes)
        self.where = _cylinder(position)
        self.dofs = (3 * self.mesh.elements[:, :, None] + np.arange(3)).reshape(len(nodes), 60)
        self.motion = _motion(self.geometry, self.table)
        self.exact = displacement(*_cylinder(self.mesh.nodes)).T.ravel()

    def solve(self):
        material = {"lamination": Material(ORTHOTROPIC.hooke(), 1.0)}
        K = assemble(self.mesh).stiffness_matrix(material)
        force = np.moveaxis(body_force(*self.where), 0, -1)
        local = np.einsum("eqca,eqc,eq->ea", self.motion, force, self.geometry.volume)
        load = np.zeros(K.shape[0])
        np.add.at(load, self.dofs, local)
        inner = np.flatnonzero(~np.repeat(self._boundary(), 3))
        u = self.exact.copy()
        u[inner] = 0
        u[inner] = factorize(sp.csr_array(K[inner][:, inner]))((load - K @ u)[inner])
        return u

    def _boundary(self):
        r, t, z = _cylinder(self.mesh.nodes)
        tiny = 1e-7
        beside = (t < tiny) | (t > np.pi / 4 - tiny) | (z < tiny) | (z > LENGTH - tiny)
        round_faces = np.zeros(len(r), dtype=bool)
        # also the nodes of the curved faces that lie beside the circle
        for bottom in ([0, 1], [1, 2], [2, 3], [3, 0]):
            face = [*bottom, bottom[0] + 4, bottom[1] + 4]
            middle = [8 + bottom[0], 12 + bottom[0], 12 + bottom[1], 16 + bottom[0]]
            radii = r[self.mesh.elements[:, face]]
            on = np.all(np.abs(radii - INNER) < tiny, axis=1) | np.all(np.abs(radii - OUTER) < tiny, axis=1)
            round_faces[self.mesh.elements[on][:, face + middle]] = True
        return beside | round_faces

    def errors(self, u):
        """Relative errors in the mean square and in the energy."""
        volume = self.geometry.volume
        exact = np.moveaxis(displacement(*self.where), 0, -1)
        found = np.einsum("eqca,ea->eqc", self.motion, u[self.dofs])
        exact_strain = np.moveaxis(strain(*self.where), 0, -1)
        wrong = np.einsum("eqsa,ea->eqs", strain_matrix(self.geometry), u[self.dofs]) - exact_strain

        def energy(e):
            return np.einsum("eq,eqs,st,eqt", volume, e, C, e)

        square = np.einsum("eq,eqc->", volume, (found - exact) ** 2) / np.einsum("eq,eqc->", volume, exact**2)
        return np.sqrt([square, energy(wrong) / energy(exact_strain)])


def _cylinder(position):
    x, y, z = np.moveaxis(position, -1, 0)
    return np.hypot(x, y), np.arctan2(y, x), z


def _motion(geometry, table):
    """Cylindrical displacement at the Gauss points of nodal cylindrical displacements, (e, q, 3, 60)."""
    cos, sin = np.cos(geometry.turn) * table.values, np.sin(geometry.turn) * table.values
    zero = np.zeros_like(cos)
    rows = [(cos, -sin, zero), (sin, cos, zero), (zero, zero, np.broadcast_to(table.values, cos.shape))]
    stacked = np.stack([np.stack(row, axis=-1) for row in rows], axis=2)
    return stacked.reshape(*stacked.shape[:3], 60)


def test_displacements_converge_by_the_cube_and_energy_by_the_square_of_the_element():
    cells = np.array([2, 4, 6])
    sectors = [Sector(n) for n in cells]
    errors = np.array([sector.errors(sector.solve()) for sector in sectors])
    rates = np.diff(np.log(errors), axis=0) / -np.diff(np.log(cells))[:, None]
    assert np.all(rates[:, 0] > 2.9)
    assert np.all(rates[:, 1] > 1.9)
    assert errors[-1, 0] < 5e-4
    assert errors[-1, 1] < 5e-3


def test_the_load_is_the_one_that_belongs_to_the_displacement():
    # Gauss's theorem over the sector: body force plus boundary tractions along z are in balance
    n = 30
    x, w = np.polynomial.legendre.leggauss(n)
    r = (INNER + OUTER) / 2 + (OUTER - INNER) / 2 * x
    t, z = np.pi / 8 * (1 + x), LENGTH / 2 * (1 + x)
    wr, wt, wz = w * (OUTER - INNER) / 2, w * np.pi / 8, w * LENGTH / 2
    R, T, Z = np.meshgrid(r, t, z, indexing="ij")
    inside = np.einsum("ijk,i,j,k,i", body_force(R, T, Z)[2], wr, wt, wz, r)
    faces = 0.0
    for sign, radius in ((1, OUTER), (-1, INNER)):
        faces += sign * radius * np.einsum("jk,j,k", stress(radius, T[0], Z[0])[4], wt, wz)
    for sign, angle in ((1, np.pi / 4), (-1, 0.0)):
        faces += sign * np.einsum("ik,i,k", stress(R[:, 0], angle, Z[:, 0])[3], wr, wz)
    for sign, level in ((1, LENGTH), (-1, 0.0)):
        faces += sign * np.einsum("ij,i,j,i", stress(R[..., 0], T[..., 0], level)[2], wr, wt, r)
    assert inside + faces == pytest.approx(0, abs=1e-9 * abs(inside))

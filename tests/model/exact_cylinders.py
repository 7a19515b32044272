"""Free hollow cylinders without finite elements: closed forms and a spectral Ritz solution.

All materials have their axes along r, θ and z; all results are natural frequencies in Hz, ascending, one per
doublet, rigid bodies left out.
"""

import numpy as np
from numpy.polynomial.legendre import Legendre, leggauss
from scipy.linalg import eigh
from scipy.optimize import brentq
from scipy.special import jvp, yvp

RIGID_HZ = 1.0


def thin_ring_bending_hz(order, E_pa, density, thickness, radius):
    """In-plane bending of a thin ring without extension of its centre line.

    R. Hoppe 1871; A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed., §293, with
    I/A = thickness²/12.
    """
    r = order
    stiffness = E_pa * thickness**2 / 12 / (density * radius**4)
    return r * (r**2 - 1) / np.sqrt(r**2 + 1) * np.sqrt(stiffness) / (2 * np.pi)


def thin_ring_extension_hz(order, E_pa, density, radius):
    """Extension of a thin ring's centre line (Love, §293); order 0 is breathing."""
    return np.sqrt((1 + order**2) * E_pa / density) / radius / (2 * np.pi)


def plane_ring_hz(order, inner, outer, E_pa, nu, density, highest_hz, steps=4000):
    """Plane-stress vibration of a thick ring with free edges, exact.

    Two potentials φ = f(r) cos nθ and ψ = g(r) sin nθ with Bessel functions of both kinds (J. D. Achenbach,
    Wave Propagation in Elastic Solids, 1973, chapter 2); the tractions of both edges vanish at the natural
    frequencies.
    """
    trial = np.linspace(RIGID_HZ, highest_hz, steps)

    def determinants(hz):
        blocks = _tractions(order, inner, outer, E_pa, nu, density, np.atleast_1d(hz))
        return [np.linalg.det(b / np.linalg.norm(b, axis=1, keepdims=True)) for b in blocks]

    found = []
    for k, values in enumerate(determinants(trial)):
        for i in np.flatnonzero(values[:-1] * values[1:] < 0):
            found.append(brentq(lambda hz, k=k: determinants(hz)[k][0], trial[i], trial[i + 1], xtol=1e-9))
    return np.sort(found)


def _tractions(n, inner, outer, E_pa, nu, density, hz):
    """Edge tractions (rows) of the potentials (columns); for n = 0 radial and tangential motion decouple."""
    shear = E_pa / (2 * (1 + nu))
    plate = E_pa / (1 - nu**2)
    columns = []
    for speed, longitudinal in ((np.sqrt(plate / density), True), (np.sqrt(shear / density), False)):
        k = 2 * np.pi * hz / speed
        for bessel in (jvp, yvp):
            column = []
            for r in (inner, outer):
                f, f1, f2 = (k**d * bessel(n, k * r, d) for d in range(3))
                # u_r = f', u_θ = -n f/r of φ; u_r = n g/r, u_θ = -g' of ψ; and their derivatives
                if longitudinal:
                    ur, ur1, ut, ut1 = f1, f2, -n * f / r, -n * (f1 / r - f / r**2)
                else:
                    ur, ur1, ut, ut1 = n * f / r, n * (f1 / r - f / r**2), -f1, -f2
                column += [plate * (ur1 + nu * (ur + n * ut) / r), shear * (ut1 - ut / r - n * ur / r)]
            columns.append(column)
    matrix = np.array(columns).transpose(2, 1, 0)
    if n == 0:
        return matrix[:, ::2, :2], matrix[:, 1::2, 2:]
    return (matrix,)


def ritz_cylinder_hz(order, inner, outer, length, hooke, density, count, degree=(9, 14)):
    """Free hollow cylinder in three dimensions, by Rayleigh and Ritz.

    Legendre polynomials up to `degree` in r and z for each displacement component, cos and sin of order θ;
    free surfaces need no constraints, so that the frequencies converge from above to the exact ones. For
    order 0 radial-axial motion and torsion come together.
    """
    values, by_r, by_z, r, weights = _products(inner, outer, length, degree)
    zero, n = np.zeros_like(values), order
    by_radius = values / r
    strain = np.stack(
        [
            np.hstack([by_r, zero, zero]),
            np.hstack([by_radius, n * by_radius, zero]),
            np.hstack([zero, zero, by_z]),
            np.hstack([zero, by_z, -n * by_radius]),
            np.hstack([by_z, zero, by_r]),
            np.hstack([-n * by_radius, by_r - by_radius, zero]),
        ]
    )
    weights = (weights * r)[:, 0]
    K = sum(
        hooke.matrix[i, j] * (strain[i].T * weights) @ strain[j]
        for i in range(6)
        for j in range(6)
        if hooke.matrix[i, j] != 0
    )
    M = np.kron(np.eye(3), density * (values.T * weights) @ values)
    squares = eigh(K, M, eigvals_only=True)
    found = np.sqrt(np.maximum(squares, 0)) / (2 * np.pi)
    return found[found > RIGID_HZ][:count]


def _products(inner, outer, length, degree):
    x, wx = leggauss(degree[0] + 6)
    y, wy = leggauss(degree[1] + 4)
    middle, half = (inner + outer) / 2, (outer - inner) / 2
    fr, fz = (
        np.array([Legendre.basis(i)(t) for i in range(d + 1)]).T for t, d in ((x, degree[0]), (y, degree[1]))
    )
    dr, dz = (
        np.array([Legendre.basis(i).deriv()(t) for i in range(d + 1)]).T
        for t, d in ((x, degree[0]), (y, degree[1]))
    )
    values, by_r, by_z = np.kron(fr, fz), np.kron(dr, fz) / half, np.kron(fr, dz) / (length / 2)
    r = np.repeat(middle + half * x, len(y))[:, None]
    return values, by_r, by_z, r, np.kron(wx * half, wy * length / 2)[:, None]

"""Vectors for a contact that is weaker over an arc: the fields of the even contact, gathered in any part of the circle.

Where the contact is weak, parts move against each other as they would if it were weak all around. Such a field within
an arc is a sum of the modes times e^{ijθ}: harmonic r becomes r + j, node by node, and no further problem is solved.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from statorhom.diagnose.bases.ring_basis import RingBasis, RingProblem, affine_terms, grown, independent
from statorhom.model.affine import Materials
from statorhom.model.harmonic import Harmonic, harmonic_spaces
from statorhom.model.radial_profile import radial_profile

MOST = 20  # vectors that one problem gains
LEAST = 1e-4  # part of a vector's energy that the others must leave to it
WEAK = 3e10  # N/m³: contact in whose energy the vectors are weighed


def with_local_fields(ring: RingBasis, materials: Materials, joint: sp.csr_array) -> RingBasis:
    """The bases with the fields of all modes of low order in every harmonic, and the harmonics that arcs bring in.

    Parameters
    ----------
    ring : on a split mesh, its modes at several even contacts.
    materials : of the regions.
    joint : contact of unit stiffness of the half pitch (m²).
    """
    model = ring.model
    mesh = model.mesh
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    energy = sp.csr_array(K + WEAK * joint + (2 * np.pi * ring.highest_hz) ** 2 * M)
    angle = np.repeat(np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0]), 3)[:, None]
    profile, terms = radial_profile(mesh), affine_terms(model)
    problems = []
    # all that the mesh has: with fewer, what parts within a few pitches would strain the bond of all others
    for order in range(mesh.slots // 2 + 1):
        known = [p for p in ring.problems if p.space.order == order]
        for problem in [*known, *_missing(ring, order)]:
            space = problem.space
            fields = _fields(ring.problems, space, angle)
            more = _new(problem.basis, fields, sp.csr_array(space.project(energy)))
            added = independent(problem.basis, more, sp.csr_array(space.project(M)))
            problems.append(grown(problem, added, terms, profile))
    return replace(ring, problems=tuple(problems))


def _missing(ring: RingBasis, order: int) -> list[RingProblem]:
    """Problems of a harmonic that no named mode is of, their bases empty."""
    known = {(p.space.axial, p.space.parity) for p in ring.problems if p.space.order == order}
    return [unsolved(s) for s in harmonic_spaces(ring.model.mesh, order) if (s.axial, s.parity) not in known]


def unsolved(space: Harmonic) -> RingProblem:
    """A problem whose basis is empty."""
    return RingProblem(space, np.zeros((space.size, 0)), {}, {}, np.zeros((0, 0)))


def _fields(problems: tuple[RingProblem, ...], space: Harmonic, angle: np.ndarray) -> np.ndarray:
    """Modes of both senses of rotation turned into a harmonic, coordinates (m, …)."""
    found = []
    for source in problems:
        if source.space.axial != space.axial:
            continue
        order, motion = source.space.order, source.space.expand(source.basis)
        if order != space.order:
            found.append(_coordinates(space, motion * np.exp(1j * (space.order - order) * angle)))
        if order:
            found.append(_coordinates(space, np.conj(motion) * np.exp(1j * (space.order + order) * angle)))
    return np.hstack(found)


def _coordinates(space: Harmonic, motion: np.ndarray) -> np.ndarray:
    """Coordinates (m, …) of a motion (3 n, …) of the half pitch; the columns of the space are orthogonal."""
    size = (space.real.multiply(space.real) + space.imaginary.multiply(space.imaginary)).sum(axis=0)
    parts = space.real.T @ motion.real + space.imaginary.T @ motion.imag
    return np.asarray(parts / np.asarray(size).ravel()[:, None])


def _new(own: np.ndarray, fields: np.ndarray, energy: sp.csr_array) -> np.ndarray:
    """The directions (m, …) that carry most of what is not in the basis."""
    fields = fields[:, np.any(fields != 0.0, axis=0)]
    fields = fields / np.sqrt(np.sum(fields * (energy @ fields), axis=0))
    if own.shape[1]:
        values, turn = np.linalg.eigh(own.T @ (energy @ own))
        unit = own @ (turn / np.sqrt(values))
        fields = fields - unit @ (unit.T @ (energy @ fields))
    values, turn = np.linalg.eigh(fields.T @ (energy @ fields))
    chosen = [i for i in np.argsort(-values)[:MOST] if values[i] > LEAST]
    return np.asarray(fields @ (turn[:, chosen] / np.sqrt(values[chosen])))

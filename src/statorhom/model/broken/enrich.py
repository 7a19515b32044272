"""Further vectors of every problem where a solution's residual asks for them.

A residual's response (K + σM)⁻¹ r splits into one vector per problem and family. Turning a change by a slot pitch
only turns their phases, so that a basis enriched for one angle serves all of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from scipy.linalg import eigh

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.coupling import Coupled
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.problem_basis import ProblemBasis

DROP = 1e-14  # squared part of a vector outside the basis below which it is rounding


def enriched(
    basis: SymmetricBasis, coupled: Coupled, values: np.ndarray, x: np.ndarray, least: float
) -> SymmetricBasis:
    """The basis with the responses to the residuals of a solution.

    Parameters
    ----------
    coupled : the broken stator in the basis.
    values, x : its eigenvalues (rad²/s²) and coordinates (n, modes).
    least : relative frequency error below which a direction is left out.
    """
    forces = {
        side: np.fft.rfft(on_copies, axis=0)
        for side, on_copies in _piece_forces(basis, coupled, values, x).items()
    }
    problems = []
    for number, problem in enumerate(basis.problems):
        # where pieces are softened the one is right inside and the other outside of them
        solvers = [problem.sector.solve, problem.soft.solve] if basis.softest else [problem.sector.solve]
        found = []
        for sine in problem.sector.families:
            residual = _residual(basis, coupled, number, sine, values, x) + _folded(problem, forces, sine)
            # in units of relative frequency error that is at stake
            found += [solve(residual) / np.sqrt(2 * values) for solve in solvers]
        problems.append(extended(problem, np.hstack(found), least))
    return replace(basis, problems=tuple(problems), grams=type(basis.grams)())


def extended(problem: ProblemBasis, vectors: np.ndarray, least: float) -> ProblemBasis:
    """A problem's basis with the directions of `vectors` whose (K + σM)-norm squared is more than `least`."""
    W, K, M, shift = problem.vectors, problem.sector.K, problem.sector.M, problem.sector.shift
    new = vectors - W @ (problem.inertial.T @ vectors)
    new -= W @ (problem.inertial.T @ new)
    elastic, inertial = K @ new, M @ new
    energy, rotation = np.linalg.eigh(new.T @ elastic + shift * (new.T @ inertial))
    rotation = rotation[:, energy > least]
    gram = rotation.T @ (new.T @ inertial) @ rotation
    scale = 1 / np.sqrt(np.diag(gram))
    gram, turn = np.linalg.eigh(gram * scale * scale[:, None])
    keep = gram > DROP
    rotation = (rotation * scale) @ (turn[:, keep] / np.sqrt(gram[keep]))
    joined = np.hstack([W, new @ rotation])
    elastic = np.hstack([problem.elastic, elastic @ rotation])
    inertial = np.hstack([problem.inertial, inertial @ rotation])
    stiffness, mass = joined.T @ elastic, joined.T @ inertial
    values, turn = eigh((stiffness + stiffness.T) / 2, (mass + mass.T) / 2)
    images = {"vectors": joined @ turn, "elastic": elastic @ turn, "inertial": inertial @ turn}
    return replace(problem, values=values, **images)


def _residual(
    basis: SymmetricBasis, coupled: Coupled, number: int, sine: bool, values: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """What the symmetric stator and the attachments leave of the equations of motion, in a problem's coordinates."""
    problem, own = basis.problems[number], coupled.statics
    size = len(basis.values)
    q, f = x[:size], x[size:]
    sector, mine = problem.sector, q[basis.places[number][sine]]
    residual = problem.elastic @ mine - (problem.inertial @ mine) * values
    if len(own):
        # K Y = Lᵀ - σ M Y
        load = own.loads[number][sine]
        residual -= (sector.inertial @ (load @ f)) * (sector.shift + values)
        motion = own.answers.motion @ x
        reaction = own.stiffness @ motion - (own.mass @ motion) * values
        residual[sector.loaded] += load @ (f + reaction)
    return np.asarray(residual)


def _piece_forces(
    basis: SymmetricBasis, coupled: Coupled, values: np.ndarray, x: np.ndarray
) -> Mapping[bool, np.ndarray]:
    """Forces (N, 3 n, modes) of changed pieces on all straight (False) and mirrored (True) half pitches."""
    slots, count = basis.mesh.slots, 3 * len(basis.mesh.nodes)
    total = {side: np.zeros((slots, count, len(values))) for side in (False, True)}
    for change in coupled.pieces:
        for part, factor in ((change.stiffness, np.ones(len(values))), (change.mass, -values)):
            if part is None:
                continue
            used = np.flatnonzero(np.any(change.weights != 0.0, axis=1))
            forces = factor * _applied(basis, coupled, part.take(used), change.weights[used], x)
            dofs = np.unique(part.take(used).dofs)
            total[False][:, dofs] += forces[0::2]
            total[True][:, dofs] += forces[1::2]
    return total


def _applied(
    basis: SymmetricBasis, coupled: Coupled, pieces: Pieces, weights: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """Weighted pieces times a motion, on their displacements in every copy, (2 N, d, modes)."""
    dofs, part = pieces.alone()
    size = len(basis.values)
    motion = basis.waves.in_copies(dofs, x[:size])
    if len(coupled.statics):
        columns, units = coupled.statics.waves
        motion += columns.in_copies(dofs, units @ x[size:])
    forces = np.zeros_like(motion)
    # what varies along the axis alone is the same matrix in all copies
    patterns, member = np.unique(weights, axis=1, return_inverse=True)
    for i in np.flatnonzero(np.any(patterns != 0.0, axis=0)):
        matrix = part.matrix(patterns[:, i])
        for copy in np.flatnonzero(member.ravel() == i):
            forces[copy] = matrix @ motion[copy]
    return forces


def _folded(problem: ProblemBasis, forces: Mapping[bool, np.ndarray], sine: bool) -> np.ndarray:
    """Forces on all half pitches, by circumferential order, in a problem's coordinates."""
    space = problem.sector.space
    straight, mirrored = (forces[side][space.order] for side in (False, True))
    if sine:
        return np.asarray(
            space.imaginary.T @ (straight.real - mirrored.real)
            - space.real.T @ (straight.imag + mirrored.imag)
        )
    return np.asarray(
        space.real.T @ (straight.real + mirrored.real) + space.imaginary.T @ (straight.imag - mirrored.imag)
    )

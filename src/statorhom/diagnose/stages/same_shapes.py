"""Which modes of another solution are those of the reference: names shift with the constants, shapes hardly do.

Mesh factors, splits by scatter, responses to what breaks the symmetry belong to a mode, and are known by the name that
it has at the reference. A softer winding shows further modes of a name, and moves a node plane beyond the end of the
core: the same mode would be called otherwise, and be given what belongs to its neighbours.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import count

import numpy as np
from scipy.optimize import linear_sum_assignment

from statorhom.diagnose.bases.ring_basis import RingModes
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.stator_mode import StatorMode

ALIKE = 0.25  # MAC below which no mode of another solution is the same one


def same_shapes(own: np.ndarray, others: np.ndarray) -> list[tuple[int, int]]:
    """Pairs (number, number of the other) that are most like each other.

    Parameters
    ----------
    own : (i, k) shapes times a mass matrix, one after the other.
    others : (k, j) shapes of unit modal mass.
    """
    alike = np.square(own @ others)
    rows, columns = linear_sum_assignment(alike, maximize=True)
    pairs = zip(rows.tolist(), columns.tolist(), strict=True)
    return [(i, j) for i, j in pairs if alike[i, j] > ALIKE]


def reference_names(
    stage: StageModel, solved: RingModes, modes: Sequence[StatorMode]
) -> dict[ModeKey, StatorMode]:
    """Visible modes by the names that they have at the reference; what is new there is the next of its own name.

    Parameters
    ----------
    solved : other materials' modes, in the stage's basis.
    modes : of these, sorted by frequency.
    """
    own, reference = mode_keys(modes), stage.reference_keys
    if all(key in reference and reference[key].place == mode.place for key, mode in own.items()):
        return own
    names = _known(stage, solved, list(own.values()))
    known = set(names.values())
    for (order, axial, _), mode in own.items():
        if mode.place not in names:
            names[mode.place] = next(k for n in count() if (k := (order, axial, n)) not in known)
            known.add(names[mode.place])
    return {names[mode.place]: mode for mode in own.values()}


def _known(
    stage: StageModel, solved: RingModes, modes: Sequence[StatorMode]
) -> dict[tuple[int, int], ModeKey]:
    """Names of those whose shapes the reference has, by their places."""
    weighted = _weighted(stage)
    found = {}
    for number in {mode.problem for mode in modes} & set(weighted):
        keys, shapes = weighted[number]
        columns = [mode.column for mode in modes if mode.problem == number]
        for i, j in same_shapes(shapes, solved.vectors[number][:, columns]):
            found[number, columns[j]] = keys[i]
    return found


def _weighted(stage: StageModel) -> Mapping[int, tuple[list[ModeKey], np.ndarray]]:
    """Names and shapes times mass (i, k) of the reference's modes, per problem; kept until the basis grows."""

    def made() -> dict[int, tuple[list[ModeKey], np.ndarray]]:
        vectors, found = stage.solve(stage.reference).vectors, {}
        for number, problem in enumerate(stage.ring.problems):
            places = [(k, m.column) for k, m in stage.reference_keys.items() if m.problem == number]
            if places:
                mass = problem.mass_matrix(stage.reference)
                found[number] = [k for k, _ in places], vectors[number][:, [c for _, c in places]].T @ mass
        return found

    known: Mapping[int, tuple[list[ModeKey], np.ndarray]] = stage.memory.once(
        ("shapes", stage.ring.sizes), made
    )
    return known

"""What breaks the symmetry does to the named modes: their shift, and the complex split of their doublets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.diagnose.stage_model import Columns, StageModel
from statorhom.model.broken.change import Change
from statorhom.model.broken.solve import BrokenModes, solve_broken
from statorhom.model.convergence import ModeKey

LEAST = 0.2  # share of a doublet's plane that its two modes must keep to be called its own


@dataclass(frozen=True)
class Response:
    """Of one named mode.

    Parameters
    ----------
    shift : change of ln f of the doublet's mean λ.
    split : complex split b_r over the mean λ (`statorhom.modes.doublets.complex_split`).
    """

    shift: float
    split: complex


def responses(stage: StageModel, changes: Sequence[Change]) -> dict[ModeKey, Response]:
    """Response of every named mode that can still be told.

    Raises
    ------
    SolverError
        If the changes leave a mass or stiffness that is not definite.
    """
    modes = solve_broken(stage.broken, changes, tolerance=None)
    found = {key: _response(modes, place) for key, place in stage.columns.items()}
    return {key: response for key, response in found.items() if response is not None}


def _response(modes: BrokenModes, place: Columns) -> Response | None:
    numbers = [place.cosine] if place.sine is None else [place.cosine, place.sine]
    parts = modes.coordinates[numbers]
    weight = np.sum(parts**2, axis=0)
    chosen = np.sort(np.argsort(-weight)[: len(numbers)])
    if len(chosen) < len(numbers) or weight[chosen].min() < LEAST:
        return None
    values = modes.eigenvalues[chosen]
    if len(numbers) == 1:
        return Response(0.5 * float(np.log(values[0] / place.eigenvalue)), 0j)
    # nearest orthonormal pair in the doublet's plane
    left, _, right = np.linalg.svd(parts[:, chosen])
    rotation = left @ right
    effective = rotation @ np.diag(values) @ rotation.T
    mean = float(values.mean())
    split = complex(effective[0, 0] - effective[1, 1], 2 * effective[0, 1]) / mean
    return Response(0.5 * float(np.log(mean / place.eigenvalue)), split)

"""What breaks the symmetry does to the named modes of a stage."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.diagnose.stage_model import StageModel
from statorhom.model.broken.change import Change
from statorhom.model.broken.named_response import Response, named_response
from statorhom.model.broken.solve import solve_broken
from statorhom.model.convergence import ModeKey

__all__ = ["Response", "responses"]


def responses(stage: StageModel, changes: Sequence[Change]) -> dict[ModeKey, Response]:
    """Response of every named mode that can still be told.

    Raises
    ------
    SolverError
        If the changes leave a mass or stiffness that is not definite.
    """
    modes = solve_broken(stage.broken, changes, tolerance=None)
    found = {key: named_response(modes, place) for key, place in stage.columns.items()}
    return {key: response for key, response in found.items() if response is not None}

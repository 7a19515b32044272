"""What lumps, springs and patches that a study declares do to the free modes of a plate, a beam or a wing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.broken.named_response import Response
from statorhom.model.convergence import ModeKey
from statorhom.model.eigen import frequency_hz
from statorhom.model.modal.acted_body import ActedBody
from statorhom.model.modal.modal_body import modal_body
from statorhom.physics.action import Action

UNDERSTOOD = ("attachments", "patches")


def body_shifts(
    actions: Sequence[Action], model: AffineModel[MirrorMesh], materials: Materials, highest_hz: float
) -> dict[ModeKey, Response]:
    """Shift of ln f of every elastic mode of the band.

    What is attached mixes modes of different parities; each keeps the name of the mode that it is most like, no two
    the same.

    Parameters
    ----------
    actions : what the effects do.
    model, materials : the body without them.
    highest_hz : end of the band.

    Raises
    ------
    SolverError
        If the effects leave a mass that is not positive.
    """
    basis = modal_body(model, [materials], highest_hz, varied=())
    inside = int(np.count_nonzero(basis.reference_hz < highest_hz))
    acted = ActedBody(model, materials, basis).modes(
        materials,
        min(2 * inside, basis.size),
        [one for action in actions for one in action.attachments],
        [one for action in actions for one in action.patches],
    )
    alike = (basis.reference[:, :inside].T @ acted.vectors) ** 2
    modes, partners = linear_sum_assignment(alike, maximize=True)
    hz = frequency_hz(acted.values)
    return {
        key: Response(float(np.log(hz[j] / basis.reference_hz[i])), 0j)
        for i, j in zip(modes.tolist(), partners.tolist(), strict=True)
        if (key := basis.keys[i]) is not None and acted.values[j] > 0.0
    }

"""The reduced models of one fit: one over the prior for the search, one around what it found for the result."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.identify.bases.stage_basis import (
    LOCAL,
    LOCAL_OF_BLOCKS,
    SEARCH,
    SEARCH_OF_BLOCKS,
    SHARED,
    SHARED_STEP,
    STEP,
    BasisPlan,
    reduce_stage,
)
from statorhom.identify.bases.training import neighbouring_materials, training_materials
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.processes.announce import Announce
from statorhom.identify.processes.workers import Workers
from statorhom.identify.residuals.stage_problem import StageProblem
from statorhom.identify.stages.stage_materials import StageMaterials
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.basis_store import BasisStore
from statorhom.model.reduced_stator import ReducedStator
from statorhom.model.space import Space


@dataclass(frozen=True)
class FitBases:
    """Makes the reduced models of a stage.

    Parameters
    ----------
    model : of the fitting mesh.
    spaces : harmonic problems of the fitted modes.
    highest_hz : highest measured frequency.
    workers : processes.
    announce : told what begins.
    store : where bases are kept between runs; None to build them anew.
    shared : whether they shall serve other machines too: exact over all of the prior.
    """

    model: AffineModel[PartMesh]
    spaces: Sequence[Space]
    highest_hz: float
    workers: Workers
    announce: Announce
    store: BasisStore | None = None
    shared: bool = False

    def over_prior(
        self, space: ParameterSpace, materials: StageMaterials, typical: Materials
    ) -> ReducedStator:
        """Reduced model for all that a prior allows, fastest at the densities of `typical`."""
        alone = SEARCH_OF_BLOCKS if isinstance(self.model.mesh, MirrorMesh) else SEARCH
        plan = SHARED if self.shared else alone
        training = training_materials(space, materials, plan.training)
        return self._reduce("reduced bases", training, typical, plan)

    def around(self, problem: StageProblem, optima: Sequence[np.ndarray]) -> ReducedStator:
        """Reduced model for what lies around optima of a problem, the best first."""
        plan = LOCAL_OF_BLOCKS if isinstance(self.model.mesh, MirrorMesh) else LOCAL
        training = neighbouring_materials(problem, optima, plan.training)
        return self._reduce("bases around the optima", training, training[0], plan)

    def _reduce(
        self, what: str, training: Sequence[Materials], typical: Materials, plan: BasisPlan
    ) -> ReducedStator:
        progress = self.announce(what, len(self.spaces))
        step = SHARED_STEP if self.shared else STEP
        known = (self.model, training, typical, self.spaces, self.highest_hz, self.workers)
        return reduce_stage(*known, plan, progress, self.store, step)

"""What declared effects (``[[stages.effects]]``) do to the named free modes of a stage: shifts and splits.

They are computed at given materials, like the mesh factors, and the constants are then fitted to frequencies that
contain them. Effects that no free frequency of the chain can contain are refused in one line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np
from threadpoolctl import threadpool_limits

from statorhom.errors import IdentificationError
from statorhom.geometry.stator import StepGeometry
from statorhom.identify.residuals.body_shifts import UNDERSTOOD as UNDERSTOOD_OF_BODIES
from statorhom.identify.residuals.body_shifts import body_shifts
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials, stator_model
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.named_response import Response, columns_of, named_response
from statorhom.model.broken.solve import solve_broken
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import FreeModes, solve_free
from statorhom.model.harmonic import Harmonic
from statorhom.physics.action import Action
from statorhom.physics.declared import DeclaredEffect, beyond, declared_effects
from statorhom.physics.rated import at_rate, self_consistent
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE

UNDERSTOOD = ("materials", "changes", "modulus_at")
MARGIN = 1.25  # of the basis in which broken symmetry is solved
RATES = 5  # frequencies between which a modulus that follows the frequency is interpolated


@dataclass(frozen=True)
class EffectShifts:
    """The declared effects of one stage.

    Parameters
    ----------
    actions : what they do.
    names : of the effects.
    """

    actions: tuple[Action, ...] = ()
    names: tuple[str, ...] = ()

    def at(
        self, model: AffineModel[PartMesh], materials: Materials, highest_hz: float, orders: Sequence[int]
    ) -> dict[ModeKey, Response]:
        """Shift of ln f and split of every named mode at given materials.

        Parameters
        ----------
        model : of the half pitch.
        materials : without the effects.
        highest_hz, orders : band and harmonics of the modes that matter.

        Raises
        ------
        SolverError
            If the effects leave a mass or stiffness that is not definite.
        """
        if not self.actions:
            return {}
        if isinstance(model.mesh, MirrorMesh):
            with threadpool_limits(limits=1, user_api="blas"):
                return body_shifts(self.actions, cast(AffineModel[MirrorMesh], model), materials, highest_hz)
        return self._at(stator_model(model), materials, highest_hz, orders)

    def _at(
        self, model: AffineModel, materials: Materials, highest_hz: float, orders: Sequence[int]
    ) -> dict[ModeKey, Response]:
        with threadpool_limits(limits=1, user_api="blas"):
            plain = mode_keys(solve_free(model, materials, highest_hz, orders).modes)
            acted = self.materials(materials)
            top = highest_hz * MARGIN
            solution = solve_free(model, acted, top, orders)
            logs = {k: float(np.log(m.frequency_hz)) for k, m in mode_keys(solution.modes).items()}
            logs |= self._rated(model, acted, top, orders)
            broken = self._broken(model, acted, solution, highest_hz)
        found = {}
        for key, mode in plain.items():
            if key in logs:
                response = broken.get(key, Response(0.0, 0j))
                shift = logs[key] - float(np.log(mode.frequency_hz)) + response.shift
                found[key] = Response(shift, response.split)
        return found

    def materials(self, materials: Materials) -> Materials:
        """Materials as the effects make them."""
        for action in self.actions:
            if action.materials is not None:
                materials = action.materials(materials)
        return materials

    def _broken(
        self, model: AffineModel, materials: Materials, solution: FreeModes, highest_hz: float
    ) -> dict[ModeKey, Response]:
        changes = [c for a in self.actions if a.changes for c in a.changes(model.mesh, materials)]
        if not changes:
            return {}
        basis = symmetric_basis(model, materials, highest_hz, margin=MARGIN)
        modes = solve_broken(basis, changes, tolerance=None)
        found = {}
        for key, mode in mode_keys(solution.modes).items():
            space = solution.harmonics[mode.problem]
            assert isinstance(space, Harmonic)
            place = columns_of(basis, space, mode.frequency_hz)
            response = None if place is None else named_response(modes, place)
            if response is not None:
                found[key] = response
        return found

    def _rated(
        self, model: AffineModel[PartMesh], materials: Materials, highest_hz: float, orders: Sequence[int]
    ) -> dict[ModeKey, float]:
        """ln f of a stator whose moduli follow the frequency: where f of the moduli at f is f itself."""
        laws = {r: law for a in self.actions for r, law in a.modulus_at.items() if r in materials}
        if not laws:
            return {}
        trial = np.linspace(np.log(0.05 * highest_hz), np.log(highest_hz), RATES)
        tables = [
            mode_keys(solve_free(model, at_rate(materials, laws, rate), 1.2 * highest_hz, orders).modes)
            for rate in np.exp(trial).tolist()
        ]
        return self_consistent(trial, tables)


NO_EFFECTS = EffectShifts()


def effect_shifts(files: StudyFiles, setup: StageSetup) -> EffectShifts:
    """The declared effects that a stage's free modes contain.

    Raises
    ------
    InputFileError
        If the study declares what no effect can be.
    IdentificationError
        If an effect cannot be in the frequencies that a fit compares.
    """
    here = [d for d in declared_effects(files) if d.action.touches(setup.keys.name)]
    understood = UNDERSTOOD if isinstance(setup.step, StepGeometry) else UNDERSTOOD_OF_BODIES
    for effect in here:
        unknown = beyond(effect.action, understood)
        if unknown is not None:
            raise IdentificationError(
                f"{files.path}: stages[{setup.keys.name}].effects: simulate, fit and run cannot model "
                f"{effect.candidate.effect} yet ({unknown.replace('_', ' ')}); delete it for them"
            )
    free = {t.name for t in setup.tests if t.support == FREE and (t.fitted or not setup.fitted)}
    used = [effect for effect in here if _seen(files, setup, effect, free)]
    return EffectShifts(tuple(e.action for e in used), tuple(e.candidate.effect for e in used))


def _seen(files: StudyFiles, setup: StageSetup, effect: DeclaredEffect, free: set[str]) -> bool:
    """Whether the step's free tests see an effect: all that are fitted, or none."""
    tests = effect.action.tests
    seen = free if tests is None else free & tests
    if seen and seen != free:
        raise IdentificationError(
            f"{files.path}: stages[{setup.keys.name}].effects: {effect.candidate.effect} is in the test "
            f"{', '.join(sorted(seen))} and not in {', '.join(sorted(free - seen))}, but the step is fitted to both; "
            'give one of them role = "predict"'
        )
    return bool(seen)

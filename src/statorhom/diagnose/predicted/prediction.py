"""Predicted modes of a test under constants and what a hypothesis changes, with their derivatives."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import log

import numpy as np

from statorhom.diagnose.bases.ring_basis import mark_of
from statorhom.diagnose.contacts.arc_slopes import Slope
from statorhom.diagnose.predicted.followed_modes import Names, named
from statorhom.diagnose.stages.broken_response import Response, responses
from statorhom.diagnose.stages.dimension_response import dimension_shift
from statorhom.diagnose.stages.order_profiles import reference_profiles
from statorhom.diagnose.stages.rated_modes import rated_modes
from statorhom.diagnose.stages.same_shapes import reference_names
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.identify.residuals.stage_problem import NamedByMode, seen
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.model.broken.named_response import Way
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.stator_mode import StatorMode
from statorhom.physics.action import Action


@dataclass(frozen=True, eq=False)
class PredictedMode(NamedByMode):
    """One named mode.

    Parameters
    ----------
    key : its name and rank.
    mode : of the symmetric stator.
    log_f : ln of its frequency (Hz), mesh factor and shifts included.
    split : complex relative split of λ by the hypothesis, without scatter.
    shared : relative standard deviation that one unit of the stage's mesh coordinate stands for.
    slope : d ln f by the entries of `material_vector` where it is not the bonded stator's, else None.
    shares : source of a material, or "joint" → share of the strain energy; empty unless damping is predicted.
    friction : what slipping adds to the loss factor.
    scattered : relative split by a unit of the scatter of its order.
    other_axial : count of node planes that the hypothesis may make it show instead of its own.
    shown : counts that a test's planes may show instead of its own, the likeliest first; empty where they are unknown.
    profile : (heights,) its order's radial motion at the stage's `heights_m`; None where nobody measured it.
    chance : that what is called by its name is what this says.
    ways : what else may be.
    lines : ln f, off that of the mode, of every line that may be called by its name, alone.
    """

    key: ModeKey
    mode: StatorMode
    log_f: float
    split: complex
    shared: float
    slope: Slope | None = None
    shares: Mapping[str, float] = field(default_factory=dict)
    friction: float = 0.0
    scattered: float = 1.0
    other_axial: int | None = None
    shown: tuple[int, ...] = ()
    profile: np.ndarray | None = None
    chance: float = 1.0
    ways: tuple[Way, ...] = ()
    lines: tuple[Way, ...] = ()

    @property
    def axial(self) -> int | None:
        return self.mode.axial

    @property
    def frequency_hz(self) -> float:
        return float(np.exp(self.log_f))

    @property
    def called(self) -> Iterator[PredictedMode]:
        """Itself, and what it is in every other way of calling modes by its name."""
        yield self
        for way in self.ways:
            yield replace(self, log_f=self.log_f + way.shift, split=way.split, chance=way.chance, ways=())

    @property
    def visibility(self) -> float:
        return seen(self.mode)


def acted_materials(
    study: StudyModel,
    stage: StageModel,
    values: Mapping[str, float],
    actions: Sequence[Action],
    test: str | None = None,
) -> Materials:
    """Materials of a test under the hypothesis.

    Raises
    ------
    MassError, MaterialError
        If no material has these constants.
    """
    corrected: dict[str, float] = {}
    for action in actions:
        corrected |= dict(action.masses)
    materials = study.materials(stage, values, study.masses(values, corrected))
    return with_rules(materials, stage.name, actions, test)


def with_rules(
    materials: Materials, stage: str, actions: Sequence[Action], test: str | None = None
) -> Materials:
    """Declared materials as the actions that touch a stage, or a test of it, make them."""
    for action in actions:
        if action.materials is not None and action.touches(stage, test):
            materials = action.materials(materials)
    return materials


def material_vector(materials: Materials, regions: Sequence[str]) -> np.ndarray:
    """Nine Hooke entries and the density of every region, one after the other."""
    of_region = [materials[region] for region in regions]
    return np.concatenate([part for m in of_region for part in (hooke_coefficients(m.hooke), (m.density,))])


def slopes_by_materials(
    stage: StageModel, materials: Materials, modes: Mapping[ModeKey, PredictedMode]
) -> dict[ModeKey, np.ndarray]:
    """d ln f of predicted modes by the entries of `material_vector`."""
    bonded = {key: mode.mode.place for key, mode in modes.items() if mode.slope is None}
    own = {key: mode.slope.vector for key, mode in modes.items() if mode.slope is not None}
    return {**stage.slopes(materials, bonded), **own}


def predicted(
    study: StudyModel,
    stage: StageModel,
    values: Mapping[str, float],
    actions: Sequence[Action],
    test: str | None = None,
    mark: Sequence[Hashable] | None = None,
    names: Names | None = None,
) -> dict[ModeKey, PredictedMode]:
    """Named modes of a free test, by key.

    Parameters
    ----------
    mark : one entry per action; equal ones say that it is the same.
    names : that the modes had where they were paired (`statorhom.diagnose.predicted.followed_modes`); the
        reference's by default, where shapes were measured, or their own.
    """
    materials = acted_materials(study, stage, values, actions, test)
    here = [a for a in actions if a.touches(stage.name, test)]
    if mark is not None:
        # what breaks no symmetry may differ
        pairs = zip(actions, mark, strict=True)
        mark = tuple(m for a, m in pairs if a.changes and a.touches(stage.name, test))
    base = _base(stage, materials, here, names)
    shifts = broken_responses(stage, here, None if mark is None else (test, mark), materials)
    mesh = values[f"{stage.name}:mesh"]
    own = reference_profiles(stage, stage.heights_m) if stage.heights_m else {}
    found = {}
    for key, one in base.items():
        shared = stage.error.shared(key)
        total = one.log_f + log(stage.error.factor(key)) + mesh * shared
        total += sum(
            dimension_shift(study, stage, a.dimensions, key, proportional=a.proportional)
            for a in here
            if a.dimensions
        )
        response = shifts.get(key, Response(0.0, 0j))
        found[key] = PredictedMode(
            key,
            one.mode,
            float(total + response.shift),
            one.split + response.split,
            shared,
            one.slope,
            scattered=stage.scattered.get(key, 1.0),
            other_axial=response.other_axial,
            profile=own.get(key) if response.profile is None else response.profile,
            chance=response.chance,
            ways=tuple(
                replace(w, shift=w.shift - response.shift, split=one.split + w.split) for w in response.ways
            ),
            lines=tuple(replace(w, shift=w.shift - response.shift) for w in response.lines),
        )
    return found


def broken_responses(
    stage: StageModel, actions: Sequence[Action], mark: Hashable = None, materials: Materials | None = None
) -> Mapping[ModeKey, Response]:
    """Shifts and splits by all that breaks the symmetry; those of a few marks are kept.

    Parameters
    ----------
    mark : equal ones say that the actions are the same; None to keep nothing.
    materials : that changes follow (`Action.follows_materials`); the reference's by default.
    """
    if not any(a.changes for a in actions):
        return {}
    there = stage.reference if materials is None else materials
    if mark is None:
        return _broken_responses(stage, actions, there)
    follow = any(a.follows_materials for a in actions)
    own = (mark, mark_of(there)) if follow else mark
    return stage.responses.once(own, lambda: _broken_responses(stage, actions, there))


def _broken_responses(
    stage: StageModel, actions: Sequence[Action], materials: Materials
) -> Mapping[ModeKey, Response]:
    mesh = stage.model.mesh
    changes = [
        c
        for a in actions
        if a.changes
        for c in a.changes(mesh, materials if a.follows_materials else stage.reference)
    ]
    trainings = [a.training for a in actions if a.training is not None]
    found = responses(stage, changes, trainings) if changes else {}
    refined = stage.refinement
    # without one of the effects that it is of, a solution is another one
    there_are = refined is not None and refined.labels <= {a.label for a in actions if a.changes}
    return refined.to(found) if refined is not None and there_are else found


@dataclass(frozen=True, eq=False)
class _Symmetric:
    """A mode before mesh factors and what breaks the symmetry."""

    mode: StatorMode
    log_f: float
    split: complex = 0j
    slope: Slope | None = None


def _base(
    stage: StageModel, materials: Materials, actions: Sequence[Action], names: Names | None
) -> dict[ModeKey, _Symmetric]:
    for action in actions:
        if action.joint is not None:
            basis = stage.joined(action.joint)
            modes = basis.solve(materials, action.joint)
            if names is not None:
                joined = {m.mode.place: m for m in modes.values()}
                followed = named([m.mode for m in modes.values()], names)
                modes = {key: joined[mode.place] for key, mode in followed.items()}
            return {key: _Symmetric(m.mode, m.log_f, m.split, m.slope) for key, m in modes.items()}
    laws = next((action.modulus_at for action in actions if action.modulus_at), None)
    problems = _problems(names)
    free = rated_modes(stage, materials, laws, problems) if laws else stage.solve(materials, problems).modes
    if names is not None:
        found = named(free, names)
    elif stage.heights_m:
        found = reference_names(stage, stage.solve(materials), free)
    else:
        # of a table the names are all that is known
        found = mode_keys(free)
    return {key: _Symmetric(mode, log(mode.frequency_hz)) for key, mode in found.items()}


def _problems(names: Names | None) -> frozenset[int] | None:
    """Harmonic problems whose modes are named; None for all."""
    return None if names is None else frozenset(problem for problem, _ in names)

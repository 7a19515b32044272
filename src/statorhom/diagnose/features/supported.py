"""Supported tests: the stator on springs, in the basis of its free modes.

How a supported frequency follows the materials is told by the energies of its own shape. What else moves the free
modes, such as stiffness that varies around the stator, moves it by their shares in its strain energy. A support
declared rigid has springs far stiffer than any stator.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.diagnose.bases.trained_basis import TrainedBasis
from statorhom.diagnose.features.mode_features import own_sd
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode, material_vector
from statorhom.diagnose.predicted.sinking import UNLIKE, held_shares, sinking
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.supported_slopes import HeldShapes, held_shapes
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials
from statorhom.model.broken.attachments import springs
from statorhom.model.broken.change import Attachment, Change
from statorhom.model.broken.named_response import Columns
from statorhom.model.broken.solve import BrokenModes, solve_broken
from statorhom.model.convergence import ModeKey
from statorhom.model.supports import HeldPoints, support_on
from statorhom.model.surface import surface_points
from statorhom.modes.supported_names import name_supported
from statorhom.physics.action import Action
from statorhom.study.regions import core_region
from statorhom.study.study import StudyFiles
from statorhom.study.supports import FaceSupport, LineSupport, SupportKeys

RIGID_PER_M2, RIGID_PER_M3 = 1e14, 1e16  # stiffness of what holds like a rock (N/m², N/m³)
OWN = 3e-3  # relative model error of a supported frequency: clamps have a form
REACH = 2.0  # of a test's highest mode: how far partners are sought
# springs whose shapes hold those of all others: part of the rigid stiffness, tangential ratio
TRAININGS = tuple((part, ratio) for part in (1e-6, 1e-5, 1e-4, 1e-3, 1.0) for ratio in (0.3, 1.2))


@dataclass(frozen=True, eq=False)
class SupportedReference:
    """Supported modes at the stage's reference.

    Parameters
    ----------
    log_f : (modes,) ln of the frequencies (Hz).
    shares : named free mode → (modes,) share of its strain energy.
    held : (modes,) share of the springs to the ground.
    slopes : (modes, entries) d ln f by the entries of `material_change`.
    own : (modes,) relative model error of the frequencies, each mode's own.
    sinking : (modes,) by how much they fall, relatively, where a line sinks in by a standard deviation more.
    radial : (modes, planes, angles) at the test's points, None where no shapes were measured or asked for.
    names : (r, n) of every mode, None where shapes were measured or names not asked for.
    """

    log_f: np.ndarray
    shares: Mapping[ModeKey, np.ndarray]
    held: np.ndarray
    slopes: np.ndarray
    own: np.ndarray
    sinking: np.ndarray
    radial: np.ndarray | None = None
    names: tuple[tuple[int | None, int | None], ...] | None = None

    @property
    def paired(self) -> bool:
        """Whether it can be paired with what was measured."""
        return self.radial is not None or self.names is not None


def elastic_keys(keys: SupportKeys) -> SupportKeys:
    """A support with a stiffness, whatever it is declared."""
    if keys.declared == "elastic":
        return keys
    table = keys.model_dump(exclude={"tangential_ratio"}) | {"declared": "elastic"}
    if isinstance(keys, FaceSupport):
        return FaceSupport.model_validate(table | {"normal_stiffness_n_per_m3": RIGID_PER_M3})
    return LineSupport.model_validate(table | {"normal_stiffness_n_per_m2": RIGID_PER_M2})


def supported_test(
    files: StudyFiles,
    stage: StageModel,
    test: MeasuredTest,
    actions: Sequence[Action],
    mark: tuple[Hashable, ...],
    shapes: bool = False,
) -> SupportedReference | None:
    """Modes of a supported test under actions; `mark` has one entry per action that tells it from others.

    Shapes and names cost more than all the rest; only a pairing needs them.
    """
    declared = files.study.support(test.support)
    held = [a.supports[test.support] for a in actions if test.support in a.supports]
    keys = held[-1] if held else declared
    assert keys is not None
    here = [(a, m) for a, m in zip(actions, mark, strict=True) if a.touches(stage.name, test.name)]
    parts = [(attached(stage, a, m), m) for a, m in here]
    # a support is known by its stiffness: what it dissipates moves no mode
    seen = (repr(keys), *(m for part, m in parts if part))
    more = [c for part, _ in parts for c in part]
    return supported_reference(stage, test, keys, more, seen, shapes)


def attached(stage: StageModel, action: Action, mark: Hashable) -> tuple[Attachment, ...]:
    """What an action attaches to the surface; kept under its mark."""
    if action.changes is None:
        return ()
    return stage.responses.once(("attached", mark), lambda: _attached(stage, action))


def _attached(stage: StageModel, action: Action) -> tuple[Attachment, ...]:
    assert action.changes is not None
    changes = action.changes(stage.model.mesh, stage.reference)
    return tuple(c for c in changes if isinstance(c, Attachment))


def without_attachments(action: Action) -> Action:
    """The rest: stiffness that varies counts by how far it shifts the free modes."""
    rule = action.changes
    if rule is None:
        return action

    def rest(mesh: HalfPitchMesh, materials: Materials) -> tuple[Change, ...]:
        return tuple(c for c in rule(mesh, materials) if not isinstance(c, Attachment))

    return replace(action, changes=rest)


def supported_reference(
    stage: StageModel,
    test: MeasuredTest,
    keys: SupportKeys,
    more: Sequence[Change],
    mark: Hashable,
    shapes: bool = False,
) -> SupportedReference | None:
    """Modes of a supported test with what else is attached; None for supports that hold end faces."""
    place = ("supported", test.name, mark)
    known = stage.responses.once(place, lambda: _solved(stage, test, keys, more, shapes))
    if shapes and known is not None and not known.paired:
        return stage.responses.put(place, _solved(stage, test, keys, more, shapes))
    return known


def _solved(
    stage: StageModel, test: MeasuredTest, keys: SupportKeys, more: Sequence[Change], shapes: bool
) -> SupportedReference | None:
    mesh = stage.model.mesh
    keys = elastic_keys(keys)
    support = support_on(mesh, keys)
    if support.ends is not None or support.points.stiffness is None:
        return None
    free = _free_basis(stage, test)
    springs = _springs(stage, support.points)
    modes = solve_broken(free.basis, [springs, *more], tolerance=None)
    log_f = np.log(modes.frequencies_hz)
    shares = {key: _share(modes, place) for key, place in free.columns.items()}
    parts = held_shares(modes, [springs, *(c for c in more if isinstance(c, Attachment))])
    held = np.asarray(parts.sum(axis=0))
    slopes = _shapes(stage, test, keys).slopes(modes, held, stage.reference)
    sinks = sinking(keys, parts, stage.reference[core_region(mesh.regions)].hooke)
    own = np.hypot(_own(stage, shares), UNLIKE * sinks)
    if not shapes:
        return SupportedReference(log_f, shares, held, slopes, own, sinks)
    if test.shapes is None:
        named = name_supported(modes, stage.model, stage.reference)
        return SupportedReference(
            log_f, shares, held, slopes, own, sinks, None, tuple((m.order, m.axial) for m in named)
        )
    z, angles = (a.ravel() for a in np.meshgrid(test.shapes.z_m, test.shapes.angles_rad, indexing="ij"))
    motion = modes.motion(surface_points(mesh, angles, z))[:, 0]
    shape = (len(test.shapes.z_m), len(test.shapes.angles_rad), len(modes))
    radial = np.moveaxis(motion.reshape(shape), -1, 0)
    return SupportedReference(log_f, shares, held, slopes, own, sinks, radial)


def _own(stage: StageModel, shares: Mapping[ModeKey, np.ndarray]) -> np.ndarray:
    """Relative model error of the frequencies: a clamp has a form, and the free modes they are made of have a mesh."""
    of_free = sum((share * own_sd(stage.error, key)) ** 2 for key, share in shares.items())
    return np.asarray(np.sqrt(OWN**2 + of_free))


def _shapes(stage: StageModel, test: MeasuredTest, keys: SupportKeys) -> HeldShapes:
    """Shapes on springs of all stiffnesses at the places of a support."""
    if test.name not in stage.held_shapes:
        springs = [_held_by(stage, _stiff(keys, *pair)) for pair in TRAININGS]
        solved = [solve_broken(_free_basis(stage, test).basis, [s], tolerance=None) for s in springs]
        stage.held_shapes[test.name] = held_shapes(stage.model, solved)
    return stage.held_shapes[test.name]


def _held_by(stage: StageModel, keys: SupportKeys) -> Attachment:
    return _springs(stage, support_on(stage.model.mesh, keys).points)


def _stiff(keys: SupportKeys, part: float, ratio: float) -> SupportKeys:
    """A support of another stiffness: a part of the rigid one's."""
    name, rigid = (
        ("normal_stiffness_n_per_m3", RIGID_PER_M3)
        if isinstance(keys, FaceSupport)
        else ("normal_stiffness_n_per_m2", RIGID_PER_M2)
    )
    return keys.model_copy(update={"declared": "elastic", name: part * rigid, "tangential_ratio": ratio})


def _springs(stage: StageModel, held: HeldPoints) -> Attachment:
    """Springs of a support; those of other stiffness share their points, whose loads are known then."""
    place = ("springs", held.angles.tobytes(), held.z.tobytes())
    found = springs(stage.model.mesh, held)
    known = stage.responses.once(place, lambda: found)
    return replace(known, stiffness=found.stiffness)


def _free_basis(stage: StageModel, test: MeasuredTest) -> TrainedBasis:
    """Free modes that a test's supported ones are made of."""
    return stage.below(REACH * max(mode.frequency_hz for mode in test.modes))


def _share(modes: BrokenModes, place: Columns) -> np.ndarray:
    energy = np.sum(modes.participation[place.numbers] ** 2, axis=0) * place.eigenvalue
    return np.asarray(np.minimum(energy / modes.eigenvalues, 1.0))


def predicted_logs(
    stage: StageModel,
    reference: SupportedReference,
    modes: Mapping[ModeKey, PredictedMode],
    materials: Materials,
) -> np.ndarray:
    """ln f of all supported modes at given materials; `modes` are the free ones predicted there."""
    change = material_change(stage.reference, materials)
    total = reference.log_f + reference.slopes @ change
    used = [key for key in reference.shares if key in modes]
    free = stage.reference_slopes(used)
    for key in used:
        # what of the free mode's shift the slopes do not say
        shift = modes[key].log_f - np.log(stage.reference_keys[key].frequency_hz)
        total += reference.shares[key] * (shift - free[key] @ change)
    return total


def material_change(before: Materials, after: Materials) -> np.ndarray:
    """What slopes by the entries of `material_vector` are multiplied by: frequencies follow powers of them."""
    regions = tuple(before)
    start, end = material_vector(before, regions), material_vector(after, regions)
    usable = start * end > 0.0
    ratio = np.divide(end, start, out=np.ones_like(start), where=usable)
    return np.where(usable, start * np.log(ratio), end - start)

"""One tested step of a study with all that its predictions need."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from statorhom.diagnose.bases.ring_basis import RingBasis, RingModes, mark_of, ring_basis
from statorhom.diagnose.bases.scatter_weights import scatter_weights
from statorhom.diagnose.bases.trained_basis import Examples, TrainedBasis, trained_basis
from statorhom.diagnose.contacts.joint_basis import JointBasis, joint_basis
from statorhom.diagnose.contacts.joint_training import KnownArc
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.processes.memory import Memory
from statorhom.diagnose.processes.side_by_side import workers
from statorhom.diagnose.stages.refinement import Refinement
from statorhom.diagnose.stages.supported_slopes import HeldShapes
from statorhom.geometry.stator import StepGeometry
from statorhom.identify.residuals.model_error import ModelError
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.mesh.density import MeshDensity
from statorhom.mesh.extrude import mesh_step
from statorhom.model.affine import AffineModel, Materials, assemble
from statorhom.model.broken.basis import SymmetricBasis, symmetric_basis
from statorhom.model.broken.visible import visible
from statorhom.model.convergence import ModeKey, converge, mode_keys
from statorhom.model.free_modes import FreeModes, problem_at
from statorhom.model.harmonic import Harmonic
from statorhom.model.kept import Kept
from statorhom.model.pitch_parts import pitch_parts
from statorhom.model.stator_mode import StatorMode
from statorhom.physics.action import Joint, Training
from statorhom.study.study_file import FREE

BAND = 1.12  # predictions reach this much higher than the highest measured mode
BROKEN_MARGIN = 1.25
CUT = 1.5  # of a narrower band: how far its basis reaches beyond it
MOST = 6  # modes of a harmonic problem on it
OF_REFERENCE = ("broken", "mirrors", "reference_keys", "scattered")
RESPONSES = 256  # to what breaks the symmetry, that are kept
FINER = 1.5  # second mesh of the extrapolation
# times as many cells through the back of the core: what is soft in a part of its depth bends it where two cannot follow
YOKE = 2


@dataclass(frozen=True, eq=False)
class StageModel:
    """A step on its mesh.

    Parameters
    ----------
    setup : geometry, regions, tests.
    tests : what was measured.
    ring : the symmetric stator near the materials that matter.
    reference : materials at which broken symmetry and mesh factors are computed.
    error : mesh factors.
    density : of the mesh.
    arcs : at which a contact that is weaker over one is predicted as the mesh has it.
    examples : key of a training → further examples of its changes, which the basis holds well.
    exact : whether it holds all that they ask for, which makes solutions dear.
    refinement : what a finer mesh adds to what breaks the symmetry at the reference.
    """

    setup: StageSetup
    tests: tuple[MeasuredTest, ...]
    ring: RingBasis
    reference: Materials
    error: ModelError
    density: MeshDensity
    _last: dict[bytes, tuple[frozenset[int], RingModes]] = field(default_factory=dict, repr=False)
    responses: Kept = field(default_factory=partial(Kept, RESPONSES), repr=False)
    _slopes: dict[bytes, dict[tuple[int, int], np.ndarray]] = field(default_factory=dict, repr=False)
    arcs: tuple[KnownArc, ...] = ()
    examples: Mapping[str, Examples] = field(default_factory=dict)
    exact: bool = False
    refinement: Refinement | None = None
    # what belongs to the reference and takes seconds
    memory: Memory = field(default_factory=Memory, repr=False)
    _trained: dict[tuple[str, ...], TrainedBasis] = field(default_factory=dict, repr=False)
    _corrected: dict[tuple[str, ...], TrainedBasis] = field(default_factory=dict, repr=False)
    _narrow: dict[float, TrainedBasis] = field(default_factory=dict, repr=False)
    held_shapes: dict[str, HeldShapes] = field(default_factory=dict, repr=False)
    sensor_responses: dict[tuple[float, ...], Any] = field(default_factory=dict, repr=False)
    # of the machine, whatever its reference
    _meshes: Kept = field(default_factory=Kept, repr=False)

    @property
    def name(self) -> str:
        """Of the stage."""
        return self.setup.keys.name

    @property
    def model(self) -> AffineModel:
        """The mesh's matrices."""
        return self.ring.model

    @property
    def finer(self) -> AffineModel:
        """The matrices of a finer mesh."""
        return self._meshes.once(FINER, lambda: _assembled(self.setup, self.density.refined(FINER)))

    @property
    def finely_layered(self) -> AffineModel:
        """The matrices of a mesh with more cells through the back of the core."""
        return self._meshes.once("layers", lambda: _assembled(self.setup, finely_layered(self.density)))

    @cached_property
    def heights_m(self) -> tuple[float, ...]:
        """Where its free tests measured shapes along the axis, ascending; empty where none did."""
        planes = {
            z for t in self.tests if t.support == FREE and t.shapes is not None for z in t.shapes.z_m.tolist()
        }
        return tuple(sorted(planes)) if len(planes) > 1 else ()

    @property
    def orders(self) -> tuple[int, ...]:
        """Harmonics that are predicted."""
        return tuple(sorted({p.space.order for p in self.ring.problems}))

    @cached_property
    def mirrors(self) -> bool:
        """Whether the stator is its own mirror image about the core's middle."""
        return len(pitch_parts(self.model.mesh)) > 1

    def solve(self, materials: Materials, problems: frozenset[int] | None = None) -> RingModes:
        """Symmetric modes, those of some harmonic problems at least; the last materials' are kept."""
        mark = mark_of(materials)
        whole = frozenset(range(len(self.ring.problems)))
        wanted = whole if problems is None else problems
        known, solved = self._last.get(mark, (frozenset[int](), None))
        if solved is None or not wanted <= known:
            if len(self._last) > 64:
                self._last.clear()
                self._slopes.clear()
            wanted = wanted | known
            solved = self.ring.solve(materials, wanted)
            self._last[mark] = wanted, solved
        return solved

    @cached_property
    def broken(self) -> SymmetricBasis:
        """Modes of all harmonics at the reference, for what breaks the symmetry."""
        top = self.ring.highest_hz
        found = symmetric_basis(
            self.model, self.reference, top, margin=BROKEN_MARGIN, certified=False, jobs=workers()
        )
        return visible(found, self._named.values())

    @property
    def _named(self) -> dict[ModeKey, tuple[Harmonic, float]]:
        """Problems and frequencies (Hz) of the named modes at the reference."""
        modes = self.reference_keys.items()
        return {key: (self.ring.problems[m.problem].space, m.frequency_hz) for key, m in modes}

    def joined(self, joint: Joint) -> JointBasis:
        """Modes with a contact around some regions, the same all around or weaker over arcs like those of `arcs`."""
        return self.memory.once(self._mark(joint), lambda: self._joined(joint))

    def _mark(self, joint: Joint) -> Hashable:
        # with arcs the contact elsewhere stays what it is
        return "joint", self._used(joint), None if joint.arc is None else (joint.normal, joint.tangential)

    def _used(self, joint: Joint) -> tuple[str, ...]:
        return tuple(r for r in joint.regions if r in self.model.mesh.regions)

    def condensed(self, samples: Sequence[tuple[Materials, Joint]], most: int) -> StageModel:
        """The stage with contacts that are lost over arcs in few vectors, good enough to tell windings apart.

        Parameters
        ----------
        samples : at least one, of all windings and arcs that matter (`JointBasis.condensed`).
        most : vectors of one family.
        """
        joint = samples[0][1]
        memory = Memory()
        memory.learn({self._mark(joint): self.joined(joint).condensed(samples, most)})
        return replace(self, memory=memory)

    def _joined(self, joint: Joint) -> JointBasis:
        differs = joint.arc is not None
        arcs = [arc.of(joint, self.reference) for arc in (self.arcs if differs else ())]
        return joint_basis(
            self.model.mesh,
            self._used(joint),
            self.reference,
            self.ring.highest_hz,
            self.orders,
            may_differ=differs,
            arcs=arcs,
        )

    @cached_property
    def reference_keys(self) -> Mapping[ModeKey, StatorMode]:
        """Modes at the reference by name."""
        return mode_keys(self.solve(self.reference).modes)

    def trained(self, trainings: Sequence[Training]) -> TrainedBasis:
        """The broken basis with what some changes need; the named modes at the frequencies that a fine mesh gives."""
        mark = tuple(sorted(t.key for t in trainings))
        if mark not in self._corrected:
            found = self._on_this_mesh(trainings)
            self._corrected[mark] = found.corrected({key: self.error.factor(key) for key in found.columns})
        return self._corrected[mark]

    def with_error(self, error: ModelError) -> StageModel:
        """The same stage with other mesh factors."""
        return replace(self, error=error, responses=Kept(RESPONSES), sensor_responses={}, _corrected={})

    def with_tests(self, tests: Sequence[MeasuredTest]) -> StageModel:
        """The same stage with other measurements."""
        return self._of_reference(replace(self, tests=tuple(tests)))

    def _of_reference(self, other: StageModel) -> StageModel:
        """Another one at the same reference, which knows what belongs to that alone."""
        other.__dict__.update({name: self.__dict__[name] for name in OF_REFERENCE if name in self.__dict__})
        return other

    def _on_this_mesh(self, trainings: Sequence[Training]) -> TrainedBasis:
        mark = tuple(sorted(t.key for t in trainings))
        if mark not in self._trained:
            named = self._named
            found = trained_basis(self.broken, named)
            for one in sorted(trainings, key=lambda t: t.key):
                found = found.trained(one.examples(self.model.mesh, self.reference), named)
                own = self.examples.get(one.key, ())
                found = found.with_all(own, named) if self.exact else found.with_own(own, named)
            self._trained[mark] = found
        return self._trained[mark]

    def below(self, highest_hz: float) -> TrainedBasis:
        """The broken basis for a narrower band: a soft winding has hundreds of modes beyond a clamped test's.

        Static responses stand for what lies above the cut.
        """
        cut = CUT * highest_hz
        if cut >= self.broken.cut_hz:
            return self._on_this_mesh(())
        known = self._narrow.get(highest_hz)
        if known is None:
            basis = replace(self.broken.truncated(cut), highest_hz=highest_hz)
            named = {key: place for key, place in self._named.items() if place[1] < cut}
            known = self._narrow[highest_hz] = trained_basis(basis, named)
        return known

    @cached_property
    def scattered(self) -> Mapping[ModeKey, float]:
        """Relative splits of the doublets by a unit of scatter, at the reference."""
        return scatter_weights(self.model, self.reference, self.solve(self.reference), self.reference_keys)

    def slopes(
        self, materials: Materials, places: Mapping[ModeKey, tuple[int, int]]
    ) -> dict[ModeKey, np.ndarray]:
        """d ln f by the Hooke entries and the density of all regions, one after the other.

        Parameters
        ----------
        places : of the modes (`StatorMode.place`).
        """
        solved = self.solve(materials, frozenset(problem for problem, _ in places.values()))
        known = self._slopes.setdefault(mark_of(materials), {})
        missing = set(places.values()) - set(known)
        for mode in solved.modes if missing else ():
            if mode.place in missing:
                known[mode.place] = solved.slope(mode, materials)
        return {key: known[place] for key, place in places.items() if place in known}

    def reference_slopes(self, keys: Iterable[ModeKey]) -> dict[ModeKey, np.ndarray]:
        """Slopes of the reference's modes at the reference."""
        return self.slopes(self.reference, {key: self.reference_keys[key].place for key in keys})


def stage_model(
    setup: StageSetup, tests: Sequence[MeasuredTest], snapshots: Sequence[Materials], density: MeshDensity
) -> StageModel:
    """A stage at the first of some materials, good near all of them; no mesh factors yet."""
    return on_mesh(_assembled(setup, density), setup, tests, snapshots, density)


def on_mesh(
    model: AffineModel,
    setup: StageSetup,
    tests: Sequence[MeasuredTest],
    snapshots: Sequence[Materials],
    density: MeshDensity,
) -> StageModel:
    """The same on a mesh that is there."""
    top = BAND * max(mode.frequency_hz for test in tests for mode in test.modes)
    named = [m.order for test in tests for m in test.modes if m.order is not None]
    highest = min(max([*named, 3]) + 1, model.mesh.slots // 2)
    ring = ring_basis(model, snapshots, top, range(highest + 1))
    return StageModel(setup, tuple(tests), ring, snapshots[0], ModelError(), density)


def finely_layered(density: MeshDensity) -> MeshDensity:
    """With more cells through the back of the core."""
    return replace(density, cells={**density.cells, "yoke": YOKE * density.cells["yoke"]})


def _assembled(setup: StageSetup, density: MeshDensity) -> AffineModel:
    assert isinstance(setup.step, StepGeometry)
    return assemble(mesh_step(setup.step, density))


def mesh_error(stage: StageModel, materials: Materials) -> ModelError:
    """Mesh factors from two meshes at given materials, which the stage's basis knows."""
    tests, ring, finer = stage.setup.tests, stage.ring, stage.finer
    orders = sorted({m.order for t in tests for m in t.modes if m.order is not None} or {2, 3, 4})
    fine = problem_at(finer, materials).solve(ring.highest_hz, orders, MOST, workers())
    coarse = FreeModes(ring.solve(materials).modes, (), (), ())
    found = converge([1.0, 1 / FINER], [ring.model.mesh.full_dof, finer.mesh.full_dof], [coarse, fine])
    error = ModelError.of_factors({c.key: c.factor for c in found})
    return replace(error, sds={c.key: c.doubt for c in found if c.doubt > 0.0})


def with_snapshots(stage: StageModel, materials: Sequence[Materials]) -> StageModel:
    """The stage at its reference, predicted well near further materials too."""
    return stage._of_reference(replace(stage, ring=stage.ring.extended(materials), _last={}, _slopes={}))


def with_reference(
    stage: StageModel,
    materials: Materials,
    arcs: tuple[KnownArc, ...] = (),
    examples: Mapping[str, Examples] | None = None,
) -> StageModel:
    """The stage at another reference, its mesh factors kept."""
    return replace(
        stage,
        arcs=arcs,
        examples=examples or {},
        refinement=None,
        ring=stage.ring.extended([materials]),
        reference=materials,
        _last={},
        _slopes={},
        memory=Memory(),
        _trained={},
        _corrected={},
        _narrow={},
        held_shapes={},
        responses=Kept(RESPONSES),
        sensor_responses={},
    )

"""The tested coupon or wing on its mesh, with the mesh's own error of every mode."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.features.mode_features import own_sd
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.stages.stage_model import BAND, FINER
from statorhom.errors import IdentificationError
from statorhom.identify.residuals.model_error import ModelError
from statorhom.identify.residuals.refinement import MeshSeries
from statorhom.identify.residuals.stage_problem import SEEN
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey, extrapolate, mode_keys
from statorhom.model.free_modes import problem_at
from statorhom.model.modal.acted_body import ActedBody
from statorhom.model.modal.modal_body import NEAR, WIDE, modal_body

FloatArray = npt.NDArray[np.float64]

SPARE = 4  # modes beyond the band that are predicted too
MORE = 6  # modes of the finer mesh beyond the elastic ones of the coarser: rigid bodies, and what comes into the band


@dataclass(frozen=True, eq=False)
class ReferenceModes:
    """What is known of the modes of the reference, the order being that of `ModalBody.reference`; 0 of rigid bodies.

    Parameters
    ----------
    log_factor : (m,) ln of the extrapolated frequency over the mesh's.
    shared, own : (m,) relative standard deviations of the mesh's error, common to all modes and of each by itself.
    visibility : (m,) 0 … 1.
    """

    log_factor: FloatArray
    shared: FloatArray
    own: FloatArray
    visibility: FloatArray


@dataclass(frozen=True)
class MeshError:
    """What a finer mesh tells of the modes, by parities and rank: mesh errors, and how well they are seen, 0 … 1."""

    error: ModelError = field(default_factory=ModelError)
    seen: Mapping[ModeKey, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class BodyStage:
    """A coupon near the materials that matter.

    Parameters
    ----------
    setup : geometry, regions, tests.
    tests : what was measured.
    series : its mesh and a finer one.
    body : its modal basis.
    varied : regions that have unknown constants.
    error : what a finer mesh tells.
    known : the same of the reference's modes.
    """

    setup: StageSetup
    tests: tuple[MeasuredTest, ...]
    series: MeshSeries
    body: ActedBody
    varied: frozenset[str]
    error: MeshError
    known: ReferenceModes
    _projectors: dict[str, FloatArray] = field(default_factory=dict, repr=False)

    @property
    def name(self) -> str:
        """Of the stage."""
        return self.setup.keys.name

    @property
    def count(self) -> int:
        """Modes that are predicted, rigid bodies included."""
        basis = self.body.basis
        return int(np.count_nonzero(basis.reference_hz < basis.highest_hz)) + SPARE

    def motion(self, test: MeasuredTest) -> FloatArray:
        """Motion (p, k) of the basis at the points of a test, along their directions."""
        assert test.points is not None
        moved = self.body.basis.motion(test.points.positions)
        return np.asarray(np.einsum("pd,pdk->pk", test.points.directions, moved))

    def projector(self, test: MeasuredTest) -> FloatArray:
        """From motion at the points of a test to amplitudes (c, p) of the reference's lowest modes."""
        if test.name not in self._projectors:
            assert test.points is not None
            basis = self.body.basis
            most = min(len(test.points.positions) // 2, basis.rigid + len(test.modes) + SPARE)
            shapes = self.motion(test) @ basis.reference[:, :most]
            self._projectors[test.name] = np.asarray(np.linalg.pinv(shapes, rcond=1e-2), dtype=float)
        return self._projectors[test.name]


def body_stage(
    setup: StageSetup,
    tests: Sequence[MeasuredTest],
    snapshots: Sequence[Materials],
    settings: Settings,
    varied: frozenset[str],
) -> BodyStage:
    """A coupon at the first of some materials, good near all of them.

    Parameters
    ----------
    varied : regions that have unknown constants.

    Raises
    ------
    IdentificationError
        If the body's mesh has no planes of symmetry that the basis could be made of.
    """
    assert setup.step is not None
    series = MeshSeries(setup.step, settings.density, (1.0, FINER))
    top = BAND * max(mode.frequency_hz for test in tests for mode in test.modes)
    model = series.coarsest
    if not isinstance(model.mesh, MirrorMesh):
        raise IdentificationError(f"{setup.keys.name}: this body cannot be diagnosed yet")
    # materials are sought before anything is attached
    basis = modal_body(model, snapshots, top, varied, reach=NEAR)  # type: ignore[arg-type]
    body = ActedBody(model, snapshots[0], basis)  # type: ignore[arg-type]
    zeros = np.zeros(len(body.basis.reference_hz))
    return BodyStage(
        setup,
        tuple(tests),
        series,
        body,
        varied,
        MeshError(),
        ReferenceModes(zeros, zeros, zeros, zeros + 1.0),
    )


def with_reference(
    stage: BodyStage,
    materials: Materials,
    others: Sequence[Materials] = (),
    *,
    mesh_known: bool = False,
    near: bool = False,
    reach: float = WIDE,
) -> BodyStage:
    """The stage at another reference.

    Parameters
    ----------
    others : materials near which the basis shall be good too.
    mesh_known : the mesh's errors are those that were computed before.
    near : the reference moves so little that local shapes, which take a solve for every point, stay what they were.
    reach : of the basis beyond the band; `NEAR` where nothing will be attached.
    """
    before = stage.body
    # local shapes are what the modes of a basis leave: of as many modes as there were
    counts = before.basis.counts if near else None
    basis = modal_body(
        before.model, [materials, *others], before.basis.highest_hz, stage.varied, counts, reach
    )
    body = ActedBody(before.model, materials, basis, before if near else None)
    error = stage.error if mesh_known else _mesh_error(stage.series, body)
    return replace(stage, body=body, error=error, known=_of_reference(error, body), _projectors={})


def _mesh_error(series: MeshSeries, body: ActedBody) -> MeshError:
    """Errors of the mesh, from a finer one."""
    basis = body.basis
    keys = basis.keys
    inside = [
        key[2] for key, hz in zip(keys, basis.reference_hz, strict=True) if key and hz < basis.highest_hz
    ]
    finer = problem_at(series.models[1], body.reference).solve(
        basis.highest_hz, most=max(inside, default=0) + 1 + MORE
    )
    fine = mode_keys(finer.modes)
    coarse = {key: float(basis.reference_hz[i]) for i, key in enumerate(keys) if key is not None}
    limits = {
        key: extrapolate(np.array([1.0, 1 / FINER]), np.array([coarse[key], fine[key].frequency_hz]))[0]
        for key in coarse
        if key in fine
    }
    error = ModelError.of_factors({key: limit / coarse[key] for key, limit in limits.items()})
    return MeshError(error, {key: min(1.0, mode.visibility / SEEN) for key, mode in fine.items()})


def _of_reference(found: MeshError, body: ActedBody) -> ReferenceModes:
    error, keys = found.error, body.basis.keys
    return ReferenceModes(
        np.array([0.0 if k is None else float(np.log(error.factor(k))) for k in keys]),
        np.array([0.0 if k is None else error.shared(k) for k in keys]),
        np.array([0.0 if k is None else own_sd(error, k) for k in keys]),
        np.array([0.0 if k is None else found.seen.get(k, 1.0) for k in keys]),
    )

"""The error map of shapes that a known lump makes lies at the lump; elements fall into their cells."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.diagnose.bases.ring_basis import ring_basis
from statorhom.diagnose.located.error_map import ErrorMap, binned, constitutive_error, error_maps
from statorhom.diagnose.measured.measured_test import MeasuredShapes, MeasuredTest
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.identify.residuals.model_error import ModelError
from statorhom.mesh import uniform
from statorhom.model.affine import assemble
from statorhom.model.broken.attachments import lump
from statorhom.model.broken.solve import solve_broken
from statorhom.model.surface import surface_points
from statorhom.study.modal_table import MeasuredMode

TOP = 9000.0
STACK = {"lamination": MATERIALS["lamination"]}
SETUP = SimpleNamespace(keys=SimpleNamespace(name="stack"))
ANGLES, HEIGHT = np.arange(24) * 2 * np.pi / 24, 0.7


@pytest.fixture(scope="module")
def stage() -> StageModel:
    model = assemble(stator_mesh(12))
    return StageModel(SETUP, (), ring_basis(model, [STACK], TOP, range(5)), STACK, ModelError(), uniform(1))


def maps(stage: StageModel, angle: float, mass: float) -> ErrorMap:
    """Map of the shapes and frequencies of the lumped stator, measured on its surface."""
    length = stage.model.mesh.length
    z = np.array([0.05, 0.35, 0.65, 0.95]) * length
    changes = [lump(stage.model.mesh, angle, HEIGHT * length, mass)]
    modes = solve_broken(stage.broken, changes, tolerance=None)
    grid = [a.ravel() for a in np.meshgrid(ANGLES, z)]
    motion = modes.shapes.motion(surface_points(stage.model.mesh, *grid))[:, 0]
    radial = np.moveaxis(motion.reshape(len(z), len(ANGLES), -1), -1, 0)
    rows, keys = [], []
    for key, place in stage.trained(()).columns.items():
        if key[0] in (2, 3) and place.sine is not None:
            weight = np.sum(modes.coordinates[[place.cosine, place.sine]] ** 2, axis=0)
            for number in np.argsort(-weight)[:2]:
                rows.append(number)
                keys.append(key)
    labels = tuple(str(i) for i in range(len(rows)))
    hz = modes.frequencies_hz[rows]
    measured = tuple(
        MeasuredMode(0, n, float(f), order=k[0]) for f, k, n in zip(hz, keys, labels, strict=True)
    )
    test = MeasuredTest(
        0, "free", "free", measured, True, shapes=MeasuredShapes(labels, z, ANGLES, radial[rows])
    )
    known = StageModel(SETUP, (test,), stage.ring, STACK, ModelError(), uniform(1))
    known.__dict__["broken"] = stage.broken
    plain = {
        k: SimpleNamespace(log_f=0.5 * np.log(p.eigenvalue) - np.log(2 * np.pi))
        for k, p in stage.trained(()).columns.items()
    }
    hypothesis = SimpleNamespace(
        study=SimpleNamespace(stages=(known,)),
        held={"free": tuple(keys)},
        all_features=lambda _: ([], {"stack": (known, {"free": plain})}),
    )
    (found,) = error_maps(SimpleNamespace(hypothesis=hypothesis, z=np.zeros(0)))  # type: ignore[arg-type]
    return found


@pytest.mark.parametrize("angle", [0.4, 2.5, 5.1])
def test_the_map_is_largest_at_a_lump(stage: StageModel, angle: float) -> None:
    found = maps(stage, angle, 0.03)
    total = sum(found.regions.values())
    assert total.sum() == pytest.approx(1.0)
    around = total.sum(axis=1)
    middle = (found.angles_rad[1:] + found.angles_rad[:-1]) / 2
    off = np.angle(np.exp(1j * (middle[np.argmax(around)] - angle)))
    assert abs(off) < np.deg2rad(20)
    # concentrated there: the error within 30° of the lump over that at the opposite side
    near = np.abs(np.angle(np.exp(1j * (middle - angle)))) < np.deg2rad(30)
    far = np.abs(np.angle(np.exp(1j * (middle - angle - np.pi)))) < np.deg2rad(30)
    assert around[near].sum() > 2 * around[far].sum()
    along = total[near].sum(axis=0)
    assert along[len(along) // 2 :].sum() > along[: len(along) // 2].sum()


def test_a_model_that_is_right_has_no_error(stage: StageModel) -> None:
    assert maps(stage, 1.0, 1e-9).error < 1e-2 * maps(stage, 1.0, 0.03).error


def test_unmeasured_points_do_not_count(stage: StageModel) -> None:
    rng = np.random.default_rng(1)
    rows = rng.standard_normal((12, len(stage.broken.values)))
    data = rng.standard_normal(12)
    square = float(np.median(stage.broken.values))
    whole = constitutive_error(stage.broken, rows[:9], data[:9], square)
    holes = constitutive_error(stage.broken, rows, np.r_[data[:9], np.full(3, np.nan)], square)
    assert holes[0] == pytest.approx(whole[0]) and holes[1] == pytest.approx(whole[1])


def test_energies_fall_into_the_cells_that_their_elements_lie_in() -> None:
    angles, heights = np.linspace(0, 2 * np.pi, 5), np.array([0.0, 1.0, 2.0])
    spans = np.array([[[-0.5, 0.5]], [[np.pi - 0.1, np.pi + 0.1]]])
    z = np.array([[0.0, 1.0], [0.5, 1.5]])
    found = binned(np.array([[4.0], [8.0]]), spans, z, angles, heights)
    assert found == pytest.approx(np.array([[2.0, 0.0], [2.0, 2.0], [2.0, 2.0], [2.0, 0.0]]))

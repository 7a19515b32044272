"""The machine that has a hypothesis's dimensions: when it is drawn, what it predicts, who leaves it again."""

from __future__ import annotations

import numpy as np
import pytest
from template_hypothesis import template_hypothesis

from statorhom.diagnose.fits import own_model as module
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import is_far, on_its_own_machine
from statorhom.diagnose.predicted.prediction import predicted
from statorhom.mesh import mesh_step
from statorhom.model.affine import assemble
from statorhom.model.convergence import mode_keys
from statorhom.model.free_modes import solve_free
from statorhom.physics.library import all_candidates

FREE = "frequency_hz,order,axial\n1428,2,0\n1766,2,1\n3770,3,0\n"
LENGTH = "core.length_mm"


@pytest.fixture(scope="module")
def declared(tmp_path_factory: pytest.TempPathFactory) -> Hypothesis:
    return template_hypothesis(tmp_path_factory.mktemp("study"), {"stack-free.csv": FREE})


@pytest.fixture(scope="module")
def shorter(declared: Hypothesis) -> Hypothesis:
    (length,) = (c for c in all_candidates(declared.study.files) if c.chosen.get("input") == "length_mm")
    return declared.of_others((length,))


def at(hypothesis: Hypothesis, part: float) -> np.ndarray:
    """Coordinates with a part of the typed length."""
    (value,) = hypothesis.candidates[0].parameters
    assert value.absent is not None
    return np.r_[np.zeros(hypothesis.constants), value.internal(part * value.absent)]


def test_a_dimension_near_the_typed_one_needs_no_other_drawing(shorter: Hypothesis) -> None:
    z = at(shorter, 0.99)
    assert not is_far(shorter, z)
    assert on_its_own_machine(shorter, z) is shorter


def test_the_drawn_machine_predicts_what_is_solved_on_its_mesh(shorter: Hypothesis) -> None:
    z = at(shorter, 0.85)
    assert is_far(shorter, z)
    drawn = on_its_own_machine(shorter, z)
    typed = shorter.study.files.geometry.core.length_mm
    assert drawn.study.files.geometry.core.length_mm == pytest.approx(0.85 * typed)
    assert drawn.study.dimensions == pytest.approx({LENGTH: 0.85 * typed})
    (stage,) = drawn.study.stages
    values = drawn.study.constants.values(z[: drawn.constants])
    found = predicted(drawn.study, stage, values, drawn.actions(z))
    assert stage.setup.step is not None
    mesh = mesh_step(stage.setup.step, stage.density)
    exact = mode_keys(solve_free(assemble(mesh), drawn.materials(stage, z), 6000.0, [2, 3]).modes)
    for key in ((2, 0, 0), (2, 1, 0), (3, 0, 0)):
        expected = np.log(exact[key].frequency_hz * stage.error.factor(key))
        assert found[key].log_f == pytest.approx(expected, abs=1e-5)
        # the cubic about the typed machine is near, but not there
        (typed_stage,) = shorter.study.stages
        far = predicted(shorter.study, typed_stage, values, shorter.actions(z))[key].log_f
        assert 1e-5 < abs(far - found[key].log_f) < 0.02


def test_its_basis_knows_other_materials_too(shorter: Hypothesis, monkeypatch: pytest.MonkeyPatch) -> None:
    """Constants that had made up for the wrong dimension are sought anew."""
    z = at(shorter, 0.85)
    several = on_its_own_machine(shorter, z)
    monkeypatch.setattr(module, "SNAPSHOTS", 1)
    alone = on_its_own_machine(shorter, z)
    far = z.copy()
    far[[n.endswith("E_p_pa") for n in shorter.study.constants.names] + [False]] = 1.5
    far[[n.endswith("G_rz_pa") for n in shorter.study.constants.names] + [False]] = -1.5
    off = [abs(np.log(sliding(h, far) / exactly(h, far))) for h in (several, alone)]
    assert off[0] < 1e-3 < off[1]


def sliding(hypothesis: Hypothesis, z: np.ndarray) -> float:
    """Frequency (Hz) of (2, 1), which slides, in the basis."""
    (stage,) = hypothesis.study.stages
    return mode_keys(stage.solve(hypothesis.materials(stage, z)).modes)[2, 1, 0].frequency_hz


def exactly(hypothesis: Hypothesis, z: np.ndarray) -> float:
    """The same on the full model."""
    (stage,) = hypothesis.study.stages
    return mode_keys(solve_free(stage.model, hypothesis.materials(stage, z), 6000.0, [2]).modes)[
        2, 1, 0
    ].frequency_hz


def test_what_does_not_correct_the_dimension_is_of_the_typed_machine(
    declared: Hypothesis, shorter: Hypothesis
) -> None:
    drawn = on_its_own_machine(shorter, at(shorter, 0.85))
    assert drawn.of_others(()).study is shorter.study
    assert drawn.of_others(drawn.candidates).study is drawn.study
    again = on_its_own_machine(drawn, at(shorter, 0.8))
    assert again.study.as_typed is shorter.study
    assert again.of_others(()).study is declared.study


def test_a_machine_that_cannot_be_drawn_is_none(declared: Hypothesis) -> None:
    (tooth,) = (c for c in all_candidates(declared.study.files) if c.chosen.get("input") == "tooth_width_mm")
    wider = declared.of_others((tooth,))
    z = at(wider, 2.9)
    assert is_far(wider, z)
    assert on_its_own_machine(wider, z) is wider

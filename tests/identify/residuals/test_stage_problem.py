"""The least-squares problem of a step."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
import synthetic_stage as stage

from statorhom.errors import MaterialError
from statorhom.identify.inference.finite_differences import jacobian
from statorhom.identify.residuals.model_error import ModelError
from statorhom.identify.residuals.stage_problem import (
    FOUND,
    HALF_FOUND,
    LABELLED_GATE,
    PAIRING_SD,
    corrected,
)
from statorhom.model.stator_mode import StatorMode

ERROR = ModelError(
    factors={(2, 0, 0): 0.99}, sds={(2, 0, 0): 1e-3}, corrections={(2, 0, 0): -0.01, (3, 0, 0): -0.02}
)


def truth(problem):
    return problem.space.internal(stage.TRUTH)


def off_truth(problem):
    return truth(problem) + 0.3 * np.random.default_rng(3).standard_normal(problem.space.dimension)


def test_the_truth_leaves_no_residual():
    problem = stage.problem()
    residuals = problem.data_residuals(truth(problem))
    assert residuals.shape == (6,)
    # in standard deviations of a thousandth: what the reduced basis is wrong by
    assert np.abs(residuals).max() < 0.5
    assert np.abs(problem.data_residuals(off_truth(problem))[:-1]).max() > 3.0


@pytest.mark.parametrize("labelled", [True, False])
def test_the_analytic_derivative_is_that_of_the_residuals(labelled):
    problem = stage.problem(stage.measured(labelled=labelled), error=ERROR)
    x = truth(problem) + 0.02
    held = problem.smooth_at(x)
    expected = jacobian(held.data_residuals, x, problem.space.bounds)
    found = problem.data_jacobian(x)
    np.testing.assert_allclose(found[:-1], expected[:-1], atol=2e-4 * np.abs(expected[:-1]).max())
    np.testing.assert_array_equal(found[-1], 0.0)


def test_tied_constants_share_a_derivative():
    problem = stage.problem(tied={"lamination": [["nu_p", "nu_pz"]]})
    x = truth(problem)
    assert problem.space.dimension == 6
    expected = jacobian(problem.smooth_at(x).data_residuals, x, problem.space.bounds)
    np.testing.assert_allclose(
        problem.data_jacobian(x)[:-1], expected[:-1], atol=2e-4 * np.abs(expected).max()
    )


def test_the_smooth_problem_holds_its_pairing():
    problem = stage.problem()
    x = truth(problem)
    held = problem.smooth_at(x)
    assert held.held == tuple((*name, 0) for name in stage.MODES)
    assert held.smooth_at(x + 1.0) is held
    np.testing.assert_array_equal(held.data_residuals(x), problem.data_residuals(x))


def test_an_unpaired_mode_costs_as_much_as_the_farthest_partner():
    modes = stage.measured()
    stray = replace(modes[0], order=7)
    problem = stage.problem((stray, *modes[1:]))
    x = truth(problem)
    residual = problem.data_residuals(x)[0]
    assert residual == pytest.approx(LABELLED_GATE * PAIRING_SD / problem.relative_sd(stray, None))
    np.testing.assert_array_equal(problem.data_jacobian(x)[0], 0.0)


def test_visible_modes_that_the_test_did_not_find_cost_by_their_visibility():
    complete, partial = stage.problem(), stage.problem(stage.measured(((2, 0), (2, 2), (3, 0), (3, 1))))
    x = truth(complete)
    missed = next(mode for mode in partial.simulated(x) if mode.key == (2, 1, 0))
    visible = missed.mode.visibility
    chance = 1 - FOUND * visible / (visible + HALF_FOUND)
    assert complete.data_residuals(x)[-1] == 0.0
    assert partial.data_residuals(x)[-1] == pytest.approx(np.sqrt(-2 * np.log(chance)))


def test_impossible_materials_have_no_residuals():
    class Impossible:
        def of(self, values):
            raise MaterialError(f"{len(values)} constants that no material has")

    problem = replace(stage.problem(), materials=Impossible())
    x = problem.space.start
    assert np.all(np.isnan(problem.data_residuals(x)))
    assert problem(x) == np.inf


def test_the_shared_error_moves_all_modes_together_in_its_own_pattern():
    problem = stage.problem(error=ERROR)
    x = truth(problem)
    shifted = x.copy()
    shifted[problem.space.coordinates.index("mesh")] += 1.0
    before, after = (
        {mode.key: mode.frequency_hz for mode in problem.simulated(point)} for point in (x, shifted)
    )
    for key, frequency in before.items():
        shift = problem.space.values(shifted)["mesh"] * ERROR.shared(key)
        assert after[key] / frequency == pytest.approx(1 + shift)
    assert ERROR.shared((3, 0, 0)) > ERROR.shared((2, 0, 0))
    plain = {mode.key: mode.frequency_hz for mode in stage.problem().simulated(x)}
    assert before[(2, 0, 0)] == pytest.approx(0.99 * plain[(2, 0, 0)])


def test_doubts_add_up():
    problem = stage.problem(error=ERROR)
    mode = stage.measured(sd=2e-3)[0]
    own = ERROR.own((2, 0, 0))
    wide = replace(problem, discrepancy=0.01)
    assert wide.relative_sd(mode, (2, 0, 0)) == pytest.approx(np.sqrt(2e-3**2 + own**2 + 0.01**2))
    assert problem.relative_sd(mode, None) == pytest.approx(2e-3)
    assert problem.relative_sd(replace(mode, frequency_sd_hz=None), None) > 0
    assert problem.coarse().discrepancy == PAIRING_SD


def test_a_partner_that_hardly_moves_the_surface_is_unlikely():
    def mode(visibility):
        return StatorMode(1000.0, 2, 0, "radial", visibility, 2, 0, 0)

    certain, faint = corrected([mode(0.5)], ModelError())[0], corrected([mode(0.01)], ModelError())[0]
    assert certain.visibility == 1.0
    assert faint.visibility == pytest.approx(0.2)
    problem = stage.problem()
    residual = replace(problem, discrepancy=PAIRING_SD)._hidden(((2, 0, 0), *[None] * 4), {(2, 0, 0): faint})
    assert residual == pytest.approx(-2 * np.log(0.2), rel=0.01)


def test_modes_without_a_name_are_left_uncorrected():
    hidden = StatorMode(1000.0, None, None, "winding", 1e-5, 1, 0, 0)
    found = corrected([hidden], ERROR, shift=1.0)[0]
    assert (found.key, found.frequency_hz, found.kind, found.multiplicity) == (None, 1000.0, "winding", 1)


def test_workers_get_an_empty_memory():
    problem = stage.problem()
    x = truth(problem)
    value = problem(x)
    assert problem._last
    copy = pickle.loads(pickle.dumps(problem))
    assert not copy._last
    assert copy(x) == pytest.approx(value)

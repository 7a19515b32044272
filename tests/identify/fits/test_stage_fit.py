"""The fit of one step on a ring whose truth is known."""

from dataclasses import replace

import numpy as np
import pytest
import synthetic_stage as stage

from statorhom.errors import IdentificationError
from statorhom.identify.bases.stage_basis import reduce_stage
from statorhom.identify.fits import stage_fit
from statorhom.identify.fits.stage_fit import (
    effective_constants,
    fit_stage,
    reduced_frequencies,
    search_space,
    unexplained,
)
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace, Tie
from statorhom.identify.parameters.prior_block import PriorBlock
from statorhom.identify.processes.workers import Workers
from statorhom.model.convergence import ModeConvergence, mode_keys
from statorhom.model.free_modes import solve_free
from statorhom.model.harmonic import problems_of

KNOWN = {"lamination": {"E_z_pa": 60e9, "nu_p": 0.29, "nu_pz": 0.31}}
MESH_FACTOR = 0.996  # of an infinitely fine mesh over the ring's, as the study below makes believe


class Refine:
    """A convergence study that finds the same error for every mode."""

    def __init__(self, factor):
        self.factor = factor
        self.calls = 0

    def __call__(self, materials):
        self.calls += 1
        modes = mode_keys(solve_free(stage.ring(), materials, stage.TOP_HZ, (2, 3)).modes)
        return tuple(
            ModeConvergence(key, (1, 2), (m.frequency_hz, m.frequency_hz), self.factor * m.frequency_hz, 3e-4)
            for key, m in modes.items()
        )


def fit(modes, *, refine=None, evaluations=80, chains=1, **identify):
    identify = {"evaluations": evaluations, "chains": chains, "fixed": KNOWN, **identify}
    with Workers() as workers:
        return fit_stage(
            stage.problem(modes, **identify),
            stage.keys(**identify).identify,
            refine or Refine(1.0),
            seed=1,
            workers=workers,
        )


@pytest.fixture(scope="module")
def fine():
    """Fit of the modes that an infinitely fine mesh would have."""
    refine = Refine(MESH_FACTOR)
    return fit(stage.measured(factor=MESH_FACTOR), refine=refine), refine


def test_the_constants_are_recovered_through_the_mesh_s_error(fine):
    result, refine = fine
    estimates = result.posterior.estimates()
    for name in ("lamination.E_p_pa", "lamination.G_rz_pa"):
        e = estimates[name]
        assert e.low90 <= stage.TRUTH[name] <= e.high90
        assert e.value == pytest.approx(stage.TRUTH[name], rel=0.01)
        assert e.status == "identified"
    assert estimates["lamination.density_kg_m3"].status == "prior_dominated"
    assert estimates["lamination.nu_p"].status == "fixed"
    assert result.problem.discrepancy == 0.0
    assert result.problem.error.factor((2, 0, 0)) == pytest.approx(MESH_FACTOR, rel=2e-3)
    assert 1 <= refine.calls <= 3
    assert {c.key for c in result.convergence} >= {(*name, 0) for name in stage.MODES}


def test_what_the_fit_did_not_see_is_predicted():
    seen = tuple(name for name in stage.MODES if name != (3, 1))
    result = fit(stage.measured(seen))
    found = reduced_frequencies(result.problem, result.posterior.best.x)[(3, 1, 0)]
    assert found == pytest.approx(stage.truth_modes()[(3, 1)], rel=5e-3)


def test_a_wrong_model_is_told_by_what_stays_unexplained(fine):
    scatter = np.array([0.01, -0.01, 0.012, -0.01, 0.008])
    spoilt = fit(stage.measured(noise=scatter))
    assert spoilt.problem.discrepancy > 5e-3
    widths = [
        e.high90 - e.low90 for e in (r.posterior.estimates()["lamination.E_p_pa"] for r in (fine[0], spoilt))
    ]
    assert widths[1] > 2 * widths[0]


def test_a_wrong_label_stays_out_or_is_counted_as_unexplained():
    modes = stage.measured()
    # (3, 0) sold as (2, 0): no mode of that name lies near
    wrong = (*modes[:3], replace(modes[3], order=2), modes[4])
    result = fit(wrong)
    held = result.problem.smooth_at(result.posterior.best.x).held
    assert held[3] is None
    e = result.posterior.estimates()["lamination.E_p_pa"]
    assert e.value == pytest.approx(stage.TRUTH["lamination.E_p_pa"], rel=0.02)


def test_unlabelled_modes_find_their_names():
    result = fit(stage.measured(labelled=False))
    held = result.problem.smooth_at(result.posterior.best.x).held
    assert held == tuple((*name, 0) for name in stage.MODES)


def test_the_same_seed_gives_the_same_fit(fine):
    again = fit(stage.measured(factor=MESH_FACTOR), refine=Refine(MESH_FACTOR))
    np.testing.assert_array_equal(again.posterior.best.x, fine[0].posterior.best.x)


def test_where_the_basis_is_not_certified_it_is_made_anew_around_the_optimum(monkeypatch):
    made = []

    def rebase(problem, optima):
        made.append(len(optima))
        return problem.solver

    def fitted():
        with Workers() as workers:
            problem = stage.problem(stage.measured(), fixed=KNOWN)
            keys = stage.keys(evaluations=80, chains=1).identify
            return fit_stage(problem, keys, Refine(1.0), rebase, seed=1, workers=workers)

    first = fitted()
    assert made == []  # the ring's basis is certified for all of its prior
    monkeypatch.setattr(stage_fit, "TOLERANCE", 0.0)
    again = fitted()
    assert 1 <= len(made) <= stage_fit.REBASED
    # of prior deviations
    np.testing.assert_allclose(again.posterior.best.x, first.posterior.best.x, atol=2e-3)


def test_nothing_to_fit_is_an_error():
    with pytest.raises(IdentificationError, match="no mode to fit"):
        fit(())


def test_a_stage_whose_constants_are_all_given_is_evaluated():
    given = {name.split(".")[1]: stage.TRUTH[name] for name in stage.TRUTH if name.endswith("_pa")}
    result = fit(stage.measured(), fixed={"lamination": {**KNOWN["lamination"], **given}})
    estimates = result.posterior.estimates()
    assert estimates["lamination.E_p_pa"].status == "fixed"
    assert estimates["lamination.density_kg_m3"].value == pytest.approx(7700.0, rel=2e-3)


def test_the_search_leaves_alone_what_is_known():
    earlier = PriorBlock(("lamination.E_p_pa", "lamination.nu_p"), [0.5, 0.0], np.diag([0.01, 1.0]))
    space = stage.space()
    extra = (
        Parameter("winding.E_pa", 1e11, 0.5e11, 2e11, 0.1e11, 9e11),
        Parameter("a", 1.0, 0.5, 2.0, 0.1, 9.0),
    )
    ties = (Tie(("lamination.E_p_pa", "winding.E_pa")),)
    full = ParameterSpace((*space.parameters, *extra), ties, (earlier,))
    searched = search_space(full)
    assert searched.coordinates == ("lamination.E_z_pa", "lamination.nu_pz", "lamination.G_rz_pa", "a")
    assert searched.ties == ()
    values = searched.values(searched.start)
    start = full.values(full.start)
    assert values["lamination.E_p_pa"] == pytest.approx(start["lamination.E_p_pa"])
    assert values["winding.E_pa"] == pytest.approx(start["lamination.E_p_pa"])
    assert values["mesh"] == 0.0


def test_unexplained_is_the_scatter_beyond_the_measurement():
    problem = stage.problem(stage.measured(noise=np.array([0.02, -0.02, 0.02, -0.02, 0.02])))
    x = problem.space.internal(stage.TRUTH)
    sharp = replace(problem, discrepancy=0.02)
    count = 5 - effective_constants(sharp, x)
    assert unexplained(sharp, x) == pytest.approx(0.02 * np.sqrt(5 / max(1.0, count)), rel=0.1)
    assert unexplained(stage.problem(), x) == 0.0


def test_a_mode_determines_at_most_one_constant():
    one = stage.problem(stage.measured(stage.MODES[:1]))
    x = one.space.internal(stage.TRUTH)
    assert 0.9 < effective_constants(one, x) <= 1.0
    assert effective_constants(stage.problem(), x) > 1.5


def test_reduced_bases_of_a_stage_are_those_of_its_harmonics():
    spaces = problems_of(stage.ring().mesh, {(2, 0)})
    progress = []
    with Workers() as workers:
        found = reduce_stage(
            stage.ring(), [stage.steel()], stage.steel(), spaces, 4000.0, workers, progress=progress.append
        )
    assert progress == [1]
    assert found.kinds.orders.tolist() == [2]
    assert found.highest_hz > 4000.0
    modes = mode_keys(found.solve(stage.steel()).modes)
    full = mode_keys(solve_free(stage.ring(), stage.steel(), 4000.0, (2,)).modes)
    assert modes[(2, 0, 0)].frequency_hz == pytest.approx(full[(2, 0, 0)].frequency_hz, rel=1e-9)

"""The two reduced models of a fit."""

from dataclasses import replace

import numpy as np
import synthetic_stage as stage

from statorhom.identify.bases.fit_bases import FitBases
from statorhom.identify.bases.stage_basis import LOCAL, SEARCH
from statorhom.identify.processes.announce import silent
from statorhom.identify.processes.workers import Workers
from statorhom.model.convergence import mode_keys
from statorhom.model.free_modes import solve_free
from statorhom.model.harmonic import problems_of

TOP_HZ = 4000.0


def made():
    """Reduced models over the prior and around the truth, with the number of announcements."""
    announced = []

    def announce(what, count):
        announced.append((what, count))
        return silent(what, count)

    spaces = problems_of(stage.ring().mesh, {(2, 0), (2, 1)})
    problem = stage.problem()
    with Workers() as workers:
        bases = FitBases(stage.ring(), spaces, TOP_HZ, workers, announce)
        wide = bases.over_prior(stage.space(), stage.LAMINATION, stage.steel())
        narrow = bases.around(replace(problem, solver=wide), [problem.space.internal(stage.TRUTH)])
    return wide, narrow, announced


def test_the_search_s_basis_is_coarse_and_the_one_around_its_result_exact():
    wide, narrow, announced = made()
    truth = stage.LAMINATION.of(stage.TRUTH)
    full = mode_keys(solve_free(stage.ring(), truth, TOP_HZ, (2,)).modes)
    errors = []
    for solver, plan in ((wide, SEARCH), (narrow, LOCAL)):
        solution = solver.solve(truth)
        found = mode_keys(solution.modes)
        error = max(abs(found[k].frequency_hz / full[k].frequency_hz - 1.0) for k in full)
        assert error <= max(solution.largest_certified_error, 1e-9)
        assert error <= plan.tolerance
        errors.append(error)
    assert errors[1] < errors[0]
    assert narrow.solve(truth).largest_certified_error <= LOCAL.tolerance
    assert [what for what, _ in announced] == ["reduced bases", "bases around the optima"]
    assert {count for _, count in announced} == {len(wide.kinds)}


def test_the_basis_around_an_optimum_is_smaller():
    wide, narrow, _ = made()
    sizes = [
        np.mean([b.padding.shape[-1] for cell in s.batches for room in cell for b in room])
        for s in (wide, narrow)
    ]
    assert sizes[1] < sizes[0]

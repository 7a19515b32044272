"""Chains have their own starts and their own random numbers."""

import numpy as np

from statorhom.identify.optimizers.annealing import SimulatedAnnealing
from statorhom.identify.optimizers.ensemble import run_ensemble
from statorhom.identify.parameters.bounds import Bounds
from statorhom.identify.processes.workers import Workers

BOX = Bounds([-4.0, -4.0], [4.0, 4.0])


def bowl(x):
    return float(np.sum((x - 1.0) ** 2))


def ensemble(starts, seed=1, **options):
    return run_ensemble(
        SimulatedAnnealing(),
        bowl,
        BOX,
        np.array(starts),
        evaluations=400,
        seed=seed,
        workers=Workers(),
        **options,
    )


def test_chains_share_the_budget_and_differ():
    seen = []
    results = ensemble([[0.0, 0.0]] * 4, progress=seen.append)
    assert [result.evaluations for result in results] == [100] * 4
    assert seen == list(range(1, 401))
    assert len({result.value for result in results}) == 4


def test_a_chain_does_not_depend_on_the_others_starts():
    one = ensemble([[0.0, 0.0], [3.0, 3.0]])
    two = ensemble([[0.0, 0.0], [-3.0, 2.0]])
    np.testing.assert_array_equal(one[0].history, two[0].history)


def test_the_same_seed_can_be_used_again():
    one, two, other = ensemble([[0.0, 0.0]]), ensemble([[0.0, 0.0]]), ensemble([[0.0, 0.0]], seed=2)
    np.testing.assert_array_equal(one[0].x, two[0].x)
    assert not np.array_equal(one[0].x, other[0].x)

"""Annealing finds minima and leaves its host alone."""

import itertools
import random
import signal
import threading

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.optimizers.annealing import SimulatedAnnealing
from statorhom.identify.optimizers.threshold import ThresholdAccepting
from statorhom.identify.parameters.bounds import Bounds

BOX = Bounds(np.full(3, -4.0), np.full(3, 4.0))
BOTH = pytest.mark.parametrize("optimizer", [SimulatedAnnealing(), ThresholdAccepting()], ids=["sa", "ta"])


def ripples(x):
    """A bowl with about 500 local minima; the lowest, 0, at (1, 1, 1)."""
    return float(np.sum(20.0 * (1.0 - np.cos(2.0 * np.pi * (x - 1.0))) + 10.0 * (x - 1.0) ** 2))


def run(optimizer, objective=ripples, **options):
    settings = {"evaluations": 3000, "seed": 3} | options
    return optimizer.minimize(objective, BOX, np.full(3, -3.0), **settings)


@BOTH
def test_the_lowest_of_many_minima_is_found(optimizer):
    values = [run(optimizer, seed=seed).value for seed in range(4)]
    # the next best minimum has the value 10
    assert sum(value < 2.0 for value in values) >= 3


@BOTH
def test_equal_seeds_give_equal_runs_whatever_the_global_generators_do(optimizer):
    random.seed(1)
    first = run(optimizer, evaluations=800)
    random.seed(2)
    np.random.seed(5)
    second, other = run(optimizer, evaluations=800), run(optimizer, evaluations=800, seed=4)
    np.testing.assert_array_equal(first.history, second.history)
    np.testing.assert_array_equal(first.x, second.x)
    assert not np.array_equal(first.x, other.x)


@BOTH
def test_the_host_is_left_alone(optimizer, capfd):
    state, handler = random.getstate(), signal.getsignal(signal.SIGINT)
    run(optimizer, evaluations=200)
    assert random.getstate() == state
    assert signal.getsignal(signal.SIGINT) is handler
    assert capfd.readouterr() == ("", "")


@BOTH
def test_it_works_outside_the_main_thread_and_several_at_once(optimizer):
    expected = [run(optimizer, seed=seed, evaluations=400).value for seed in range(3)]
    values = [np.nan] * 3

    def work(seed):
        values[seed] = run(optimizer, seed=seed, evaluations=400).value

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert values == expected


@BOTH
def test_the_box_is_never_left_and_the_budget_is_met_exactly(optimizer):
    seen = []

    def watched(x):
        assert BOX.contains(x)
        seen.append(ripples(x))
        return seen[-1]

    result = run(optimizer, watched, evaluations=321)
    assert len(seen) == result.evaluations == 321
    assert result.value == min(seen)
    assert ripples(result.x) == result.value
    assert np.all(np.diff(result.history[:, 1]) < 0.0)


@BOTH
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_points_without_a_value_are_never_accepted(optimizer, bad):
    result = run(optimizer, lambda x: bad if x[0] > 0.0 else float(np.sum((x - 0.5) ** 2)))
    assert result.x[0] <= 0.0
    assert result.value == pytest.approx(0.25, abs=0.02)


@BOTH
def test_a_start_without_a_value_and_a_plateau_do_no_harm(optimizer):
    lost = run(optimizer, lambda x: np.nan if x[0] < -1.0 else float(x @ x))
    assert lost.value < 0.05
    assert run(optimizer, lambda _: 7.0).value == 7.0
    assert run(optimizer, lambda _: np.nan).value == np.inf


@BOTH
@pytest.mark.parametrize("scale", [1e-8, 1e12])
def test_the_temperatures_follow_the_scale_of_the_objective(optimizer, scale):
    assert run(optimizer, lambda x: scale * float(x @ x)).value < 1e-2 * scale


@BOTH
def test_the_callback_sees_all_and_can_end_the_run(optimizer):
    seen = []

    def callback(count, best):
        seen.append((count, best))
        if count == 77:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(optimizer, callback=callback)
    assert [count for count, _ in seen] == list(range(1, 78))
    assert all(a >= b for (_, a), (_, b) in itertools.pairwise(seen))


@BOTH
def test_too_small_a_budget_is_said(optimizer):
    with pytest.raises(IdentificationError, match=r"raise identify\.evaluations"):
        run(optimizer, evaluations=49)

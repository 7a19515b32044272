"""Processes and inline work are interchangeable."""

import time

import numpy as np
import pytest
from threadpoolctl import threadpool_info

from statorhom.errors import IdentificationError, MaterialError
from statorhom.identify.processes.workers import Workers


def square(task, tick):
    for _ in range(3):
        tick()
    return task**2


def blas_threads(_task, tick):
    tick()
    np.linalg.eigvalsh(np.eye(3))
    return max((pool["num_threads"] for pool in threadpool_info()), default=1)


def refuse(task, _tick):
    raise MaterialError(f"no material {task}")


def endless(_task, tick):
    while True:
        time.sleep(0.005)
        tick()


@pytest.fixture(scope="module", params=[1, 2], ids=["inline", "processes"])
def workers(request):
    with Workers(request.param) as pool:
        yield pool


def test_results_come_in_the_order_of_the_tasks_and_ticks_are_counted(workers):
    seen = []
    assert workers.map(square, range(5), progress=seen.append) == [0, 1, 4, 9, 16]
    assert seen == sorted(seen)
    assert seen[-1] == 15


def test_linear_algebra_runs_on_one_thread(workers):
    assert workers.map(blas_threads, range(2)) == [1, 1]


def test_errors_keep_their_kind_and_the_next_tasks_still_run(workers):
    with pytest.raises(MaterialError, match="no material"):
        workers.map(refuse, range(3))
    assert workers.map(square, [2, 3]) == [4, 9]


def test_an_interrupt_ends_endless_tasks(workers):
    def interrupt(ticks):
        if ticks > 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        workers.map(endless, range(3), progress=interrupt)
    assert workers.map(square, [2, 3]) == [4, 9]


def test_no_job_at_all_is_refused():
    with pytest.raises(IdentificationError, match="at least one"):
        Workers(0)

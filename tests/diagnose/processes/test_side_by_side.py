"""Parts of a diagnosis in forked processes."""

import os
import pickle
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pytest

from statorhom.diagnose.processes.side_by_side import CAN_FORK, processes, side_by_side

needs_fork = pytest.mark.skipif(not CAN_FORK, reason="this system cannot fork")


class Model:
    """What no process can send to another."""

    def __init__(self) -> None:
        self.pid = os.getpid()

    def __reduce__(self):
        raise TypeError("a model cannot be sent")


@dataclass(frozen=True, eq=False)
class Found:
    model: Model
    values: np.ndarray
    nothing: None = None


@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_results_come_in_order_with_any_number_of_processes(jobs: int) -> None:
    with processes(jobs):
        assert side_by_side(lambda n: n**2, range(17)) == [n**2 for n in range(17)]
        assert side_by_side(lambda n: n, []) == []


@needs_fork
def test_several_processes_take_part() -> None:
    def slow(_: int) -> int:
        sum(n * n for n in range(200_000))
        return os.getpid()

    with processes(2):
        assert len(set(side_by_side(slow, range(12)))) == 2
        assert set(side_by_side(slow, range(12), least=13)) == {os.getpid()}
    assert set(side_by_side(slow, range(12))) == {os.getpid()}


@needs_fork
def test_within_an_item_nothing_is_forked_again() -> None:
    with processes(2):
        inner = side_by_side(lambda _: set(side_by_side(lambda _: os.getpid(), range(4))), range(4))
    assert all(len(pids) == 1 for pids in inner)


@needs_fork
def test_what_both_have_comes_back_as_it_is_and_is_never_sent() -> None:
    model = Model()
    with pytest.raises(TypeError):
        pickle.dumps(model)
    with processes(3):
        found = side_by_side(lambda n: Found(model, np.full(3, n)), range(9), shared=[model])
    assert all(one.model is model for one in found)
    assert [one.values[0] for one in found] == list(range(9))
    assert all(one.nothing is None for one in found)


@needs_fork
def test_what_a_child_cannot_send_is_done_here() -> None:
    with processes(2):
        found = side_by_side(lambda _: Model(), range(6))
    assert {one.pid for one in found} == {os.getpid()}


@needs_fork
def test_what_a_child_that_dies_did_not_do_is_done_here() -> None:
    own = os.getpid()

    def item(number: int) -> int:
        if os.getpid() != own:
            os._exit(1)
        return number

    with processes(2):
        assert side_by_side(item, range(50)) == list(range(50))


@pytest.mark.parametrize("jobs", [1, 2])
def test_errors_are_raised_here(jobs: int) -> None:
    def item(number: int) -> int:
        if number == 5:
            raise ValueError("five")
        return number

    with processes(jobs), pytest.raises(ValueError, match="five"):
        side_by_side(item, range(9))


ORPHAN = """
import os, sys, time
from statorhom.diagnose.processes.side_by_side import processes, side_by_side
parent = os.getpid()
def item(number):
    if os.getpid() == parent:
        time.sleep(0.2)
        os.kill(parent, 9)
    print(os.getpid(), flush=True)
    time.sleep(0.4)
    return bytes(300_000)
with processes(2):
    side_by_side(item, range(400))
"""


@needs_fork
def test_children_of_a_killed_parent_end() -> None:
    """Neither blocked on a pipe that nobody reads, nor busy with all that was left."""
    # the child holds the pipe of standard output: this returns when it is gone
    done = subprocess.run(
        [sys.executable, "-c", ORPHAN], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == -9
    assert len(done.stdout.split()) <= 2


@needs_fork
def test_items_that_stay_here_are_done_by_this_process_first() -> None:
    remembered = []

    def remember(n: int) -> int:
        remembered.append(n)
        sum(k * k for k in range(200_000))
        return os.getpid()

    with processes(2):
        pids = side_by_side(remember, range(8), here=[5, 6])
        assert side_by_side(lambda n: n, [3, 1], here=[0, 1]) == [3, 1]
    assert remembered[:2] == [5, 6] and pids[5] == pids[6] == os.getpid()
    assert len(set(pids)) == 2

"""What is made once stays, whichever process made it."""

import os

import pytest

from statorhom.diagnose.processes.memory import Memory, remembering
from statorhom.diagnose.processes.side_by_side import CAN_FORK, processes


def test_equal_marks_are_made_once() -> None:
    memory, made = Memory(), []
    for _ in range(2):
        assert memory.once(("square", 3), lambda: made.append(3) or 9) == 9
    assert made == [3]


@pytest.mark.parametrize("jobs", [1, 2, 3])
def test_what_other_processes_made_need_not_be_made_again(jobs: int) -> None:
    memories = [Memory(), Memory()]

    def square(n: int) -> int:
        return memories[n % 2].once(n, lambda: n**2)

    with processes(jobs):
        assert remembering(square, range(7), memories) == [n**2 for n in range(7)]
    for n in range(7):
        assert memories[n % 2].once(n, lambda: pytest.fail("made again")) == n**2
    assert memories[0].marks == {0, 2, 4, 6}


@pytest.mark.skipif(not CAN_FORK, reason="this system cannot fork")
def test_what_is_there_already_stays_the_same_object() -> None:
    memory = Memory()
    own = memory.once("own", lambda: [os.getpid()])
    with processes(2):
        remembering(lambda n: memory.once(n, lambda: [n]), range(4), [memory])
    assert memory.once("own", lambda: [0]) is own
    assert memory.beyond(frozenset({"own"})) == {n: [n] for n in range(4)}

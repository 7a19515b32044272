"""Threads of independent solutions, and what factors leave behind."""

from __future__ import annotations

import threading

from statorhom.model.threads import mapper


def numbers(jobs: int) -> set[int]:
    """Threads that did the work."""
    with mapper(jobs) as run:
        return set(run(lambda _: threading.get_ident(), range(20)))


def test_one_job_is_done_here() -> None:
    """SuperLU's factors must be dropped by the thread that made them."""
    assert numbers(1) == {threading.get_ident()}


def test_several_are_done_by_others() -> None:
    assert threading.get_ident() not in numbers(2)

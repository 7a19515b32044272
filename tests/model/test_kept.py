"""Results that are kept while they are among the latest."""

import pytest

from statorhom.model.kept import Kept


def test_what_was_asked_for_longest_ago_is_made_again() -> None:
    kept, made = Kept(2), list[int]()

    def square(n: int) -> int:
        return kept.once(n, lambda: made.append(n) or n**2)

    assert [square(n) for n in (1, 2, 1, 3, 1)] == [1, 4, 1, 9, 1]
    assert made == [1, 2, 3]
    assert square(2) == 4
    assert made == [1, 2, 3, 2]
    assert len(kept) == 2


def test_everything_stays_where_no_number_is_given() -> None:
    kept = Kept()
    for n in range(1000):
        kept.once(n, lambda n=n: n)
    assert kept.once(0, lambda: pytest.fail("made again")) == 0


def test_a_result_may_be_nothing_and_be_replaced() -> None:
    kept = Kept(2)
    assert kept.once("support", lambda: None) is None
    assert kept.once("support", lambda: pytest.fail("made again")) is None
    assert kept.put("support", 3) == 3
    assert kept.once("support", lambda: 4) == 3
    assert "support" in kept

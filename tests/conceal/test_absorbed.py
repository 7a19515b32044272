"""What a refit of the declared constants leaves of an effect."""

from dataclasses import dataclass
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.conceal.absorbed import Misfit, _settled, absorbed
from statorhom.conceal.declared_residual import WIDEST_SPLIT, Residual, _aligned

SPREADS = {"winding (wound).E_pa": 0.5, "lamination (stack).E_pa": 0.5}
NAMES = tuple(SPREADS)


@dataclass(frozen=True)
class Curved:
    """Modes whose ln f follow the constants' logarithms with a bend, and a truth at some of them."""

    truth: tuple[float, float]
    offset: float = 0.0
    name: str = "free"

    def _logs(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        share = 0.5 / (1 + np.exp(-np.array([[1.0, -1.0], [2.0, 0.5], [0.5, 1.5], [-1.0, 2.0]]) * x))
        return np.log(np.sum(np.exp(share), axis=1)), share

    def residual(self, changes) -> Residual:
        x = np.array([changes.get(n, 0.0) for n in NAMES])
        own, step = self._logs(x)[0], 1e-6
        slopes = {n: (self._logs(x + step * np.eye(2)[i])[0] - own) / step for i, n in enumerate(NAMES)}
        values = self._logs(np.array(self.truth))[0] - own
        values[0] += self.offset
        return Residual(self.name, ((2, 0, 0),), values, np.arange(4), slopes, SPREADS)


def test_what_constants_can_do_is_absorbed_although_one_step_does_not() -> None:
    test = Curved((-1.0, 0.6))
    misfit = absorbed([test])
    begin = test.residual({})
    one_step = np.column_stack([begin.slopes[n] for n in NAMES]) @ np.array(test.truth)
    assert np.abs(begin.values - one_step).max() > 20 * np.abs(misfit.values).max()
    assert misfit.left_sd < 3


def test_what_constants_cannot_do_is_left() -> None:
    clean, odd = absorbed([Curved((-0.2, 0.1))]), absorbed([Curved((-0.2, 0.1), offset=0.05)])
    assert clean.left_sd < 0.5
    assert odd.left_sd > 10


def test_constants_are_held_by_what_is_known_of_them() -> None:
    misfit = absorbed([Curved((-6.0, 6.0))])
    assert np.abs(misfit.changes).max() < 6.0
    assert misfit.merit >= np.sum((misfit.changes / 0.5) ** 2)


def test_nothing_compared_is_nothing_absorbed() -> None:
    assert absorbed([]) is None


def _brute(lines, modes, doublets):
    best = np.inf
    for choice in product([None, *range(len(modes))], repeat=len(lines)):
        taken = [c for c in choice if c is not None]
        if taken != sorted(taken) or any(taken.count(c) > (2 if doublets else 1) for c in taken):
            continue
        cost = 0.0
        for i, c in enumerate(choice):
            cost += 10.0 if c is None else np.log(lines[i] / modes[c]) ** 2
            if c is not None and i and choice[i - 1] == c and lines[i] >= WIDEST_SPLIT * lines[i - 1]:
                cost = np.inf
        apart = any(
            choice[i] is not None and choice[i] == choice[k] and None in choice[i + 1 : k]
            for i in range(len(lines))
            for k in range(i + 2, len(lines))
        )
        best = min(best, np.inf if apart else cost)
    return best


hertz = st.floats(500.0, 5000.0)


@given(st.lists(hertz, min_size=1, max_size=4), st.lists(hertz, min_size=0, max_size=3), st.booleans())
def test_lines_meet_the_modes_of_their_name_in_order(lines, modes, doublets) -> None:
    lines, modes = tuple(sorted(lines)), tuple(sorted(modes))
    found = _aligned(lines, modes, doublets)
    cost = sum(10.0 if j is None else np.log(f / modes[j]) ** 2 for f, j in zip(lines, found, strict=True))
    assert cost == pytest.approx(_brute(lines, modes, doublets), abs=1e-9)


def test_two_lines_farther_apart_than_a_doublet_have_modes_of_their_own() -> None:
    assert _aligned((791.0, 1472.0, 1679.0), (1080.0, 2269.0, 3289.0), True) == (0, 1, 2)
    assert _aligned((1000.0, 1010.0), (1005.0, 2000.0), True) == (0, 0)
    assert _aligned((1000.0, 1010.0), (1005.0, 2000.0), False) == (0, 1)


def test_a_valley_that_is_far_off_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.conceal.absorbed.PATIENCE", 3)
    asked = []

    class Counted(Curved):
        def residual(self, changes) -> Residual:
            asked.append(changes)
            return super().residual(changes)

    test = Counted((-6.0, 6.0), offset=1.0)
    begin = Misfit((test.residual({}),), NAMES, np.zeros(2))
    whole = _settled(begin, [test])
    steps = len(asked)
    asked.clear()
    left = _settled(begin, [test], far=0.0)
    assert len(asked) == 3 < steps
    assert left.merit > whole.merit

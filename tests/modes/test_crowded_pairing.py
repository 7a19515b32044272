"""Many lines without names near few doublets: the best pairing, in a bounded number of ways."""

from itertools import combinations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from plain_modes import Measured, Simulated
from statorhom.modes import pairing

SD, SPLIT, GATE = 0.05, 0.02, 4.0


def cost_of(given_to, lines, doublets):
    """Of giving each line one of the doublets or none."""
    total = GATE**2 * sum(j is None for j in given_to)
    for j, doublet in enumerate(doublets):
        own = [f for f, k in zip(lines, given_to, strict=True) if k == j]
        errors = [(np.log(f / doublet) / SD) ** 2 for f in own]
        apart = len(own) == 2 and abs(np.log(own[0] / own[1])) > SPLIT
        if len(own) > 2 or apart or any(e >= GATE**2 for e in errors):
            return np.inf
        total += sum(errors) + (2.0 * np.log(2.0) if len(own) == 2 else 0.0)
    return total


@given(st.lists(st.floats(1000, 1400), min_size=1, max_size=5), st.lists(st.floats(1000, 1400), max_size=3))
@settings(deadline=None, max_examples=60)
def test_no_other_way_is_cheaper(lines, doublets):
    simulated = [Simulated(f, 2, k) for k, f in enumerate(doublets)]
    found = pairing.pair([Measured(f) for f in lines], simulated, SD, gate=GATE, doublet_split=SPLIT)
    taken = {one.measured: one.simulated for one in found.pairs}
    ways = product([None, *range(len(doublets))], repeat=len(lines))
    best = min(cost_of(way, lines, doublets) for way in ways)
    assert cost_of([taken.get(i) for i in range(len(lines))], lines, doublets) == pytest.approx(best)


def test_the_number_of_ways_is_bounded(monkeypatch):
    made = []
    monkeypatch.setattr(
        pairing, "linear_sum_assignment", lambda table: made.append(1) or linear_sum_assignment(table)
    )
    rng = np.random.default_rng(1)
    simulated = [Simulated(f, 2, k) for k, f in enumerate(rng.uniform(1000, 2000, 16))]
    lines = rng.uniform(1000, 2000, 40)
    found = pairing.pair([Measured(f) for f in lines], simulated, SD, doublet_split=SPLIT, with_doubt=False)
    assert pairing.MOST < len(made) < 2 * pairing.MOST
    assert len(found.pairs) >= len(simulated)
    for one, other in combinations(found.pairs, 2):
        near = abs(np.log(lines[one.measured] / lines[other.measured])) <= SPLIT
        assert one.simulated != other.simulated or near

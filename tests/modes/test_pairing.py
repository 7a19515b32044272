import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plain_modes import Measured, Simulated
from statorhom.modes.pairing import pair

STACK = (
    Simulated(1360.0, 2, 0),
    Simulated(1700.0, 2, 1),
    Simulated(2100.0, None, None, "torsion", 0.0, 1),
    Simulated(3530.0, 3, 0),
    Simulated(4010.0, 3, 1),
)


def indices(pairing):
    return [one[:2] for one in pairing.pairs]


def test_labels_pair_and_the_rest_stays_unpaired_on_both_sides():
    measured = [Measured(4020.0, 3, 1), Measured(1350.0, 2, 0), Measured(9000.0, 7, 0)]
    pairing = pair(measured, STACK, 0.02)
    assert indices(pairing) == [(0, 4), (1, 0)]
    assert pairing.unpaired_measured == (2,)
    assert pairing.unpaired_simulated == (1, 2, 3)
    assert all(one.doubt < 1e-6 for one in pairing.pairs)


def test_a_label_outweighs_a_nearer_frequency():
    assert indices(pair([Measured(1700.0, 2, 0)], STACK, 0.05)) == [(0, 0)]


def test_a_mode_of_several_names_takes_the_one_that_leaves_nothing_over():
    # the first may be called (2, 2) too, and lies nearer to that: the second can be nothing else
    simulated = [Simulated(6020.0, 2, 1), Simulated(6093.0, 2, 2)]
    measured = [Measured(5964.0, 2, 1), Measured(6004.0, 2, 2)]
    assert indices(pair(measured, simulated, 0.05, also=[[2, 3], []])) == [(0, 0), (1, 1)]
    assert indices(pair(measured[1:], simulated[:1], 0.05, also=[[2, 3]])) == [(0, 0)]
    assert indices(pair(measured[1:], simulated[:1], 0.05)) == []


def test_both_modes_of_a_doublet_are_called_alike():
    measured = [Measured(5964.0, 2, 1), Measured(5970.0, 2, 2)]
    assert indices(pair(measured, [Simulated(5966.0, 2, 1)], 0.05, also=[[2]])) == [(0, 0)]


def test_half_a_label_leaves_the_other_half_open():
    assert indices(pair([Measured(1690.0, 2, None)], STACK, 0.02)) == [(0, 1)]
    assert indices(pair([Measured(1650.0, None, 0)], STACK, 0.05)) == [(0, 0)]
    assert pair([Measured(2100.0, None, 0)], STACK, 0.001).pairs == ()


def test_unlabelled_modes_pair_by_frequency():
    measured = [Measured(1340.0), Measured(1720.0), Measured(3560.0), Measured(2600.0)]
    pairing = pair(measured, STACK, 0.02)
    assert indices(pairing) == [(0, 0), (1, 1), (2, 3)]
    assert pairing.unpaired_measured == (3,)


def test_unlabelled_modes_never_pair_with_what_cannot_be_seen():
    assert pair([Measured(2100.0)], STACK, 0.02).unpaired_measured == (0,)


def test_the_more_visible_of_two_equally_near_modes_is_taken():
    simulated = [Simulated(990.0, 2, 0, visibility=0.05), Simulated(1010.1, 3, 0, visibility=0.9)]
    (only,) = pair([Measured(1000.0)], simulated, 0.02).pairs
    assert only.simulated == 1
    assert only.doubt == pytest.approx(0.05 / 0.95, rel=0.02)


def test_doubt_grows_to_a_half_where_another_explanation_is_as_good():
    near = [Simulated(1000.0 * np.exp(-0.01), 2, 0), Simulated(1000.0 * np.exp(0.01), 3, 0)]
    assert pair([Measured(1000.0)], near, 0.02).pairs[0].doubt == pytest.approx(0.5)
    clear = [near[0], Simulated(2000.0, 3, 0)]
    assert pair([Measured(1000.0)], clear, 0.02).pairs[0].doubt < 0.01
    at_the_gate = pair([Measured(1000.0)], [Simulated(1000.0 * np.exp(0.0799), 2, 0)], 0.02)
    assert at_the_gate.pairs[0].doubt == pytest.approx(0.5, abs=0.02)


def test_doubt_of_one_label_does_not_spread_to_others():
    ambiguous = (*STACK, Simulated(1361.0, 4, 0))
    pairing = pair([Measured(1360.5), Measured(3530.0, 3, 0)], ambiguous, 0.02)
    first, second = pairing.pairs
    assert first.doubt > 0.4
    assert second.doubt < 1e-6


def test_doubt_costs_time_and_can_be_left_out():
    quick = pair([Measured(1350.0)], STACK, 0.02, with_doubt=False)
    assert indices(quick) == [(0, 0)]
    assert np.isnan(quick.pairs[0].doubt)


ABSORBER_PAIR = (Simulated(1760.0, 2, 0), Simulated(4250.0, 2, 0, visibility=0.3), Simulated(1900.0, 2, 1))


def test_absorber_pair_measured_twice():
    measured = [Measured(4200.0, 2, 0), Measured(1740.0, 2, 0)]
    assert indices(pair(measured, ABSORBER_PAIR, 0.05)) == [(0, 1), (1, 0)]


@pytest.mark.parametrize(("frequency", "taken", "left"), [(1800.0, 0, 1), (4100.0, 1, 0)])
def test_absorber_pair_measured_once(frequency, taken, left):
    pairing = pair([Measured(frequency, 2, 0)], ABSORBER_PAIR, 0.05)
    assert indices(pairing) == [(0, taken)]
    assert left in pairing.unpaired_simulated


def test_a_doublet_measured_twice_is_one_simulated_doublet():
    measured = [Measured(1352.0, 2, 0), Measured(1366.0, 2, 0), Measured(1710.0, 2, 1)]
    pairing = pair(measured, STACK, 0.02)
    assert indices(pairing) == [(0, 0), (1, 0), (2, 1)]
    assert pairing.unpaired_simulated == (2, 3, 4)


def test_an_unlabelled_doublet_is_one_simulated_doublet():
    assert indices(pair([Measured(1352.0), Measured(1366.0)], STACK, 0.02)) == [(0, 0), (1, 0)]


def test_a_single_mode_takes_one_measured_mode_only():
    simulated = [Simulated(3000.0, 0, 0, multiplicity=1)]
    pairing = pair([Measured(3030.0, 0, 0), Measured(3010.0, 0, 0)], simulated, 0.02)
    assert indices(pairing) == [(1, 0)]
    assert pairing.unpaired_measured == (0,)


def test_modes_too_far_apart_for_a_doublet_do_not_share_one():
    # the upper mode of an absorber pair beyond the simulated range must not join the lower one's doublet
    pairing = pair([Measured(1900.0, 2, 0), Measured(1740.0, 2, 0)], [Simulated(1760.0, 2, 0)], 0.05)
    assert indices(pairing) == [(1, 0)]


def test_a_third_mode_far_away_does_not_take_half_a_doublet():
    measured = [Measured(1000.0, 2, 0), Measured(1010.0, 2, 0), Measured(1300.0, 2, 0)]
    pairing = pair(measured, [Simulated(1140.0, 2, 0)], 0.05)
    shared = {one.measured for one in pairing.pairs}
    assert shared == {0, 1}
    assert pairing.unpaired_measured == (2,)


def test_rigid_body_modes_and_empty_sides():
    assert pair([Measured(1.0)], [Simulated(0.0, None, None, "axial", 1.0, 1)], 10.0).pairs == ()
    nothing = pair([], STACK, 0.02)
    assert (nothing.pairs, nothing.unpaired_simulated) == ((), (0, 1, 2, 3, 4))
    assert pair([Measured(1000.0)], [], 0.02).unpaired_measured == (0,)
    assert pair([], [], 0.02).pairs == ()


def test_each_measured_mode_may_have_its_own_uncertainty():
    simulated = [Simulated(1050.0, 2, 0), Simulated(2100.0, 3, 0)]
    pairing = pair([Measured(1000.0), Measured(2000.0)], simulated, [0.005, 0.05])
    assert indices(pairing) == [(1, 1)]


@pytest.mark.parametrize(
    ("frequency", "log_sd", "gates"),
    [
        (float("nan"), 0.02, {}),
        (0.0, 0.02, {}),
        (1000.0, 0.0, {}),
        (1000.0, float("inf"), {}),
        (1000.0, 0.02, {"gate": float("inf")}),
        (1000.0, 0.02, {"labelled_gate": 0.0}),
    ],
)
def test_values_without_meaning_are_refused(frequency, log_sd, gates):
    with pytest.raises(ValueError, match="finite and positive"):
        pair([Measured(frequency)], STACK, log_sd, **gates)


modes = st.lists(
    st.tuples(st.floats(500, 8000), st.sampled_from([None, 1, 2, 3]), st.sampled_from([None, 0, 1])),
    max_size=7,
)


@given(measured=modes, simulated=modes, factor=st.floats(0.01, 100))
@settings(deadline=None, max_examples=60)
def test_invariants(measured, simulated, factor):
    ours = [Measured(*one) for one in measured]
    theirs = [
        Simulated(f, r, 0 if n is None else n, multiplicity=2 if r else 1)
        if r
        else Simulated(f, None, None, "axial")
        for f, r, n in simulated
    ]
    pairing = pair(ours, theirs, 0.05)
    used = [one.simulated for one in pairing.pairs]

    assert sorted([one.measured for one in pairing.pairs] + list(pairing.unpaired_measured)) == list(
        range(len(ours))
    )
    assert set(used) | set(pairing.unpaired_simulated) == set(range(len(theirs)))
    assert not set(used) & set(pairing.unpaired_simulated)
    for i, j, doubt in pairing.pairs:
        assert used.count(j) <= theirs[j].multiplicity
        assert ours[i].order in (None, theirs[j].order)
        assert ours[i].axial in (None, theirs[j].axial)
        assert 0.0 <= doubt <= 0.5
    assert pair(ours, theirs, 0.05) == pairing

    scaled = pair(
        [Measured(m.frequency_hz * factor, m.order, m.axial) for m in ours],
        [Simulated(s.frequency_hz * factor, s.order, s.axial, s.kind, 1.0, s.multiplicity) for s in theirs],
        0.05,
    )
    if all(one.doubt < 0.49 for one in pairing.pairs):
        assert indices(scaled) == indices(pairing)


@given(st.permutations(range(5)), st.permutations(range(4)))
@settings(deadline=None, max_examples=30)
def test_the_order_of_the_lists_does_not_matter(simulated_order, measured_order):
    measured = [Measured(1352.0, 2, 0), Measured(1366.0), Measured(1720.0), Measured(3500.0, 3, None)]
    straight = {(m, s) for m, s, _ in pair(measured, STACK, 0.02).pairs}
    shuffled = pair([measured[i] for i in measured_order], [STACK[j] for j in simulated_order], 0.02)
    assert {(measured_order[m], simulated_order[s]) for m, s, _ in shuffled.pairs} == straight

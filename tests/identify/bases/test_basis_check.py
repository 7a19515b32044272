"""The reduced model is held against the full one."""

from dataclasses import replace

import synthetic_stage as stage

from statorhom.identify.bases.basis_check import BasisCheck, check_basis, together
from statorhom.model.free_modes import solve_free


def full():
    return solve_free(stage.ring(), stage.LAMINATION.of(stage.TRUTH), stage.TOP_HZ, (2, 3))


def test_the_reduced_model_is_as_good_as_its_certificate():
    check = check_basis(stage.reduced().solve(stage.LAMINATION.of(stage.TRUTH)), full())
    assert check.holds
    assert 0.0 < check.deviation <= check.certified < 1e-2


def test_a_mode_that_lies_elsewhere_is_named():
    exact = full()
    wrong = tuple(
        m._replace(frequency_hz=0.98 * m.frequency_hz) if (m.order, m.axial) == (2, 0) else m
        for m in exact.modes
    )
    check = check_basis(stage.reduced().solve(stage.LAMINATION.of(stage.TRUTH)), replace(exact, modes=wrong))
    assert not check.holds
    assert set(check.broken) == {(2, 0)}
    assert check.deviation > 0.019


def test_of_several_optima_the_worst_counts():
    one, other = BasisCheck(1e-5, 1e-3, ()), BasisCheck(2e-3, 1e-4, ((3, 1), (2, 0)))
    both = together([one, other])
    assert (both.deviation, both.certified) == (2e-3, 1e-3)
    assert both.broken == ((2, 0), (3, 1))
    assert together([one]) == one

"""What the mesh may be wrong by."""

import numpy as np
import pytest

from statorhom.identify.residuals.model_error import (
    OWN,
    OWN_PART,
    SHARED_FLOOR,
    SHARED_PART,
    ModelError,
    model_error,
)
from statorhom.model.convergence import ModeConvergence


def converged(key, first, limit, sd):
    return ModeConvergence(key, (10, 20), (first, (first + limit) / 2), limit, sd)


ERROR = model_error(
    [converged((2, 0, 0), 1010.0, 1000.0, 1e-3), converged((2, 1, 0), 2040.0, 2000.0, 0.0)],
    {(2, 0, 0): 1011.0, (2, 1, 0): 2040.0, (3, 0, 0): 3000.0},
)


def test_factors_take_the_reduced_model_s_error_along():
    assert 1011.0 * ERROR.factor((2, 0, 0)) == pytest.approx(1000.0)
    # the mesh's own error does not know the basis
    assert ERROR.corrections[(2, 0, 0)] == pytest.approx(1000 / 1010 - 1)


def test_modes_that_were_not_computed_take_the_mean_of_their_order_or_of_all():
    mean = (ERROR.factor((2, 0, 0)) + ERROR.factor((2, 1, 0))) / 2
    assert ERROR.factor((2, 2, 0)) == pytest.approx(mean)
    assert ERROR.factor((5, 0, 0)) == pytest.approx(mean)
    single = ModelError({(2, 0, 0): 0.99, (3, 0, 0): 0.9})
    assert single.factor((3, 1, 0)) == 0.9


def test_a_factor_that_others_stand_in_for_is_as_uncertain_as_they_differ():
    """Of a stack of 48 slots (2, 0) is corrected by 0.5 %, (2, 2) by 4.3 %: what of (2, 3), which no mesh study had?"""
    known = ModelError({(2, 0, 0): 0.995, (2, 2, 0): 0.957, (3, 0, 0): 0.987})
    assert known.borrowed((2, 0, 0)) == 0.0
    assert known.borrowed((2, 3, 0)) == pytest.approx(0.019)
    assert known.borrowed((4, 0, 0)) == pytest.approx(np.std([0.995, 0.957, 0.987]))
    assert ModelError().borrowed((2, 0, 0)) == 0.0


def test_uncertainties_follow_the_correction():
    correction = 1000 / 1010 - 1
    assert ERROR.shared((2, 0, 0)) == pytest.approx(np.hypot(SHARED_FLOOR, SHARED_PART * correction))
    assert ERROR.own((2, 0, 0)) == pytest.approx(np.hypot(1e-3, OWN_PART * correction))
    assert ERROR.own((2, 1, 0)) > OWN  # an extrapolation that agrees with itself is not exact


def test_without_a_convergence_study_nothing_is_corrected():
    plain = ModelError()
    assert plain.factor((2, 0, 0)) == 1.0
    assert plain.shared((2, 0, 0)) == SHARED_FLOOR
    assert plain.own((2, 0, 0)) == OWN


def test_modes_that_the_reduced_model_lacks_are_left_out():
    lost = model_error([converged((4, 0, 0), 1010.0, 1000.0, 1e-3)], {})
    assert dict(lost.factors) == dict(lost.sds) == dict(lost.corrections) == {}

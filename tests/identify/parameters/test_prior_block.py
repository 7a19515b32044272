"""Joint priors are checked where they are made."""

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.prior_block import PriorBlock


@pytest.mark.parametrize(
    "covariance", [[[1.0, 2.0], [2.0, 1.0]], [[1.0, 0.1], [0.3, 1.0]], [[np.nan, 0.0], [0.0, 1.0]]]
)
def test_what_is_no_covariance_is_refused(covariance):
    with pytest.raises(IdentificationError, match="a, b: the covariance is not symmetric positive definite"):
        PriorBlock(("a", "b"), np.zeros(2), covariance)


def test_shapes_must_agree():
    with pytest.raises(IdentificationError, match="give 2 means"):
        PriorBlock(("a", "b"), np.zeros(3), np.eye(2))

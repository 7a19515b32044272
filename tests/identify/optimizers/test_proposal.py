"""Step lengths follow the landscape."""

import numpy as np

from statorhom.identify.optimizers.proposal import Proposal
from statorhom.identify.parameters.bounds import Bounds


def test_steps_shrink_where_the_objective_is_steep_and_stay_where_it_is_flat():
    rng = np.random.default_rng(0)
    proposal = Proposal(Bounds([-5.0, -5.0], [5.0, 5.0]), rng)
    x = np.zeros(2)

    def value(point):
        return (point[0] / 1e-3) ** 2 + point[1] ** 2

    for _ in range(2000):
        candidate = proposal.propose(x)
        accepted = np.log(rng.random()) < 0.5 * (value(x) - value(candidate))
        proposal.feedback(accepted)
        x = candidate if accepted else x
    assert 2e-4 < proposal.steps[0] < 2e-2
    assert 0.3 < proposal.steps[1] <= 1.0


def test_jumps_reach_the_other_end_of_the_box():
    proposal = Proposal(Bounds([-5.0, -5.0], [5.0, 5.0]), np.random.default_rng(1))
    points = np.array([proposal.propose(np.full(2, -4.5)) for _ in range(2000)])
    assert np.all(points.max(axis=0) > 3.0)

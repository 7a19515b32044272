"""The angular map's peaks: 2r of one order, θ and θ + π of several, none at a cause of the other sign."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.located.angular_map import SplitSeen, angular_map

ANGLES = np.deg2rad(np.arange(0.0, 360.0, 1.0))


def splits(angle: float, orders: tuple[int, ...], sign: float = -1.0) -> list[SplitSeen]:
    """Of a mass (-1) or a stiffness (+1) at an angle."""
    return [SplitSeen("s", "t", (r, 0, 0), sign * 0.01 * np.exp(2j * r * angle), 1e-4) for r in orders]


def peaks(weights: np.ndarray) -> list[int]:
    """Degrees of the highest points, those within 1 % of the largest."""
    around = (np.roll(weights, 1) <= weights) & (np.roll(weights, -1) < weights)
    return [int(i) for i in np.flatnonzero(around & (weights > 0.99 * weights.max()))]


@pytest.mark.parametrize(
    ("orders", "expected"),
    [
        ((2,), [63, 153, 243, 333]),
        ((2, 3), [63, 243]),
        ((2, 4), [63, 153, 243, 333]),
        ((3,), [3, 63, 123, 183, 243, 303]),
    ],
)
def test_orders_leave_their_own_ambiguity(orders: tuple[int, ...], expected: list[int]) -> None:
    unit = {(r, 0, 0): -0.02 + 0j for r in orders}
    weights = angular_map(splits(np.deg2rad(63.0), orders), unit, ANGLES, signed=True)
    assert weights.max() == pytest.approx(1.0)
    assert peaks(weights) == expected


def test_a_cause_of_the_other_sign_lies_elsewhere() -> None:
    seen = splits(np.deg2rad(63.0), (2, 3))
    stiff = angular_map(seen, {s.key: 1.0 for s in seen}, ANGLES, signed=True)
    assert stiff[63] == 0.0 and stiff.max() < 1.0
    either = angular_map(seen, {s.key: 1.0 for s in seen}, ANGLES, signed=False)
    assert either[63] == pytest.approx(1.0) and either[243] == pytest.approx(1.0)


def test_what_no_single_cause_explains_stays_below_one() -> None:
    seen = [*splits(0.3, (2,)), *splits(1.2, (3,))]
    weights = angular_map(seen, {s.key: -1.0 for s in seen}, ANGLES, signed=True)
    assert 0.3 < weights.max() < 0.99


def test_nothing_measured_weighs_nothing() -> None:
    assert not angular_map([], {}, ANGLES, signed=True).any()
    assert not angular_map(splits(0.1, (2,)), {(5, 0, 0): 1.0}, ANGLES, signed=True).any()

"""What a diagnosis takes from extracted modes."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.measured.recorded import KNOWN, _somewhere, _split, overlap_sd

FREQUENCY_HZ = 1500.0
SQUARE = (2 * np.pi * FREQUENCY_HZ) ** 2


def doublet(*shifts: np.ndarray | None, losses: tuple[float, float] = (0.0, 0.0)) -> Any:
    """Two modes of one frequency with shifts over the points, and their relative split of 1e-3 ± 1e-5."""
    modes = [
        SimpleNamespace(mode=SimpleNamespace(frequency_hz=FREQUENCY_HZ, loss_factor=loss, shift=shift))
        for shift, loss in zip(shifts, losses, strict=True)
    ]
    pair = SimpleNamespace(
        lower=0, upper=1, split=1e-3 * SQUARE, split_covariance=np.eye(2) * (1e-5 * SQUARE) ** 2
    )
    return SimpleNamespace(modes=modes, extraction=SimpleNamespace(loaded=None)), pair


def moved(size: float) -> np.ndarray:
    return size * np.array([-1.0, 1.0, -1.0, 1.0]).reshape(4, 1)


@pytest.mark.parametrize(
    ("shifts", "sd"),
    [
        ((None, None), 1e-5),
        ((moved(2e-3), None), 1e-5),  # the other stays: both were seen by themselves
        ((moved(2e-3), moved(1e-3)), np.hypot(1e-5, 2e-3)),
    ],
)
def test_the_split_of_two_modes_that_move_is_known_no_better_than_they_move(shifts, sd) -> None:
    found = _split(*doublet(*shifts))
    assert abs(found.relative) == pytest.approx(1e-3)
    assert found.sd == pytest.approx(sd)


def test_the_split_of_two_modes_of_unlike_damping_is_known_no_better_than_that_is_alike() -> None:
    alike = np.hypot(1e-5, 2 * overlap_sd(0.0095))
    assert _split(*doublet(None, None, losses=(0.0095, 0.0095))).sd == pytest.approx(alike)
    # an image between two doublets of a stack: measured split 0.0061, the concealed model's 0.0006
    assert _split(*doublet(None, None, losses=(0.00944, 0.01159))).sd == pytest.approx(0.00215, rel=1e-3)


def test_broad_resonances_hide_others_and_sharp_ones_do_not() -> None:
    assert 1e-3 < overlap_sd(0.08) < 7e-3
    assert overlap_sd(0.01) < 1e-5
    assert overlap_sd(None) == 0.0


def test_a_peak_that_may_be_anywhere_under_its_width_has_no_row() -> None:
    bandwidth = 20.0
    measured: Any = SimpleNamespace(
        modes=[
            SimpleNamespace(
                mode=SimpleNamespace(frequency_sd_hz=part * KNOWN * bandwidth, bandwidth_hz=bandwidth)
            )
            for part in (0.01, 1.1, 0.9)
        ]
    )
    assert _somewhere(measured, [0, 1, 2]) == {0, 2}
    assert _somewhere(measured, [1]) == {1}  # all that there is

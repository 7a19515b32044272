"""Who wins when data are drawn anew, and the evidence that decides it."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.refit import log_volume
from statorhom.diagnose.resampling import wins


def test_a_draw_without_detection_counts_for_nobody() -> None:
    assert wins([2.0, 0.0, 4.9]) is None


def test_a_rival_wins_only_by_a_lead_that_tells_the_two_apart() -> None:
    assert wins([20.0, 0.0, 15.0]) is True
    assert wins([20.0, 0.0, 22.0]) is True
    assert wins([20.0, 0.0, 24.0]) is False


def test_an_unseen_uniform_coordinate_gains_nothing() -> None:
    """The angle of a feature that only frequencies show: its range stays what it was."""
    seen, angle = np.diag([400.0]), np.diag([400.0, 0.0])
    without = log_volume(seen, np.array([1.0]))
    assert log_volume(angle, np.array([1.0, 0.0])) == pytest.approx(without)


def test_a_well_seen_uniform_coordinate_has_its_gaussian_volume() -> None:
    precision = 1e4
    volume = np.sqrt(2 * np.pi / precision) / np.sqrt(12)  # of the Gaussian over the range √12
    assert log_volume(np.diag([precision]), np.array([0.0])) == pytest.approx(np.log(volume), abs=1e-4)


def test_a_normal_coordinate_shrinks_from_prior_to_posterior() -> None:
    assert log_volume(np.diag([99.0]), np.array([1.0])) == pytest.approx(-0.5 * np.log(100.0))

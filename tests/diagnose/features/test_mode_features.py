"""Residuals of single features."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from statorhom.conceal.breaks import Wave
from statorhom.conceal.scatter import scatter
from statorhom.diagnose.features.mode_features import (
    SCATTER_SD,
    doubt_by,
    free_features,
    own_sd,
    shift_features,
)
from statorhom.diagnose.fits.derivatives import slopes_of
from statorhom.diagnose.measured.feature import LOST, held_down
from statorhom.diagnose.measured.measured_test import MeasuredSplit, MeasuredTest, PlaneShifts
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.predicted.sensor_response import SensorResponse
from statorhom.identify.residuals.model_error import ModelError
from statorhom.model.broken.named_response import Way
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode


def test_the_right_sensor_mass_leaves_nothing() -> None:
    places = np.array([0.005, 0.035, 0.065, 0.095])
    square = (20 * places - 1) ** 2 + (0.3 + 2 * places) ** 2
    shift = -0.5 * 0.01 * (square - square.mean())
    shifts = PlaneShifts("1", places, shift, np.full(4, 1e-5), 0.0)
    test = MeasuredTest(0, "free", "free", (), True, (), (shifts,))
    key = (2, 1, 0)
    still = {key: np.zeros(4)}
    response = SensorResponse(places, {key: -0.5 * square}, still, still)
    right = shift_features(test, {"1": key}, response, 0.01)
    none = shift_features(test, {"1": key}, response, 0.0)
    assert max(abs(f.residual) for f in right) < 1e-6
    assert max(abs(f.residual) for f in none) > 3.0


def test_the_scatter_of_cores_is_as_wide_as_it_is_taken_for() -> None:
    rng = np.random.default_rng(0)
    # the sum of a core's waves of one harmonic, a doublet's 2r, in both parts
    waves = np.array([[_wave(core, n) for n in (4, 6, 8)] for core in (scatter(rng) for _ in range(4000))])
    typical = np.sqrt(np.mean(np.abs(waves) ** 2) / 2)
    assert 0.6 * SCATTER_SD < typical < SCATTER_SD
    # of normal parts one wave of a hundred is stronger than this
    assert np.quantile(np.abs(waves), 0.99) < np.sqrt(2 * np.log(100)) * SCATTER_SD


def _wave(core: Sequence[Wave], harmonic: int) -> complex:
    own = (w.amplitude * np.exp(1j * harmonic * w.angle) for w in core if w.harmonic == harmonic)
    return complex(sum(own))


@pytest.mark.parametrize("rows", [1, 2])
@pytest.mark.parametrize("recorded", [False, True])
@pytest.mark.parametrize("resolved", [False, True])
def test_a_vanished_partner_leaves_as_many_features(rows: int, recorded: bool, resolved: bool) -> None:
    """The list of features is the same on both sides of a step, penalties in the place of what is missing."""
    key = (2, 0, 0)
    modes = tuple(MeasuredMode(i + 1, str(i), 1000.0 + 4 * i, order=2, axial=0) for i in range(rows))
    splits = (MeasuredSplit("0", "1", 0.004 + 0j, 1e-4),) if resolved else ()
    test = MeasuredTest(0, "t", "free", modes, recorded, splits)
    doublet = StatorMode(1000.0, 2, 0, "radial", 1.0, 2, 0, 0)
    there = {key: PredictedMode(key, doublet, float(np.log(1000.0)), 0.004 + 0j, 1e-3)}
    both = [free_features(test, modes, (key,) * rows, p, {}, ModelError()) for p in (there, {})]
    assert [(f.kind, f.group) for f in both[0]] == [(f.kind, f.group) for f in both[1]]
    assert sum(f.residual == -held_down(LOST) for f in both[1]) == min(rows, len(both[1]))
    assert not any(f.lost for f in both[0]) and all(f.lost for f in both[1])
    assert not slopes_of(both[0], both[1], 1e-2).any()


def test_a_coarse_mesh_leaves_more_of_a_frequency_open_than_its_correction_says() -> None:
    key = (2, 0, 0)
    fine, coarse = (own_sd(ModelError(factors={key: 1 - part}), key) for part in (0.004, 0.04))
    assert fine == pytest.approx(5e-4, rel=0.2)
    assert coarse > 8 * fine


def test_modes_with_more_node_planes_are_corrected_less_surely() -> None:
    """Of thirteen stacks extrapolation left two and five times as much of two and three planes as of none."""
    keys = [(2, planes, 0) for planes in range(4)]
    none, one, two, three = (own_sd(ModelError(factors={key: 0.98}), key) for key in keys)
    assert none == one and 1.7 < two / one < three / one < 4


def test_a_mode_that_may_be_another_on_a_finer_mesh_says_as_little_as_they_lie_apart() -> None:
    key, factors = (3, 1, 1), {(3, 1, 1): 0.997}
    sure, unsure = (own_sd(ModelError(factors=factors, sds=sds), key) for sds in ({}, {key: 0.056}))
    assert sure < 1e-3 and unsure == pytest.approx(np.hypot(sure, 0.056))


@pytest.mark.parametrize("recorded", [False, True])
def test_a_small_split_beside_large_ones_says_little_of_its_cause(recorded: bool) -> None:
    """In one mode what a local cause bends and what of it shears may nearly cancel: that is its shape, not its size."""
    keys = ((2, 0, 0), (3, 0, 0))

    def residual_of_the_second(first: float) -> float:
        sizes = first, 0.001
        modes, splits = [], []
        for order, (key, size) in enumerate(zip(keys, sizes, strict=True)):
            middle = 1000.0 * (order + 1)
            lines = [
                MeasuredMode(2 * order + i, f"{order}{i}", middle * np.exp(size * (i - 0.5) / 2), *key[:2])
                for i in range(2)
            ]
            modes += [replace(line, frequency_sd_hz=0.01) for line in lines]
            splits.append(MeasuredSplit(f"{order}0", f"{order}1", size + 0j, 1e-5))
        predicted = {
            key: PredictedMode(key, StatorMode(f, *key[:2], "radial", 1.0, 2, 0, 0), np.log(f), split, 1e-3)
            for key, f, split in zip(keys, (1000.0, 2000.0), (first + 0j, 0.004 + 0j), strict=True)
        }
        test = MeasuredTest(0, "t", "free", tuple(modes), recorded, tuple(splits) if recorded else ())
        held = tuple(key for key in keys for _ in range(2))
        found = free_features(test, modes, held, predicted, {}, ModelError())
        return max(abs(f.residual) for f in found if f.kind == "split" and f.key == keys[1])

    assert residual_of_the_second(0.04) < 1.5
    assert residual_of_the_second(0.001) > 5.0


@pytest.mark.parametrize("rows", [1, 2])
def test_a_mode_that_the_mesh_hardly_shows_is_doubted_and_wide_valleys_doubt_all_alike(rows: int) -> None:
    key, log_f = (2, 0, 0), float(np.log(1000.0))
    modes = tuple(MeasuredMode(i, str(i), 1000.0, order=2, axial=0, frequency_sd_hz=0.1) for i in range(rows))
    test = MeasuredTest(0, "t", "free", modes, False, ())
    mode = PredictedMode(key, StatorMode(1000.0, 2, 0, "radial", 1.0, 2, 0, 0), log_f, 0j, 1e-3)

    def doubt(correction: float, discrepancy: float) -> float:
        error = ModelError(factors={key: 1 - correction})
        return sum(
            f.doubt for f in free_features(test, modes, (key,) * rows, {key: mode}, {}, error, discrepancy)
        )

    assert doubt(0.0, 0.0) == pytest.approx(0.0, abs=1e-9)
    # the square of a tenth says 3 %, of which 5e-4 are usual
    assert doubt(0.1, 0.0) == pytest.approx(np.log(0.03 / 5e-4), abs=0.1)
    assert doubt(0.1, 0.03) == pytest.approx(0.5 * np.log(2.0), abs=0.05)


@pytest.mark.parametrize("correction", [0.0, 0.02, 0.1])
def test_what_another_mesh_error_would_leave_open_is_what_features_with_it_say(correction: float) -> None:
    key, log_f = (2, 0, 0), float(np.log(1000.0))
    row = MeasuredMode(0, "0", 1000.0, order=2, axial=0, frequency_sd_hz=0.7)
    test = MeasuredTest(0, "t", "free", (row,), False, ())
    predicted = {key: PredictedMode(key, StatorMode(1000.0, 2, 0, "radial", 1.0, 1, 0, 0), log_f, 0j, 1e-3)}
    one, other = (ModelError(factors={key: 1 - part}) for part in (0.05, correction))
    (before,), (after,) = (
        free_features(test, (row,), (key,), predicted, {}, error) for error in (one, other)
    )
    assert doubt_by(before, other) == pytest.approx(after.doubt, abs=1e-9)
    assert doubt_by(before, one) == pytest.approx(before.doubt)


MIXED = (2, 0, 0)


def mixed_mode(*ways: Way) -> PredictedMode:
    """A doublet with lines 5 % of λ apart, and what else may be called by its name."""
    mode = StatorMode(1000.0, 2, 0, "radial", 1.0, 2, 0, 0)
    return PredictedMode(MIXED, mode, float(np.log(1000.0)), 0.05 + 0j, 1e-3, chance=0.6, ways=ways)


@pytest.mark.parametrize("recorded", [False, True])
def test_of_a_mixed_mode_the_way_counts_that_was_measured(recorded: bool) -> None:
    """Its lines may be called by another mode's name; each way is as sharp as ever, and has a chance."""
    lines = tuple(MeasuredMode(i, str(i), 1000.0 + 40 * i, order=2, axial=0) for i in range(2))
    test = MeasuredTest(0, "t", "free", lines, recorded, (MeasuredSplit("0", "1", 0.0784 + 0j, 1e-4),))
    usual, other = (
        free_features(test, lines, (MIXED, MIXED), {MIXED: mode}, {}, ModelError())
        for mode in (mixed_mode(), mixed_mode(Way(0.0196, 0.0784 + 0j, 0.3), Way(0.1, 0j, 0.1)))
    )
    assert [f.kind for f in other] == [f.kind for f in usual]
    assert usual[0].chance == 0.6 and usual[0].residual > 8.0
    assert other[0].chance == 0.3 and max(abs(f.residual) for f in other) < 0.1
    assert other[0].sd == usual[0].sd < 3e-3


def test_a_way_that_had_hardly_a_chance_is_taken_where_it_explains_more_than_that_costs() -> None:
    lines = tuple(MeasuredMode(i, str(i), 975.0 + 50 * i, order=2, axial=0) for i in range(2))
    test = MeasuredTest(0, "t", "free", lines, False)
    away = Way(0.0025, 0.05 + 0j, 1e-3)
    near, far = (
        free_features(test, rows, (MIXED, MIXED), {MIXED: mixed_mode(away)}, {}, ModelError())[0].chance
        for rows in (lines, [replace(m, frequency_hz=m.frequency_hz * 1.02) for m in lines])
    )
    assert near == 0.6
    assert far == 1e-3


def test_a_doublet_that_is_mixed_need_not_show_both_lines() -> None:
    line = MeasuredMode(0, "0", 1000.0, loss_factor=0.007, order=2, axial=0)
    test = MeasuredTest(0, "t", "free", (line,), True)
    silent = [
        free_features(test, (line,), (MIXED,), {MIXED: mode}, {}, ModelError())[1].predicted
        for mode in (mixed_mode(), mixed_mode(Way(0.0, 0j, 0.2)))
    ]
    assert silent[0] > 2.5
    assert silent[1] < 1.0

"""Loss factors and force levels as features: what they predict, and when they stay silent."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.features.damping import JOINT, LOSS_SD, free_losses, losses_of, supported_losses
from statorhom.diagnose.features.levels import level_bases, level_features, slipped
from statorhom.diagnose.features.supported import SupportedReference
from statorhom.diagnose.measured.feature import MOST
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.physics.action import Friction
from statorhom.physics.friction import jenkins_resonance
from statorhom.study.modal_table import MeasuredMode

KEYS = ((2, 0, 0), (3, 0, 0))
HZ = {KEYS[0]: 1000.0, KEYS[1]: 2600.0}
LOSSES = {KEYS[0]: 0.004, KEYS[1]: 0.006}


def mode(key, log_shift: float = 0.0, **more) -> PredictedMode:
    log_f = float(np.log(HZ[key])) + log_shift
    return PredictedMode(key, SimpleNamespace(), log_f, 0j, 0.0, **more)  # type: ignore[arg-type]


def rows(shift: float, rise: float) -> tuple[MeasuredMode, ...]:
    return tuple(
        MeasuredMode(
            row=i + 1,
            mode=str(i + 1),
            frequency_hz=HZ[key] * np.exp(shift),
            loss_factor=LOSSES[key] * np.exp(rise),
            order=key[0],
            axial=0,
            frequency_sd_hz=2e-5 * HZ[key],
        )
        for i, key in enumerate(KEYS)
    )


def test_a_mode_loses_what_its_regions_and_contacts_lose() -> None:
    study = SimpleNamespace(constants=SimpleNamespace(losses=({"lamination": "a", "winding": "b"},)))
    stage = SimpleNamespace(name="wound", setup=SimpleNamespace(index=0))
    slips = mode(KEYS[0], shares={"lamination": 0.7, "winding": 0.2, JOINT: 0.1}, friction=0.01)
    modes = {KEYS[0]: slips, KEYS[1]: mode(KEYS[1])}  # nobody knows where the second one's energy is
    contact = SimpleNamespace(joint=SimpleNamespace(loss_factor=0.2), touches=lambda stage: stage == "wound")
    elsewhere = SimpleNamespace(joint=SimpleNamespace(loss_factor=0.5), touches=lambda _: False)
    actions: Any = [contact, elsewhere, SimpleNamespace(joint=None)]
    found = losses_of(study, stage, modes, {"a": 0.002, "b": 0.03}, actions)  # type: ignore[arg-type]
    assert found == {KEYS[0]: pytest.approx(0.7 * 0.002 + 0.2 * 0.03 + 0.1 * 0.2 + 0.01)}


def test_no_loss_factor_pulls_harder_than_its_scatter() -> None:
    test = MeasuredTest(0, "free", "free", rows(0.0, 3.0))
    found = free_losses(test, test.modes, KEYS, LOSSES)
    assert [f.kind for f in found] == ["loss", "loss"]
    assert all(abs(f.residual) <= MOST["loss"] for f in found)
    # a mode that vanished keeps its row, without a pull
    (lost,) = free_losses(test, test.modes[:1], KEYS[:1], {})
    assert lost.lost and lost.residual == 0.0


def test_a_loss_factor_that_is_hardly_known_says_little() -> None:
    known = rows(0.0, 0.3)
    broad = tuple(replace(m, loss_factor_sd=0.4 * (m.loss_factor or 0.0)) for m in known)
    plain, doubted = (
        free_losses(MeasuredTest(0, "free", "free", m), m, KEYS, LOSSES) for m in (known, broad)
    )
    assert [f.sd for f in plain] == pytest.approx([LOSS_SD] * 2)
    assert [f.sd for f in doubted] == pytest.approx([np.hypot(LOSS_SD, 0.4)] * 2)


def test_springs_with_losses_damp_the_modes_that_they_hold() -> None:
    test = MeasuredTest(0, "held", "clamp", rows(0.0, 0.0))
    shares = {KEYS[0]: np.array([0.6, 0.0]), KEYS[1]: np.array([0.0, 1.0])}
    reference = SupportedReference(
        np.zeros(2), shares, np.array([0.4, 0.0]), np.zeros((2, 10)), np.zeros(2), np.zeros(2)
    )
    found = supported_losses(test, (0, 1), reference, LOSSES, 0.05)
    assert np.exp(found[0].predicted) == pytest.approx(0.6 * 0.004 + 0.4 * 0.05)
    assert np.exp(found[1].predicted) == pytest.approx(0.006)


def test_the_lowest_level_is_what_the_others_are_compared_with() -> None:
    def stage(levels):
        tests = [SimpleNamespace(name=f"t{i}", support="free", force_level_n=f) for i, f in enumerate(levels)]
        return SimpleNamespace(setup=SimpleNamespace(keys=SimpleNamespace(tests=tests)), tests=tests)

    assert level_bases(stage([10.0, 2.0, 50.0])) == {"t0": "t1", "t2": "t1"}  # type: ignore[arg-type]
    assert level_bases(stage([10.0, 10.0])) == level_bases(stage([None, 5.0])) == {}  # type: ignore[arg-type]


def test_equal_levels_leave_nothing_and_slipping_ones_much() -> None:
    predicted = {key: mode(key) for key in KEYS}

    def total(shift: float, rise: float, higher, losses) -> float:
        test = MeasuredTest(0, "high", "free", rows(shift, rise), recorded=True)
        found = level_features(
            test, (rows(0.0, 0.0), test.modes), (KEYS, KEYS), (predicted, higher), (LOSSES, losses)
        )
        assert [f.kind for f in found] == ["level", "level_loss"] * 2
        return sum(f.residual**2 for f in found)

    assert total(0.0, 0.0, predicted, LOSSES) == 0.0
    assert total(-0.01, 0.5, predicted, LOSSES) > 20
    # what the law says of this force explains all of it
    friction = Friction("jenkins", 0.04, slip_force=10.0)
    slipping = slipped(predicted, friction, 10.0, 10.0, LOSSES)
    one = jenkins_resonance(0.04, LOSSES[KEYS[0]], np.sqrt(2.0))
    assert slipping[KEYS[0]].log_f - predicted[KEYS[0]].log_f == pytest.approx(0.5 * np.log1p(-one.fall))
    assert slipping[KEYS[0]].friction == one.loss > 0
    more = {key: LOSSES[key] + slipping[key].friction for key in KEYS}
    shift = slipping[KEYS[0]].log_f - predicted[KEYS[0]].log_f
    rise = float(np.log(more[KEYS[0]] / LOSSES[KEYS[0]]))
    assert total(shift, rise, slipping, more) < 0.1 * total(shift, rise, predicted, LOSSES)


def test_micro_slip_grows_with_the_level() -> None:
    predicted = {key: mode(key) for key in KEYS}
    friction = Friction("iwan", 0.02, exponent=-0.5)
    falls = [
        predicted[KEYS[0]].log_f - slipped(predicted, friction, force, 50.0, LOSSES)[KEYS[0]].log_f
        for force in (2.0, 10.0, 50.0)
    ]
    assert 0 < falls[0] < falls[1] < falls[2] < 0.02

"""Which simulated mode of a supported test is which measured one, and how well its frequency is known."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.features import supported_partners as module
from statorhom.diagnose.features.supported import OWN, SupportedReference
from statorhom.diagnose.features.supported_partners import _mac, partners
from statorhom.diagnose.measured.measured_test import MeasuredShapes, MeasuredTest
from statorhom.study.modal_table import MeasuredMode

ANGLES = np.arange(24) * np.pi / 12


def waves(*orders: int) -> np.ndarray:
    """cos rθ in one plane, (modes, 1, angles)."""
    return np.array([[np.cos(r * ANGLES)] for r in orders])


def measured(shapes: np.ndarray, *frequencies: float) -> MeasuredTest:
    labels = tuple(str(i + 1) for i in range(len(shapes)))
    modes = tuple(
        MeasuredMode(i + 1, label, f) for i, (label, f) in enumerate(zip(labels, frequencies, strict=True))
    )
    return MeasuredTest(
        0, "held", "clamp", modes, True, shapes=MeasuredShapes(labels, np.array([0.05]), ANGLES, shapes)
    )


def reference(shapes: np.ndarray) -> SupportedReference:
    n = len(shapes)
    return SupportedReference(
        np.zeros(n), {}, np.zeros(n), np.zeros((n, 10)), np.full(n, OWN), np.zeros(n), shapes
    )


def found(
    monkeypatch: pytest.MonkeyPatch, test: MeasuredTest, shapes: np.ndarray, *frequencies: float
) -> tuple[int | None, ...]:
    monkeypatch.setattr(module, "predicted_logs", lambda *_: np.log(frequencies))
    nobody: Any = None
    return partners(nobody, test, reference(shapes), {}, {})


def test_mixed_modes_of_one_frequency_are_paired_with_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """Half of each is the other's: a third mode, far off, is more like one of them than its partner."""
    two, three = waves(2)[0], waves(3)[0]
    test = measured(np.array([two + three, two - three, waves(4)[0]]), 3792.0, 3807.0, 3940.0)
    alike = np.array([two + 0.2 * three, three - 0.2 * two, waves(4)[0], 0.9 * two - three])
    assert found(monkeypatch, test, alike, 3808.0, 3818.0, 3957.0, 4700.0)[:2] in ((0, 1), (1, 0))


def test_where_frequencies_are_met_no_partner_is_sought_far_off(monkeypatch: pytest.MonkeyPatch) -> None:
    shapes = waves(2, 3, 4, 5, 1)
    blurred = shapes[4] + 0.6 * waves(6)[0]
    test = measured(np.array([*shapes[:4], blurred]), 1000.0, 1500.0, 2000.0, 2500.0, 3000.0)
    near, far = shapes[4] + 0.9 * waves(7)[0], blurred
    assert (
        found(monkeypatch, test, np.array([*shapes[:4], near, far]), 1001, 1501, 2001, 2501, 3010, 3400)[4]
        == 4
    )


def test_supports_that_yield_may_put_every_mode_far_off(monkeypatch: pytest.MonkeyPatch) -> None:
    shapes = waves(2, 3, 4)
    test = measured(shapes, 1000.0, 1500.0, 2000.0)
    assert found(monkeypatch, test, shapes, 1200.0, 1700.0, 2300.0) == (0, 1, 2)


def test_shapes_alone_tell_modes_that_do_not_mix() -> None:
    shapes = waves(2, 3)
    alike = _mac(measured(shapes, 1000.0, 1002.0), shapes, np.log([1000.0, 1002.0]))
    assert np.allclose(alike, [[1.0, 0.5], [0.5, 1.0]])

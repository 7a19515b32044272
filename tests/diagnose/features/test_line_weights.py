"""Lines of one mode by what they say of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.features.damping import mean_loss
from statorhom.diagnose.features.line_weights import line_weights
from statorhom.study.modal_table import MeasuredMode

Line = Callable[..., MeasuredMode]


@pytest.fixture
def line() -> Line:
    def made(hz: float, sd_hz: float | None, loss: float = 0.008) -> MeasuredMode:
        known: dict[str, Any] = {"row": 1, "mode": "1", "order": 3, "axial": 0}
        return MeasuredMode(frequency_hz=hz, frequency_sd_hz=sd_hz, loss_factor=loss, **known)

    return made


def test_lines_of_a_doublet_count_alike(line: Line) -> None:
    assert line_weights([line(1000.0, 0.02), line(1003.0, 0.1)]) == pytest.approx([0.5, 0.5], abs=0.01)
    assert line_weights([line(1000.0, None)] * 2) == pytest.approx([0.5, 0.5])


def test_an_image_of_which_hardly_the_frequency_is_known_says_little(line: Line) -> None:
    peak, image = line(4704.36, 0.02), line(4708.6, 69.7, loss=0.037)
    assert line_weights([peak, image])[0] > 0.99
    key = (3, 0, 0)
    found = mean_loss([peak, image], [key, key], key)
    assert found is not None
    assert found[0] == pytest.approx(0.008, rel=0.02)
    assert not np.isclose(found[0], 0.008, rtol=1e-6)


def test_no_loss_is_told_of_what_has_none(line: Line) -> None:
    assert mean_loss([line(1000.0, 0.1)], [(3, 0, 0)], (2, 0, 0)) is None

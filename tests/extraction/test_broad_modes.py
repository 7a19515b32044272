"""What a mode that is broader than others says of its frequency."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from statorhom.extraction.broad_modes import BROAD, OFF, with_doubt
from statorhom.extraction.extraction import ExtractedMode

SD = 1e-5  # of a frequency
LOSS = 0.008


def mode(hz: float, loss: float, sd: float = SD) -> ExtractedMode:
    one = np.ones(1)
    pole = (2 * np.pi * hz) ** 2 * (1 + 1j * loss)
    return ExtractedMode(hz, sd * hz, loss, sd, one + 0j, one, one + 0j, one, None, None, 1.0, 1.0, 1.0, pole)


def recorded(loss: list[float]) -> list[ExtractedMode]:
    return [mode(1000.0 * 1.07**i, eta) for i, eta in enumerate(loss)]


@pytest.fixture
def alike() -> list[ExtractedMode]:
    """Modes of one material."""
    return recorded((LOSS * (1 + 0.003 * np.sin(np.arange(14.0)))).tolist())


def test_modes_that_are_alike_are_as_the_noise_leaves_them(alike: list[ExtractedMode]) -> None:
    found, said = with_doubt(alike)
    assert not said
    for before, after in zip(alike, found, strict=True):
        assert after.frequency_sd_hz == pytest.approx(before.frequency_sd_hz, rel=5.0)
        assert after.frequency_hz == before.frequency_hz and after.loss_factor == before.loss_factor


def test_what_is_too_broad_may_lie_half_of_that_aside(alike: list[ExtractedMode]) -> None:
    alike[5] = mode(alike[5].frequency_hz, 1.5 * LOSS)
    found, said = with_doubt(alike)
    assert found[5].frequency_sd_hz == pytest.approx(OFF * 0.5 * LOSS * found[5].frequency_hz, rel=0.05)
    assert found[5].loss_factor_sd == pytest.approx(0.5 * LOSS, rel=0.05)
    assert all(one.frequency_sd_hz < 1e-4 * one.frequency_hz for i, one in enumerate(found) if i != 5)
    (remark,) = said
    assert f"{alike[5].frequency_hz:.2f} Hz" in remark and "1.5 times as broad" in remark


def test_what_is_too_broad_and_unsure_may_be_anywhere_under_its_peak(alike: list[ExtractedMode]) -> None:
    hz, loss = alike[5].frequency_hz, (BROAD + 0.1) * LOSS
    alike[5] = mode(hz, loss, 0.05 * loss)
    found, _ = with_doubt(alike)
    assert found[5].frequency_sd_hz == pytest.approx(loss * hz, rel=0.01)


def test_several_broad_ones_do_not_hide_each_other(alike: list[ExtractedMode]) -> None:
    for i in (4, 6, 7):
        alike[i] = mode(alike[i].frequency_hz, 2.0 * LOSS)
    _, said = with_doubt(alike)
    assert len(said) == 3


def test_where_modes_differ_anyhow_a_broad_one_is_nothing_unusual() -> None:
    wound = recorded((0.01 * 1.9 ** np.sin(2.0 * np.arange(14.0))).tolist())
    wound[5] = replace(wound[5], loss_factor=0.019)
    found, said = with_doubt(wound)
    assert found == tuple(wound) and not said


def test_a_broad_mode_with_nothing_near_it_is_one_mode(alike: list[ExtractedMode]) -> None:
    """The first bending of a free beam on soft foam is six times as broad as the others, and alone."""
    alone = mode(400.0, 6.0 * LOSS)
    found, said = with_doubt([alone, *alike])
    assert found[0] == alone and not said


def test_few_modes_tell_nothing() -> None:
    few = recorded([LOSS] * 5 + [3 * LOSS])
    assert with_doubt(few) == (tuple(few), ())
    assert with_doubt([]) == ((), ())

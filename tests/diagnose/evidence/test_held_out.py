"""What the modes that were seen do not tell counts for little; what they tell decides."""

from __future__ import annotations

import pytest

from statorhom.diagnose.evidence.held_out import OF_TABLES, SHIFT, HeldOut

TOLD = (
    ("stack-free", (2, 0, 0)),
    ("stack-free", (3, 0, 0)),
    ("stack-free", (4, 0, 0)),
    ("stack-free", (2, 1, 0)),
)
OPEN = ("wound-free", (2, 0, 0))


def errors(open_noise: float, after: float = 2.0) -> HeldOut:
    """Four modes that are met, and one that is missed; the noise of the latter."""
    return HeldOut(
        (*TOLD, OPEN),
        (1.0, 0.8, 0.9, 1.1, 1.0),
        (0.1, 0.1, 0.1, 0.1, after),
        (0.1, 0.1, 0.1, 0.1, open_noise),
    )


def test_a_mode_that_the_others_do_not_tell_hides_nothing() -> None:
    assert errors(3.0).falls
    assert not errors(3.0).worsens
    assert errors(3.0).after_rms < 0.2 < 0.8 < errors(3.0).before_rms


def test_one_that_they_tell_and_that_gets_worse_does() -> None:
    assert errors(0.1).worsens
    assert errors(0.1).after_rms > 0.8


def test_one_extrapolation_that_fails_is_not_all_that_counts() -> None:
    found = HeldOut(TOLD, (5.0, 0.8, 0.9, 1.1), (5.0, 0.1, 0.1, 0.1), (0.1,) * 4)
    assert found.after_rms > 0.75 * found.before_rms
    assert found.falls


def test_nothing_that_was_held_out_proves_nothing() -> None:
    empty = HeldOut((), (), (), ())
    assert not empty.falls
    assert empty.before_rms == 0.0


def test_a_mode_whose_lines_are_told_apart_is_one_mode_all_the_same() -> None:
    twice = HeldOut((*TOLD, *TOLD[:2]), (1.0,) * 6, (0.1,) * 6, (0.1,) * 6)
    assert twice.informative == len(TOLD)


def sensor(frequencies: tuple[float, ...]) -> HeldOut:
    """Shifts that a sensor predicts, and frequencies that were missed by twice their noise and are now by so much."""
    count = len(TOLD)
    return HeldOut(
        TOLD * 2,
        (0.3,) * count + (0.2,) * count,
        (0.1,) * count + frequencies,
        (0.1,) * 2 * count,
        kinds=(SHIFT,) * count + ("mode",) * count,
    )


def test_shifts_tell_of_a_sensor_where_frequencies_are_blurred_by_the_mesh() -> None:
    blurred = sensor((0.3, 0.35, 0.25, 0.3))
    assert not blurred.falls and not blurred.worsens
    assert blurred.of_shifts.falls
    assert blurred.of_shifts.groups == TOLD
    assert blurred.of_shifts.before_rms == pytest.approx(0.3)


def test_frequencies_that_get_much_worse_contradict_a_sensor_whatever_its_shifts() -> None:
    assert sensor((0.6, 0.9, 0.5, 0.7)).worsens


def test_what_has_no_shifts_has_none_that_fall() -> None:
    assert not errors(0.1).of_shifts.falls


def test_of_a_table_errors_have_to_fall_by_more() -> None:
    known = TOLD, (1.0, 0.8, 0.9, 1.1), (0.7, 0.56, 0.63, 0.77), (0.01,) * 4
    assert HeldOut(*known).falls and HeldOut(*known).improves
    table = HeldOut(*known, least_fall=OF_TABLES)
    assert not table.falls and not table.improves

"""Modes keep their names while constants move: by place, and by shape where two of one problem exchange it."""

from __future__ import annotations

from statorhom.diagnose.predicted.followed_modes import named, names_of, with_partners
from statorhom.model.convergence import mode_keys
from statorhom.model.stator_mode import StatorMode


def mode(hz: float, place: tuple[int, int], name: tuple[int, int] | None) -> StatorMode:
    order, axial = name if name is not None else (None, None)
    return StatorMode(hz, order, axial, "radial", 0.5, 2, *place)


def test_a_rank_does_not_change_when_another_mode_of_the_name_shows() -> None:
    paired = [mode(900.0, (3, 0), (2, 1)), mode(1500.0, (3, 2), (2, 1))]
    names = names_of(mode_keys(paired))
    later = [mode(905.0, (3, 0), (2, 1)), mode(1200.0, (3, 1), (2, 1)), mode(1490.0, (3, 2), (2, 1))]
    assert {key: m.frequency_hz for key, m in named(later, names).items()} == {
        (2, 1, 0): 905.0,
        (2, 1, 1): 1490.0,
    }
    assert mode_keys(later)[2, 1, 1].frequency_hz == 1200.0


def test_a_mode_that_the_surface_no_longer_shows_is_still_followed() -> None:
    names = names_of(mode_keys([mode(900.0, (3, 0), (2, 1))]))
    assert named([mode(890.0, (3, 0), None)], names)[2, 1, 0].frequency_hz == 890.0


def test_modes_that_exchange_their_shapes_exchange_their_places() -> None:
    names = names_of(mode_keys([mode(8800.0, (4, 1), (2, 0)), mode(9000.0, (4, 2), (2, 2))]))
    later = [mode(8000.0, (4, 1), (2, 2)), mode(8900.0, (4, 2), (2, 0))]
    found = named(later, names)
    assert found[2, 0, 0].frequency_hz == 8900.0
    assert found[2, 2, 0].frequency_hz == 8000.0


def test_a_doubtful_number_of_node_planes_changes_nothing() -> None:
    names = names_of(mode_keys([mode(4100.0, (4, 3), (2, 4))]))
    assert named([mode(4110.0, (4, 3), (2, 2))], names)[2, 4, 0].frequency_hz == 4110.0


def test_a_mode_that_the_reference_calls_otherwise_is_followed_all_the_same() -> None:
    paired = [mode(1320.0, (4, 1), (2, 2)), mode(1940.0, (4, 2), (2, 2))]
    names = names_of({(2, 0, 1): paired[0], (2, 2, 0): paired[1]})
    later = [mode(1310.0, (4, 1), (2, 2)), mode(1930.0, (4, 2), (2, 2))]
    assert {key: m.frequency_hz for key, m in named(later, names).items()} == {
        (2, 0, 1): 1310.0,
        (2, 2, 0): 1930.0,
    }


def test_what_is_gone_is_left_out() -> None:
    names = names_of(mode_keys([mode(4100.0, (4, 3), (2, 4))]))
    assert named([mode(4110.0, (5, 0), (2, 1))], names) == {}


def test_problems_without_partners_are_left_out_and_change_no_other() -> None:
    paired = [mode(900.0, (3, 0), (2, 1)), mode(1500.0, (3, 2), (2, 1)), mode(2000.0, (5, 0), (3, 0))]
    names = names_of(mode_keys(paired))
    tests = {"low": names, "high": names}
    found = with_partners(tests, {"low": [(2, 1, 1), None], "high": [None]})
    # tests of one step are predicted together
    assert found["low"] == found["high"] == {(3, 0): ((2, 1, 0), (2, 1)), (3, 2): ((2, 1, 1), (2, 1))}
    later = [mode(905.0, (3, 0), (2, 1)), mode(1490.0, (3, 2), (2, 1)), mode(2010.0, (5, 0), (3, 0))]
    whole = named(later, names)
    assert named(later, found["low"]) == {k: m for k, m in whole.items() if m.problem == 3}

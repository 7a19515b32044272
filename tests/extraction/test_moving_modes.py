"""Poles that settle from hammer point to hammer point, and those that only seem to move."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

from statorhom.extraction import extract
from statorhom.extraction.extraction import ExtractedMode
from statorhom.extraction.mode_search import FittedWindow, ModeSearch
from statorhom.extraction.moving_modes import most_move
from statorhom.extraction.noise import expected_sd, noise_sd
from statorhom.extraction.point_grid import point_grid
from statorhom.extraction.set_up_shifts import SetUps, fit_shifted
from statorhom.extraction.window_fit import fit_window
from statorhom.recordings.frf_set import FrfSet
from synthetic_frfs import frf_set, ring_points, ring_shape

POINTS = ring_points(8, 1)
LINES = np.arange(850.0, 1750.0)
POLES = [(1000.0, 0.006), (1500.0, 0.008)]
SHAPES = np.array([ring_shape(POINTS, 2, 0.2), ring_shape(POINTS, 3, 0.1)])
HAMMERS = [0, 1, 3, 6]
DRIFT = np.array([-4e-4, -1e-4, 1e-4, 3e-4])
DAMPED = np.array([0.9, 0.95, 1.05, 1.2])


def drifting() -> FrfSet:
    """Every hammer point with its own frequencies and loss factors."""
    sets = []
    for hammer, shift, factor in zip(HAMMERS, DRIFT, DAMPED, strict=True):
        poles = [(frequency * (1 + shift), loss * factor) for frequency, loss in POLES]
        sets.append(frf_set(LINES, POINTS, [hammer], poles, SHAPES, noise=0.001, seed=hammer))
    return replace(
        sets[0],
        responses=tuple(dof for one in sets for dof in one.responses),
        references=tuple(dof for one in sets for dof in one.references),
        accelerance=np.concatenate([one.accelerance for one in sets]),
    )


def test_modes_that_move_with_the_reference_stay_one() -> None:
    found = extract(drifting())
    assert len(found.modes) == len(POLES)
    for mode, (frequency, loss) in zip(found.modes, POLES, strict=True):
        assert mode.shift is not None and mode.shift.shape == (1, len(HAMMERS))
        assert mode.frequency_hz == pytest.approx(frequency, rel=2e-4)
        assert mode.loss_factor == pytest.approx(loss, rel=0.05)
        np.testing.assert_allclose(np.ptp(mode.shift.real), np.ptp(DRIFT), rtol=0.1)
    frfs = drifting()
    error = np.abs(found.regenerate(LINES) - frfs.receptance) / np.abs(frfs.receptance).max()
    assert error.max() < 5e-3


def test_a_doublet_that_one_reference_cannot_resolve_is_one_mode_and_is_said() -> None:
    shapes = np.array([SHAPES[0], ring_shape(POINTS, 2, 0.2 + np.pi / 4), SHAPES[1]])
    poles = [(1000.0, 0.008), (1000.12, 0.008), (1500.0, 0.008)]
    found = extract(frf_set(LINES, POINTS, [1], poles, shapes, noise=0.003))
    assert len(found.modes) == 2
    assert found.modes[0].frequency_hz == pytest.approx(1000.06, abs=0.1)
    assert all(mode.shift is None for mode in found.modes)


def test_a_mode_that_is_but_a_trace_is_not_listed_where_the_model_limits_the_fit() -> None:
    """Noise far below what a linear model explains: a pole of one part in a thousand may be anything."""
    shapes = np.array([*SHAPES, 0.02 * ring_shape(POINTS, 4, 0.3)])
    frfs = frf_set(LINES, POINTS, [0], [*POLES, (1240.0, 0.01)], shapes, noise=1e-4, floor_db=-140.0)
    found = extract(frfs)
    assert [round(mode.frequency_hz) for mode in found.modes] == [1000, 1500]


@pytest.mark.parametrize("set_ups", SetUps)
def test_where_no_mode_is_to_move_none_does(set_ups: SetUps) -> None:
    """A hammered beam stopped here, at products of no columns."""
    grid = point_grid([drifting()])
    poles = np.array([(2 * np.pi * f) ** 2 * (1 + 1j * loss) for f, loss in POLES])
    parts = np.ones((len(POLES), len(HAMMERS)), dtype=complex)
    search = ModeSearch(grid, expected_sd(grid, noise_sd(grid)), poles, parts, poles)
    window, none = search.window(slice(0, len(LINES))), search.modes.of([])
    plain = fit_window(window, search.modes, none)
    found = fit_shifted(window, search.modes, none, np.zeros(len(POLES), dtype=bool), set_ups)
    assert found.chi2 == plain.chi2 and not found.modes.moving.any()


def test_a_promise_from_afar_is_dropped_where_the_windows_do_not_keep_it() -> None:
    assert most_move([False] * 3)  # too few to tell
    assert not most_move([False] * 4)
    assert most_move([True, False, False, True])
    assert not most_move([True, False, False, False])


def under_a_sensor(relative_split: float, relative_shift: float) -> FrfSet:
    """Two doublets of a core under a sensor that roves over three planes, each FRF as its own mass leaves it.

    A mass m at a point makes H / (1 - ω² m H_pp) of the receptance H there (Sherman and Morrison 1950).
    """
    points = ring_points(10, 4)
    references = [1, 32]
    shapes = [ring_shape(points, r, a + half, n) for r, a, n, half in family((2, 0.2, 1), (3, 0.1, 1))]
    poles = [(f * (1 + s), 0.006) for f in (1000.0, 1500.0) for s in (0.0, relative_split)]
    squared = (2 * np.pi * LINES) ** 2
    loaded = []
    for number, shape in enumerate(zip(*shapes, strict=True)):
        curves = [1 / ((2 * np.pi * f) ** 2 * (1 + 1j * loss) - squared) for f, loss in poles]
        own = sum(phi**2 * curve for phi, curve in zip(shape, curves, strict=True))
        for reference in references:
            plain = sum(
                phi * one[reference] * curve for phi, one, curve in zip(shape, shapes, curves, strict=True)
            )
            loaded.append((reference, number, plain / (1 - squared * 2 * relative_shift * own)))
    rng = np.random.default_rng(5)
    accelerance = -squared * np.array([values for _, _, values in loaded])
    size = np.hypot(0.003 * np.abs(accelerance), 3e-4 * np.abs(accelerance).max())
    noise = rng.normal(size=(2, *accelerance.shape)) / np.sqrt(2)
    return FrfSet(
        LINES,
        tuple(points[number] for _, number, _ in loaded),
        tuple(points[reference] for reference, _, _ in loaded),
        accelerance + size * (noise[0] + 1j * noise[1]),
    )


def family(*modes: tuple[int, float, int]) -> list[tuple[int, float, int, float]]:
    """Cosine and sine of every order, angle and number of node planes."""
    return [(r, a, n, half) for r, a, n in modes for half in (0.0, np.pi / (2 * r))]


def test_doublets_that_a_first_look_took_for_moving_modes_do_not_move(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    points, loss, split = ring_points(12, 4), 0.005, (0.4, 0.3, 0.5, 0.4)  # of a bandwidth
    shapes = np.array(
        [
            ring_shape(points, r, a + h, n)
            for r, a, n, h in family((2, 0.2, 0), (2, 0.3, 1), (3, 0.1, 0), (3, 0.25, 1))
        ]
    )
    poles = [
        (f * (1 + part * loss * half), loss)
        for f, part in zip((1000.0, 1300.0, 2000.0, 2500.0), split, strict=True)
        for half in (0, 1)
    ]
    look = ModeSearch.first_look

    def taken_for_moving(search: ModeSearch) -> list[FittedWindow]:
        windows = look(search)
        search.set_ups = None if search.steady else SetUps.POINTS
        return windows

    monkeypatch.setattr(ModeSearch, "first_look", taken_for_moving)
    found = extract(frf_set(np.arange(900.0, 2700.0), points, [5], poles, shapes, noise=1e-3, floor_db=-80.0))
    assert found.loaded is None
    assert [mode.frequency_hz for mode in found.modes] == pytest.approx([f for f, _ in poles], rel=1e-4)
    assert all(mode.shift is None for mode in found.modes)


def test_both_modes_of_a_doublet_move_with_a_sensor() -> None:
    """Its split is a quarter of what the sensor moves it by: at every point another sum of the two is the lower one."""
    frfs = under_a_sensor(5e-4, 2e-3)
    found = extract(frfs)
    moving = [mode for mode in found.modes if mode.shift is not None]
    assert [round(mode.frequency_hz, -1) for mode in moving] == [1000, 1000, 1500, 1500]
    for low, high in zip(moving[::2], moving[1::2], strict=True):
        alike = abs(np.vdot(low.participation, high.participation))
        assert alike < 0.8 * np.linalg.norm(low.participation) * np.linalg.norm(high.participation)
    # what little of the other sum a point sees stays where it is
    assert len(found.modes) <= 8
    assert max((strength(m) for m in found.modes if m.shift is None), default=0.0) < 0.6 * min(
        strength(m) for m in moving
    )
    error = np.abs(found.regenerate(LINES) - frfs.receptance) / np.abs(frfs.receptance).max()
    assert error.max() < 1e-2


def test_a_search_for_modes_that_stay_is_given_up_where_its_first_sweep_explains_little(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sweep, swept = ModeSearch._sweep, []

    def counted(search: ModeSearch) -> None:
        swept.append(search.steady)
        sweep(search)

    monkeypatch.setattr(ModeSearch, "_sweep", counted)
    monkeypatch.setattr(import_module("statorhom.extraction.extract"), "find_load", lambda *_: None)
    found = extract(under_a_sensor(5e-4, 4e-3))
    assert swept.count(True) == 1 < swept.count(False)
    assert sum(mode.shift is not None for mode in found.modes) == 4


def strength(mode: ExtractedMode) -> float:
    """Size of a mode's receptances."""
    return float(np.linalg.norm(mode.shape) * np.linalg.norm(mode.participation))

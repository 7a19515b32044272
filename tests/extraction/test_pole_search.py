"""Which trial poles are proposed, and in which order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest

from statorhom.extraction import pole_search
from statorhom.extraction.modal_model import Modes, Window, steady_modes
from statorhom.extraction.pole_search import best_candidates, trial_poles
from statorhom.extraction.window_fit import WindowFit, fit_window

ComplexArray = npt.NDArray[np.complex128]

POLES = np.array([0.90**2 * (1 + 0.01j), 1.00**2 * (1 + 0.01j), 1.15**2 * (1 + 0.01j)])
POINTS = 30


def recorded(seed: int = 3, references: int = 1) -> tuple[Window, WindowFit]:
    """Three modes over points that are weighted unlike, of which the strongest was fitted."""
    rng = np.random.default_rng(seed)
    squared = np.linspace(0.8, 1.3, 260) ** 2
    shapes = rng.normal(size=(3, POINTS, references)) * np.array([1.0, 8.0, 2.0])[:, None, None]
    values = np.einsum("mkj,mx->kjx", shapes, 1.0 / (POLES[:, None] - squared)).astype(complex)
    # each point's noise grows with what it sees, as a recording's does
    sd = 1e-2 * np.abs(values) + 0.3 * rng.uniform(0.3, 3.0, size=(POINTS, 1, 1))
    values += sd * (rng.normal(size=sd.shape) + 1j * rng.normal(size=sd.shape)) / np.sqrt(2)
    window = Window(squared, values, sd**-2.0, 1.0)
    return window, fit_window(window, steady_modes(POLES[1:2], np.ones((1, references), dtype=complex)))


def all_gains(window: Window, fit: WindowFit, trials: ComplexArray) -> npt.NDArray[np.float64]:
    """Of every trial to the last."""
    return pole_search._Scores(window, fit, None, trials).gains(np.arange(len(trials)))[0]


@pytest.mark.parametrize("references", [1, 2])
def test_the_best_come_first_and_no_peak_comes_twice(references: int) -> None:
    window, fit = recorded(references=references)
    trials = trial_poles(window, fit.modes.poles)
    gains = all_gains(window, fit, trials)
    found = list(best_candidates(window, fit, None, trials, count=6))
    assert found[0].gain == pytest.approx(gains.max(), rel=1e-9)
    assert [c.gain for c in found] == sorted((c.gain for c in found), reverse=True)
    for i, one in enumerate(found):
        for other in found[:i]:
            assert abs(one.pole - other.pole) >= one.pole.imag + other.pole.imag


def test_what_was_left_out_is_found() -> None:
    window, fit = recorded()
    found = list(best_candidates(window, fit, None, trial_poles(window, fit.modes.poles), count=6))
    assert abs(found[0].pole.real - POLES[2].real) < POLES[2].imag
    assert any(abs(one.pole.real - POLES[0].real) < POLES[0].imag for one in found)


def test_nothing_that_gains_too_little_is_proposed_or_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    window, fit = recorded()
    trials = trial_poles(window, fit.modes.poles)
    most = float(all_gains(window, fit, trials).max())
    computed: list[int] = []
    whole = pole_search._Scores.gains

    def counted(self: pole_search._Scores, chosen: npt.NDArray[np.int_]) -> tuple[object, object]:
        computed.extend(chosen)
        return whole(self, chosen)

    monkeypatch.setattr(pole_search._Scores, "gains", counted)
    assert [c.gain for c in best_candidates(window, fit, None, trials, 0.99 * most, 4)] == [
        pytest.approx(most)
    ]
    assert len(computed) < 0.5 * len(trials)
    assert not list(best_candidates(window, fit, None, trials, 1.01 * most, 4))


def test_poles_that_move_are_all_computed() -> None:
    """Where each point has columns of its own, there is nothing that all points share."""
    window, fit = recorded()
    shift = np.random.default_rng(1).normal(scale=1e-3, size=(POINTS, 1, 1)).astype(complex)
    moving = fit_window(window, Modes(fit.modes.poles, fit.modes.parts, shift), iterations=2)
    trials = trial_poles(window, moving.modes.poles)
    first = next(best_candidates(window, moving, None, trials))
    assert first.gain == pytest.approx(all_gains(window, moving, trials).max(), rel=1e-9)


def test_no_trial_gains_more_than_there_is() -> None:
    """A column that rounding alone tells from the known ones would promise anything."""
    window, fit = recorded()
    pole = fit.modes.poles[0]
    beside = pole * (1 + np.logspace(-12, -3, 40) * 1j)
    gains = all_gains(window, fit, np.concatenate([beside, [pole]]))
    assert gains[-1] == 0
    assert np.all(gains <= fit.chi2)
    score, new = np.ones((1, POINTS), dtype=complex), np.full((1, POINTS), 1e-9)
    assert pole_search._gain(score, new, np.zeros((1, POINTS)), np.ones(POINTS)).sum() == 0


def test_no_trials_are_missed_where_the_weights_of_points_run_alike() -> None:
    """Then what a trial promises is what it gains."""
    window, fit = recorded()
    alike = replace(window, weights=np.broadcast_to(window.weights[:1], window.weights.shape).copy())
    fit = fit_window(alike, fit.modes)
    trials = trial_poles(alike, np.zeros(0, dtype=complex))
    scores = pole_search._Scores(alike, fit, None, trials)
    promised, gains = scores.promises(), all_gains(alike, fit, trials)
    far = np.isfinite(promised) & (gains > 0)
    assert far.sum() > 100
    assert promised[far] == pytest.approx(gains[far], rel=1e-6)

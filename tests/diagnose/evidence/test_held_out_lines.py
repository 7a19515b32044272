"""A doublet that alone shows an effect: one of its lines tells where the other is, if the effect is the right one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence import held_out_lines as module
from statorhom.diagnose.evidence.held_out import HeldOut
from statorhom.diagnose.evidence.held_out_lines import held_out_lines, unseen_modes
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.feature import Feature

MODES = 5
SD, SPLIT_SD = 1e-3, 2e-3
FAR = 0.02


@dataclass(frozen=True)
class Linear:
    """Frequencies that one constant moves alike, and the split of the last mode, which the other coordinate is."""

    means: tuple[float, ...]
    split: float
    splits: bool

    prior_weights = np.ones(2)

    def features(self, z: np.ndarray) -> list[Feature]:
        found = [
            Feature("frequency", "free", (n, 0, 0), mean, 0.01 * z[0], SD)
            for n, mean in enumerate(self.means)
        ]
        away = FAR * z[1] if self.splits else 0.0
        return [*found, Feature("split", "free", (MODES - 1, 0, 0), self.split, away, SPLIT_SD)]

    def residuals(self, z: np.ndarray) -> np.ndarray:
        return np.array([f.residual for f in self.features(z)])


def fitted(h: Linear) -> Any:
    z = np.zeros(2)
    for _ in range(30):
        J = slopes(h, z)
        z = z - np.linalg.solve(J.T @ J + np.eye(2), J.T @ h.residuals(z) + z)
    return Refit(h, z, slopes(h, z), 0.0, 0.0)  # type: ignore[type-var]


def slopes(h: Linear, z: np.ndarray) -> np.ndarray:
    step = 1e-6
    return np.array([(h.residuals(z + e) - h.residuals(z - e)) / (2 * step) for e in step * np.eye(2)]).T


def both(means: Sequence[float], split: float) -> HeldOut:
    measured = Linear(tuple(means), split, splits=True)
    explanation: Any = type("E", (), {"refit": fitted(measured), "set_aside": frozenset()})
    return held_out_lines(fitted(replace(measured, splits=False)), explanation)


def test_a_line_tells_the_other_one_where_the_mean_is_what_all_modes_say() -> None:
    found = both([0.0] * MODES, FAR)
    assert len(found.groups) == 2
    assert found.falls
    assert not found.worsens
    # the declared model takes the seen line for both, as far as the other modes let it
    assert found.before == pytest.approx([100 * FAR / 4] * 2, rel=0.5)
    assert max(found.after) < 0.2 * min(found.before)


def test_it_does_not_where_both_lines_moved_to_the_same_side() -> None:
    found = both([*[0.0] * (MODES - 1), -FAR / 2], FAR)
    assert not found.falls


def test_a_line_is_predicted_as_a_fit_without_its_mate_predicts_it() -> None:
    h = Linear((1e-4, -3e-4, 2e-4, 0.0, 4e-4), FAR, splits=True)
    # ln f of both lines by the two coordinates: all other means, and the upper line, by ordinary least squares
    upper, lower = h.means[-1] + FAR / 4, h.means[-1] - FAR / 4
    sd = np.hypot(SD, SPLIT_SD / 4)
    rows = np.array([*[[0.01 / SD, 0.0]] * (MODES - 1), [0.01 / sd, FAR / 4 / sd], [1.0, 0.0], [0.0, 1.0]])
    right = np.array([*(m / SD for m in h.means[:-1]), upper / sd, 0.0, 0.0])
    z = np.linalg.lstsq(rows, right, rcond=None)[0]
    expected = abs(lower - (0.01 * z[0] - FAR * z[1] / 4))
    assert both(h.means, FAR).after[0] == pytest.approx(100 * expected, rel=1e-4)


def test_a_lone_line_is_no_doublet() -> None:
    assert both([0.0] * MODES, 0.0).groups == ()


@pytest.mark.parametrize(("few", "lines"), [(True, True), (False, False)])
def test_lines_are_asked_where_too_few_modes_tell(
    monkeypatch: pytest.MonkeyPatch, few: bool, lines: bool
) -> None:
    modes = HeldOut((), (), (), ())
    told = HeldOut((("free", (2, 0, 0)),) * 2, (1.0, 1.0), (0.01, 0.01), (0.1, 0.1))
    monkeypatch.setattr(module, "held_out", lambda *_: modes)
    monkeypatch.setattr(module, "held_out_lines", lambda *_: told)
    monkeypatch.setattr(module, "too_few", lambda _: few)
    missing: Any = None
    assert (unseen_modes(missing, missing) is told) == lines


def test_lines_that_contradict_leave_the_modes_their_say(monkeypatch: pytest.MonkeyPatch) -> None:
    modes = HeldOut((), (), (), ())
    told = HeldOut((("free", (2, 0, 0)),) * 2, (1.0, 1.0), (1.1, 0.9), (0.1, 0.1))
    monkeypatch.setattr(module, "held_out", lambda *_: modes)
    monkeypatch.setattr(module, "held_out_lines", lambda *_: told)
    missing: Any = None
    assert unseen_modes(missing, missing) is modes

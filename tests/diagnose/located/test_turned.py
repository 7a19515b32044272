"""Angles that the strongest doublets do not tell apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located import turned as module
from statorhom.diagnose.located.turned import at_fitting_angle
from statorhom.diagnose.measured.feature import Feature
from statorhom.physics.parameter import EffectParameter, angle

STIFFNESS = EffectParameter("stiffness_n_per_m", 3e4, 3e7, 1e3, 1e9, "log", (1e6,), None)
NOISE = 0.002


@dataclass(frozen=True)
class _Candidate:
    parameters: tuple[EffectParameter, ...] = (STIFFNESS, angle())


@dataclass(frozen=True)
class Spring:
    """A spring at an angle that parts order 2 by 0.04 and order 3 by 0.006; one constant beside it.

    Parameters
    ----------
    true : angle (rad) of what was measured.
    signed : whether the recordings tell the angle of a split.
    """

    true: float
    signed: bool = True
    held: None = None
    missed: float = 0.0
    constants: int = 1
    candidates: tuple[_Candidate, ...] = (_Candidate(),)
    parameters: tuple[tuple[int, int], ...] = ((0, 0), (0, 1))

    def features(self, z: np.ndarray) -> Sequence[Feature]:
        found = []
        for order, size in ((2, 0.04), (3, 0.006)):
            here, there = (size * np.exp(2j * order * a) for a in (angle_of(z), self.true))
            for part in ("real", "imag") if self.signed else ():
                values = float(getattr(there, part)), float(getattr(here, part))
                found.append(Feature("split", "free", (order, 0, 0), *values, NOISE))
            if not self.signed:
                found.append(Feature("split", "free", (order, 0, 0), size, size, NOISE))
        return found

    def objective(self, z: np.ndarray) -> float:
        return sum(f.deviation**2 for f in self.features(z))


def angle_of(z: np.ndarray) -> float:
    return angle().value(float(z[-1]))


def optimum(spring: Spring, at: float) -> Refit[Any]:
    z = np.array([0.0, 0.5, angle().internal(at)])
    objective = spring.objective(z)
    return Refit(spring, z, np.zeros((4, 3)), objective, objective)  # type: ignore[arg-type]


@pytest.fixture
def tried(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Angles (deg) that are evaluated; refits stay where they begin."""
    seen: list[float] = []

    def nearest_first(hypothesis: Spring, points: Sequence[np.ndarray]) -> list[np.ndarray]:
        seen.extend(np.rad2deg([angle_of(z) for z in points]).round(3).tolist())
        return sorted(points, key=hypothesis.objective)

    def refitted(hypothesis: Spring, z: np.ndarray, worth: float) -> Refit[Any] | None:
        found = optimum(hypothesis, angle_of(z))
        return found if found.objective < worth else None

    monkeypatch.setattr(module, "nearest_first", nearest_first)
    monkeypatch.setattr(module, "refitted", refitted)
    return seen


def test_the_weaker_order_chooses(tried: list[float]) -> None:
    """Order 2 is split alike a quarter of a turn away, order 3 the other way."""
    true = np.deg2rad(328.9)
    found = at_fitting_angle(optimum(Spring(true), true - np.pi / 2))
    assert np.rad2deg(angle_of(found.z)) == pytest.approx(328.9)
    assert found.objective == pytest.approx(0.0, abs=1e-12)
    # order 3 is hardly split: turns that leave it as it is are not tried
    assert tried == [238.9, 328.9]


def test_where_the_angle_fits_it_stays(tried: list[float]) -> None:
    best = optimum(Spring(1.0), 1.0)
    assert at_fitting_angle(best) is best
    assert len(tried) == 2


def test_what_matters_to_nobody_is_not_taken(tried: list[float]) -> None:
    true = np.deg2rad(10.0)
    best = optimum(Spring(true), true + np.pi / 2)
    assert at_fitting_angle(best, worth=-1.0) is best
    assert len(tried) == 2


def test_splits_without_angles_tell_none(tried: list[float]) -> None:
    best = optimum(Spring(1.0, signed=False), 2.0)
    assert at_fitting_angle(best) is best and tried == []

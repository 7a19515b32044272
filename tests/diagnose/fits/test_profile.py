"""Constants at their best for given parameters, against minimizing over all of them."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from statorhom.diagnose.fits.profile import ENOUGH, HALF_PERIOD, Profile
from statorhom.diagnose.fits.refit import refit
from statorhom.errors import IdentificationError


@dataclass
class Bent:
    """One constant c, a magnitude m with a normal prior, and an angle a; c acts a little out of proportion."""

    told: float = 1.0
    missed: float = 0.0
    constants: int = 1
    held: Any = None
    untold: tuple[int, ...] = ()

    @property
    def prior_weights(self) -> np.ndarray:
        return np.array([1.0, 1.0, 0.0])

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.array([-5.0, -2.0, -np.inf]), np.array([5.0, 2.0, np.inf])

    def paired(self, _: np.ndarray) -> Bent:
        return self

    def residuals(self, z: np.ndarray) -> np.ndarray:
        c, m, a = z
        if m < -1.5:
            raise IdentificationError("no body")
        wave = self.told * np.sin(np.pi * a / HALF_PERIOD)
        return np.array([8 * (c + 0.1 * c**2 + m - 1.0), 5 * (m**2 - 0.5), 3 * (c - 2 * m), wave])

    def charges(self, _: np.ndarray) -> np.ndarray:
        return np.zeros(4)

    def features(self, z: np.ndarray) -> list[SimpleNamespace]:
        return [SimpleNamespace(lost=False, residual=r, chance=1.0, doubt=0.0) for r in self.residuals(z)]


def profile(told: float = 1.0) -> Profile:
    return Profile.of(refit(Bent(told), np.array([0.3, 0.5, 0.0])))  # type: ignore[type-var]


@pytest.mark.parametrize("magnitude", [0.9, 0.1, -0.8])
def test_the_constants_are_where_they_are_best(magnitude: float) -> None:
    about, angle = profile(), 0.4
    model = Bent()

    def objective(c: float) -> float:
        z = np.array([c, magnitude, angle])
        return float(np.sum(model.residuals(z) ** 2) + c**2 + magnitude**2)

    exact = minimize_scalar(objective, bounds=(-5.0, 5.0), method="bounded")
    best = about.best(np.array([magnitude, angle]))
    assert best is not None
    assert best[1] == pytest.approx(exact.fun, abs=ENOUGH)
    assert about.log_likelihood(np.array([magnitude, angle])) == pytest.approx(
        -0.5 * (best[1] - magnitude**2), abs=1e-9
    )


def test_at_the_optimum_it_is_the_refits_objective() -> None:
    about = profile()
    best = about.best(about.middle)
    assert best is not None
    assert best[1] == pytest.approx(about.optimum.objective, abs=1e-3)


def test_what_nothing_is_told_of_is_left_out() -> None:
    assert profile().places == [1, 2]
    assert profile(told=0.0).places == [1]


def test_an_angle_has_the_limits_of_a_turn() -> None:
    about = profile()
    low, high = about.limits()
    np.testing.assert_allclose(high - low, [4.0, 2 * HALF_PERIOD])
    np.testing.assert_allclose(0.5 * (low + high)[1], about.middle[1])
    np.testing.assert_array_equal(about.is_normal, [True, False])


def test_no_body_is_no_likelihood() -> None:
    assert profile().best(np.array([-1.8, 0.0])) is None
    assert profile().log_likelihood(np.array([-1.8, 0.0])) == -np.inf

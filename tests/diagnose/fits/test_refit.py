"""A refit that can no longer matter is left where it stands; one that can is finished."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.refit import refit, refit_objective

FLOOR = 10.0  # residual that no coordinate moves


@dataclass
class Valley:
    """Residuals (10 (e^z - 2), 10): the optimum is near ln 2, its objective a little over 100."""

    missed: float = 0.0
    constants: int = 1
    held: Any = None
    untold: tuple[int, ...] = ()
    asked: list[float] = field(default_factory=list)

    @property
    def prior_weights(self) -> np.ndarray:
        return np.array([1e-4])

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.array([-10.0]), np.array([10.0])

    def paired(self, _: np.ndarray) -> Valley:
        return self

    def residuals(self, z: np.ndarray) -> np.ndarray:
        self.asked.append(float(z[0]))
        return np.array([10 * (np.exp(z[0]) - 2), FLOOR])

    def chances(self, _: np.ndarray) -> np.ndarray:
        return np.ones(2)

    def charges(self, z: np.ndarray) -> np.ndarray:
        return np.sqrt(-2.0 * np.log(self.chances(z)))

    def features(self, z: np.ndarray) -> list[SimpleNamespace]:
        rows = zip(self.residuals(z), self.chances(z), strict=True)
        return [SimpleNamespace(lost=False, residual=r, chance=c, doubt=0.0) for r, c in rows]


def found(worth: float) -> tuple[float, float, int]:
    valley = Valley()
    best = refit(valley, np.array([-3.0]), worth=worth)  # type: ignore[type-var]
    return float(best.z[0]), best.objective, len(valley.asked)


def test_an_optimum_that_matters_is_found() -> None:
    z, objective, _ = found(np.inf)
    assert z == pytest.approx(np.log(2), abs=1e-3)
    assert objective == pytest.approx(FLOOR**2, abs=0.1)
    assert found(FLOOR**2 + 5) == pytest.approx((z, objective, found(np.inf)[2]))


def test_one_that_does_not_is_given_up_early() -> None:
    _, objective, asked = found(0.5 * FLOOR**2)
    assert objective > FLOOR**2 + 1
    assert asked < found(np.inf)[2]


@dataclass
class Walled(Valley):
    """Two coordinates that mostly move together; the second one changes nothing beyond its limit of 1."""

    wish: float = 3.0

    @property
    def prior_weights(self) -> np.ndarray:
        return np.full(2, 1e-6)

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.array([-10.0, -1.0]), np.array([10.0, 1.0])

    def paired(self, _: np.ndarray) -> Walled:
        return self

    def residuals(self, z: np.ndarray) -> np.ndarray:
        x, y = z[0], min(z[1], 1.0)
        return np.array([100 * (x - y), y - self.wish])


@pytest.mark.parametrize(("wish", "there"), [(3.0, 1.0), (0.5, 0.5)])
@pytest.mark.parametrize("start", [1.0, 0.2])
def test_limits_hold_one_coordinate_and_not_the_others(wish: float, there: float, start: float) -> None:
    best = refit(Walled(wish=wish), np.array([0.0, start]))  # type: ignore[type-var]
    np.testing.assert_allclose(best.z, there, atol=1e-3)


@dataclass
class Saturated(Walled):
    """Rows that count no more than 3, on either side of 0.8, beside one of another coordinate."""

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.full(2, -10.0), np.full(2, 10.0)

    def paired(self, _: np.ndarray) -> Saturated:
        return self

    def residuals(self, z: np.ndarray) -> np.ndarray:
        return np.array([*np.full(19, 3.0 * np.tanh(2.0 * (z[0] - 0.8))), 10.0 * (z[1] - 0.3)])

    def chances(self, _: np.ndarray) -> np.ndarray:
        return np.ones(20)


@pytest.mark.parametrize("start", [1.8, -0.2])
def test_rows_that_are_all_far_off_are_not_stepped_over(start: float) -> None:
    # the longest step ends as far off on the other side, while the other coordinate gains by it
    best = refit(Saturated(), np.array([start, 0.55]))  # type: ignore[type-var]
    assert best.z[0] == pytest.approx(0.8, abs=1e-3)


@dataclass
class Turning(Valley):
    """A magnitude with a prior and an angle without one that hardly matters: the magnitude has to explain the data."""

    @property
    def prior_weights(self) -> np.ndarray:
        return np.array([1.0, 0.0])

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.array([-10.0, -np.inf]), np.array([10.0, np.inf])

    def paired(self, _: np.ndarray) -> Turning:
        return self

    def residuals(self, z: np.ndarray) -> np.ndarray:
        # what the angle adds to has a phase of its own, which no frequency tells
        return np.array([10 * (np.exp(z[0]) - 4 + 0.01 * np.sin(z[1])), 0.5 * (z[0] - 1)])


def test_an_angle_that_tells_nothing_keeps_no_magnitude_from_its_optimum() -> None:
    best = refit(Turning(), np.array([0.5, 0.3]))  # type: ignore[type-var]
    assert best.z[0] == pytest.approx(np.log(4), abs=0.02)


def test_an_angle_that_tells_nothing_widens_no_interval_beyond_its_own_range() -> None:
    best = refit(Turning(), np.array([0.5, 0.3]))  # type: ignore[type-var]
    magnitude, angle = np.sqrt(np.diag(best.covariance))
    assert magnitude < 0.03  # 10 e^z per unit
    assert angle < 1.5  # of a uniform coordinate: one


@dataclass
class Mixing(Valley):
    """An effect whose residual is 10 / (1 + z): the more it mixes, the less is asked, with a chance of 1 / (1 + z²)."""

    constants: int = 0

    def residuals(self, z: np.ndarray) -> np.ndarray:
        return np.array([10.0 / (1.0 + abs(z[0]))])

    def chances(self, z: np.ndarray) -> np.ndarray:
        return 1.0 / (1.0 + z**2)

    def paired(self, _: np.ndarray) -> Mixing:
        return self


def test_a_refit_pays_for_modes_that_it_mixes_on_its_way() -> None:
    """Not only for those that were mixed where it started: without a charge it would end at its limit."""
    best = refit(Mixing(), np.array([0.1]))  # type: ignore[type-var]
    z = np.linspace(0.0, 10.0, 100001)
    objective = 100.0 / (1.0 + z) ** 2 + 2.0 * np.log(1.0 + z**2)
    assert best.objective == pytest.approx(objective.min(), abs=0.05)
    assert best.z[0] == pytest.approx(z[objective.argmin()], rel=0.05)
    assert best.objective == refit_objective(Mixing(), best.z)  # type: ignore[arg-type]


def test_what_a_model_is_not_sure_of_is_no_part_of_the_objective_but_of_the_evidence() -> None:
    class Unsure(Valley):
        def features(self, z: np.ndarray) -> list[SimpleNamespace]:
            return [SimpleNamespace(**vars(f) | {"doubt": 2.0}) for f in super().features(z)]

    sure, unsure = (refit(kind(), np.array([-3.0])) for kind in (Valley, Unsure))  # type: ignore[type-var]
    assert unsure.objective == sure.objective
    assert unsure.log_evidence == pytest.approx(sure.log_evidence - 4.0)

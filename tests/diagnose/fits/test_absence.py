"""Effects that may as well be absent."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits import absence
from statorhom.diagnose.fits.absence import differs_from_absence, likeliest_without
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.materials.typical_ranges import Z95
from statorhom.physics.candidate import Candidate
from statorhom.physics.parameter import EffectParameter

WARMTH = EffectParameter("temperature_k", -20.0, 20.0, -60.0, 60.0, "linear", (5.0,), 0.0)
UNIT = 40.0 / (2 * Z95)  # kelvin of an internal one


def warmer(kelvin: float, sd: float, both: float = 0.0) -> Explanation:
    """By a temperature, whose covariance with the only constant is given; it costs 40."""
    candidate = Candidate("temperature_shift", "wound", (WARMTH,))
    hypothesis: Any = SimpleNamespace(constants=1, parameters=[(0, 0)], candidates=(candidate,))
    covariance = np.array([[1.0, both], [both, (sd / UNIT) ** 2]])
    refit: Any = SimpleNamespace(
        hypothesis=hypothesis, z=np.array([0.3, kelvin / UNIT]), covariance=covariance, cost=40.0
    )
    return Explanation((candidate,), refit, 0.0)


def left_without(monkeypatch: pytest.MonkeyPatch, cost: float | None) -> list[np.ndarray]:
    """Where refits without the effect begin, each of which leaves as much, or finds no stator."""
    begun: list[np.ndarray] = []

    def refit(_r: Any, _number: int, constants: np.ndarray) -> Any:
        begun.append(constants)
        return None if cost is None else SimpleNamespace(cost=cost)

    monkeypatch.setattr(absence, "without", refit)
    return begun


@pytest.mark.parametrize(
    ("kelvin", "sd", "differs"), [(9.5, 8.2, False), (9.5, 5.0, True), (-9.5, 5.0, True), (0.1, 8.2, False)]
)
def test_what_may_as_well_be_absent_is_not_what_is_missing(
    monkeypatch: pytest.MonkeyPatch, kelvin: float, sd: float, differs: bool
) -> None:
    """Of a clean chain a temperature, 9.5 K (-4 … 23), led the constants out of a wrong valley and got the name."""
    left_without(monkeypatch, 41.3)
    assert differs_from_absence(warmer(kelvin, sd)) is differs


@pytest.mark.parametrize(("cost", "differs"), [(42.6, False), (42.8, True), (None, True)])
def test_an_effect_of_uncertain_magnitudes_differs_where_much_is_left_without_it(
    monkeypatch: pytest.MonkeyPatch, cost: float | None, differs: bool
) -> None:
    """Of a strip in a table (e20 over nothing) neither stiffness nor size was told, and it got no name."""
    begun = left_without(monkeypatch, cost)
    assert differs_from_absence(warmer(9.5, 8.2, both=0.5)) is differs
    # where the constants are, and where they would likely be without it
    away = -9.5 / UNIT * 0.5 / (8.2 / UNIT) ** 2
    assert [float(z[0]) for z in begun] == pytest.approx([0.3, 0.3 + away])


def test_what_is_absent_takes_the_constants_that_it_shares_with_it() -> None:
    pair = (
        Candidate("temperature_shift", "wound", (WARMTH,)),
        Candidate("temperature_shift", "stack", (WARMTH,)),
    )
    hypothesis: Any = SimpleNamespace(constants=1, parameters=[(0, 0), (1, 0)], candidates=pair)
    covariance = np.array([[1.0, 0.4, 0.2], [0.4, 1.0, 0.0], [0.2, 0.0, 0.5]])
    refit: Any = SimpleNamespace(hypothesis=hypothesis, z=np.array([0.0, 2.0, 3.0]), covariance=covariance)
    assert likeliest_without(refit, [0]) == pytest.approx([-0.8])
    assert likeliest_without(refit, [1]) == pytest.approx([-1.2])
    assert likeliest_without(refit, [0, 1]) == pytest.approx([-2.0])


@pytest.mark.parametrize("absent", [None, 0.0])
def test_a_magnitude_without_an_absence_on_its_scale_is_never_that(absent: float | None) -> None:
    mass = EffectParameter("mass_kg", 0.01, 0.1, 1e-4, 10.0, "log", (0.03,), absent)
    candidate = Candidate("attached_mass", "wound", (mass,))
    hypothesis: Any = SimpleNamespace(constants=0, parameters=[(0, 0)], candidates=(candidate,))
    refit: Any = SimpleNamespace(hypothesis=hypothesis, z=np.zeros(1), covariance=np.eye(1) * 100.0)
    assert differs_from_absence(Explanation((candidate,), refit, 0.0))


def test_an_effect_without_a_magnitude_is_there_or_not() -> None:
    name = Candidate("mislabelled_mode", "wound", ())
    hypothesis: Any = SimpleNamespace(constants=1, parameters=[], candidates=(name,))
    refit: Any = SimpleNamespace(hypothesis=hypothesis, z=np.zeros(1), covariance=np.eye(1))
    assert differs_from_absence(Explanation((name,), refit, 0.0))


def test_beside_a_wrong_name_a_magnitude_has_to_differ_from_absence_too(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    left_without(monkeypatch, 41.0)
    pair = (Candidate("mislabelled_mode", "wound", ()), Candidate("temperature_shift", "wound", (WARMTH,)))
    hypothesis: Any = SimpleNamespace(constants=0, parameters=[(1, 0)], candidates=pair)
    for sd, differs in ((1.0, False), (0.1, True)):
        refit: Any = SimpleNamespace(
            hypothesis=hypothesis, z=np.ones(1), covariance=np.eye(1) * sd**2, cost=40.0
        )
        assert differs_from_absence(Explanation(pair, refit, 0.0)) is differs


def test_where_an_effect_may_be_absent_the_constants_without_it_are_tried_too() -> None:
    """Two constants and a temperature that one of them makes up for: without it that one is where the data put both."""
    hypothesis = SimpleNamespace(
        constants=2, parameters=[(0, 0)], candidates=(SimpleNamespace(parameters=(WARMTH,)),)
    )
    # 0.1 of what is measured is known, of their sum alone: constant + 2 temperatures = 3
    precision = np.diag([1.0, 1.0, 1.0]) + 100.0 * np.outer([1.0, 0.0, 2.0], [1.0, 0.0, 2.0])
    z = np.linalg.solve(precision, 100.0 * np.array([1.0, 0.0, 2.0]) * 3.0)
    refit: Any = SimpleNamespace(hypothesis=hypothesis, z=z, covariance=np.linalg.inv(precision))
    np.testing.assert_allclose(likeliest_without(refit, [0]), [300.0 / 101.0, 0.0], atol=1e-12)

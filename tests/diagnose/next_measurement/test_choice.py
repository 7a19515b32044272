"""The worth of measurements: the formula, what makes an option useless, and which of two wins per hour."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from statorhom.diagnose.next_measurement import inspections, ladders
from statorhom.diagnose.next_measurement.option import Option, expected_gain
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.parameter import EffectParameter
from statorhom.study.supports import LineSupport

MASS = EffectParameter("value", 1.0, 3.0, 0.1, 10.0, "log", (2.1,), 2.0)
SENSOR = EffectParameter("mass_kg", 0.001, 0.02, 1e-4, 0.1, "log", (0.005,), 0.0)


def told(values: list[float], sd: float = 1.0) -> list[SimpleNamespace]:
    """Views whose prediction is given: the optimum first."""
    return [SimpleNamespace(told={"a": (v, sd)}) for v in values]


OPTION = Option("a", 1.0, lambda view: view.told)  # type: ignore[attr-defined]


def test_without_uncertainty_the_gain_is_half_the_squared_distance() -> None:
    assert expected_gain(OPTION, told([3.0, 3.0, 3.0]), told([0.0, 0.0, 0.0])) == pytest.approx(4.5)  # type: ignore[arg-type]


def test_what_the_explanations_leave_open_lowers_the_gain() -> None:
    rng = np.random.default_rng(1)
    loose = [3.0, *(3.0 + 2.0 * rng.standard_normal(4000))]
    found = expected_gain(OPTION, told(loose), told([0.0, 0.0, 0.0]))  # type: ignore[arg-type]
    assert found == pytest.approx(0.5 * 9.0 / (1.0 + 0.5 * 4.0), rel=0.1)


def test_equal_predictions_bring_nothing_and_unknown_ones_neither() -> None:
    assert expected_gain(OPTION, told([1.0, 1.0, 1.0]), told([1.0, 1.0, 1.0])) == 0.0  # type: ignore[arg-type]
    other = [SimpleNamespace(told={"b": (1.0, 1.0)})]
    assert expected_gain(OPTION, told([1.0]), other) == 0.0  # type: ignore[arg-type]


def test_correlated_predictions_count_together() -> None:
    """Two quantities that an explanation moves together say less than two independent ones."""
    rng = np.random.default_rng(2)

    def views(mean: float, draws: np.ndarray) -> list[SimpleNamespace]:
        rows = np.vstack([np.zeros(2), draws]) + mean
        return [SimpleNamespace(told={"a": (r[0], 0.1), "b": (r[1], 0.1)}) for r in rows]

    common = np.repeat(rng.standard_normal((3000, 1)), 2, axis=1)
    own = rng.standard_normal((3000, 2))
    gains = [expected_gain(OPTION, views(1.0, d), views(0.0, d)) for d in (common, own)]  # type: ignore[arg-type]
    assert gains[0] == pytest.approx(0.5 * 2 / (2 + 0.01), rel=0.1)
    assert gains[1] == pytest.approx(2 * gains[0], rel=0.1)


def view(*effects: tuple[Candidate, dict[str, float], Action]) -> SimpleNamespace:
    return SimpleNamespace(effects=effects, actions=tuple(a for _, _, a in effects))


def test_a_claimed_mass_is_weighed_and_a_sensor_too() -> None:
    wrong = Candidate("wrong_input", "stack", (MASS,), choice=(("input", "mass_kg"),))
    (option,) = inspections._again(wrong)
    assert "mass_kg of step stack" in option.what
    claimed, other = view((wrong, {"value": 2.1}, Action())), view()
    assert option.predict(claimed)["value"][0] == 2.1  # type: ignore[arg-type]
    assert option.predict(other)["value"] == (2.0, pytest.approx(0.002))  # type: ignore[arg-type]
    assert expected_gain(option, [claimed], [other]) == pytest.approx(0.5 * 50.0**2)  # type: ignore[list-item]


def test_force_levels_move_what_slips_alone() -> None:
    assert ladders.slip_share(Action()) == 0.0
    test = SimpleNamespace(name="t")
    predict = ladders._levels(SimpleNamespace(name="s"), test)  # type: ignore[arg-type]
    assert predict(view())["fall of ln f"][0] == 0.0  # type: ignore[arg-type]


def test_a_tighter_clamp_stiffens_elastic_supports_alone() -> None:
    elastic = LineSupport(
        name="c", kind="lines", angles_deg=(0.0,), declared="elastic", normal_stiffness_n_per_m2=1e10
    )
    action = Action(supports={"c": elastic})
    stiff = ladders._stiffer(action, "c").supports["c"]
    assert stiff.normal_stiffness_n_per_m2 == pytest.approx(ladders.STIFFER * 1e10)  # type: ignore[union-attr]
    assert ladders._stiffer(action, "other") is action
    rigid = LineSupport(name="c", kind="lines", angles_deg=(0.0,), declared="rigid")
    held = Action(supports={"c": rigid})
    assert ladders._stiffer(held, "c") is held

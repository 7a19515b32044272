"""Heights that mirror each other: the same but for the height, and as often mirrored back."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located import mirrored as module
from statorhom.diagnose.located.mirrored import (
    at_fitting_height,
    at_likelier_height,
    height_is_told,
    mirrored,
)
from statorhom.physics.parameter import EffectParameter

HEIGHT = EffectParameter("z_m", 0.0, 0.08, 0.0, 0.08, "place", (), None)


def lump(internal: float, mirrors: bool = True) -> Explanation:
    """A lump at a height of a stage that is or is not its own mirror image."""
    stage = SimpleNamespace(name="stack", mirrors=mirrors, tests=[SimpleNamespace(name="free")])
    candidate = SimpleNamespace(parameters=(HEIGHT,), effect="lump")
    hypothesis = SimpleNamespace(
        constants=1,
        candidates=(candidate,),
        parameters=((0, 0),),
        study=SimpleNamespace(stages=[stage]),
        actions=lambda _: [SimpleNamespace(touches=lambda *_: True)],
    )
    refit = Refit(hypothesis, np.array([0.3, internal]), np.ones((4, 2)), 1.0, 1.0)  # type: ignore[arg-type]
    return Explanation((candidate,), refit, 0.0)  # type: ignore[arg-type]


def height(explanation: Explanation) -> float:
    return HEIGHT.value(float(explanation.refit.z[1]))


def shapes_prefer(monkeypatch: pytest.MonkeyPatch, place: float, shapes: int = 6) -> None:
    """What measured shapes leave unexplained: less, the nearer the height is to a place."""

    def left(explanation: Explanation, *_: object) -> list[float]:
        away = abs(height(explanation) - place)
        return [0.01 + away * (1 + 0.1 * k) for k in range(shapes)]

    monkeypatch.setattr(module, "left_of_all", left)
    monkeypatch.setattr(module, "equivalent_angles", lambda *_: ())


def test_a_height_is_mirrored_about_the_middle_and_back() -> None:
    here = lump(HEIGHT.internal(0.02))
    there = mirrored(here, 0)
    assert there is not None
    assert height(there) == pytest.approx(0.06)
    assert there.refit.jacobian[:, 1] == pytest.approx(-here.refit.jacobian[:, 1])
    back = mirrored(there, 0)
    assert back is not None and height(back) == pytest.approx(0.02)


def test_where_the_ends_differ_the_height_is_told() -> None:
    here = lump(HEIGHT.internal(0.02), mirrors=False)
    assert mirrored(here, 0) is None and height_is_told(here, 0)


@pytest.mark.parametrize("true", [0.02, 0.06])
def test_shapes_choose_between_the_heights(monkeypatch: pytest.MonkeyPatch, true: float) -> None:
    shapes_prefer(monkeypatch, true)
    chosen = at_likelier_height(lump(HEIGHT.internal(0.021)))
    assert height(chosen) == pytest.approx(true, abs=0.002)
    assert height_is_told(chosen, 0)


def test_without_shapes_the_height_stays_open(monkeypatch: pytest.MonkeyPatch) -> None:
    shapes_prefer(monkeypatch, 0.06, shapes=0)
    here = lump(HEIGHT.internal(0.02))
    assert height(at_likelier_height(here)) == pytest.approx(0.02)
    assert not height_is_told(here, 0)


def refits_are(
    monkeypatch: pytest.MonkeyPatch, here: Refit, refitted: Callable[..., Refit | None], kind: str = "lean"
) -> None:
    """An optimum whose only feature is of some kind, and what refits from elsewhere find."""
    monkeypatch.setattr(module, "refitted", refitted)
    monkeypatch.setattr(
        module, "explained", lambda best, _: Explanation(best.hypothesis.candidates, best, 0.0)
    )
    monkeypatch.setattr(
        module, "replace", lambda one, **more: one if "held" in more else replace(one, **more)
    )
    here.hypothesis.features = lambda _: [SimpleNamespace(kind=kind)]  # type: ignore


@pytest.mark.parametrize(("leans", "expected"), [(True, 0.06), (False, 0.02)])
def test_leans_of_shapes_lead_to_the_other_height(
    monkeypatch: pytest.MonkeyPatch, leans: bool, expected: float
) -> None:
    """A refit at 16 mm of 97 left 57, of which three leans of the wrong sign were 48."""
    here = lump(HEIGHT.internal(0.02)).refit

    def refitted(_: object, z: np.ndarray, worth: float) -> Refit:
        assert worth == here.objective
        return replace(here, z=z, objective=abs(HEIGHT.value(float(z[1])) - 0.06))

    refits_are(monkeypatch, here, refitted, "lean" if leans else "split")
    assert HEIGHT.value(float(at_fitting_height(here).z[1])) == pytest.approx(expected)


def test_the_other_height_is_not_followed_beyond_what_it_is_worth(monkeypatch: pytest.MonkeyPatch) -> None:
    """A rival at 1750 beside an explanation at 60 was refitted on both sides of the middle, for ten seconds."""
    here = replace(lump(HEIGHT.internal(0.02)).refit, objective=1750.0)
    asked: list[float] = []
    refits_are(monkeypatch, here, lambda *task: asked.append(task[2]))
    assert at_fitting_height(here, 120.0) is here
    assert at_fitting_height(here) is here
    assert asked == [120.0, 1750.0]

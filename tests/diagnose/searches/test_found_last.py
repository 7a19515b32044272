"""What an effect's refits begin with as usual: the width of a strip, whose depth and ratio make up for it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.searches import best_refit as module
from statorhom.diagnose.searches import refit_starts
from statorhom.diagnose.searches.refit_starts import start_of
from statorhom.physics.parameter import EffectParameter

RATIO = EffectParameter("stiffness_ratio", 0.3, 2.5, 0.02, 12.0, "log", (0.6,), 1.0)
WIDTH = EffectParameter("width_deg", 5.0, 20.0, 2.0, 40.0, "log", (10.0,), None, usual=10.0, last=True)
STRIP: Any = SimpleNamespace(parameters=(RATIO, WIDTH))
STUDY: Any = SimpleNamespace(constants=SimpleNamespace(limits=(np.empty(0), np.empty(0))))


class Limited(AnyHypothesis):
    """A hypothesis whose limits alone are asked for."""

    def paired(self, z: np.ndarray) -> Any:
        raise NotImplementedError

    def features_of_all(self, z: np.ndarray) -> Any:
        raise NotImplementedError

    @property
    def constants(self) -> int:
        return 0


def test_the_last_effect_s_width_stays_until_the_rest_is_found() -> None:
    held = Limited(STUDY, (STRIP, STRIP), whole=False)
    low, high = held.limits()
    # of the first one, which is known already, nothing is held
    assert (low < high).tolist() == [True, True, True, False]
    assert WIDTH.value(low[3]) == pytest.approx(10.0)
    low, high = Limited(STUDY, (STRIP, STRIP)).limits()
    assert np.all(low < high)


@pytest.mark.parametrize(("parameters", "whole"), [((RATIO, WIDTH), False), ((RATIO,), True)])
def test_refits_begin_with_what_is_usual(
    monkeypatch: pytest.MonkeyPatch, parameters: tuple[EffectParameter, ...], whole: bool
) -> None:
    candidate: Any = SimpleNamespace(parameters=parameters)
    base: Any = SimpleNamespace(hypothesis=Limited(STUDY), z=np.empty(0))
    monkeypatch.setattr(refit_starts, "blank", lambda one, _: one)
    assert start_of(base, candidate, np.zeros(len(parameters))).hypothesis.whole is whole


@pytest.mark.parametrize(("free", "found"), [(12.0, 12.0), (20.0, 15.0), (None, 15.0)])
def test_what_is_reported_has_all_of_them_free(
    monkeypatch: pytest.MonkeyPatch, free: float | None, found: float
) -> None:
    """Where that leads nowhere better the optimum stays, and its uncertainty knows of the width."""
    held: Any = SimpleNamespace(hypothesis=Limited(STUDY, whole=False), z=None, objective=15.0)

    def refitted(hypothesis: Any, *_: Any) -> Any:
        return None if free is None else SimpleNamespace(hypothesis=hypothesis, objective=free)

    monkeypatch.setattr(module, "refitted", refitted)
    monkeypatch.setattr(
        module, "evaluated", lambda hypothesis, _: SimpleNamespace(hypothesis=hypothesis, objective=15.0)
    )
    best = module._whole(held, np.inf)
    assert best.objective == found
    assert best.hypothesis.whole

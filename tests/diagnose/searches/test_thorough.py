"""When effects on later steps are sought more thoroughly, and what of them is kept."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits import explanations
from statorhom.diagnose.fits.explanations import ADEQUATE, WELL
from statorhom.diagnose.searches import refit_starts
from statorhom.diagnose.searches import thorough as module
from statorhom.diagnose.searches.refit_starts import CHEAP, DEAR

# objectives in wide valleys, and what they leave in narrow ones
WIDE = {"soft": (15.2, 15.9, 30.0), "loose": (16.0,), "arc": (1.0,), "yoke": (1.0,)}
NARROW = {15.2: 127.0, 15.9: 26.0, 30.0: 5.0, 16.0: 90.0}


def explanation(log_evidence: float, adequacy: float = 0.0, label: str = "") -> Any:
    return SimpleNamespace(
        log_evidence=log_evidence, adequacy=adequacy, adequacy_but_one=adequacy, label=label
    )


@pytest.fixture
def searched(monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
    """Label → points that were followed."""
    seen: dict[str, int] = {}

    def start(_: Any, own: Any, z: np.ndarray) -> Any:
        action = SimpleNamespace(dimensions=(), supports={})
        hypothesis = SimpleNamespace(
            label=own.label, candidates=(own,), shared=(), actions=lambda _: [action]
        )
        return SimpleNamespace(hypothesis=hypothesis, z=z)

    def starts(hypothesis: Any, _: Any, seed: int, most: int) -> list[Any]:
        assert seed != 0  # the points that were tried already
        seen[hypothesis.label] = most
        return [SimpleNamespace(objective=o, z=np.array([o])) for o in WIDE[hypothesis.label]]

    def refitted(hypothesis: Any, z: np.ndarray) -> Any:
        return SimpleNamespace(hypothesis=hypothesis, objective=NARROW[float(z[0])])

    prices = {"arc": DEAR}
    monkeypatch.setattr(refit_starts, "price", lambda trial: prices.get(trial[1][0].hypothesis.label, CHEAP))
    monkeypatch.setattr(module, "Hypothesis", SimpleNamespace)
    monkeypatch.setattr(module, "nothing", lambda base: explanation(-60.0, base.adequacy))
    monkeypatch.setattr(refit_starts, "scan_starts", lambda *_: [np.zeros(1)])
    monkeypatch.setattr(refit_starts, "start_of", start)
    monkeypatch.setattr(module, "shared_by", lambda _: [])
    monkeypatch.setattr(module, "searched_starts", starts)
    monkeypatch.setattr(explanations, "narrowed", lambda rough: rough)
    monkeypatch.setattr(explanations, "refitted", refitted)
    monkeypatch.setattr(
        module, "explained", lambda r, _: explanation(-0.5 * r.objective, label=r.hypothesis.label)
    )
    return seen


def base(adequacy: float = 0.0) -> Any:
    study = SimpleNamespace(stages=[SimpleNamespace(name=n) for n in ("stack", "wound")])
    return SimpleNamespace(adequacy=adequacy, hypothesis=SimpleNamespace(study=study))


CANDIDATES: Any = [
    SimpleNamespace(label=label, stage=stage, parameters=(1,))
    for label, stage in (("soft", "wound"), ("loose", "wound"), ("arc", "wound"), ("yoke", "stack"))
]


def test_of_optima_that_wide_valleys_like_equally_the_narrow_one_is_kept(searched: dict[str, int]) -> None:
    lead = explanation(-33.0, 0.5 * WELL, "lump")
    found = module.sought_thoroughly(base(), [lead], CANDIDATES, {})
    # what is no better than the lead is left, and what wide valleys like less is not followed
    assert [(e.label, e.log_evidence) for e in found] == [("soft", -13.0)]
    assert searched == {"soft": module.REFITTED, "loose": module.REFITTED}


@pytest.mark.parametrize(("declared", "lead"), [(0.0, 2 * WELL), (2 * ADEQUATE, 0.0)])
def test_nothing_is_sought_where_something_leaves_no_more_than_noise(
    searched: dict[str, int], declared: float, lead: float
) -> None:
    assert not module.sought_thoroughly(base(declared), [explanation(-33.0, lead)], CANDIDATES, {})
    assert not searched

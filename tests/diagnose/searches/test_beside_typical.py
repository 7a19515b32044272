"""Effects that cost little beside materials all over the prior: when they are sought, which, and from where."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.explanations import ADEQUATE
from statorhom.diagnose.searches import beside_typical as module
from statorhom.diagnose.searches import best_refit as effects
from statorhom.diagnose.searches import fled_materials as fled
from statorhom.diagnose.searches import refit_starts as starts_module
from statorhom.diagnose.searches import typical_materials as typical
from statorhom.diagnose.searches.refit_starts import CHEAP, DEAR
from statorhom.errors import SolverError
from statorhom.study.study_file import FREE

# of a stack, and of the winding
NAMES = ("stack:lamination.E_p_pa", "wound:winding.E_p_pa", "wound:winding.nu_p", "wound:mass_kg")
# objectives that lead from the typical winding's model, and what is left in a model of its own
FIRST = {"soft": 25.0, "loose": 100.0, "yoke": 60.0, "far": 500.0}
OWN = {"soft": 20.0, "loose": 37.0, "yoke": 58.0}


def candidate(label: str, stage: str = "wound") -> Any:
    return SimpleNamespace(label=label, stage=stage, parameters=(1,))


def explanation(log_evidence: float, adequacy: float = 0.0, label: str = "", refit: Any = None) -> Any:
    return SimpleNamespace(
        log_evidence=log_evidence,
        adequacy_but_one=adequacy,
        label=label,
        refit=refit or SimpleNamespace(objective=-2.0 * log_evidence),
        settled=False,
    )


class Search:
    """One in which each effect has one optimum."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.models: list[np.ndarray] = []
        self.sharpened: list[str] = []
        self.prices = {"arc": DEAR}
        self.actions = {"length": SimpleNamespace(dimensions=("length_mm",), supports={})}
        items = tuple(SimpleNamespace(name=n, fixed=False) for n in NAMES)
        self.typical = 0.0  # what a typical winding's mesh would be unsure of
        stages = tuple(
            SimpleNamespace(name=n, tests=(SimpleNamespace(name=f"{n}-free", support=FREE),), error=n)
            for n in ("stack", "wound", "baked")
        )
        study = SimpleNamespace(stages=stages, constants=SimpleNamespace(items=items))
        self.doubts = {"wound-free": 0.0, "stack-free": 20.0}
        self.residual = 0.5
        hypothesis = SimpleNamespace(
            study=study, candidates=(), shared=(), prior_weights=np.ones(4), features=self.features
        )
        self.base: Any = SimpleNamespace(
            hypothesis=hypothesis, z=np.array([0.4, -2.0, 0.7, 0.1]), objective=400.0
        )
        self.adequacy = 0.0
        monkeypatch.setattr(module, "Hypothesis", SimpleNamespace)
        monkeypatch.setattr(module, "nothing", lambda _: explanation(-200.0, self.adequacy))
        monkeypatch.setattr(typical, "blank", lambda h, _: h)
        monkeypatch.setattr(typical, "in_its_own_model", self.model)
        monkeypatch.setattr(typical, "evaluated", lambda h, z: SimpleNamespace(hypothesis=h, z=z))
        monkeypatch.setattr(starts_module, "scan_starts", lambda *_: [np.zeros(1)])
        monkeypatch.setattr(starts_module, "start_of", self.start)
        monkeypatch.setattr(starts_module, "price", lambda trial: self.prices.get(trial[1][0].label, CHEAP))
        monkeypatch.setattr(effects, "narrowed_starts", lambda start: [start])
        monkeypatch.setattr(effects, "shared_by", lambda _: [])
        monkeypatch.setattr(module, "shared_by", lambda _: [])
        monkeypatch.setattr(effects, "refitted", lambda h, _: None if h.label == "lost" else self.refit(h))
        monkeypatch.setattr(
            module, "explained", lambda r, _: explanation(-r.objective, label=r.hypothesis.label, refit=r)
        )
        monkeypatch.setattr(module, "sharpened", self.sharper)
        monkeypatch.setattr(fled, "doubt_by", lambda *_: self.typical)

    def features(self, _: np.ndarray) -> list[Any]:
        told = {"kind": "frequency", "residual": self.residual}
        return [SimpleNamespace(test=test, doubt=doubt, **told) for test, doubt in self.doubts.items()]

    def model(self, hypothesis: Any, z: np.ndarray) -> Any:
        self.models.append(z)
        return hypothesis

    def start(self, base: Any, own: Any, start: np.ndarray) -> Any:
        absent = SimpleNamespace(dimensions=(), supports={})
        actions = self.actions.get(own.label, absent)
        declared = SimpleNamespace(
            dimensions=("bore_mm",), supports={}
        )  # after the effects: no part of their price
        hypothesis = SimpleNamespace(
            label=own.label, candidates=(own,), shared=(), actions=lambda _: [actions, declared]
        )
        return SimpleNamespace(hypothesis=hypothesis, z=np.r_[base.z, start], label=own.label)

    def refit(self, hypothesis: Any) -> Any:
        return SimpleNamespace(objective=FIRST[hypothesis.label], hypothesis=hypothesis)

    def sharper(self, e: Any) -> Any:
        self.sharpened.append(e.label)
        r = SimpleNamespace(objective=OWN[e.label], hypothesis=e.refit.hypothesis)
        return explanation(-r.objective, label=e.label, refit=r)

    def sought(self, *labels: str, found: Any = ()) -> list[str]:
        own = [candidate(label, "baked" if label == "resin" else "wound") for label in labels]
        return [e.label for e in module.beside_typical_materials(self.base, found, own, {})]


@pytest.fixture
def search(monkeypatch: pytest.MonkeyPatch) -> Search:
    return Search(monkeypatch)


def test_it_is_sought_in_the_model_of_the_step_as_it_usually_is(search: Search) -> None:
    """A soft end winding at -52; beside the declared winding, a tenth as stiff, nothing was at -138."""
    assert search.sought("soft", "lost") == ["soft"]
    (z,) = search.models
    assert z.tolist() == [0.4, 0.0, 0.0, 0.1]  # another step's materials and what was weighed stay
    assert search.base.z.tolist() == [0.4, -2.0, 0.7, 0.1]


def test_what_is_near_the_best_is_compared_in_its_own_model(search: Search) -> None:
    assert search.sought("loose", "soft", "yoke", "far") == ["soft", "yoke", "loose", "far"]
    assert search.sharpened == ["soft", "yoke"]


def test_what_costs_much_and_a_step_without_materials_are_left_out(search: Search) -> None:
    assert search.sought("arc", "length", "resin") == []
    assert search.models == []


@pytest.mark.parametrize("adequacy", [0.0, 2 * ADEQUATE])
def test_where_something_explains_the_misfit_nothing_is_sought(search: Search, adequacy: float) -> None:
    assert search.sought("soft", found=[explanation(-150.0, adequacy)]) == ([] if adequacy else ["soft"])
    search.adequacy = adequacy
    assert search.sought("soft") == ([] if adequacy else ["soft"])


@pytest.mark.parametrize(("doubt", "sought"), [(2.0, []), (4.0, ["soft"])])
def test_a_winding_that_explains_everything_by_saying_nothing_explains_too_little(
    search: Search, doubt: float, sought: list[str]
) -> None:
    """So soft that the mesh is sure of none of its modes; z of -2 and 0.7 lose 2.2 more, and a stack has not fled."""
    search.adequacy = 0.99
    search.doubts["wound-free"] = doubt
    assert search.sought("soft") == sought
    assert len(search.models) == len(sought)


def test_what_typical_materials_would_be_as_unsure_of_is_no_reason_to_look(search: Search) -> None:
    search.adequacy = 0.99
    search.doubts["wound-free"], search.typical = 4.0, 3.0
    assert search.sought("soft") == []
    assert len(search.models) == 1


def test_what_is_left_of_frequencies_beyond_noise_is_one(search: Search) -> None:
    search.adequacy, search.residual = 0.02, 3.0  # 4 above what noise leaves
    assert search.sought("soft") == ["soft"]
    search.residual = 1.0
    assert search.sought("soft") == []


def test_what_is_no_better_is_not_taken(search: Search) -> None:
    assert search.sought("soft", found=[explanation(-19.0, refit=SimpleNamespace(objective=300.0))]) == []


def test_materials_that_no_stator_has_lead_nowhere(search: Search, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(*_: Any) -> Any:
        raise SolverError("no stator has these constants")

    monkeypatch.setattr(typical, "in_its_own_model", none)
    assert search.sought("soft") == []


def test_what_explains_most_of_the_misfit_needs_no_other_materials(search: Search) -> None:
    """Beside a wrong yoke that leaves a few gross rows, a search all over the prior took minutes."""
    assert search.sought("soft", found=[explanation(-90.0)]) == []
    assert search.models == []

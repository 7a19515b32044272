"""Arcs of lost contact beside a typical winding: when they are sought, from where, and what is made of them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose import lost_contact as module
from statorhom.diagnose import valleys as valleys_of
from statorhom.diagnose.lost_contact import FOLLOWED, GRID, WINDINGS, with_lost_contact
from statorhom.diagnose.refit_starts import Start
from statorhom.errors import SolverError
from statorhom.physics.candidate import Candidate
from statorhom.physics.effects.interface_debond import ARC, LOSS, RATIO
from statorhom.physics.parameter import angle

ARCS = Candidate("interface_debond", "wound", (ARC, RATIO, LOSS, angle()), "winding")
LUMP = Candidate("attached_mass", "wound", (), "lamination")
TRUE = {"arc_deg": 60.0, "contact_ratio": 3e-4, "angle_rad": np.pi}
# of a stack, and of the winding: two logarithms and a Poisson's ratio
NAMES = ("stack:lamination.E_p_pa", "wound:winding.E_p_pa", "wound:winding.G_rz_pa", "wound:winding.nu_p")


class Valleys:
    """Each refit's objective is the distance from one arc beside a winding that is a deviation stiffer than usual."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.windings: list[np.ndarray] = []
        self.asked: list[Start] = []
        self.own = 0
        items = tuple(SimpleNamespace(name=n, log=not n.endswith("nu_p"), fixed=False) for n in NAMES)
        stage = SimpleNamespace(setup=SimpleNamespace(keys=SimpleNamespace(name="wound")))
        self.study = SimpleNamespace(constants=SimpleNamespace(items=items), stages=(stage,))
        hypothesis = SimpleNamespace(study=self.study, candidates=())
        self.base = SimpleNamespace(
            hypothesis=hypothesis, z=np.array([0.4, -2.0, -2.5, 0.7]), log_evidence=-200.0
        )
        monkeypatch.setattr(module, "nothing", lambda _: self.explanation(-200.0))
        monkeypatch.setattr(module, "explained", lambda r, _: self.explanation(-r.objective, r))
        monkeypatch.setattr(module, "blank", lambda h, _: h)
        monkeypatch.setattr(module, "evaluated", lambda h, z: SimpleNamespace(hypothesis=h, z=z))
        monkeypatch.setattr(module, "in_its_own_model", self.model)
        monkeypatch.setattr(module, "scan_starts", lambda *_: [np.zeros(4)])
        monkeypatch.setattr(module, "start_of", self.start)
        monkeypatch.setattr(valleys_of, "refit_objective", self.distance)
        monkeypatch.setattr(module, "refitted", self.refitted)

    @staticmethod
    def explanation(log_evidence: float, refit: Any = None, adequacy: float = 0.0) -> Any:
        return SimpleNamespace(
            log_evidence=log_evidence, refit=refit, adequacy=adequacy, adequacy_but_one=adequacy
        )

    def model(self, r: Any, *, mesh_known: bool = False) -> Any:
        if mesh_known:
            self.windings.append(r.z)
        else:
            self.own += 1
        return r.hypothesis

    def start(self, typical: Any, candidate: Candidate, z: np.ndarray) -> Start:
        return Start(SimpleNamespace(study=self.study, candidates=(candidate,)), np.r_[typical.z, z])  # type: ignore[arg-type]

    def distance(self, _: Any, z: np.ndarray) -> float:
        effect = {p.name: p.value(float(v)) for p, v in zip(ARCS.parameters, z[4:], strict=True)}
        away = [np.log(effect[n] / TRUE[n]) for n in GRID]
        turned = 1 - np.cos(effect["angle_rad"] - TRUE["angle_rad"])
        return float(np.linalg.norm(away) + turned + 10 * abs(z[1] - WINDINGS[-1]))

    def refitted(self, hypothesis: Any, z: np.ndarray) -> Any:
        self.asked.append(Start(hypothesis, z))
        return SimpleNamespace(hypothesis=hypothesis, z=z, objective=self.distance(hypothesis, z))


@pytest.fixture
def valleys(monkeypatch: pytest.MonkeyPatch) -> Valleys:
    return Valleys(monkeypatch)


def test_the_arc_is_found_beside_the_winding_that_is_usual(valleys: Valleys) -> None:
    (found,) = with_lost_contact(valleys.base, [], [LUMP, ARCS], {})  # type: ignore[arg-type]
    effect = {p.name: p.value(float(v)) for p, v in zip(ARCS.parameters, found.refit.z[4:], strict=True)}
    assert {n: effect[n] for n in TRUE} == pytest.approx(TRUE)
    # the stack stays as the declared model has it, a Poisson's ratio is what is usual
    assert [z.tolist() for z in valleys.windings] == [[0.4, sds, sds, 0.0] for sds in WINDINGS]
    assert len(valleys.asked) == FOLLOWED * len(WINDINGS) + module.ROUNDS
    assert valleys.own == module.ROUNDS


def test_nothing_is_sought_where_something_explains_the_misfit(valleys: Valleys) -> None:
    enough = valleys.explanation(-20.0, adequacy=0.3)
    assert with_lost_contact(valleys.base, [enough], [ARCS], {}) == []  # type: ignore[arg-type]
    assert not valleys.windings


def test_an_arc_that_explains_less_is_no_news(valleys: Valleys) -> None:
    better = valleys.explanation(1.0)
    assert with_lost_contact(valleys.base, [better], [ARCS], {}) == []  # type: ignore[arg-type]
    assert valleys.windings


def test_windings_without_a_body_are_passed_over(valleys: Valleys, monkeypatch: pytest.MonkeyPatch) -> None:
    def impossible(*_: Any, **__: Any) -> Any:
        raise SolverError("no such body")

    monkeypatch.setattr(module, "evaluated", impossible)
    assert with_lost_contact(valleys.base, [], [ARCS], {}) == []  # type: ignore[arg-type]

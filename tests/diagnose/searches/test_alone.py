"""Which of two effects needs the other one."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits import absence
from statorhom.diagnose.fits.explanations import PAIR_GAIN, Explanation
from statorhom.diagnose.searches.alone import with_both_needed, without_idle_partners

CONSTANTS = 2


class Hypothesis(SimpleNamespace):
    """Two constants and effects of one and of two parameters."""

    @property
    def parameters(self) -> tuple[tuple[int, int], ...]:
        return tuple((i, j) for i, c in enumerate(self.candidates) for j in range(len(c.parameters)))


RISE: Any = SimpleNamespace(effect="viscoelastic_winding", parameters=("slope",), both_sides=False)
ENDS: Any = SimpleNamespace(effect="end_winding_stiffness", parameters=("ratio", "depth"), both_sides=False)


def pair(log_evidence: float) -> Explanation:
    hypothesis: Any = Hypothesis(candidates=(RISE, ENDS), constants=CONSTANTS)
    refit: Any = SimpleNamespace(hypothesis=hypothesis, z=np.array([0.1, 0.2, 3.0, 4.0, 5.0]))
    return Explanation((RISE, ENDS), refit, log_evidence)


def found(monkeypatch: pytest.MonkeyPatch, evidence: dict[str, float | None]) -> list[Explanation]:
    """What stands instead of a pair at -50, where its effects alone have an evidence, or do not exist."""
    begun: dict[str, np.ndarray] = {}

    def refitted(hypothesis: Any, z: np.ndarray) -> Any:
        (candidate,) = hypothesis.candidates
        begun[candidate.effect] = z
        own = evidence[candidate.effect]
        return None if own is None else SimpleNamespace(hypothesis=hypothesis, log_evidence=own)

    def blank(hypothesis: Hypothesis, candidates: tuple[Any, ...]) -> Hypothesis:
        return Hypothesis(candidates=candidates, constants=hypothesis.constants)

    monkeypatch.setattr(absence, "refitted", refitted)
    monkeypatch.setattr(absence, "blank", blank)
    instead = with_both_needed([pair(-50.0), pair(-52.0)], {})
    assert begun["viscoelastic_winding"].tolist() == [0.1, 0.2, 3.0]
    assert begun["end_winding_stiffness"].tolist() == [0.1, 0.2, 4.0, 5.0]
    return instead


def test_the_one_that_does_without_the_other_takes_the_place(monkeypatch: pytest.MonkeyPatch) -> None:
    instead = found(monkeypatch, {"viscoelastic_winding": -62.0, "end_winding_stiffness": -47.0})
    assert [e.effects for e in instead] == [("end_winding_stiffness",)]
    # a second effect has to gain what the rules ask of it
    near = found(monkeypatch, {"viscoelastic_winding": -50.1 - PAIR_GAIN, "end_winding_stiffness": -54.9})
    assert [e.effects for e in near] == [("end_winding_stiffness",)]


@pytest.mark.parametrize("ends", [-50.1 - PAIR_GAIN, None])
def test_a_pair_that_needs_both_stays(monkeypatch: pytest.MonkeyPatch, ends: float | None) -> None:
    instead = found(monkeypatch, {"viscoelastic_winding": -62.0, "end_winding_stiffness": ends})
    assert [e.log_evidence for e in instead] == [-50.0, -52.0]
    assert with_both_needed([], {}) == []


@pytest.mark.parametrize(
    ("ends", "left"),
    [
        (-52.0, [("end_winding_stiffness",)]),  # the pair says little more than that
        (
            -50.0 - 2 * PAIR_GAIN,
            [("viscoelastic_winding", "end_winding_stiffness"), ("end_winding_stiffness",)],
        ),
    ],
)
def test_a_pair_that_one_of_its_effects_comes_near_is_no_rival(
    ends: float, left: list[tuple[str, ...]]
) -> None:
    """A lump by recordings came within 2.3 of a lump and a heavy sensor: two names, and no verdict."""
    single, worse = (Explanation((ENDS,), pair(at).refit, at) for at in (ends, ends - 30.0))
    lone = Explanation((RISE,), pair(-90.0).refit, -90.0)
    stay = without_idle_partners([pair(-50.0), single, worse, lone])
    assert [e.effects for e in stay] == [*left, ("end_winding_stiffness",), ("viscoelastic_winding",)]

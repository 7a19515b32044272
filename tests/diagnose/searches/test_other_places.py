"""What a table leaves open of a place is tried: heights away from the ends, and the other side of an absence."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence.decision import NEAR_RIVAL
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import refit
from statorhom.diagnose.searches import other_places
from statorhom.diagnose.searches.other_places import AS_RIGHT_ONES, at_their_best_places
from statorhom.physics.candidate import Candidate
from statorhom.physics.parameter import EffectParameter, angle, height

MASS = EffectParameter("mass_kg", 0.01, 1.0, 1e-3, 10.0, "log", (0.1,), 0.0)
RATIO = EffectParameter("stiffness_ratio", 0.3, 3.0, 0.02, 12.0, "log", (0.5,), 1.0)
LUMP = Candidate("attached_mass", "stack", (MASS, angle(), height(0.1)))
STRIP = Candidate("local_stiffness", "stack", (RATIO, angle(), height(0.1)))
RIGHT, TRAPPED = 0.3, 0.1  # parts of the height


@dataclass
class Core:
    """A lump at three tenths of the height, from the lowest tenth of which all slopes lead to the end; or a soft strip.

    Nothing tells the angle.
    """

    candidates: tuple[Candidate, ...] = (LUMP,)
    recorded: bool = False
    two: bool = False
    hidden: bool = False
    held: Any = None
    untold: tuple[int, ...] = ()
    constants: int = 1
    whole: bool = True
    shared: tuple[object, ...] = ()
    missed: float = 0.0

    @property
    def study(self) -> Any:
        constants = SimpleNamespace(items=(SimpleNamespace(log=True, sd=2.0),))
        tests = (SimpleNamespace(recorded=self.recorded),)
        stage = SimpleNamespace(tests=tests, refinement=None)
        return SimpleNamespace(stages=(stage,), constants=constants)

    @property
    def prior_weights(self) -> np.ndarray:
        return np.array([1.0, 1.0, 0.0, 0.0])

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        end = np.sqrt(3.0)
        return np.array([-5.0, -3.0, -np.inf, -end]), np.array([5.0, 3.0, np.inf, end])

    def paired(self, _: np.ndarray) -> Core:
        return self

    def actions(self, _: np.ndarray) -> list[Any]:
        return [SimpleNamespace(changes="it", joint=None)]

    def residuals(self, z: np.ndarray) -> np.ndarray:
        part = float(self.candidates[0].parameters[2].value(float(z[3]))) / 0.1
        where = 3.0 + 5.0 * part if part < TRAPPED else 10.0 * (part - RIGHT)
        # splits have no sign, and a strip's mean frequencies hardly tell it
        size = 5.0 * (abs(z[1]) - 1.0), 2.0 * (z[1] + 1.0) if self.candidates[0] is STRIP else 0.0
        # two valleys of a modulus, of which the upper one leaves less
        modulus = 6.0 * (z[0] ** 2 - 1.0), 1.0 * (z[0] - 1.0)
        if self.hidden:
            # five are left but in one narrow valley
            size = (5.0 - 4.8 * np.exp(-8.0 * (z[1] + 1.5) ** 2), 0.0)
        return np.array([*(modulus if self.two else (10 * z[0], 0.0)), *size, where])

    def charges(self, _: np.ndarray) -> np.ndarray:
        return np.zeros(5)

    def charge(self, _: np.ndarray) -> float:
        return 0.0

    def features(self, z: np.ndarray) -> list[SimpleNamespace]:
        same = {"kind": "frequency", "lost": False, "chance": 1.0, "doubt": 0.0}
        return [SimpleNamespace(residual=r, **same) for r in self.residuals(z)]


@pytest.fixture(autouse=True)
def _own_models(monkeypatch: pytest.MonkeyPatch) -> None:
    """Models of their own are no others."""
    monkeypatch.setattr(other_places, "in_its_own_models", lambda e: e)


def explanation(core: Core, size: float = 1.0, part: float = 0.0, modulus: float = 0.0) -> Explanation:
    at = core.candidates[0].parameters[2].internal(part * 0.1)
    found = refit(core, np.array([modulus, size, 0.0, at]))  # type: ignore[type-var]
    return Explanation(core.candidates, found, found.log_evidence)  # type: ignore[arg-type]


def part_of(found: Explanation) -> float:
    return float(found.candidates[0].parameters[2].value(float(found.refit.z[3]))) / 0.1


def test_a_lump_that_a_refit_carried_to_an_end_comes_back() -> None:
    before = explanation(Core())
    assert part_of(before) == pytest.approx(0.0)
    (found,) = at_their_best_places([before], seed=0)
    assert part_of(found) == pytest.approx(RIGHT, abs=1e-3)
    assert found.log_evidence == pytest.approx(found.refit.log_evidence)


def test_a_strip_is_tried_on_the_other_side_of_its_absence() -> None:
    before = explanation(Core((STRIP,)), size=1.0, part=RIGHT)
    assert before.refit.z[1] > 0.5
    (found,) = at_their_best_places([before], seed=0)
    assert found.refit.z[1] == pytest.approx(-1.0, abs=0.1)


def test_a_constant_goes_to_the_side_where_it_leaves_least() -> None:
    before = explanation(Core(two=True), part=RIGHT, modulus=-1.0)
    assert before.refit.z[0] < -0.5
    (found,) = at_their_best_places([before], seed=0)
    assert found.refit.z[0] == pytest.approx(1.0, abs=0.2)


def test_what_leaves_too_much_is_sought_all_over_the_prior() -> None:
    """A lump of a hundredth of what it is: neither of its heights leads anywhere, and one of thirty points does."""
    before = explanation(Core(hidden=True), part=RIGHT)
    assert before.adequacy_but_one < 0.2
    (found,) = at_their_best_places([before], seed=0)
    assert found.refit.z[1] == pytest.approx(-1.5, abs=0.2)
    # a rival is not followed as far
    lead = replace(explanation(Core(), part=RIGHT), log_evidence=before.log_evidence + 1.0)
    assert at_their_best_places([lead, before], seed=0)[1].refit is before.refit


def test_where_it_is_best_it_stays() -> None:
    before = explanation(Core(), part=RIGHT)
    (found,) = at_their_best_places([before], seed=0)
    assert found.refit is before.refit
    # nobody has to ask for a model of its own once more
    assert found.settled


def test_a_near_rival_may_come_to_lead() -> None:
    lead = replace(explanation(Core((STRIP,)), size=-1.0, part=RIGHT), log_evidence=-1.0)
    trapped = explanation(Core())
    near = replace(trapped, log_evidence=-2.0)
    assert [e.effects for e in at_their_best_places([lead, near], seed=0)] == [
        ("attached_mass",),
        ("local_stiffness",),
    ]
    far = replace(trapped, log_evidence=-1.0 - NEAR_RIVAL)
    assert at_their_best_places([lead, far], seed=0)[1].refit is far.refit


def test_beside_recordings_what_leaves_as_little_as_right_names_do_stays() -> None:
    before = [explanation(Core(recorded=True), part=RIGHT)]
    assert before[0].adequacy_but_one > AS_RIGHT_ONES
    assert at_their_best_places(before, seed=0) == before
    assert at_their_best_places([], seed=0) == []


def test_beside_recordings_what_leads_and_leaves_more_is_tried_elsewhere_and_no_rival() -> None:
    trapped = explanation(Core(recorded=True))
    assert trapped.adequacy_but_one < AS_RIGHT_ONES
    lead, _ = at_their_best_places([trapped, trapped], seed=0)
    assert part_of(lead) == pytest.approx(RIGHT, abs=1e-3)
    lump = explanation(Core((STRIP,), recorded=True), size=-1.0, part=RIGHT)
    near = replace(trapped, log_evidence=lump.log_evidence - 1.0)
    assert at_their_best_places([lump, near], seed=0)[1].refit is near.refit

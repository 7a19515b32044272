"""What leads in a side valley is led to the deepest one, within its limits; what explains all stays where it is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import refit
from statorhom.diagnose.searches.deeper import DEEPER, in_its_deepest_valley
from statorhom.physics.candidate import Candidate
from statorhom.physics.parameter import EffectParameter, angle

MASS = EffectParameter("mass_kg", 0.01, 1.0, 1e-3, 10.0, "log", (0.1,), None)
LUMP, OTHER = (Candidate(effect, "stack", (MASS, angle())) for effect in ("attached_mass", "ovality"))
NOWHERE = Candidate("interlaminar_shear", "stack", (MASS,))
BESIDE = -2.0  # ln of the prior over candidates


@dataclass
class TwoValleys:
    """A constant that is told by itself, a magnitude of ±1 of which -1 is the likelier, an angle nobody is told of.

    Something is `left` whatever these are.
    """

    tilt: float = 1.0
    left: float = 4.0
    sharp: float = 2.0
    highest: float = 3.0
    missed: float = 0.0
    constants: int = 1
    held: Any = None
    untold: tuple[int, ...] = ()
    arc: Any = None
    changes: Any = "a lump"
    whole: bool = True
    shared: tuple[object, ...] = ()

    @property
    def prior_weights(self) -> np.ndarray:
        return np.array([1.0, 1.0, 0.0])

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.array([-5.0, -3.0, -np.inf]), np.array([5.0, self.highest, np.inf])

    def paired(self, _: np.ndarray) -> TwoValleys:
        return self

    def actions(self, _: np.ndarray) -> list[Any]:
        joint = SimpleNamespace(arc=self.arc)
        return [SimpleNamespace(changes=self.changes, joint=joint)]

    def residuals(self, z: np.ndarray) -> np.ndarray:
        return np.array([10 * z[0], self.sharp * (z[1] ** 2 - 1.0), self.tilt * (z[1] + 1.0), self.left])

    def charges(self, _: np.ndarray) -> np.ndarray:
        return np.zeros(4)

    def charge(self, _: np.ndarray) -> float:
        return 0.0

    def features(self, z: np.ndarray) -> list[SimpleNamespace]:
        same = {"kind": "frequency", "lost": False, "chance": 1.0, "doubt": 0.0}
        return [SimpleNamespace(residual=r, **same) for r in self.residuals(z)]


@dataclass
class Narrow(TwoValleys):
    """The constant is told a hundred times as sharply beside a negative magnitude."""

    def residuals(self, z: np.ndarray) -> np.ndarray:
        found = super().residuals(z)
        found[0] *= 1.0 if z[1] > 0.0 else 100.0
        return found


def explanation(
    model: TwoValleys, candidates: tuple[Candidate, ...] = (LUMP,), start: float = 1.0
) -> Explanation:
    found = refit(model, np.array([0.1, start, 0.5]))  # type: ignore[type-var]
    return Explanation(candidates, found, found.log_evidence + BESIDE)  # type: ignore[arg-type]


def test_what_leads_goes_where_it_is_deepest() -> None:
    before = explanation(TwoValleys())
    (found,) = in_its_deepest_valley([before], seed=0)
    assert before.refit.z[1] > 0.5
    assert found.refit.z[1] < -0.5
    assert found.refit.objective < before.refit.objective - DEEPER
    assert found.log_evidence == pytest.approx(found.refit.log_evidence + BESIDE)


def test_in_the_deepest_valley_it_stays_as_it_is() -> None:
    before = explanation(TwoValleys(), start=-1.0)
    (found,) = in_its_deepest_valley([before], seed=0)
    assert found.refit is before.refit
    assert found.log_evidence == before.log_evidence


def test_a_valley_beyond_a_limit_is_none() -> None:
    before = explanation(TwoValleys(tilt=-1.0, highest=0.0), start=-1.0)
    assert in_its_deepest_valley([before], seed=0)[0].refit is before.refit


def test_a_valley_so_narrow_that_nothing_speaks_for_it_is_none() -> None:
    before = explanation(Narrow())
    (found,) = in_its_deepest_valley([before], seed=0)
    at = refit(Narrow(), np.array([0.0, -1.0, 0.5]))  # type: ignore[type-var]
    assert at.objective < before.refit.objective - DEEPER
    assert at.log_evidence < before.refit.log_evidence
    assert found.refit is before.refit


def test_rivals_stay_behind_as_they_are() -> None:
    lead = explanation(TwoValleys())
    rival = replace(explanation(TwoValleys(), (OTHER,)), log_evidence=lead.log_evidence - 1.0)
    first, second = in_its_deepest_valley([lead, rival], seed=0)
    assert first.effects == lead.effects
    assert second is rival


@pytest.mark.parametrize(
    "untouched",
    [
        explanation(TwoValleys(left=0.1, tilt=0.5)),
        explanation(TwoValleys(), (NOWHERE,)),
        explanation(TwoValleys(arc=1.0)),
        explanation(TwoValleys(changes=None)),
        explanation(TwoValleys(whole=False)),
        explanation(TwoValleys(), (LUMP, OTHER)),
        replace(explanation(TwoValleys()), compared=explanation(TwoValleys()).refit),
    ],
    ids=["explains all", "nowhere", "arc", "symmetric", "a detail as usual", "pair", "without a gross row"],
)
def test_others_keep_what_they_have(untouched: Explanation) -> None:
    assert in_its_deepest_valley([untouched], seed=0) == [untouched]


def test_where_nothing_was_found_nothing_leads() -> None:
    assert in_its_deepest_valley([], seed=0) == []

"""A row that no explanation explains decides nothing between them; one that an explanation explains does."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence import gross_rows as module
from statorhom.diagnose.evidence.gross_rows import without_gross_rows
from statorhom.diagnose.fits.explanations import Explanation

LUMP, STRIP = "attached_mass", "local_stiffness"


@dataclass(frozen=True)
class Model:
    """Residuals of two modes; left out, the second one's are forgotten."""

    residuals: tuple[float, ...]
    left_out: frozenset[Any] = frozenset()

    def features(self, _: np.ndarray) -> list[Any]:
        return [
            SimpleNamespace(kind="frequency", group=("free", k), residual=r, lost=False, third=False)
            for k, r in enumerate(self.residuals)
        ]


def refit(*residuals: float) -> Any:
    return SimpleNamespace(hypothesis=Model(residuals), z=np.zeros(1))


def explanation(effect: str, log_evidence: float, *residuals: float) -> Explanation:
    candidate: Any = SimpleNamespace(effect=effect, label=effect)
    return Explanation((candidate,), refit(*residuals), log_evidence)


@pytest.fixture(autouse=True)
def refitted_without(monkeypatch: pytest.MonkeyPatch) -> None:
    """Refits whose evidence is that of the rows that are seen, less the objective of -100."""

    def refit_held(hypothesis: Model, z: np.ndarray) -> Any:
        seen = [f.residual for f in hypothesis.features(z) if f.group not in hypothesis.left_out]
        return SimpleNamespace(hypothesis=hypothesis, log_evidence=-0.5 * float(np.sum(np.square(seen))))

    monkeypatch.setattr(module, "refit_held", refit_held)
    monkeypatch.setattr(module, "explained", lambda r, _: SimpleNamespace(log_evidence=r.log_evidence))


def order(base: Any, *found: Explanation) -> list[str]:
    return [e.effects[0] for e in without_gross_rows(base, found, {})]


def test_the_one_that_bends_a_hopeless_row_leads_no_more() -> None:
    strip, lump = explanation(STRIP, -10.0, 2.0, 4.0), explanation(LUMP, -18.0, 0.5, 6.0)
    assert order(refit(9.0, 5.0), strip, lump) == [LUMP, STRIP]


def test_the_row_costs_all_what_it_costs_the_declared_model() -> None:
    found = without_gross_rows(
        refit(9.0, 5.0), [explanation(STRIP, -10.0, 2.0, 4.0), explanation(LUMP, -18.0, 0.5, 6.0)], {}
    )
    assert [e.log_evidence for e in found] == pytest.approx([-0.125 - 12.5, -2.0 - 12.5])
    assert all(e.set_aside == {("free", 1)} for e in found)
    # what is reported stays the whole refit
    assert all(not e.refit.hypothesis.left_out for e in found)


@pytest.mark.parametrize(
    ("base", "strip", "lump"),
    [
        ((9.0, 5.0), (2.0, 1.0), (0.5, 6.0)),  # one of them explains it
        ((9.0, 3.0), (2.0, 4.0), (0.5, 6.0)),  # the declared model does
        ((9.0, 5.0), (4.0, 4.0), (4.0, 6.0)),  # more than one such row is missing physics
    ],
)
def test_all_else_decides(base: tuple[float, ...], strip: tuple[float, ...], lump: tuple[float, ...]) -> None:
    found = explanation(STRIP, -10.0, *strip), explanation(LUMP, -18.0, *lump)
    assert order(refit(*base), *found) == [STRIP, LUMP]
    assert not any(e.set_aside for e in without_gross_rows(refit(*base), found, {}))


def test_what_is_far_behind_is_left_where_it_is() -> None:
    strip, lump = explanation(STRIP, -10.0, 2.0, 4.0), explanation(LUMP, -60.0, 0.5, 6.0)
    assert order(refit(9.0, 5.0), strip, lump) == [STRIP, LUMP]

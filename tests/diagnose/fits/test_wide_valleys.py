"""What a hypothesis computes in wide valleys, and what it computes twice."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from template_hypothesis import template_hypothesis

from statorhom.diagnose.fits import derivatives
from statorhom.diagnose.fits import hypothesis as module
from statorhom.diagnose.fits.hypothesis import Hypothesis

TABLE = (
    "frequency_hz,order,axial,damping_ratio\n1428,2,0,0.004\n1434,2,0,0.005\n1766,2,1,0.004\n3770,3,0,0.006\n"
)
STEP = 1e-3


@pytest.fixture(scope="module")
def hypothesis(tmp_path_factory: pytest.TempPathFactory) -> Hypothesis:
    return template_hypothesis(tmp_path_factory.mktemp("study"), {"stack-free.csv": TABLE}, with_losses=True)


def test_wide_valleys_are_sought_without_damping(hypothesis: Hypothesis) -> None:
    z = np.zeros(len(hypothesis))
    wide = replace(hypothesis, discrepancy=0.03).paired(z)
    narrow = replace(wide, discrepancy=0.0)
    kinds = {h: Counter(f.kind for f in h.features_of_all(z)) for h in (wide, narrow)}
    assert kinds[narrow]["loss"] == 3 and kinds[wide]["loss"] == 0
    assert kinds[narrow] - Counter(loss=3) == kinds[wide]
    slopes = derivatives.jacobian(wide, z)
    moved = [(wide.residuals(z + e) - wide.residuals(z - e)) / (2 * STEP) for e in STEP * np.eye(len(z))]
    np.testing.assert_allclose(slopes, np.array(moved).T, rtol=0.02, atol=2e-3 * np.abs(slopes).max())


def test_the_last_point_is_evaluated_once(hypothesis: Hypothesis, monkeypatch: pytest.MonkeyPatch) -> None:
    z = np.zeros(len(hypothesis))
    paired = hypothesis.paired(z)
    before = paired.residuals(z)
    asked: list[str] = []
    monkeypatch.setattr(
        module,
        "predicted",
        lambda *args: asked.append(args[4]) or pytest.fail("a known point is solved again"),
    )
    np.testing.assert_array_equal(paired.residuals(z), before)
    with pytest.raises(pytest.fail.Exception):
        paired.residuals(z + 0.1)
    assert asked == ["stack-free"]

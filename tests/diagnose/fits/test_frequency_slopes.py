"""One pass for all constants gives the derivatives that moving them one by one gives."""

from __future__ import annotations

import numpy as np
import pytest
from template_hypothesis import template_hypothesis

from statorhom.diagnose.fits import derivatives
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.stages.stage_model import mesh_error

STEP = 1e-3  # of internal coordinates
DOUBLET = "frequency_hz,order,axial\n1428,2,0\n1434,2,0\n1766,2,1\n3770,3,0\n6200,0,1\n"
CLAMPED = """
[[stages.tests]]
name = "stack-clamped"
support = "clamped"
modal_table = "stack-clamped.csv"

[[supports]]
name = "clamped"
kind = "lines"
angles_deg = [158.0, 202.0]
declared = "rigid"
"""


@pytest.fixture(scope="module")
def hypothesis(tmp_path_factory: pytest.TempPathFactory) -> Hypothesis:
    tables = {"stack-free.csv": DOUBLET, "stack-clamped.csv": "frequency_hz\n640\n1130\n1300\n"}
    return template_hypothesis(tmp_path_factory.mktemp("study"), tables, CLAMPED)


def test_slopes_are_those_of_moved_constants(hypothesis: Hypothesis) -> None:
    z = 0.1 * np.random.default_rng(3).standard_normal(len(hypothesis))
    paired = hypothesis.paired(z)
    found = derivatives.jacobian(paired, z)
    expected = np.array([moved(paired, z, unit) for unit in STEP * np.eye(len(z))]).T
    tests = {f.test for f, row in zip(paired.features(z), found, strict=True) if np.any(row)}
    assert tests == {"", "stack-free", "stack-clamped"}
    # residuals beyond the knee bend over a step
    np.testing.assert_allclose(found, expected, rtol=0.02, atol=2e-3 * np.abs(expected).max())
    names = paired.study.constants.names
    for name in (
        "stack:lamination.E_p_pa",
        "stack:mass_kg",
        "stack:mesh",
        "scatter 2 re",
        "sinking stack-clamped",
    ):
        assert np.any(found[:, names.index(name)]), name


def moved(hypothesis: Hypothesis, z: np.ndarray, change: np.ndarray) -> np.ndarray:
    """Central difference of the residuals, every mode solved anew."""
    after, before = (hypothesis.residuals(z + sign * change) for sign in (1, -1))
    return np.asarray((after - before) / (2 * STEP))


def test_every_measured_order_has_its_own_mesh_factors(hypothesis: Hypothesis) -> None:
    (stage,) = hypothesis.study.stages
    error = mesh_error(stage, stage.reference)
    assert {key[0] for key in error.factors} >= {0, 2, 3}
    assert error.factor((0, 1, 0)) != error.factor((1, 1, 0))


def test_lines_that_sink_in_lower_all_modes_of_their_test_together(hypothesis: Hypothesis) -> None:
    """A clean clamped stack, all of whose modes lay half a percent low, was given another temperature."""
    z = np.zeros(len(hypothesis))
    paired = hypothesis.paired(z)
    deeper = z.copy()
    deeper[paired.study.constants.names.index("sinking stack-clamped")] = 1.0
    pairs = list(zip(paired.features(z), paired.features(deeper), strict=True))
    falls = [a.predicted - b.predicted for a, b in pairs if a.test == "stack-clamped" and not a.lost]
    assert len(falls) == 3 and all(1e-4 < fall < 0.05 for fall in falls)
    assert all(a.predicted == b.predicted for a, b in pairs if a.test == "stack-free")

"""Evidence of modes that are off by chance, against the densities of normal distributions."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import logsumexp
from scipy.stats import chi, multivariate_normal

from statorhom.diagnose.evidence.free_discrepancy import AMPLITUDES, discrepancy_evidence
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.feature import LOST, Feature, Silence

SD = np.array([1e-3, 2e-3, 1e-3, 3e-3, 2e-3])
KINDS = ("frequency", "frequency", "frequency", "split", "split")
SLOPES = np.array([[0.5, 0.1], [0.4, -0.2], [0.5, 0.0], [0.0, 0.1], [0.0, 0.3]])  # in standard deviations


def declared(errors: np.ndarray, *, lost: int | None = None, silent: Silence | None = None) -> Refit[Any]:
    """A linear model of two constants at its optimum, beside errors (n,) in standard deviations."""
    z = -np.linalg.solve(SLOPES.T @ SLOPES + np.eye(2), SLOPES.T @ errors)
    left = errors + SLOPES @ z
    features = [
        Feature(kind, "t", (2, i, 0), float(r * sd), 0.0, float(sd))
        for i, (kind, r, sd) in enumerate(zip(KINDS, left, SD, strict=True))
    ]
    if lost is not None:
        features[lost] = Feature("frequency", "t", None, float(left[lost]), 0.0, 1.0, lost=True)
    slopes = SLOPES
    if silent is not None:
        left, slopes = np.append(left, silent.residual()), np.vstack([SLOPES, np.zeros(2)])
        features.append(Feature("split", "t", (9, 0, 0), 0.0, left[-1], 1.0, silence=silent))
    hypothesis = SimpleNamespace(features=lambda _: features, prior_weights=np.ones(2), charge=lambda _: 0.0)
    return Refit(hypothesis, z, slopes, float(left @ left), float(left @ left + z @ z))  # type: ignore[arg-type]


def by_densities(errors: np.ndarray, lost: int | None = None, silent: Silence | None = None) -> float:
    own = []
    for a in AMPLITUDES:
        for b in AMPLITUDES:
            off = np.where(np.array(KINDS) == "frequency", a, b) / SD
            if lost is not None:
                off[lost] = 0.0
            covariance = np.diag(1 + off**2) + SLOPES @ SLOPES.T
            own.append(multivariate_normal.logpdf(errors, cov=covariance))
            own[-1] += 0.0 if silent is None else np.log(likelihood(silent, b))
    return float(logsumexp(own)) - 2 * np.log(len(AMPLITUDES)) + 0.5 * len(errors) * np.log(2 * np.pi)


def likelihood(silent: Silence, amplitude: float) -> float:
    """Of one line alone, where the doublet's split is drawn anew."""
    return float(
        quad(lambda q: chi.pdf(q, silent.parts) * np.exp(-0.5 * silent.residual(amplitude * q) ** 2), 0, 9)[0]
    )


@pytest.mark.parametrize("parts", [1, 2])
def test_it_parts_the_lines_of_silent_doublets_too(parts: int) -> None:
    errors = np.array([1.0, -1.0, 0.5, 1.0, -7.0])
    silent = Silence(split=1e-3, width=3e-3, most=1.8, parts=parts)
    found = discrepancy_evidence(declared(errors, silent=silent))
    assert found == pytest.approx(by_densities(errors, silent=silent), abs=0.02)
    assert found < discrepancy_evidence(declared(errors)) - 0.5


@pytest.mark.parametrize("lost", [None, 2])
def test_the_evidence_is_the_mean_of_the_data_s_densities(lost: int | None) -> None:
    errors = np.array([3.0, -2.0, 4.0, 1.0, -5.0])
    assert discrepancy_evidence(declared(errors, lost=lost)) == pytest.approx(
        by_densities(errors, lost), abs=1e-9
    )


def test_it_gains_nothing_where_nothing_is_off() -> None:
    fits = declared(np.array([0.3, -0.2, 0.1, 0.4, -0.5]))
    assert discrepancy_evidence(fits) < fits.log_evidence


def test_it_gains_much_where_every_mode_is_off() -> None:
    off = declared(np.array([7.0, -6.0, 5.0, 7.0, -7.0]))
    assert discrepancy_evidence(off) > off.log_evidence + 20


def test_one_gross_error_costs_no_more_than_it_costs_an_effect() -> None:
    """A wrong name is off by 50 standard deviations and is held down in every model."""
    errors = np.array([0.1, 0.2, 60.0, 0.3, -0.2])
    held = discrepancy_evidence(declared(errors))
    assert held > by_densities(errors) - 5
    assert np.isfinite(held)


@pytest.mark.parametrize(
    "feature",
    [
        Feature("loss", "t", (2, 0, 0), 9.0, 0.0, 1.0),
        Feature("frequency", "t", None, LOST, 0.0, 1.0, lost=True),
    ],
)
def test_what_no_discrepancy_is_of_costs_what_it_costs_the_declared_model(feature: Feature) -> None:
    """A loss factor that a cable has doubled, and a line that no model has, are held down once and for all."""
    fits = Feature("frequency", "t", (3, 0, 0), 0.0, 0.0, 1e-3)
    hypothesis = SimpleNamespace(
        features=lambda _: [feature, fits], prior_weights=np.ones(1), charge=lambda _: 0.0
    )
    objective = feature.residual**2
    base: Refit[Any] = Refit(hypothesis, np.zeros(1), np.zeros((2, 1)), objective, objective)  # type: ignore[arg-type]
    assert base.log_evidence - 3 < discrepancy_evidence(base) < base.log_evidence


def test_it_pays_for_what_the_model_is_not_sure_of_as_the_model_does() -> None:
    fits = declared(np.array([3.0, -2.0, 4.0, 1.0, -5.0]))
    unsure = replace(fits, doubt=7.0)
    assert unsure.log_evidence == pytest.approx(fits.log_evidence - 7.0)
    assert discrepancy_evidence(unsure) == pytest.approx(discrepancy_evidence(fits) - 7.0)

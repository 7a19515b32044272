"""What simpler methods say of the same data: the yardstick that every answer of the whole method has to beat.

- Young's modulus alone: everything else stays as typed or typical; tells how well such a fit predicts modes it did not
  see.
- All constants, regularised by their priors: the declared model's refit, with nothing left out.
- An effect by the Bayesian information criterion with all constants held at that refit, nothing projected out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.diagnose.evidence.held_out_modes import groups_of, left_out_errors, refit_held
from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.fits.derivatives import jacobian
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.scan import Scan
from statorhom.errors import StatorhomError

FOLDS = 3
ITERATIONS = 8
LARGEST_STEP = 2.0  # in prior standard deviations
LISTED = 5


@dataclass(frozen=True)
class SimplerFits:
    """Modes predicted from fits that did not see them (three folds), root mean square errors in percent.

    Parameters
    ----------
    modulus_alone, all_constants : of the two fits; None where they could not be made.
    """

    modulus_alone: float | None
    all_constants: float | None


def simpler_fits(base: Refit) -> SimplerFits:
    """Held-out errors of the two fits on the same modes."""
    groups = groups_of(base)
    folds = [fold for k in range(FOLDS) if (fold := frozenset(groups[k::FOLDS]))]
    if len(folds) < 2:
        return SimplerFits(None, None)
    moduli = in_plane_moduli(base.hypothesis)
    alone: list[float] = []
    whole: list[float] = []
    for fold in folds:
        trained = replace(base.hypothesis, left_out=fold)
        try:
            all_free = refit_held(trained, base.z)
            pair = (
                left_out_errors(trained, fitted_alone(trained, base.z, moduli)),
                left_out_errors(all_free.hypothesis, all_free.z),
            )
        except StatorhomError:
            continue
        both = sorted(pair[0].keys() & pair[1].keys(), key=str)
        alone += [pair[0][g][0] for g in both]
        whole += [pair[1][g][0] for g in both]
    return SimplerFits(_rms(alone), _rms(whole))


def in_plane_moduli(hypothesis: AnyHypothesis) -> list[int]:
    """Numbers of the constants that are Young's moduli, those along the stack left out."""
    names = [name.split(".")[-1] for name in hypothesis.study.constants.names]
    return [i for i, name in enumerate(names) if name.startswith("E_") and name != "E_z_pa"]


def fitted_alone(hypothesis: AnyHypothesis, start: np.ndarray, free: Sequence[int]) -> np.ndarray:
    """Optimum over some of the constants, all others at their prior medians; the pairing is held.

    Raises
    ------
    StatorhomError
        If no stator has the constants of the start.
    """
    low, high = (limit[list(free)] for limit in hypothesis.limits())
    z = np.zeros_like(start)
    z[list(free)] = start[list(free)]
    residuals = hypothesis.residuals(z)
    for _ in range(ITERATIONS):
        J = jacobian(hypothesis, z)[:, list(free)]
        own = z[list(free)]
        step = -np.linalg.solve(J.T @ J + np.eye(len(free)), J.T @ residuals + own)
        better = False
        for factor in (1.0, 0.5, 0.25, 0.1):
            trial = z.copy()
            trial[list(free)] = np.clip(own + np.clip(factor * step, -LARGEST_STEP, LARGEST_STEP), low, high)
            new = hypothesis.residuals(trial)
            if new @ new + trial @ trial < residuals @ residuals + z @ z:
                z, residuals, better = trial, new, True
                break
        if not better:
            break
    return z


def by_criterion(found: Scan, base: Refit) -> list[tuple[str, str, float]]:
    """Effect, label and gain 2 ln L - k ln n of the best candidates with all constants held, the best first."""
    residuals = base.hypothesis.residuals(base.z)
    price = float(np.log(max(len(residuals), 2)))
    best: dict[str, tuple[str, str, float]] = {}
    for s in found.signatures:
        total = float(s.whole @ s.whole)
        if total == 0.0 or len(s.whole) != len(residuals):
            continue
        gain = max(0.0, -float(s.whole @ residuals)) ** 2 / total - price * len(s.candidate.parameters)
        label = s.candidate.label
        if label not in best or gain > best[label][2]:
            best[label] = (s.candidate.effect, label, gain)
    return sorted(best.values(), key=lambda row: -row[2])[:LISTED]


def _rms(values: Sequence[float]) -> float | None:
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else None

"""Where around the stator a local cause of the measured doublet splits may sit (physics.md §5, §7).

A local cause at θ gives the split b_r = κ_r e^{2irθ}: κ_r is what it would be at θ = 0, of one sign for stiffness, of
the other for mass. B(θ) is the share of the measured splits, in units of their noise, that one cause at θ and of the
best size explains. One order leaves 2r equal peaks, several fewer; θ and θ + π are always alike.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.diagnose.features.mode_features import SCATTER_SD, SPLIT_OWN, SPLIT_PART
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.predicted.prediction import broken_responses
from statorhom.model.convergence import ModeKey
from statorhom.physics.library import library
from statorhom.study.study_file import FREE

STEP_DEG = 2.0


@dataclass(frozen=True)
class SplitSeen:
    """A measured doublet.

    Parameters
    ----------
    stage, test, key : which.
    split : complex, relative to the mean λ.
    sd : of either part, with the scatter that every stator has.
    """

    stage: str
    test: str
    key: ModeKey
    split: complex
    sd: float


def splits_seen(base: Refit) -> tuple[SplitSeen, ...]:
    """All splits of free tests whose angle was measured."""
    found = []
    for stage in base.hypothesis.study.stages:
        for test in stage.tests:
            if test.support != FREE or base.hypothesis.held is None:
                continue
            names = {m.label: k for m, k in zip(test.modes, base.hypothesis.held[test.name], strict=True)}
            for s in test.splits:
                key = names.get(s.lower)
                if isinstance(key, tuple) and key == names.get(s.upper):
                    size = (SPLIT_PART * abs(s.relative)) ** 2
                    sd = float(np.sqrt(s.sd**2 + SCATTER_SD**2 + SPLIT_OWN**2 + size))
                    found.append(SplitSeen(stage.name, test.name, key, s.relative, sd))
    return tuple(found)


def angular_map(
    splits: Sequence[SplitSeen], unit: Mapping[ModeKey, complex], angles_rad: np.ndarray, *, signed: bool
) -> np.ndarray:
    """B(θ), 0 … 1.

    Parameters
    ----------
    splits : measured.
    unit : mode → κ_r.
    angles_rad : (a,) θ.
    signed : whether only causes of κ's own sign count, or those of the other sign too.
    """
    used = [s for s in splits if abs(unit.get(s.key, 0.0)) > 0]
    if not used:
        return np.zeros(len(angles_rad))
    whitened = np.array([s.split / s.sd for s in used])
    expected = np.array([unit[s.key] / s.sd for s in used])
    turn = np.exp(2j * np.outer([s.key[0] for s in used], angles_rad))
    projected = np.real(np.conj(expected[:, None] * turn) * whitened[:, None]).sum(axis=0)
    if signed:
        projected = np.maximum(projected, 0.0)
    whole = float(np.sum(np.abs(expected) ** 2) * np.sum(np.abs(whitened) ** 2))
    return np.asarray(projected**2 / whole)


def angles_of(base: Refit, best: Explanation) -> tuple[tuple[float, float], ...]:
    """(angle in degrees, B) around the stator: for the best explanation's cause, else for any local cause."""
    splits = splits_seen(base)
    if not splits:
        return ()
    angles = np.arange(0.0, 360.0, STEP_DEG)
    unit = _unit_splits(best)
    known = bool(unit)
    weights = angular_map(
        splits, unit if known else {s.key: 1.0 for s in splits}, np.deg2rad(angles), signed=known
    )
    return tuple((float(a), round(float(w), 4)) for a, w in zip(angles, weights, strict=True))


def _unit_splits(best: Explanation) -> dict[ModeKey, complex]:
    """Splits by the explanation's local cause, turned to θ = 0; empty where it has none."""
    r = best.refit
    found: dict[ModeKey, complex] = {}
    values = r.hypothesis.effect_values(r.z)
    for candidate, own in zip(best.candidates, values, strict=True):
        period = [p.upper - p.lower for p in candidate.parameters if p.name == "angle_rad"]
        if not period or period[0] < 2 * np.pi - 1e-9:
            continue
        at_zero = {**own, "angle_rad": 0.0}
        action = library()[candidate.effect].action(candidate, at_zero, r.hypothesis.study.files)
        for stage in r.hypothesis.study.stages:
            here = replace(action, tests=None)
            if here.touches(stage.name):
                found |= {k: response.split for k, response in broken_responses(stage, [here]).items()}
    return found

"""Which of the many other names that modes might have are worth a refit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.predicted.prediction import predicted
from statorhom.physics.candidate import Candidate
from statorhom.physics.library import library

NEAR = 0.06  # of ln f: how far a mode may lie from one whose name it shall take
OUTLIER = 3.0


def worth_trying(base: Refit, candidates: Sequence[Candidate]) -> tuple[Candidate, ...]:
    """Candidates that give outliers the name of a predicted mode nearby."""
    if not candidates:
        return ()
    hypothesis = base.hypothesis
    assert hypothesis.held is not None
    values = hypothesis.study.constants.values(base.z[: hypothesis.constants])
    odd = _outliers(base)
    near: dict[tuple[str, str], set[tuple[int, int]]] = {}
    for stage in hypothesis.study.stages:
        for test in stage.tests:
            modes = predicted(hypothesis.study, stage, values, hypothesis.study.effects, test.name)
            for mode in test.modes:
                if (test.name, mode.label) in odd:
                    near[test.name, mode.label] = {
                        key[:2]
                        for key, p in modes.items()
                        if abs(p.log_f - np.log(mode.frequency_hz)) < NEAR and p.visibility > 0.1
                    }
    found = []
    for candidate in candidates:
        names = library()[candidate.effect].action(candidate, {}, hypothesis.study.files).names
        if any(name in near.get(place, ()) for place, name in names.items()):
            found.append(candidate)
    return tuple(found)


def _outliers(base: Refit) -> set[tuple[str, str]]:
    """(test, label) of modes that no partner explains."""
    hypothesis: Hypothesis = base.hypothesis
    assert hypothesis.held is not None
    bad = {
        f.group for f in hypothesis.features(base.z) if f.kind == "frequency" and abs(f.residual) > OUTLIER
    }
    return {
        (test.name, mode.label)
        for stage in hypothesis.study.stages
        for test in stage.tests
        if test.name in hypothesis.held
        for mode, key in zip(test.modes, hypothesis.held[test.name], strict=True)
        if (test.name, key) in bad or key is None
    }

"""Which further measurement tells two explanations apart best."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.explanations import Explanation
from statorhom.diagnose.features import OWN, SPLIT_OWN
from statorhom.diagnose.prediction import predicted
from statorhom.diagnose.refit import Refit
from statorhom.physics.library import library
from statorhom.results.diagnosis import NextMeasurement

MEASURED_SD = 3e-4  # relative, of a frequency of a careful test
WEIGHED_SD = 1e-3  # relative, of a mass or dimension that is measured again


def next_measurement(best: Explanation, rest: Sequence[Explanation]) -> NextMeasurement | None:
    """The measurement whose outcome the two leading explanations predict most differently."""
    if not rest:
        return None
    second = rest[0]
    options = [*_again(best, second), *_modes(best.refit, second.refit)]
    text = _said(best, second)
    what, value = max(options, key=lambda o: o[1], default=(text, 0.0))
    if text and value < 1.0:
        what = text
    names = tuple(dict.fromkeys((*best.effects, *second.effects)))
    return NextMeasurement(what=what, separates=names, expected_log_evidence=value or None)


def _said(best: Explanation, second: Explanation) -> str:
    """What the library says of the two."""
    for a, b in ((best, second), (second, best)):
        for name in a.effects:
            for confusion in library()[name].confused_with:
                if confusion.effect in b.effects:
                    return confusion.separated_by
    return "repeat the test with more points"


def _again(best: Explanation, second: Explanation) -> list[tuple[str, float]]:
    """Measuring an input again that one of them says is wrong."""
    found = []
    for e in (best, second):
        values = e.refit.hypothesis.effect_values(e.refit.z)
        for candidate, own in zip(e.candidates, values, strict=True):
            absent = candidate.parameters[0].absent if candidate.parameters else None
            if "input" in candidate.chosen and absent:
                change = np.log(own["value"] / absent) / WEIGHED_SD
                key = candidate.chosen["input"]
                found.append((f"measure {key} of stage {candidate.stage} again", 0.5 * float(change**2)))
    return found


def _modes(first: Refit, second: Refit) -> list[tuple[str, float]]:
    """A modal test that sees all modes of the band with their angles."""
    found = []
    for stage in first.hypothesis.study.stages:
        both = []
        for r in (first, second):
            values = r.hypothesis.study.constants.values(r.z[: r.hypothesis.constants])
            both.append(predicted(r.hypothesis.study, stage, values, r.hypothesis.actions(r.z)))
        gain = 0.0
        for key in both[0].keys() & both[1].keys():
            a, b = both[0][key], both[1][key]
            if a.visibility > 0.1:
                sd = np.hypot(MEASURED_SD, OWN)
                gain += (
                    0.25 * ((a.log_f - b.log_f) / sd) ** 2 + 0.25 * abs(a.split - b.split) ** 2 / SPLIT_OWN**2
                )
        what = (
            f"modal test of stage {stage.name}, free, with all modes of the band, their doublets and angles"
        )
        found.append((what, float(gain)))
    return found

"""From explanations to the rows of diagnosis.json."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from statorhom.diagnose.evidence.held_out_modes import LACKING, lacked
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.sides import one_by_one, opposite_location
from statorhom.diagnose.measured.feature import Feature
from statorhom.materials.typical_ranges import Z95
from statorhom.physics.candidate import Candidate
from statorhom.physics.declared import DeclaredEffect
from statorhom.physics.library import library
from statorhom.physics.parameter import EffectParameter
from statorhom.results.diagnosis import (
    ConstantRow,
    EffectResult,
    Errors,
    Estimated,
    FeatureRow,
    Location,
    PlanLocation,
)

Located = Callable[[Explanation, int], Location | PlanLocation | None]

STEP = 1e-3  # of internal coordinates
TOGETHER = (
    "the recordings tell what its sizes come to together rather than each of them, "
    "so that an interval may hold none at all"
)


def effect_results(
    explanation: Explanation, probability: float, located: Located
) -> tuple[EffectResult, ...]:
    """The explanation's effects as the file names them."""
    r = explanation.refit
    files = r.hypothesis.study.files
    found = []
    for number, (candidate, values) in enumerate(
        zip(explanation.candidates, r.hypothesis.effect_values(r.z), strict=True)
    ):
        effect = library()[candidate.effect]
        intervals = _intervals(explanation, number)
        place = located(explanation, number)
        places = (place, opposite_location(place, files)) if candidate.both_sides else (place,)
        parameters: dict[str, Estimated | float | str] = {}
        for name, value in effect.reported(candidate, values).items():
            known = intervals.get(name)
            parameters[name] = value if known is None else Estimated(value=value, ci90=known)
        found += [
            EffectResult(
                effect=candidate.effect,
                stage=candidate.stage,
                region=candidate.region,
                test=candidate.test,
                location=location,
                parameters=parameters,
                probability=probability,
                note=_note(effect.words(files).note, candidate, intervals),
            )
            for location in places
        ]
    return tuple(found)


def _note(note: str | None, candidate: Candidate, intervals: Mapping[str, tuple[float, float]]) -> str | None:
    """Of an effect, and of one of several sizes why it is named though a magnitude's own interval holds its absence."""
    known = ((p.absent, intervals[p.name]) for p in candidate.magnitudes if p.name in intervals)
    if len(intervals) > 1 and any(
        absent is not None and low <= absent <= high for absent, (low, high) in known
    ):
        return "; ".join(n for n in (note, TOGETHER) if n)
    return note


def as_declared(explanation: Explanation, located: Located) -> tuple[DeclaredEffect, ...]:
    """The explanation's effects with their values, as a study would declare them."""
    r = explanation.refit
    found = []
    for number, (candidate, values) in enumerate(
        zip(explanation.candidates, r.hypothesis.effect_values(r.z), strict=True)
    ):
        place = located(explanation, number)
        if isinstance(place, Location) and place.angle_deg is not None:
            # the likeliest of the angles that splits alone do not tell apart
            values = {**values, "angle_rad": float(np.deg2rad(place.angle_deg))}
        files = r.hypothesis.study.files
        for one, own in one_by_one(candidate, values, files):
            found.append(DeclaredEffect(one, own, library()[one.effect].action(one, own, files)))
    return tuple(found)


def _intervals(explanation: Explanation, number: int) -> dict[str, tuple[float, float]]:
    """90 % intervals of the magnitudes."""
    r = explanation.refit
    covariance = r.covariance
    found = {}
    for k, (i, j) in enumerate(r.hypothesis.parameters):
        parameter: EffectParameter = r.hypothesis.candidates[i].parameters[j]
        if i == number and not parameter.located:
            place = r.hypothesis.constants + k
            shape = _shape_spread(r.hypothesis.candidates[i], parameter, float(r.z[place]))
            spread = Z95 * float(np.hypot(np.sqrt(covariance[place, place]), shape))
            low, high = (parameter.value(r.z[place] + sign * spread) for sign in (-1, 1))
            found[parameter.name] = (low, high)
    return found


def _shape_spread(candidate: Candidate, parameter: EffectParameter, z: float) -> float:
    """What the unknown shape of a local cause leaves open of its magnitude, in internal units.

    All splits share it, so that more of them do not average it out as they do what each has by itself.
    """
    if not candidate.located:
        return 0.0
    slope = (parameter.value(z + STEP) - parameter.value(z - STEP)) / (2 * STEP)
    size = abs(parameter.value(z) - (parameter.absent or 0.0))
    return library()[candidate.effect].open_by_shape * size / abs(slope) if slope else 0.0


def frequency_errors(r: Refit, other: Refit) -> Errors:
    """Of the modes that have a partner here or in another fit, in percent; what is lacking here is off by `LACKING`."""
    errors = [
        100 * abs(f.measured - f.predicted)
        for f in r.hypothesis.features(r.z)
        if f.kind == "frequency" and not f.lost
    ]
    errors += [LACKING] * len(lacked(r, other))
    if not errors:
        return Errors(rms_percent=0.0, max_percent=0.0)
    return Errors(rms_percent=float(np.sqrt(np.mean(np.square(errors)))), max_percent=float(max(errors)))


def feature_rows(base: Refit, best: Refit) -> tuple[FeatureRow, ...]:
    """All features that both have, measured and predicted.

    The two may take a line for different modes of one name, and two lines for one mode or for two.
    """
    stages = {t.name: s.name for s in base.hypothesis.study.stages for t in s.tests}
    after: dict[tuple[str, object, str], list[Feature]] = {}
    for f in best.hypothesis.features(best.z):
        after.setdefault(_measured(f), []).append(f)
    rows = []
    for f in base.hypothesis.features(base.z):
        same = after.get(_measured(f))
        if f.key is None or f.lost or not same or same[0].lost:
            continue
        twin = same.pop(0)
        rows.append(
            FeatureRow(
                stage=stages[f.test],
                test=f.test,
                mode=f.mode,
                kind=f.kind,
                measured=f.measured,
                before=f.predicted,
                after=twin.predicted,
                sd=f.sd,
            )
        )
    return tuple(rows)


def _measured(f: Feature) -> tuple[str, object, str]:
    """What a feature was measured of: its lines, or its mode where these have no labels."""
    return f.test, f.rows or f.key, f.kind


def constant_rows(base: Refit, best: Refit) -> tuple[ConstantRow, ...]:
    """Material constants and weights before and after."""
    n = base.hypothesis.constants
    before, after = (np.sqrt(np.diag(r.covariance))[:n] for r in (base, best))
    rows = []
    for k, c in enumerate(base.hypothesis.study.constants.items):
        if "." not in c.name.partition(":")[2] and not c.name.endswith("mass_kg"):
            continue
        spread = [
            0.5 * abs(c.value(r.z[k] + s[k]) - c.value(r.z[k] - s[k]))
            for r, s in ((base, before), (best, after))
        ]
        rows.append(
            ConstantRow(
                name=c.name,
                before=c.value(base.z[k]),
                before_sd=spread[0],
                after=c.value(best.z[k]),
                after_sd=spread[1],
            )
        )
    return tuple(rows)

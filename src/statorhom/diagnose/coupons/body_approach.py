"""The diagnosis of bodies without circumferential order, as one approach."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np

from statorhom.diagnose.coupons.body_baseline import body_baseline, sharpened_body
from statorhom.diagnose.coupons.body_hypothesis import BodyHypothesis
from statorhom.diagnose.coupons.body_place import body_located
from statorhom.diagnose.fits.baseline import Baseline
from statorhom.diagnose.fits.explanations import Explanation, explained
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.next_measurement.choice import Choice, said_of
from statorhom.diagnose.searches.approach import Approach
from statorhom.geometry.tested_object import ObjectGeometry
from statorhom.identify.stages.settings import Settings
from statorhom.physics.plan import plan_of
from statorhom.results.diagnosis import NextMeasurement, PlanRow
from statorhom.study.study import StudyFiles

OWN = 2  # leading explanations that get models of their own


def _baseline(
    files: StudyFiles, geometry: ObjectGeometry, tests: Mapping[str, MeasuredTest], settings: Settings
) -> Baseline:
    found, valleys = body_baseline(files, geometry, tests, settings)
    # scan, refits and rules ask no more of it than `AnyHypothesis` has
    free = cast(Refit, found)
    return Baseline(cast(Any, found.hypothesis.study), free, free, valleys)


def _declared_again(base: Baseline, found: Sequence[Explanation]) -> Baseline | None:
    del base, found  # a coupon's constants have one valley
    return None


def _refined(
    explanations: Sequence[Explanation], valleys: Sequence[np.ndarray], counts: dict[str, int]
) -> list[Explanation]:
    del valleys  # a coupon's constants have been sought once; effects do not move them far
    found = [
        explained(_final(e).refit, counts) if number < OWN else e for number, e in enumerate(explanations)
    ]
    return sorted(found, key=lambda e: -e.log_evidence)


def _final(explanation: Explanation) -> Explanation:
    return cast(Explanation, sharpened_body(cast(Explanation[BodyHypothesis], explanation)))


def _next_measurement(best: Explanation, rest: Sequence[Explanation]) -> Choice:
    if not rest:
        return Choice()
    names = tuple(dict.fromkeys((*best.effects, *rest[0].effects)))
    return Choice(NextMeasurement(what=said_of(best, rest[0]), separates=names))


def _pictures(
    files: StudyFiles, base: Refit, best: Explanation, named: bool, missing: bool
) -> Mapping[str, Any]:
    del base, best, named, missing
    plan = plan_of(files)
    if plan is None:
        return {}
    return {"plan": PlanRow(outline_mm=tuple((1e3 * x, 1e3 * y) for x, y in plan.outline))}


def _located(explanation: Explanation, number: int) -> Any:
    return body_located(cast(Explanation[BodyHypothesis], explanation), number)


BODY = Approach(_baseline, _declared_again, _refined, _final, _located, _next_measurement, _pictures)

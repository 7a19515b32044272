"""What of a diagnosis depends on the kind of body: its model, and how places on it are told and drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from statorhom.diagnose.fits.baseline import Baseline, baseline
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.location import located
from statorhom.diagnose.located.mirrored import at_likelier_height
from statorhom.diagnose.located.place_rows import angle_rows, machine_row, map_rows, opposite_rows
from statorhom.diagnose.next_measurement.choice import Choice, next_measurement
from statorhom.diagnose.searches.declared_again import declared_again
from statorhom.diagnose.searches.sharper import at_its_own_materials, refined, sharpened
from statorhom.results.diagnosis import Location, PlanLocation
from statorhom.study.study import StudyFiles

Refined = Callable[[Sequence[Explanation], Sequence[np.ndarray], dict[str, int]], list[Explanation]]


@dataclass(frozen=True)
class Approach:
    """A kind of body.

    Parameters
    ----------
    baseline : fits the declared model.
    declared_again : the declared model where explanations lead, if it is the better there.
    refined : the leading explanations in models of their own.
    final : the explanation that is reported, in its own model and at the likeliest of places that look alike.
    located : where an explanation's effect of a number is; None where it is nowhere.
    next_measurement : what tells the best explanation from the others.
    pictures : what the pictures of a diagnosis need, as fields of its details: from the study, the declared model, the
        best explanation and whether it is named, and whether anything is missing.
    """

    baseline: Callable[..., Baseline]
    declared_again: Callable[[Baseline, Sequence[Explanation]], Baseline | None]
    refined: Refined
    final: Callable[[Explanation], Explanation]
    located: Callable[[Explanation, int], Location | PlanLocation | None]
    next_measurement: Callable[[Explanation, Sequence[Explanation]], Choice]
    pictures: Callable[[StudyFiles, Refit, Explanation, bool, bool], Mapping[str, Any]]


def _ring_final(explanation: Explanation) -> Explanation:
    own = explanation if explanation.settled else sharpened(explanation)
    return at_likelier_height(at_its_own_materials(own))


def _ring_pictures(
    files: StudyFiles, base: Refit, best: Explanation, named: bool, missing: bool
) -> Mapping[str, Any]:
    return {
        "angles": angle_rows(base, best),
        "machine": machine_row(files),
        "maps": map_rows(base) if missing else (),
        "opposite": opposite_rows(best) if named else (),
    }


RING = Approach(baseline, declared_again, refined, _ring_final, located, next_measurement, _ring_pictures)

"""Two of one effect that mirror each other, told one by one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from statorhom.physics.candidate import Candidate
from statorhom.physics.plan import plan_of
from statorhom.results.diagnosis import Location, PlanLocation
from statorhom.study.study import StudyFiles


def one_by_one(
    candidate: Candidate, values: Mapping[str, float], files: StudyFiles
) -> list[tuple[Candidate, Mapping[str, float]]]:
    """The candidate and its values; where it stands on both sides, one of each side."""
    plan = plan_of(files)
    if plan is None or not candidate.both_sides:
        return [(candidate, values)]
    one = replace(candidate, both_sides=False)
    return [(one, values), (one, plan.opposite(values))]


def opposite_location(
    place: Location | PlanLocation | None, files: StudyFiles
) -> Location | PlanLocation | None:
    """A location on the other side; one that has no other side stays where it is."""
    plan = plan_of(files)
    if plan is None or not isinstance(place, PlanLocation):
        return place

    def across(x_mm: float, y_mm: float) -> tuple[float, float]:
        x, y = plan.opposite_point(x_mm / 1e3, y_mm / 1e3)
        return 1e3 * x, 1e3 * y

    x, y = across(place.x_mm, place.y_mm)
    alike = tuple(across(*point) for point in place.place_ambiguity_mm)
    return place.model_copy(update={"x_mm": x, "y_mm": y, "place_ambiguity_mm": alike})

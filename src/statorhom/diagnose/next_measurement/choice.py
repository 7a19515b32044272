"""Which further measurement tells two explanations apart best, for what it costs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.next_measurement import inspections, ladders, modal_tests, probes
from statorhom.diagnose.next_measurement.option import Option, expected_gain
from statorhom.diagnose.next_measurement.view import views
from statorhom.errors import StatorhomError
from statorhom.physics.library import library
from statorhom.results.diagnosis import NextMeasurement, OptionRow

LEAST_GAIN = 1.0  # log evidence below which a measurement decides nothing
SHOWN = 6


@dataclass(frozen=True)
class Choice:
    """The best measurement, and the others by what they bring per hour."""

    best: NextMeasurement | None = None
    options: tuple[OptionRow, ...] = ()


def next_measurement(best: Explanation, rest: Sequence[Explanation]) -> Choice:
    """The measurement whose outcome the two leading explanations predict most differently per hour of work."""
    if not rest:
        return Choice()
    second = rest[0]
    names = tuple(dict.fromkeys((*best.effects, *second.effects)))
    rows = ranked(best, second)
    said = said_of(best, second)
    if not rows or rows[0].log_evidence < LEAST_GAIN:
        # none of the model's own options decides: what the library knows of the two is the better advice
        return Choice(NextMeasurement(what=said, separates=names), tuple(rows[:SHOWN]))
    chosen = NextMeasurement(
        what=f"measure {rows[0].what}", separates=names, expected_log_evidence=rows[0].log_evidence
    )
    return Choice(chosen, tuple(rows[:SHOWN]))


def ranked(best: Explanation, second: Explanation) -> list[OptionRow]:
    """All options that bring anything, the most log evidence per hour first."""
    both = [views(e.refit) for e in (best, second)]
    rows = []
    for option in _options(best, second):
        try:
            gain = expected_gain(option, *both)
        except (StatorhomError, KeyError):
            continue  # one of the explanations cannot be asked for it
        if gain > 0.01:
            rows.append(OptionRow(what=option.what, hours=option.hours, log_evidence=gain))
    return sorted(rows, key=lambda row: -row.log_evidence / row.hours)


def _options(best: Explanation, second: Explanation) -> list[Option]:
    refit = best.refit
    found = [*modal_tests.options(refit), *ladders.options(refit), *probes.options(refit)]
    for e in (best, second):
        found += inspections.options(e.refit)
    seen: dict[str, Option] = {}
    for option in found:
        seen.setdefault(option.what, option)
    return list(seen.values())


def said_of(best: Explanation, second: Explanation) -> str:
    """What the library says of the two."""
    for a, b in ((best, second), (second, best)):
        for name in a.effects:
            for confusion in library()[name].words(a.refit.hypothesis.study.files).confused_with:
                if confusion.effect in b.effects:
                    return confusion.separated_by
    return "repeat the test with more points"

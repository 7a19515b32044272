"""The whole way: declared model, scan, explanations, rules, verdict."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from threadpoolctl import threadpool_limits

from statorhom.diagnose.coupons.body_approach import BODY
from statorhom.diagnose.evidence.decision import (
    AS_IT_SHOULD,
    NEAR_RIVAL,
    Evidence,
    Verdict,
    decide,
    least_over_nothing,
    others,
    within_bounds,
)
from statorhom.diagnose.evidence.free_discrepancy import discrepancy_evidence
from statorhom.diagnose.evidence.gross_rows import without_gross_rows
from statorhom.diagnose.evidence.held_out import HeldOut
from statorhom.diagnose.evidence.held_out_lines import unseen_modes
from statorhom.diagnose.evidence.held_out_name import held_out_names, renames_alone
from statorhom.diagnose.evidence.passed_rules import rule_rows
from statorhom.diagnose.evidence.resampling import stability
from statorhom.diagnose.evidence.shared_part import shared_part
from statorhom.diagnose.evidence.simpler import by_criterion, simpler_fits
from statorhom.diagnose.fits.absence import differs_from_absence
from statorhom.diagnose.fits.baseline import Baseline
from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    WELL,
    Explanation,
    effect_evidence,
    effects_over,
    nothing,
)
from statorhom.diagnose.located.place_rows import summaries
from statorhom.diagnose.located.scan import Scan
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.mismatch import mismatch
from statorhom.diagnose.next_measurement.choice import Choice
from statorhom.diagnose.processes.one_line_errors import one_line_errors
from statorhom.diagnose.processes.side_by_side import processes
from statorhom.diagnose.report_rows import (
    as_declared,
    constant_rows,
    effect_results,
    feature_rows,
    frequency_errors,
)
from statorhom.diagnose.searches.alone import without_idle_partners
from statorhom.diagnose.searches.approach import RING, Approach
from statorhom.diagnose.searches.deeper import in_its_deepest_valley
from statorhom.diagnose.searches.hidden_materials import beside_hidden_materials
from statorhom.diagnose.searches.leading_effects import Leading, leading_effects
from statorhom.diagnose.searches.other_places import at_their_best_places
from statorhom.diagnose.searches.second_effects import confirmed_pairs
from statorhom.diagnose.searches.sharper import BEHIND
from statorhom.geometry.tested_object import ObjectGeometry, RingGeometry
from statorhom.identify.processes.announce import Announce, silent
from statorhom.identify.stages.settings import Settings
from statorhom.physics.declared import DeclaredEffect
from statorhom.physics.library import all_candidates, library
from statorhom.results.diagnosis import (
    Alternative,
    Details,
    Diagnosis,
    EffectResult,
    FitErrors,
    HeldOutErrors,
    ScanRow,
    SimplerRow,
)
from statorhom.study.study import StudyFiles

COMPARED = 4  # explanations that resamplings compare
LEAST_PROBABILITY = 0.005
ALTERNATIVES = 2  # that an ambiguous answer names at least


@dataclass(frozen=True, eq=False)
class Found:
    """A verdict and what it rests on; `part` is what all explanations of an ambiguous one concern."""

    verdict: Verdict
    best: Explanation
    explanations: tuple[Explanation, ...]
    scan: Scan
    evidence: Evidence
    base: Baseline
    part: tuple[str, ...]


def diagnose(
    files: StudyFiles,
    geometry: ObjectGeometry,
    tests: Mapping[str, MeasuredTest],
    settings: Settings,
    announce: Announce = silent,
) -> tuple[Diagnosis, Details, tuple[DeclaredEffect, ...]]:
    """Diagnose a study whose recordings have become tables; named effects come as a study would declare them.

    Raises
    ------
    StatorhomError
        If files, masses or tests do not allow it.
    """
    began = time.perf_counter()
    with (
        threadpool_limits(limits=1, user_api="blas"),
        one_line_errors(str(files.path)),
        processes(settings.jobs),
    ):
        approach = RING if isinstance(geometry, RingGeometry) else BODY
        found = _find(approach, files, geometry, tests, settings, announce)
        undecided = found.verdict == "ambiguous"
        choice = (
            approach.next_measurement(found.best, others(found.best, found.explanations))
            if undecided
            else Choice()
        )
        diagnosis = _diagnosis(approach, files, found, choice)
        details = _details(approach, files, found, choice, time.perf_counter() - began)
        named = as_declared(found.best, approach.located) if found.verdict == "named" else ()
    return diagnosis, details, named


def _find(
    approach: Approach,
    files: StudyFiles,
    geometry: ObjectGeometry,
    tests: Mapping[str, MeasuredTest],
    settings: Settings,
    announce: Announce,
) -> Found:
    progress = announce("declared model", 1)
    base = approach.baseline(files, geometry, tests, settings)
    progress(1)
    candidates = all_candidates(files)
    counts = dict(Counter(c.effect for c in candidates))
    progress = announce("explanations", 1)
    leading = leading_effects(approach, base, candidates, counts, settings.seed)
    found, confirmed = list(leading.found), True
    if leading.misfit_is_real:
        if found and _is_open_to_pairs(leading):
            found, confirmed = _with_pairs(approach, leading, counts, settings.seed)
        found = without_gross_rows(leading.base.free, found, counts)
        found = without_idle_partners(at_their_best_places(found, settings.seed))
        found = in_its_deepest_valley(found, settings.seed)
    progress(1)
    none = nothing(leading.base.refit)
    best = found[0] if found else none
    over = effects_over(none, best, found)
    if found and not leading.by_chance(best) and over > least_over_nothing(none.adequacy):
        # reported numbers come from the own model of what may be named, comparisons from the common one
        best = replace(approach.final(best), log_evidence=best.log_evidence, compared=best.compared)
    evidence = _evidence(leading, best, none, found, over, settings.seed)
    evidence = replace(evidence, confirmed=confirmed or not best.is_pair)
    verdict = decide(evidence)
    part = shared_part(evidence, found, none, settings.seed) if verdict == "ambiguous" else ()
    return Found(verdict, best, tuple(found), leading.scan, evidence, leading.base, part)


def _with_pairs(
    approach: Approach, leading: Leading, counts: dict[str, int], seed: int
) -> tuple[list[Explanation], bool]:
    """Single effects and pairs, the best first, and whether unseen modes confirm a pair that leads."""
    found = list(leading.found)
    alone = _stands_alone(found)
    if alone:
        found = approach.refined(found, leading.base.valleys, counts)
    hidden, confirmed = beside_hidden_materials(leading, found[0], counts, seed)
    if hidden and hidden[0].adequacy_but_one > ADEQUATE:
        # a model of its own would not bring any single effect so far
        return _instead(found, hidden), confirmed
    if not alone and _is_open(found):
        found = approach.refined(found, leading.base.valleys, counts)
    pairs, confirmed = confirmed_pairs(leading, found[0], counts, seed)
    return _instead(found, pairs), confirmed


def _is_open_to_pairs(leading: Leading) -> bool:
    """Whether a second effect, or a model of its own, may lead by as much as is asked for.

    Beside a declared model that misses nothing by more than chance, what does not lead at all does not.
    """
    none = nothing(leading.base.refit)
    return none.adequacy <= AS_IT_SHOULD or leading.found[0].log_evidence > none.log_evidence


def _stands_alone(found: Sequence[Explanation]) -> bool:
    """Whether what leads is so far ahead that it comes first: in a model of its own it may explain everything."""
    first, rest = found[0], others(found[0], found)
    return first.adequacy_but_one < WELL and all(e.log_evidence < first.log_evidence - BEHIND for e in rest)


def _instead(found: Sequence[Explanation], better: Sequence[Explanation]) -> list[Explanation]:
    """Better explanations, and those that they do not stand for."""
    labels = {e.label for e in better}
    return [*better, *(e for e in found if e.label not in labels)]


def _is_open(found: Sequence[Explanation]) -> bool:
    """Whether models of their own may change what leads.

    A misfit that is hardly one of noise may be a side valley; near rivals are compared where each is at its best.
    """
    first, rest = found[0], others(found[0], found)
    return first.adequacy_but_one < WELL or (
        bool(rest) and rest[0].log_evidence > first.log_evidence - NEAR_RIVAL
    )


def _evidence(
    leading: Leading,
    best: Explanation,
    none: Explanation,
    found: Sequence[Explanation],
    over: float,
    seed: int,
) -> Evidence:
    rest, totals = others(best, found), effect_evidence(found)
    own = over + none.log_evidence
    next_best = max((totals[e.effects] for e in rest), default=-np.inf)
    unseen: HeldOut | None = None
    if best.candidates and over > 0:
        unseen = (held_out_names if renames_alone(best) else unseen_modes)(leading.base.refit, best)
    # compared in the model that all share: the best one's own basis is not its rivals'
    common = found[0] if found else best
    return Evidence(
        p_value=leading.chance(best),
        unpaired=leading.unpaired,
        over_nothing=over,
        over_others=float(own - next_best) if np.isfinite(next_best) else float("inf"),
        over_discrepancy=own - discrepancy_evidence(leading.base.refit),
        held_out=unseen,
        adequacy=best.adequacy_but_one,
        chance_of_rows=best.chance_of_rows,
        nothing_adequacy=none.adequacy,
        nothing_but_one=none.adequacy_but_one,
        within=within_bounds(best) and differs_from_absence(best),
        stability=stability([common, none, *rest[: COMPARED - 2]], seed),
    )


def _diagnosis(approach: Approach, files: StudyFiles, found: Found, choice: Choice) -> Diagnosis:
    base, best = found.base.refit, found.best
    chances, own = _probabilities(found), "+".join(best.effects)
    named = found.verdict == "named"
    after = best.refit if found.verdict in ("named", "ambiguous") else base
    unseen = found.evidence.held_out
    rest = [Alternative(effect=e, probability=p) for e, p in chances.items() if e != own or not named]
    ambiguous = found.verdict == "ambiguous"
    several = [a for a in rest if a.effect != "none"]
    # the second one of an ambiguous answer may win in resamplings alone
    shown = [
        a
        for i, a in enumerate(several)
        if a.probability >= LEAST_PROBABILITY or (ambiguous and i < ALTERNATIVES)
    ]
    return Diagnosis(
        schema=1,
        study=files.study.name,
        verdict=found.verdict,
        effects=effect_results(best, chances.get(own, 0.0), approach.located) if named else (),
        alternatives=tuple(shown) if found.verdict != "none" else (),
        mismatch=mismatch(base, found.part) if found.verdict != "none" else None,
        fit=FitErrors(
            before=frequency_errors(base, after),
            after=frequency_errors(after, base),
            held_out=None
            if unseen is None or found.verdict == "none"
            else HeldOutErrors(
                what=unseen.what,
                before_rms_percent=unseen.before_rms,
                after_rms_percent=unseen.after_rms,
            ),
        ),
        next_measurement=choice.best,
    )


def _probabilities(found: Found) -> dict[str, float]:
    """Of every combination of effects and of nothing, equally likely beforehand."""
    totals = {"+".join(e): v for e, v in effect_evidence(found.explanations).items()}
    totals["none"] = found.base.refit.log_evidence
    top = max(totals.values())
    weights = {e: float(np.exp(v - top)) for e, v in totals.items()}
    whole = sum(weights.values())
    return dict(sorted(((e, w / whole) for e, w in weights.items()), key=lambda p: -p[1]))


def _details(approach: Approach, files: StudyFiles, found: Found, choice: Choice, seconds: float) -> Details:
    best, e = found.best, found.evidence
    effect = library()[best.effects[0]] if best.effects else None
    words = None if effect is None else effect.words(files)
    seen: dict[str, ScanRow] = {}
    for s in found.scan.signatures:
        c = s.candidate
        seen.setdefault(c.label, ScanRow(effect=c.effect, label=c.label, gain=s.gain))
    return Details(
        p_value=e.p_value,
        over_nothing=e.over_nothing,
        over_others=min(e.over_others, 1e6),
        over_discrepancy=e.over_discrepancy,
        adequacy=e.adequacy,
        nothing_adequacy=e.nothing_adequacy,
        stability=e.stability,
        summary=None if words is None else words.summary,
        citation=None if effect is None else effect.citation,
        confusions=() if words is None else tuple((c.effect, c.separated_by) for c in words.confused_with),
        features=feature_rows(found.base.refit, best.refit),
        scan=tuple(seen.values())[:20],
        constants=constant_rows(found.base.refit, best.refit),
        evidence=tuple((x.candidates[0].label, x.log_evidence) for x in found.explanations),
        seconds=seconds,
        simpler=_simpler(found),
        second_confirmed=e.confirmed if best.is_pair else None,
        rules=rule_rows(e, pair=best.is_pair),
        options=choice.options,
        possible=_possible(approach, found) if found.verdict == "ambiguous" else (),
        part=found.part,
        **approach.pictures(files, found.base.refit, best, found.verdict == "named", found.verdict != "none"),
        summaries=summaries(tuple(dict.fromkeys(n for x in found.explanations for n in x.effects)), files),
    )


def _possible(approach: Approach, found: Found) -> tuple[tuple[EffectResult, ...], ...]:
    """Where and how large what is left of an ambiguous answer would be."""
    chances = _probabilities(found)
    rivals = others(found.best, found.explanations)
    likely = [e for e in rivals if chances["+".join(e.effects)] >= LEAST_PROBABILITY]
    left = (found.best, *(likely or rivals[: ALTERNATIVES - 1]))
    return tuple(effect_results(e, chances["+".join(e.effects)], approach.located) for e in left)


def _simpler(found: Found) -> SimplerRow:
    fits = simpler_fits(found.base.refit)
    rows = by_criterion(found.scan, found.base.free)
    return SimplerRow(
        modulus_alone_held_out_percent=fits.modulus_alone,
        all_constants_held_out_percent=fits.all_constants,
        by_criterion=tuple(ScanRow(effect=e, label=label, gain=gain) for e, label, gain in rows),
    )

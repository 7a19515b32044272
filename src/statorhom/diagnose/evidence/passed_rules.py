"""Which rules an answer passed, by how much, and what was asked: for those who want to know why it is what it is."""

from __future__ import annotations

from statorhom.diagnose.evidence.decision import (
    FAR_OVER_NOTHING,
    FAR_OVER_OTHERS,
    MAX_T_P,
    OVER_ADEQUATE,
    OVER_OTHERS,
    STABLE,
    Evidence,
)
from statorhom.diagnose.fits.explanations import ADEQUATE
from statorhom.results.diagnosis import RuleRow


def rule_rows(e: Evidence, *, pair: bool) -> tuple[RuleRow, ...]:
    """All rules of `statorhom.diagnose.evidence.decision.decide`; an effect is named where none that asks fails.

    Parameters
    ----------
    e : what the rules look at.
    pair : whether the best explanation has two effects, the second of which has to be confirmed.
    """
    far = _needs_more_evidence(e)
    nothing, others, discrepancy = _asked(e, far=far)
    rows = [
        RuleRow(rule="chance", found=e.p_value, needed=MAX_T_P, passed=not e.by_chance),
        RuleRow(rule="nothing", found=e.over_nothing, needed=nothing, passed=e.over_nothing > nothing),
        RuleRow(rule="others", found=min(e.over_others, 1e6), needed=others, passed=e.over_others > others),
        RuleRow(
            rule="discrepancy",
            found=e.over_discrepancy,
            needed=discrepancy,
            passed=e.over_discrepancy > discrepancy,
        ),
        _held_out(e, far=far),
        RuleRow(rule="adequacy", found=e.adequacy, needed=ADEQUATE, passed=e.adequacy > ADEQUATE),
        RuleRow(rule="within", found=None, needed=None, passed=e.within),
        RuleRow(rule="stability", found=e.stability, needed=STABLE, passed=e.stability >= STABLE),
    ]
    if pair:
        rows.insert(5, RuleRow(rule="confirmed", found=None, needed=None, passed=e.confirmed))
    return tuple(rows)


def _asked(e: Evidence, *, far: bool) -> tuple[float, float, float]:
    """Log evidence over nothing, over every rival and over something in no library."""
    if not far:
        return e.least_over_nothing, OVER_OTHERS, e.least_over_discrepancy
    if e.held_out is not None and e.held_out.improves:
        return OVER_ADEQUATE, FAR_OVER_OTHERS, max(FAR_OVER_OTHERS, e.least_over_discrepancy)
    return FAR_OVER_NOTHING, FAR_OVER_OTHERS, FAR_OVER_NOTHING


def _needs_more_evidence(e: Evidence) -> bool:
    """Whether the held-out modes are predicted better but may be so by chance, or by little."""
    unseen = e.held_out
    if unseen is None or e.predicts or unseen.of_lines:
        return False
    return unseen.improves or (e.beyond_doubt and e.over_others > FAR_OVER_OTHERS)


def _held_out(e: Evidence, *, far: bool) -> RuleRow:
    unseen = e.held_out
    if unseen is None or unseen.before_rms <= 0.0:
        return RuleRow(rule="held_out", found=None, needed=None, passed=None)
    # errors that are no more than noise tell nothing: where all else is far behind, nothing is asked of them
    blind = far and unseen.after_rms >= unseen.before_rms
    better = not blind and (far or (unseen.falls and not unseen.worsens))
    return RuleRow(
        rule="held_out",
        found=1 - unseen.after_rms / unseen.before_rms,
        # where all else is far behind, it is enough that nothing contradicts
        needed=unseen.least_fall if unseen.improves or not far else None if blind else 0.0,
        # too few modes show anything: they cannot contradict, nor can they confirm
        passed=True if better else None if blind or e.undecided else False,
    )

"""How sure the answer is: probabilities, the tests that it had to pass, and what looks alike."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.diagnosis.words import effect_words
from statorhom.report.document import (
    Block,
    Column,
    Definitions,
    Paragraph,
    Picture,
    Row,
    Section,
    Span,
    Table,
    Text,
    muted,
    strong,
    text,
    warning,
)
from statorhom.report.figures.canvas import FONT_PT, PRIOR, SIMULATED, new_figure, safe, svg, tidy
from statorhom.results.diagnosis import Details, Diagnosis, RuleRow

MOST = 8
STRICT = (
    "An effect is named only if it passes every one of these tests. They are strict on purpose: a wrong name costs "
    "more than an open question."
)
WORDS = {
    "chance": "Its trace in the data is no accident",
    "nothing": "The data prefer it to “nothing”",
    "others": "… and to every other effect",
    "discrepancy": "… and to something else that moves each mode by chance",
    "held_out": "Modes that it was not fitted to are predicted better",
    "confirmed": "… and better with both effects than with one",
    "adequacy": "What remains is no more than chance",
    "within": "Its size is possible, not at an end of what was searched, and not one that may as well be none",
    "stability": "Resampled data give the same answer",
}
FAILED = {"confirmed": "too few modes show it"}  # why, where it is no number
ODDS = ("nothing", "others", "discrepancy")  # rules of log evidence


def sure_section(d: Diagnosis, e: Details) -> Section:
    """Fourth section."""
    blocks: list[Block] = []
    chances = [(x.effect, x.probability, True) for x in d.effects[:1]] if len(d.effects) == 1 else []
    if len(d.effects) > 1:
        chances = [("+".join(x.effect for x in d.effects), d.effects[0].probability, True)]
    chances += [(a.effect, a.probability, False) for a in d.alternatives]
    if len(chances) > 1:
        blocks.append(_chances(chances[:MOST]))
    if e.rules:
        blocks += [Paragraph(text(STRICT)), _rules(e.rules, e.nothing_adequacy)]
    if e.confusions and d.verdict in ("named", "ambiguous"):
        items = tuple(
            (text(strong(effect_words(name))), text(f"told apart by: {how}")) for name, how in e.confusions
        )
        blocks.append(Paragraph(text("What looks alike, and what would tell it apart"), "heading"))
        blocks.append(Definitions(items))
    if e.citation and d.verdict == "named":
        blocks.append(Paragraph(text(f"More on the effect: {e.citation}."), "note"))
    return Section("How sure the diagnosis is", tuple(blocks))


def _chances(chances: list[tuple[str, float, bool]]) -> Picture:
    figure = new_figure(140, 12 + 6.5 * len(chances))
    axes = figure.subplots()
    places = range(len(chances))[::-1]
    colours = [SIMULATED if named else PRIOR for _, _, named in chances]
    axes.barh(
        places,
        [100 * p for _, p, _ in chances],
        height=0.62,
        color=colours,
        edgecolor="#8a96a1",
        linewidth=0.5,
    )
    for place, (_, p, _) in zip(places, chances, strict=True):
        said = "< 1 %" if p < 0.005 else "> 99 %" if p > 0.995 else f"{100 * p:.0f} %"
        axes.text(min(100 * p, 100) + 1, place, said, va="center", fontsize=FONT_PT - 0.5)
    axes.set_yticks(list(places), [safe(effect_words(e)) for e, _, _ in chances])
    axes.set_xlim(0, 112)
    axes.set_xticks(range(0, 101, 25))
    axes.set_xlabel("probability (%), all effects thought equally likely beforehand")
    tidy(axes, "x")
    return Picture(svg(figure), "svg", 140.0, "probabilities of the explanations")


def _rules(rules: Sequence[RuleRow], nothing_adequacy: float) -> Table:
    head = (
        Column(text("test")),
        Column(text("found"), "right"),
        Column(text("needed"), "right"),
        Column(text("passed"), "center"),
    )
    body = tuple(
        Row((text(WORDS[r.rule]), text(_found(r)), text(_needed(r)), _passed(r.passed))) for r in rules
    )
    alone = _chance(nothing_adequacy)
    caption = f"For the explanation that fits best. Chance of the misfit, if the declared model were right: {alone}."
    return Table(head, body, text(caption))


def _found(r: RuleRow) -> str:
    value = r.found
    if value is None:
        return "–" if r.passed is None else "yes" if r.passed else FAILED.get(r.rule, "no")
    if r.rule == "held_out":
        return f"error {100 * value:.0f} % smaller" if value >= 0 else "error larger"
    if r.rule == "stability":
        return f"{100 * value:.0f} %"
    return f"odds {_odds(value)}" if r.rule in ODDS else f"chance {_chance(value)}"


def _needed(r: RuleRow) -> str:
    value = r.needed
    if value is None:
        return "–" if r.passed is None else "yes"
    if r.rule == "held_out":
        return f"{100 * value:.0f} % smaller" if value > 0 else "not larger"
    if r.rule == "stability":
        return f"at least {100 * value:.0f} %"
    if r.rule in ODDS:
        return f"over {_odds(value)}"
    return f"{'below' if r.rule == 'chance' else 'above'} {_chance(value)}"


def _passed(ok: bool | None) -> Text:
    if ok is None:
        return text(muted("not tested"))
    return text(Span("yes", "good")) if ok else text(warning("no"))


def _chance(p: float) -> str:
    if p <= 1e-9:
        return "below one in a billion"
    return f"{100 * p:.0f} %" if p >= 0.095 else f"1 in {_count(1 / p)}"


def _odds(log: float) -> str:
    if log > 20:
        return "over a billion : 1"
    if log < 0:
        return f"1 : {_count(2.718281828 ** min(-log, 20.0))}" if log > -20 else "below 1 : a billion"
    return f"{_count(2.718281828**log)} : 1"


def _count(number: float) -> str:
    if number < 10:
        return f"{number:.1f}".removesuffix(".0")
    digits = f"{number:.2g}"
    return f"{float(digits):,.0f}".replace(",", " ")

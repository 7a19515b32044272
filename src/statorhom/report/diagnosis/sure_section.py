"""How sure the answer is: probabilities, the tests that it had to pass, and what looks alike."""

from __future__ import annotations

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
from statorhom.results.diagnosis import Details, Diagnosis

MOST = 8


def sure_section(d: Diagnosis, e: Details) -> Section:
    """Fourth section."""
    blocks: list[Block] = []
    chances = [(x.effect, x.probability, True) for x in d.effects[:1]] if len(d.effects) == 1 else []
    if len(d.effects) > 1:
        chances = [("+".join(x.effect for x in d.effects), d.effects[0].probability, True)]
    chances += [(a.effect, a.probability, False) for a in d.alternatives]
    if len(chances) > 1:
        blocks.append(_chances(chances[:MOST]))
    blocks.append(
        Paragraph(
            text(
                "An effect is named only if it passes every one of these tests. They are strict on purpose: a wrong "
                "name costs more than an open question."
            )
        )
    )
    blocks.append(_rules(d, e))
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


def _rules(d: Diagnosis, e: Details) -> Table:
    fall = _fall(d)
    better = "–" if fall is None else f"error {100 * fall:.0f} % smaller" if fall >= 0 else "error larger"
    rows: list[tuple[str, str, str, bool | None]] = [
        (
            "Its trace in the data is no accident",
            f"chance {_chance(e.p_value)}",
            "below 1 in 100",
            e.p_value < 0.01,
        ),
        (
            "The data prefer it to “nothing”",
            f"odds {_odds(e.over_nothing)}",
            "over 148 : 1",
            e.over_nothing > 5,
        ),
        ("… and to every other effect", f"odds {_odds(e.over_others)}", "over 20 : 1", e.over_others > 3),
        (
            "Modes that it was not fitted to are predicted better",
            better,
            "25 % smaller",
            None if fall is None else fall >= 0.25,
        ),
        (
            "What remains is no more than chance",
            f"chance {_chance(e.adequacy)}",
            "above 1 in 100",
            e.adequacy > 0.01,
        ),
        (
            "Resampled data give the same answer",
            f"{100 * e.stability:.0f} %",
            "at least 80 %",
            e.stability >= 0.8,
        ),
    ]
    if e.over_discrepancy is not None:
        least, needed = (0.0, "over 1 : 1") if e.adequacy > 0.1 else (5.0, "over 148 : 1")
        own = (
            "… and to something else that moves each mode by chance",
            f"odds {_odds(e.over_discrepancy)}",
            needed,
            e.over_discrepancy > least,
        )
        rows.insert(3, own)
    if e.second_confirmed is not None:
        found = "yes" if e.second_confirmed else "too few modes show it"
        rows.insert(-2, ("… and better with both effects than with one", found, "yes", e.second_confirmed))
    head = (
        Column(text("test")),
        Column(text("found"), "right"),
        Column(text("needed"), "right"),
        Column(text("passed"), "center"),
    )
    body = tuple(Row((text(a), text(b), text(c), _passed(ok))) for a, b, c, ok in rows)
    alone = _chance(e.nothing_adequacy)
    caption = f"For the explanation that fits best. Chance of the misfit, if the declared model were right: {alone}."
    return Table(head, body, text(caption))


def _fall(d: Diagnosis) -> float | None:
    """Part by which the error of what was held out falls."""
    h = d.fit.held_out
    return None if h is None or h.before_rms_percent <= 0 else 1 - h.after_rms_percent / h.before_rms_percent


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
        return f"{number:.1f}"
    digits = f"{number:.2g}"
    return f"{float(digits):,.0f}".replace(",", " ")

"""The answer in a few sentences: what is missing, how large, where; or why there is no such answer."""

from __future__ import annotations

from statorhom.report.diagnosis.next_steps import next_steps
from statorhom.report.diagnosis.words import VERDICTS, effect_words, place_words, sizes_words
from statorhom.report.document import Block, Notice, Paragraph, Section, Text, strong, text
from statorhom.results.diagnosis import Details, Diagnosis, EffectResult

MET = 0.01  # chance of a misfit from which on the declared model meets what was measured


def verdict_section(d: Diagnosis, details: Details) -> Section:
    """First section."""
    blocks: list[Block] = [Paragraph(text(strong(VERDICTS[d.verdict])), "lead")]
    blocks.append(Paragraph(_explained(d, details)))
    for effect in d.effects:
        blocks.append(Notice(_title(effect.effect), _lines(effect, details)))
    if d.verdict == "ambiguous":
        blocks.append(Notice("What it may be", tuple(_alternatives(d, details)), "warning"))
    blocks += next_steps(d, details)
    return Section("What the model left out", tuple(blocks))


def _explained(d: Diagnosis, e: Details) -> Text:
    if d.verdict == "none":
        hint = f" The strongest hint, {effect_words(e.scan[0].effect)}, is within chance." if e.scan else ""
        return text(
            "The model as the study declares it was fitted to all tests at once. What is left between measured and "
            "predicted values is no more than measurement and mesh leave uncertain, and no left-out effect that the "
            f"program knows is needed.{hint} An effect too weak to show in these measurements may still be there."
        )
    told = "The model as the study declares it was fitted to all tests at once, and "
    told += (
        "meets them only with constants that are unlikely, or with which it hardly knows its own modes."
        if e.nothing_adequacy > MET
        else "cannot meet them with any constants."
    )
    if d.verdict == "named":
        met = (
            "With the effect below in the model it meets them, also on modes that took no part in finding it."
        )
        return text(f"{told} {met}")
    if d.verdict == "ambiguous":
        return text(f"{told} Several effects would mend it about equally well, so none is named.")
    return text(
        f"{told} No effect in the program’s library passes all the tests below. The constants identified from these "
        "measurements are not to be trusted; “Where the model fails” says what contradicts it."
    )


def _title(effect: str) -> str:
    words = effect_words(effect)
    return words[:1].upper() + words[1:]


def _lines(effect: EffectResult, details: Details) -> tuple[Text, ...]:
    summary = details.summaries.get(effect.effect) or details.summary or effect_words(effect.effect)
    lines = [text(f"What: {summary}."), text(f"Where: {_where(effect)}.")]
    sizes = sizes_words(effect.parameters)
    if sizes:
        lines.append(text("How much: ", strong(sizes), "."))
    lines.append(text(f"How sure: probability {_percent(effect.probability)} among all that was tried."))
    if effect.note:
        lines.append(text(f"Modelled as: {effect.note}."))
    return tuple(lines)


def _where(effect: EffectResult) -> str:
    where = [f"step {effect.stage}"]
    where += [f"test {effect.test}"] if effect.test else []
    where += [effect.region] if effect.region else []
    place = place_words(effect)
    return f"{', '.join(where)}{'; ' + place if place else ''}"


def _alternatives(d: Diagnosis, details: Details) -> list[Text]:
    told = {"+".join(e.effect for e in effects): effects for effects in details.possible}
    lines = (
        [text(strong(f"Whichever it is, it concerns {' and '.join(details.part)}."))] if details.part else []
    )
    for a in d.alternatives:
        lines.append(
            text(
                strong(_title(a.effect)),
                f" (probability {_percent(a.probability)}): {_summary(a.effect, details)}.",
                *(f" {_would_be(effect)}" for effect in told.get(a.effect, ())),
            )
        )
    return lines


def _would_be(effect: EffectResult) -> str:
    """Where and how large, if it is that."""
    sizes = sizes_words(effect.parameters)
    return f"It would be in {_where(effect)}{'; ' + sizes if sizes else ''}."


def _summary(effect: str, details: Details) -> str:
    if effect == "none":
        return "the declared model is right, and the misfit an accident"
    parts = [details.summaries.get(name, effect_words(name)) for name in effect.split("+")]
    return "; and ".join(parts)


def _percent(probability: float) -> str:
    if probability > 0.995:
        return "over 99 %"
    return "under 1 %" if probability < 0.005 else f"{100 * probability:.0f} %"

"""The whole study in a few sentences with figures."""

from __future__ import annotations

import math
from collections.abc import Sequence

from statorhom.report.context import Step, coupon_of
from statorhom.report.document import (
    Block,
    Fold,
    Notice,
    Paragraph,
    Points,
    Section,
    Text,
    joined,
    strong,
    text,
)
from statorhom.report.figures.mode_comparison import error_half_width
from statorhom.report.wording import (
    WING,
    constant_interval,
    constant_symbol,
    constant_value,
    number,
    plural,
    step_words,
)
from statorhom.results import Constant, ModeResult

_WARNINGS_SHOWN = 8


def summary(steps: Sequence[Step]) -> Section:
    """First section: what was found, how well it fits, what stays unknown, what to look at."""
    blocks: list[Block] = [Paragraph(_opening(steps), "lead")]
    if steps:
        blocks.append(Points(tuple(_step(step) for step in steps)))
    warnings = [text(strong(f"{s.result.name}: "), w) for s in steps for w in s.result.warnings]
    if warnings:
        blocks += _warnings(warnings)
    return Section("In short", tuple(blocks))


def _opening(steps: Sequence[Step]) -> Text:
    if not steps:
        return text("No fabrication step has been fitted yet; this report is empty until one is.")
    constants = [c for step in steps for _, _, c in step.new_constants]
    known = sum(c.status == "identified" for c in constants)
    measured = [m for s in steps for m in s.result.modes if m.measured_hz is not None]
    fitted = sum(m.role == "fitted" for m in measured)
    return text(
        _subject(steps),
        f"{plural(len(measured), 'measured mode').capitalize()} were compared with simulated ones; {number(fitted)} "
        f"of them decided about the constants, the others test them. Of "
        f"{plural(len(constants), 'elastic constant')}, ",
        strong(f"{number(known) if known else 'none'} could be determined by the measurements"),
        "; the others were prescribed, or the measurements leave them open."
        if known < len(constants)
        else ".",
    )


def _subject(steps: Sequence[Step]) -> str:
    coupon = coupon_of(steps)
    if coupon is not None:
        return (
            f"This report describes how {'the materials' if coupon == WING else 'the material'} of a {coupon} "
            f"{'were' if coupon == WING else 'was'} found from its weight and its measured modes. "
        )
    return (
        "This report describes how the materials of a stator were found from its weight and its measured "
        f"modes, step by step of its fabrication. {plural(len(steps), 'step').capitalize()} were weighed. "
    )


def _step(step: Step) -> Text:
    result = step.result
    sentences: list[Text] = [_masses(step), *_fit(step), *_constants(step), *_unmatched(step)]
    return text(strong(f"{result.name}"), f" ({step_words(result.kind)}). ", joined(sentences, " "))


def _masses(step: Step) -> Text:
    densities = [
        text(
            f"{name} {region.density_kg_m3:.0f}",
            f" ± {region.density_sd_kg_m3:.0f}" if region.density_sd_kg_m3 else "",
            " kg/m³",
        )
        for name, region in step.new_regions.items()
        if region.density_kg_m3 is not None
    ]
    weight = f"Weight {step.result.mass_kg:.3f} kg"
    return text(weight, "; density: ", joined(densities), ".") if densities else text(f"{weight}.")


def _fit(step: Step) -> list[Text]:
    if not step.result.modes:
        return [text("No modes were measured: only the weight counts.")]
    groups = (("fitted", "fitted"), ("held_out", "not used in the fit predicted"))
    return [
        _errors(found, words)
        for role, words in groups
        if (found := [m for m in step.paired if m.role == role])
    ]


def _errors(modes: Sequence[ModeResult], words: str) -> Text:
    head = f"{plural(len(modes), 'mode').capitalize()} {words} with an "
    if len(modes) == 1:
        return text(head, "error of ", strong(f"{_largest(modes):.2f} %"), _within(modes), ".")
    rms = strong(f"{_rms(modes):.2f} %")
    return text(head, "rms error of ", rms, f", at most {_largest(modes):.2f} %", _within(modes), ".")


def _within(modes: Sequence[ModeResult]) -> str:
    known = [(m, h) for m in modes if (h := error_half_width(m)) is not None]
    if not known:
        return ""
    inside = sum(abs(m.error_percent or 0.0) <= h for m, h in known)
    return f" ({inside} of {len(known)} within their 90 % uncertainty)"


def _constants(step: Step) -> list[Text]:
    heads = (
        ("identified", "Determined by the data, with 90 % interval: "),
        ("prior_dominated", "Not determined, with what remains possible: "),
        ("fixed", "Prescribed: "),
    )
    sentences = []
    for status, head in heads:
        regions = [
            text(f"{name} ", joined(found))
            for name, region in step.new_regions.items()
            if (found := [_constant(key, c) for key, c in region.engineering.items() if c.status == status])
        ]
        if regions:
            sentences.append(text(head, joined(regions, "; "), "."))
    return sentences


def _constant(key: str, c: Constant) -> Text:
    symbol = constant_symbol(key)
    if c.status == "fixed":
        return text(symbol, f" = {constant_value(key, c.value)}")
    return text(
        symbol, f" = {constant_value(key, c.value, c.ci90)} ({constant_interval(key, c.value, c.ci90)})"
    )


def _unmatched(step: Step) -> list[Text]:
    alone = sum(m.measured_hz is not None and m.simulated_hz is None for m in step.result.modes)
    if not alone:
        return []
    noun = plural(alone, "measured mode").capitalize()
    return [text(f"{noun} found no simulated partner.")]


def _rms(modes: Sequence[ModeResult]) -> float:
    return math.sqrt(sum((m.error_percent or 0.0) ** 2 for m in modes) / len(modes))


def _largest(modes: Sequence[ModeResult]) -> float:
    return max(abs(m.error_percent or 0.0) for m in modes)


def _warnings(warnings: list[Text]) -> list[Block]:
    first = tuple(warnings[:_WARNINGS_SHOWN])
    blocks: list[Block] = [Notice("Look at these first", first, "warning")]
    if len(warnings) > len(first):
        rest = tuple(warnings[_WARNINGS_SHOWN:])
        blocks.append(Fold(text(f"{len(rest)} more warnings"), (Points(rest),)))
    return blocks

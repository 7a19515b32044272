"""Where the model and the measurements differ: step, test, modes, and the place on the unrolled body."""

from __future__ import annotations

import numpy as np

from statorhom.report.diagnosis.place_figure import place_figure
from statorhom.report.diagnosis.plan_figure import plan_figure
from statorhom.report.diagnosis.words import effect_words, mode_words
from statorhom.report.document import Block, Column, Paragraph, Row, Section, Table, text
from statorhom.results.diagnosis import Details, Diagnosis, MapRow


def where_section(d: Diagnosis, details: Details) -> Section:
    """Second section."""
    blocks: list[Block] = []
    if d.mismatch is not None:
        m = d.mismatch
        modes = ", ".join(mode_words(mode) for mode in m.modes)
        concerned = f" Modes concerned: {modes}." if modes else ""
        statement = m.statement.removeprefix(f"{m.test}: ").replace(" -", " −")
        blocks.append(Paragraph(text(f"Step {m.stage}, test {m.test}: {statement}.{concerned}"), "lead"))
        blocks.append(
            Paragraph(
                text(
                    "A mode is told by its row in the table."
                    if all(len(mode) == 1 for mode in m.modes)
                    else "A mode is named (r, n): r waves around it, n places along its axis that stand still."
                ),
                "note",
            )
        )
    row = _map(d, details)
    if details.plan is not None:
        picture = plan_figure(d.effects, details.plan)
    else:
        angles = details.angles if d.verdict != "none" else ()
        picture = place_figure(d.effects, row, angles, details.machine)
    if picture is not None:
        blocks.append(picture)
    blocks += _opposite(details)
    if row is not None:
        blocks.append(_regions(row))
    if picture is None:
        blocks.append(Paragraph(text(_no_picture(d, details))))
    return Section("Where the model fails", tuple(blocks))


def _map(d: Diagnosis, details: Details) -> MapRow | None:
    """The map of the stage that is named, else of the worst test, else the first."""
    wanted = [e.stage for e in d.effects] + ([d.mismatch.stage] if d.mismatch else [])
    for stage in wanted:
        for row in details.maps:
            if row.stage == stage:
                return row
    return details.maps[0] if details.maps else None


def _opposite(details: Details) -> list[Block]:
    found: list[Block] = []
    for row in details.opposite:
        kept, excluded = (
            ", ".join(f"{a:.0f}°" for a in angles) for angles in (row.kept_deg, row.excluded_deg)
        )
        name = effect_words(row.effect)
        leave = f"The split modes alone leave {kept}"
        if row.excluded_deg:
            said = f"{leave} and {excluded} for the {name}; other waves in the measured shapes exclude {excluded}."
        elif row.mean_log_ratio is None:
            said = f"{leave} for the {name}; no measured shape tells these apart."
        else:
            said = f"{leave} for the {name}; the measured shapes do not tell these apart safely."
        found.append(Paragraph(text(said)))
    return found


def _regions(row: MapRow) -> Table:
    """Share of the contradiction by region, and in the quarter of the places where it is largest."""
    total = np.sum([np.array(part) for part in row.regions.values()], axis=0)
    order = np.sort(total.ravel())[::-1]
    worst = float(order[: max(1, len(order) // 4)].sum() / max(float(total.sum()), 1e-300))
    rows = [
        Row((text(region), text(f"{100 * float(np.sum(part)):.0f} %")))
        for region, part in sorted(row.regions.items(), key=lambda item: -float(np.sum(item[1])))
    ]
    caption = (
        f"Share of the contradiction between measured motion and model, test {row.test}. The quarter of it "
        f"where it is largest holds {100 * worst:.0f} % of it; spread evenly it would be 25 %."
    )
    return Table((Column(text("region")), Column(text("share"), "right")), tuple(rows), text(caption))


def _no_picture(d: Diagnosis, details: Details) -> str:
    if d.verdict == "none":
        return "There is no place to show: no test contradicts the model."
    seen = {f.kind for f in details.features}
    if details.plan is not None:
        return "What is missing has no place on the body, or these measurements do not tell it."
    if "split" in seen or d.effects:
        return "What is missing has no place around the axis, or these measurements do not tell it."
    return (
        "Tables of frequencies alone do not tell a place around the axis. Recordings at several points around the "
        "circumference (FRFs) would."
    )

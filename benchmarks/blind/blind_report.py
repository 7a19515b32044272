"""The benchmark's table (CSV and Markdown) and plot."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from blind_baselines import comparison, median_ratios
from blind_kept import write_rows
from blind_score import DETECTABLE, interval, median_interval, medians, proportions
from matplotlib.axes import Axes

from statorhom.study.atomic import write_text

BINS = (0.0, 2.0, 4.0, 8.0, 16.0, 32.0, np.inf)
TARGETS: Mapping[str, str] = {
    "effect right, snr >= 4": "≥ 0.85",
    "class right, snr >= 4": "≥ 0.95",
    "named on nothing missing": "≤ 0.05",
    "named outside the library": "≤ 0.10",
    "median angle error (deg)": "≤ 10",
    "median magnitude error": "≤ 0.20",
    "90 % intervals cover": "0.85 … 0.95",
    "median held-out error, after over before": "≤ 0.5",
    "median seconds, tables": "≤ 30",
    "median seconds, FRFs": "≤ 120",
    "no answer": "0",
}
GROUPS: Mapping[str, str] = {
    "single": "one effect",
    "double": "two effects",
    "ambiguous": "look alike",
    "outside": "outside\nlibrary",
    "nothing": "nothing",
}
ANSWERS: Mapping[str, str] = {
    "named, right": "tab:green",
    "named, wrong": "tab:red",
    "ambiguous": "tab:olive",
    "unknown": "tab:blue",
    "none": "lightgrey",
    "failed": "black",
}


def write_report(rows: Sequence[Mapping[str, Any]], folder: Path, listed: int) -> str:
    """Write cases.csv, blind.md and blind.png; the Markdown.

    Parameters
    ----------
    listed : how many cases were to be run.
    """
    write_rows(rows, folder)
    text = markdown(rows, listed)
    write_text(folder / "blind.md", text)
    if len(rows):
        plot(rows, folder / "blind.png")
    return text


def markdown(rows: Sequence[Mapping[str, Any]], listed: int) -> str:
    """Figures against targets, answers by signal-to-noise, methods side by side, and failures by kind."""
    commits = Counter(r.get("commit") or "unknown" for r in rows)
    made = ", ".join(f"{commit} ({n})" for commit, n in commits.most_common())
    lines = [f"{len(rows)} of {listed} cases, diagnosed at commit {made or '-'}.", ""]
    lines += ["| figure | measured | 95 % interval | cases | target |", "|---|---|---|---|---|"]
    lines += [
        _line(name, share(k, n), span(interval(k, n), n), f"{k} of {n}")
        for name, (k, n) in proportions(rows).items()
    ]
    lines += [
        _line(
            name,
            f"{np.median(values):.3g}" if values else "-",
            span(median_interval(values), len(values)) if values else "-",
            str(len(values)),
        )
        for name, values in medians(rows).items()
    ]
    lines += [
        "",
        "| single effects, projected signal-to-noise | cases | effect right | class right | none said |",
    ]
    lines += ["|---|---|---|---|---|", *(_bin_line(rows, a, b) for a, b in pairwise(BINS))]
    lines += ["", "| single effect, snr >= 4 | cases | effect right | class right | said instead |"]
    lines += ["|---|---|---|---|---|", *_effect_lines(rows)]
    lines += [
        "",
        "| method | effect right, snr >= 4 | named on nothing | named outside "
        "| held-out error over that of refitting all constants |",
        "|---|---|---|---|---|",
    ]
    ratios = median_ratios(rows, DETECTABLE)
    for method, shares in comparison(rows, DETECTABLE).items():
        cells = [f"{share(k, n)} ({k} of {n})" for k, n in shares.values()]
        ratio = "-" if np.isnan(ratios[method]) else f"{ratios[method]:.2f}"
        lines.append(f"| {method} | " + " | ".join([*cells, ratio]) + " |")
    lines += ["", "| failure | truth (group, data) | answer | cases |", "|---|---|---|---|"]
    lines += [
        f"| {kind} | {true} | {said} | {n} |" for (kind, true, said), n in sorted(_failures(rows).items())
    ]
    return "\n".join([*lines, ""])


def _line(name: str, value: str, ends: str, cases: str) -> str:
    return f"| {name} | {value} | {ends} | {cases} | {TARGETS.get(name, '')} |"


def share(right: int, count: int) -> str:
    """A share, or a dash where nothing was counted."""
    return f"{right / count:.2f}" if count else "-"


def span(ends: tuple[float, float], count: int) -> str:
    """An interval, or a dash where nothing was counted."""
    return f"{ends[0]:.3g} … {ends[1]:.3g}" if count else "-"


def _bin_line(rows: Sequence[Mapping[str, Any]], low: float, high: float) -> str:
    inside = [r for r in rows if r["group"] == "single" and low <= r["snr"] < high]
    shares = [
        np.mean([bool(r.get(k)) for r in inside]) if inside else np.nan
        for k in ("effect_right", "class_right")
    ]
    silent = np.mean([r.get("verdict") == "none" for r in inside]) if inside else np.nan
    ends = f"{low:g} … {high:g}" if np.isfinite(high) else f"over {low:g}"
    return f"| {ends} | {len(inside)} | {shares[0]:.2f} | {shares[1]:.2f} | {silent:.2f} |"


def _effect_lines(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """One line per concealed effect."""
    single = [r for r in rows if r["group"] == "single" and r["snr"] >= DETECTABLE]
    lines = []
    for effect in sorted({r["truth"] for r in single}):
        own = [r for r in single if r["truth"] == effect]
        wrong = Counter(_said(r) for r in own if not r.get("effect_right"))
        cells = [share(sum(bool(r.get(k)) for r in own), len(own)) for k in ("effect_right", "class_right")]
        instead = ", ".join(f"{said} ({n})" for said, n in wrong.most_common()) or "-"
        lines.append(f"| {effect} | {len(own)} | {' | '.join(cells)} | {instead} |")
    return lines


def _said(row: Mapping[str, Any]) -> str:
    """What was answered, in a few words."""
    if row["verdict"] == "failed":
        return f"no answer: {row.get('fault') or '-'}"
    named = row.get("named")
    if named:
        return str(named)
    best = row.get("best")
    return f"{row['verdict']} (of {best})" if best else str(row["verdict"])


def _kind(row: Mapping[str, Any]) -> str | None:
    """Kind of a failure, None where the answer is right; of effects that leave next to nothing, silence is right."""
    verdict = row["verdict"]
    if verdict == "failed":
        return "no answer"
    if row.get("verdict_right") or (row["snr"] < DETECTABLE and verdict == "none"):
        return None
    if verdict == "named":
        if row["group"] in ("nothing", "outside"):
            return "false name"
        return "should be ambiguous" if row["group"] == "ambiguous" else "wrong name"
    if row["group"] in ("nothing", "outside"):
        return f"should be {row['right_verdict']}, not {verdict}"
    return {"none": "missed", "unknown": "not explained", "ambiguous": "not decided"}[verdict]


def _failures(rows: Sequence[Mapping[str, Any]]) -> Counter[tuple[str, str, str]]:
    """What was said where it was wrong."""
    found: Counter[tuple[str, str, str]] = Counter()
    for row in rows:
        kind = _kind(row)
        if kind is not None:
            found[kind, f"{row['truth']} ({row['group']}, {row['data']})", _said(row)] += 1
    return found


def plot(rows: Sequence[Mapping[str, Any]], path: Path) -> None:
    """Single effects by signal-to-noise, verdicts by group, and methods side by side."""
    figure, axes = plt.subplots(1, 3, figsize=(13.5, 4.2), layout="constrained", width_ratios=(1.2, 1.1, 1))
    _plot_strengths(axes[0], [r for r in rows if r["group"] == "single"])
    _plot_verdicts(axes[1], rows)
    _plot_methods(axes[2], rows)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=150)
    plt.close(figure)


def _plot_strengths(axes: Axes, single: Sequence[Mapping[str, Any]]) -> None:
    places = [f"{a:g}–{b:g}" if np.isfinite(b) else f"> {a:g}" for a, b in pairwise(BINS)]
    inside = [[r for r in single if a <= r["snr"] < b] for a, b in pairwise(BINS)]
    labels = [f"{p}\nn = {len(own)}" for p, own in zip(places, inside, strict=True)]
    for offset, key, name, target in (
        (-0.08, "effect_right", "effect", 0.85),
        (0.08, "class_right", "class", 0.95),
    ):
        used = [i for i, own in enumerate(inside) if own]
        counts = [(sum(bool(r.get(key)) for r in inside[i]), len(inside[i])) for i in used]
        middle = np.array([k / n for k, n in counts])
        ends = np.array([interval(k, n) for k, n in counts]).reshape(-1, 2)
        bars = np.abs(ends.T - middle)
        drawn = axes.errorbar(
            np.array(used) + offset, middle, bars, fmt="o-", capsize=3, label=f"{name} right"
        )
        axes.hlines(
            target,
            1.6,
            len(places) - 0.6,
            colors=drawn.lines[0].get_color(),
            linestyles="dotted",
            linewidth=1,
        )
    axes.set_xticks(range(len(places)), labels, fontsize="small")
    axes.set(xlabel="projected signal-to-noise", ylabel="share of single effects", ylim=(-0.03, 1.03))
    axes.set_title("Single effects (95 % intervals; dotted: targets from 4 on)", fontsize="medium")
    axes.legend(fontsize="small", loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2)


def _plot_verdicts(axes: Axes, rows: Sequence[Mapping[str, Any]]) -> None:
    groups = [g for g in GROUPS if any(r["group"] == g for r in rows)]
    labels = [f"{GROUPS[g]}\nn = {sum(r['group'] == g for r in rows)}" for g in groups]
    bottom = np.zeros(len(groups))
    for answer, colour in ANSWERS.items():
        part = np.array(
            [np.mean([_answer(r) == answer for r in rows if r["group"] == group]) for group in groups]
        )
        axes.bar(labels, part, bottom=bottom, label=answer, color=colour)
        bottom += part
    axes.set(ylabel="share of answers", ylim=(0, 1))
    axes.tick_params(axis="x", labelsize="small")
    axes.set_title("Answers by what was concealed", fontsize="medium")
    axes.legend(fontsize="small", loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3)


def _answer(row: Mapping[str, Any]) -> str:
    if row["verdict"] == "named":
        right = row.get("effect_right") and row["group"] not in ("nothing", "outside")
        return "named, right" if right else "named, wrong"
    return str(row["verdict"])


def _plot_methods(axes: Axes, rows: Sequence[Mapping[str, Any]]) -> None:
    table = comparison(rows, DETECTABLE)
    methods = list(table)[::-1]
    names = ("effect right", "named on nothing", "named on outside")
    for number, name in enumerate(names):
        place = np.arange(len(methods)) + 0.27 * (1 - number)
        counts = [table[m][name] for m in methods]
        values = np.array([k / n if n else 0.0 for k, n in counts])
        ends = np.array([interval(k, n) if n else (0.0, 0.0) for k, n in counts])
        axes.barh(place, values, 0.25, xerr=np.abs(ends.T - values), label=name, capsize=2)
    axes.set_yticks(range(len(methods)), [m.replace(" ", "\n", 1) for m in methods], fontsize="small")
    axes.set(xlabel="share of cases", xlim=(0, 1.0))
    axes.set_title("Against simpler methods", fontsize="medium")
    axes.legend(fontsize="small", loc="upper center", bbox_to_anchor=(0.45, -0.16), ncols=3)

"""The benchmark's table (CSV and Markdown) and plot."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from blind_baselines import comparison
from blind_score import DETECTABLE, summary

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
}


def write_report(rows: Sequence[Mapping[str, Any]], folder: Path) -> str:
    """Write cases.csv, blind.md and blind.png; the Markdown."""
    table = pd.DataFrame(
        [{k: v for k, v in row.items() if k != "answers"} | row.get("answers", {}) for row in rows]
    )
    write_text(folder / "cases.csv", table.to_csv(index=False, float_format="%.4g"))
    text = markdown(rows)
    write_text(folder / "blind.md", text)
    if len(rows):
        _plot(rows, folder / "blind.png")
    return text


def markdown(rows: Sequence[Mapping[str, Any]]) -> str:
    """Figures against targets, answers by signal-to-noise, and failures by kind."""
    lines = [f"{len(rows)} cases.", "", "| figure | measured | target |", "|---|---|---|"]
    lines += [f"| {name} | {value:.3g} | {TARGETS.get(name, '')} |" for name, value in summary(rows).items()]
    lines += [
        "",
        "| single effects, projected signal-to-noise | cases | effect right | class right | none said |",
    ]
    lines += ["|---|---|---|---|---|", *(_bin_line(rows, a, b) for a, b in pairwise(BINS))]
    lines += [
        "",
        "| method | effect right, snr >= 4 | named on nothing | named outside |",
        "|---|---|---|---|",
    ]
    for method, shares in comparison(rows, DETECTABLE).items():
        lines.append(f"| {method} | " + " | ".join(f"{share:.2f}" for share in shares.values()) + " |")
    lines += ["", "| truth | answer | cases |", "|---|---|---|"]
    lines += [f"| {true} | {said} | {n} |" for (true, said), n in _failures(rows).most_common()]
    return "\n".join([*lines, ""])


def _bin_line(rows: Sequence[Mapping[str, Any]], low: float, high: float) -> str:
    inside = [r for r in rows if r["group"] == "single" and low <= r["snr"] < high]
    shares = [
        np.mean([bool(r.get(k)) for r in inside]) if inside else np.nan
        for k in ("effect_right", "class_right")
    ]
    silent = np.mean([r.get("verdict") == "none" for r in inside]) if inside else np.nan
    ends = f"{low:g} … {high:g}" if np.isfinite(high) else f"over {low:g}"
    return f"| {ends} | {len(inside)} | {shares[0]:.2f} | {shares[1]:.2f} | {silent:.2f} |"


def _failures(rows: Sequence[Mapping[str, Any]]) -> Counter[tuple[str, str]]:
    """What was said where it was wrong; of effects that leave next to nothing, silence is right."""
    found: Counter[tuple[str, str]] = Counter()
    for row in rows:
        is_faint = row["snr"] < DETECTABLE and row.get("verdict") == "none"
        if not row.get("verdict_right") and not is_faint:
            said = row.get("named") or f"{row['verdict']} ({row.get('best') or row.get('fault') or '-'})"
            found[f"{row['truth']} ({row['group']}, {row['data']})", said] += 1
    return found


def _plot(rows: Sequence[Mapping[str, Any]], path: Path) -> None:
    single = [r for r in rows if r["group"] == "single"]
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
    for key, name in (("effect_right", "effect"), ("class_right", "class")):
        shares, places = [], []
        for low, high in pairwise(BINS):
            inside = [bool(r.get(key)) for r in single if low <= r["snr"] < high]
            if inside:
                shares.append(np.mean(inside))
                places.append(f"{low:g}–{high:g}" if np.isfinite(high) else f"> {low:g}")
        axes[0].plot(places, shares, "o-", label=f"{name} right")
    axes[0].set(xlabel="projected signal-to-noise", ylabel="share of single effects", ylim=(-0.02, 1.02))
    axes[0].legend()
    groups = ("single", "nothing", "outside", "double", "ambiguous")
    bottom = np.zeros(len(groups))
    for verdict in ("none", "named", "ambiguous", "unknown", "failed"):
        part = np.array(
            [np.mean([r.get("verdict") == verdict for r in rows if r["group"] == g] or [0.0]) for g in groups]
        )
        axes[1].bar(groups, part, bottom=bottom, label=verdict)
        bottom += part
    axes[1].set(ylabel="share of answers")
    axes[1].legend(fontsize="small")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=150)
    plt.close(figure)

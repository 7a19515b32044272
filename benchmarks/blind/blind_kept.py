"""Rows of cases that earlier runs have scored, and cases that could not be concealed, as they left them behind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
from blind_baselines import METHODS

from statorhom.study.atomic import write_text

TABLE = "cases.csv"
REFUSED = "refused.txt"
RATIO = "held-out ratio, "
FAULTS, WORDS = ("fault", "commit"), ("named", "best", "effect", "part")


def write_rows(rows: Sequence[Mapping[str, Any]], folder: Path) -> None:
    """Write a table of scored cases, one line each."""
    flat = [
        {k: v for k, v in row.items() if k not in ("answers", "held_out")}
        | row.get("answers", {})
        | {f"{RATIO}{method}": v for method, v in row.get("held_out", {}).items()}
        for row in rows
    ]
    write_text(folder / TABLE, pd.DataFrame(flat).to_csv(index=False, float_format="%.4g"))


def kept_rows(folder: Path) -> dict[str, dict[str, Any]]:
    """Case → its row as it was scored; none without a table.

    Parameters
    ----------
    folder : where `write_rows` has left its table.
    """
    if not (folder / TABLE).exists():
        return {}
    table = pd.read_csv(folder / TABLE, dtype={"commit": str}, keep_default_na=False, na_values=[""])
    return {str(line["case"]): _row(line) for line in table.to_dict("records")}


def _row(line: dict[Any, Any]) -> dict[str, Any]:
    # an empty cell is what was not named
    words = FAULTS if line["verdict"] == "failed" else (*FAULTS, *WORDS)
    known = {str(k): "" if pd.isna(v) else v for k, v in line.items() if k in words or not pd.isna(v)}
    ratios = {k.removeprefix(RATIO): v for k, v in known.items() if k.startswith(RATIO)}
    row = {k: v for k, v in known.items() if k not in METHODS and not k.startswith(RATIO)}
    row |= {word: "" for word in words if word not in row}
    if row["verdict"] == "failed":
        return row
    answers = {method: known.get(method, "") for method in METHODS}
    # answers of before there were parts tell a class by a name alone
    row.setdefault("class_named", row["class_right"])
    return row | {"answers": answers, "held_out": ratios}


def write_refused(messages: Sequence[str], folder: Path) -> None:
    """Write why cases cannot be concealed, "case: reason", beside what is known of others."""
    known = {line.partition(":")[0]: line for line in [*_refusals(folder), *messages]}
    if known:
        write_text(folder / REFUSED, "".join(f"{known[name]}\n" for name in sorted(known)))


def refused(folder: Path) -> frozenset[str]:
    """Names of cases that could not be concealed; to find that out again may take a quarter of an hour."""
    return frozenset(line.partition(":")[0] for line in _refusals(folder))


def _refusals(folder: Path) -> list[str]:
    path = folder / REFUSED
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []

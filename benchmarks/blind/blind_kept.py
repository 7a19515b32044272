"""Rows of cases that earlier runs have scored, out of the table that they left behind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
from blind_baselines import METHODS

from statorhom.study.atomic import write_text

TABLE = "cases.csv"
RATIO = "held-out ratio, "


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
    known = {str(k): v for k, v in line.items() if not pd.isna(v)}
    ratios = {k.removeprefix(RATIO): v for k, v in known.items() if k.startswith(RATIO)}
    row = {k: v for k, v in known.items() if k not in METHODS and not k.startswith(RATIO)}
    row |= {"fault": row.get("fault", ""), "commit": row.get("commit", "")}
    if row["verdict"] == "failed":
        return row
    # an empty cell is what was not named
    words = {k: row.get(k, "") for k in ("named", "best", "effect")}
    answers = {method: known.get(method, "") for method in METHODS}
    return row | words | {"answers": answers, "held_out": ratios}

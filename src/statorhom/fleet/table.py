"""The fleet's table: one row per machine and step, the same whoever fitted which machine when."""

from __future__ import annotations

import importlib.util
import io
from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

from statorhom.results.schema import RegionResult, Results, StageResult
from statorhom.study.atomic import write_bytes, write_text

NAME = "fleet"
Row = dict[str, str | float | int | None]


def fleet_table(
    machines: Sequence[str], results: Mapping[str, Results], errors: Mapping[str, str]
) -> pd.DataFrame:
    """Table of a fleet.

    Parameters
    ----------
    machines : names in the order of the rows.
    results : of the machines that are done.
    errors : why others are not.
    """
    rows: list[Row] = []
    for name in machines:
        if name in results:
            rows += [_row(name, stage) for stage in results[name].stages]
        else:
            state = "failed" if name in errors else "open"
            rows.append({"study": name, "state": state, "error": errors.get(name)})
    leading = ["study", "stage", "state", "error"]
    table = pd.DataFrame(rows)
    return table.reindex(columns=[*leading, *(c for c in table.columns if c not in leading)])


def write_table(table: pd.DataFrame, folder: Path) -> tuple[Path, ...]:
    """Write fleet.csv, and fleet.parquet where pyarrow is installed.

    Raises
    ------
    ResultsError
        Where a file cannot be written.
    """
    written = [folder / f"{NAME}.csv"]
    write_text(written[0], table.to_csv(index=False))
    if importlib.util.find_spec("pyarrow") is not None:
        content = io.BytesIO()
        table.to_parquet(content, index=False, engine="pyarrow")
        written.append(folder / f"{NAME}.parquet")
        write_bytes(written[1], content.getvalue())
    return tuple(written)


def _row(study: str, stage: StageResult) -> Row:
    row: Row = {
        "study": study,
        "stage": stage.name,
        "state": "fitted",
        "error": None,
        "mass_kg": stage.mass_kg,
    }
    fit = stage.fit
    row |= {
        "rms_percent": None if fit is None else fit.rms_percent,
        "max_percent": None if fit is None else fit.max_percent,
        "warnings": len(stage.warnings),
    }
    for region, material in stage.regions.items():
        row |= {f"{region}.{key}": value for key, value in _material(material).items()}
    return row


def _material(material: RegionResult) -> Row:
    found: Row = {"density_kg_m3": material.density_kg_m3}
    for name, constant in material.engineering.items():
        low, high = constant.ci90
        found |= {name: constant.value, f"{name}.low90": low, f"{name}.high90": high}
        found[f"{name}.status"] = constant.status
    if (loss := material.loss_factor) is not None:
        found |= {
            "loss_factor": loss.value,
            "loss_factor.low90": loss.ci90[0],
            "loss_factor.high90": loss.ci90[1],
        }
    return found

"""The fleet's table."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from statorhom.errors import ResultsError
from statorhom.fleet import table as module
from statorhom.fleet.table import fleet_table, write_table
from statorhom.results.schema import Constant, FitSummary, Interval, RegionResult, Results, StageResult


def results(name: str, modulus: float) -> Results:
    region = RegionResult(
        volume_m3=1e-4,
        density_kg_m3=7800.0,
        loss_factor=Interval(value=0.004, ci90=(0.003, 0.005)),
        engineering={"E_pa": Constant(value=modulus, ci90=(1.8e11, 2.1e11), status="identified")},
    )
    fit = FitSummary(method="annealing", evaluations=60, optima=(), rms_percent=0.25, max_percent=0.5)
    fitted = StageResult(
        name="stack",
        kind="stack",
        mass_kg=3.0,
        mass_sd_kg=0.005,
        added_mass_kg=3.0,
        regions={"lamination": region},
        fit=fit,
        warnings=("one", "two"),
    )
    weighed = fitted.model_copy(update={"name": "wound", "fit": None, "warnings": ()})
    return Results(schema=1, study=name, seed=1, stages=(fitted, weighed))


def test_a_row_per_machine_and_step() -> None:
    found = fleet_table(
        ["b", "a", "c", "d"], {"a": results("a", 2e11), "b": results("b", 1.9e11)}, {"c": "why, so"}
    )
    assert list(zip(found["study"], found["stage"].fillna(""), found["state"], strict=True)) == [
        ("b", "stack", "fitted"),
        ("b", "wound", "fitted"),
        ("a", "stack", "fitted"),
        ("a", "wound", "fitted"),
        ("c", "", "failed"),
        ("d", "", "open"),
    ]
    first = found.iloc[0]
    assert first["lamination.E_pa"] == 1.9e11
    assert (first["lamination.E_pa.low90"], first["lamination.E_pa.high90"]) == (1.8e11, 2.1e11)
    assert first["lamination.E_pa.status"] == "identified"
    assert (first["lamination.loss_factor"], first["lamination.density_kg_m3"]) == (0.004, 7800.0)
    assert (first["mass_kg"], first["rms_percent"], first["warnings"]) == (3.0, 0.25, 2)
    assert found["error"].iloc[4] == "why, so"


def test_a_fleet_without_any_result_has_the_leading_columns() -> None:
    found = fleet_table(["a"], {}, {})
    assert list(found.columns) == ["study", "stage", "state", "error"]


def test_csv_and_parquet_hold_the_same(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow", reason="needs the extra parquet")
    table = fleet_table(["a", "c"], {"a": results("a", 2e11)}, {"c": 'a "quoted", word'})
    csv, parquet = write_table(table, tmp_path)
    pd.testing.assert_frame_equal(pd.read_csv(csv), pd.read_parquet(parquet), check_dtype=False)
    assert pd.read_csv(csv)["lamination.E_pa"][0] == 2e11


def test_without_pyarrow_there_is_the_csv(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module.importlib.util, "find_spec", lambda _name: None)
    (path,) = write_table(fleet_table(["a"], {}, {}), tmp_path)
    assert path.read_text(encoding="utf-8") == "study,stage,state,error\na,,open,\n"


def test_a_place_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(ResultsError, match=r"fleet\.csv: cannot be written"):
        write_table(fleet_table(["a"], {}, {}), tmp_path / "file")

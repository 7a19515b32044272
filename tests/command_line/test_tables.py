from __future__ import annotations

import pandas as pd
import pytest

from statorhom.command_line.tables import print_materials, print_modes
from statorhom.results.schema import Constant, RegionResult, Results, StageResult


def results(**stage: object) -> Results:
    constants = {
        "E_pa": Constant(value=191.5e9, ci90=(187e9, 196e9), status="identified"),
        "nu": Constant(value=0.3, ci90=(0.3, 0.3), status="fixed"),
    }
    made = StageResult(
        name="stack [red]",
        kind="stack",
        mass_kg=3.08,
        mass_sd_kg=0.005,
        added_mass_kg=3.08,
        regions={"lamination": RegionResult(volume_m3=3.943e-4, engineering=constants)},
    ).model_copy(update=stage)
    return Results(schema=1, study="s", seed=1, stages=(made,))


def test_constants_in_engineers_units(capsys: pytest.CaptureFixture[str]) -> None:
    print_materials(results())
    lines = capsys.readouterr().out.splitlines()
    # names are the user's: they are no markup
    assert lines[0] == "stack [red] (stack): 3.08 kg"
    assert [line.split() for line in lines[2:]] == [
        ["lamination", "E_pa", "191.5", "GPa", "187", "GPa", "…", "196", "GPa", "identified"],
        ["lamination", "nu", "0.300", "0.300", "…", "0.300", "fixed"],
    ]


def test_warnings_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    print_materials(results(warnings=("density of [winding] 12000 kg/m3",)))
    assert "warning: density of [winding] 12000 kg/m3" in capsys.readouterr().out


def test_modes_without_a_name_leave_their_cells_empty(capsys: pytest.CaptureFixture[str]) -> None:
    table = pd.DataFrame({"mode": [1, 2], "frequency_hz": [1432.0, 2103.456], "order": [2, None]})
    print_modes(table.astype({"order": "Int64"}))
    lines = capsys.readouterr().out.splitlines()
    assert [line.split() for line in lines] == [
        ["mode", "frequency_hz", "order"],
        ["1", "1432.00", "2"],
        ["2", "2103.46"],
    ]

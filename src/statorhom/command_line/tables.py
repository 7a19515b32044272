"""Results as tables in the terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from statorhom.results.diagnosis import Estimated

if TYPE_CHECKING:
    import pandas as pd

    from statorhom.results.diagnosis import Diagnosis
    from statorhom.results.schema import Results, StageResult


def print_materials(results: Results) -> None:
    """Materials with 90 % intervals, fits and warnings of all steps."""
    console = Console()
    for stage in results.stages:
        console.print(_stage_line(stage))
        table = Table("region", "constant", "value", "90 % interval", "status", box=None, pad_edge=False)
        for region, material in stage.regions.items():
            for name, constant in material.engineering.items():
                low, high = constant.ci90
                interval = f"{_figure(name, low)} … {_figure(name, high)}"
                table.add_row(region, name, _figure(name, constant.value), interval, constant.status)
        if table.row_count:
            console.print(table)
        for warning in stage.warnings:
            console.print(f"[bold yellow]warning[/]: {escape(warning)}")


def print_modes(table: pd.DataFrame) -> None:
    """Simulated modes."""
    import pandas as pd  # here, so that a usage error is answered without it

    shown = Table(*(str(c) for c in table.columns), box=None, pad_edge=False)
    for row in table.itertuples(index=False):
        shown.add_row(
            *("" if pd.isna(v) else f"{v:.2f}" if isinstance(v, float) else escape(str(v)) for v in row)
        )
    Console().print(shown)


def print_measured(table: pd.DataFrame) -> None:
    """Extracted modes with their standard deviations."""
    import pandas as pd

    bare = "frequency_without_sensor_hz" in table.columns
    further = ("without sensor Hz", "± Hz") if bare else ()
    label = "name" if "name" in table.columns else "(r, n)"
    shown = Table("mode", "Hz", "± Hz", "loss %", "± %", label, "share %", "MPC %", *further, box=None)
    for row in table.to_dict("records"):
        name = "" if pd.isna(row["order"]) else f"({row['order']}, {_or(row['axial'], '?')})"
        name = escape(row["name"]) if "name" in row else name
        share = "" if pd.isna(row["share"]) else f"{100 * row['share']:.1f}"
        loss = f"{100 * row['loss_factor']:.3g}", f"{100 * row['loss_factor_sd']:.1g}"
        frequency = f"{row['frequency_hz']:.3f}", f"{row['frequency_sd_hz']:.1g}"
        collinearity = f"{100 * row['phase_collinearity']:.1f}"
        shown.add_row(
            str(row["mode"]), *frequency, *loss, name, share, collinearity, *(_bare(row) if bare else ())
        )
    Console().print(shown)


def _bare(row: Mapping[Any, Any]) -> tuple[str, str]:
    import pandas as pd

    frequency, sd = row["frequency_without_sensor_hz"], row["frequency_without_sensor_sd_hz"]
    return ("", "") if pd.isna(frequency) else (f"{frequency:.3f}", f"{sd:.1g}")


def _or(value: object, unknown: str) -> str:
    import pandas as pd

    return unknown if pd.isna(value) else str(value)  # type: ignore[call-overload]


def print_fleet(table: pd.DataFrame, errors: Mapping[str, str]) -> None:
    """Median and scatter of every constant over a fleet, step by step, and the machines without results."""
    console = Console()
    for stage, rows in table[table["stage"].notna()].groupby("stage", sort=False):
        console.print(f"[bold]{escape(str(stage))}[/]: {len(rows)} machines")
        shown = Table("constant", "lowest", "median", "highest", box=None, pad_edge=False)
        for column in [c.removesuffix(".status") for c in rows.columns if c.endswith(".status")]:
            values = rows[column].dropna()
            if len(values):
                figures = (values.min(), values.median(), values.max())
                shown.add_row(column, *(_figure(column, figure) for figure in figures))
        console.print(shown)
    for machine, error in errors.items():
        console.print(f"[bold yellow]failed[/]: {escape(machine)}: {escape(error)}")


def print_diagnosis(diagnosis: Diagnosis) -> None:
    """Verdict, effects, alternatives and what to measure next."""
    console = Console()
    console.print(f"verdict: [bold]{diagnosis.verdict}[/]")
    if diagnosis.mismatch is not None:
        console.print(escape(diagnosis.mismatch.statement))
    for effect in diagnosis.effects:
        values = ", ".join(
            f"{name} = {f'{p.value:.4g}' if isinstance(p, Estimated) else p}"
            for name, p in effect.parameters.items()
        )
        console.print(escape(f"{effect.effect} in stage {effect.stage}: {values} ({effect.probability:.0%})"))
    for other in diagnosis.alternatives:
        console.print(escape(f"or {other.effect} ({other.probability:.1%})"))
    if diagnosis.next_measurement is not None:
        console.print(escape(f"next: {diagnosis.next_measurement.what}"))


def _stage_line(stage: StageResult) -> str:
    line = f"[bold]{escape(stage.name)}[/] ({stage.kind}): {stage.mass_kg:g} kg"
    if stage.fit is not None:
        line += f", fitted modes within {stage.fit.rms_percent:.2f} % (rms), {stage.fit.max_percent:.2f} % at most"
    return line


def _figure(name: str, value: float) -> str:
    return f"{value / 1e9:.4g} GPa" if name.endswith("_pa") else f"{value:.3f}"

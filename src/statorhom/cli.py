"""The command line: init, simulate, modes, fit, run, diagnose, conceal, batch and report."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

import typer

from statorhom.command_line.blas import one_thread_each
from statorhom.command_line.exit_codes import guarded
from statorhom.command_line.progress import progress_bars
from statorhom.command_line.tables import print_fleet, print_materials, print_measured, print_modes

app = typer.Typer(
    name="statorhom",
    help="Homogenized materials of electrical-machine stators, found step by step from weights and measured modes.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

StudyPath = Annotated[Path, typer.Argument(metavar="STUDY", help="The study file (study.toml).")]
Out = Annotated[
    Path | None, typer.Option("--out", metavar="DIR", help="Folder for results [default: beside the study].")
]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Equal seeds give equal results.")]
Jobs = Annotated[
    int,
    typer.Option(
        "--jobs",
        min=1,
        show_default=False,
        help="Number of processes [default: the processors]; results do not depend on it.",
    ),
]
PROCESSORS = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else (os.cpu_count() or 1)
Stage = Annotated[str | None, typer.Option("--stage", metavar="NAME", help="Only up to this step.")]
Json = Annotated[bool, typer.Option("--json", help="Print the main result as JSON on standard output.")]


@app.command()
def init(
    folder: Annotated[
        Path, typer.Argument(metavar="DIR", help="Folder to make; it must not hold a study yet.")
    ],
) -> None:
    """Make a study to start from: a geometry, a study file and a modal table with explanations."""
    from statorhom.command_line.template import write_template

    for path in write_template(folder):
        typer.echo(f"wrote {path}")


@app.command()
def simulate(study: StudyPath, stage: Stage = None, out: Out = None, json: Json = False) -> None:
    """Simulate the modes of each step with typical materials, or with identified ones where DIR has them."""
    from statorhom.simulate import simulate_study

    path, table = simulate_study(study, stage, out)
    if json:
        typer.echo(table.to_json(orient="records"))
    else:
        print_modes(table)
        typer.echo(f"wrote {path}", err=True)


@app.command()
def modes(
    recordings: Annotated[
        list[Path], typer.Argument(metavar="RECORDING…", help="Files of one test: FRFs or hits.")
    ],
    study: Annotated[
        Path | None,
        typer.Option("--study", metavar="STUDY", help="Study with a test of these files: takes its keys."),
    ] = None,
    out: Out = None,
    sweep_hz: Annotated[
        tuple[float, float] | None,
        typer.Option("--sweep-hz", metavar="START STOP", help="Time records are sine sweeps over this band."),
    ] = None,
    segment_s: Annotated[
        float | None,
        typer.Option("--segment-s", help="Segments of a sweep's spectra [default: 1000 lines in its band]."),
    ] = None,
    json: Json = False,
) -> None:
    """Extract the modes of a test's recordings: modal table, shapes, plots."""
    from statorhom.measure import measure, sweep_settings

    sweep = sweep_settings(sweep_hz, segment_s)
    with progress_bars(quiet=json) as announce:
        table, paths = measure(recordings, study, out, announce, sweep)
    if json:
        typer.echo(table.to_json(orient="records"))
    else:
        print_measured(table)
        for path in paths:
            typer.echo(f"wrote {path}", err=True)


@app.command()
def fit(
    study: StudyPath,
    stage: Stage = None,
    out: Out = None,
    seed: Seed = 1,
    jobs: Jobs = PROCESSORS,
    json: Json = False,
) -> None:
    """Identify the materials of a step; earlier steps are taken from DIR or fitted first."""
    from statorhom.api import Study

    with progress_bars(quiet=json) as announce:
        results = Study.load(study).fit(out, stage=stage, seed=seed, jobs=jobs, announce=announce)
    _show(results.model_dump_json(by_alias=True) if json else None, results)


@app.command()
def run(
    study: StudyPath, out: Out = None, seed: Seed = 1, jobs: Jobs = PROCESSORS, json: Json = False
) -> None:
    """Identify all steps and write results.json, report.html and report.pdf."""
    from statorhom.api import Study

    loaded = Study.load(study)
    with progress_bars(quiet=json) as announce:
        results = loaded.run(out, seed=seed, jobs=jobs, announce=announce)
    _show(results.model_dump_json(by_alias=True) if json else None, results)
    if not json:
        typer.echo(f"report: {(out or loaded.default_folder) / 'report.html'}", err=True)


@app.command()
def diagnose(
    study: StudyPath,
    out: Out = None,
    apply: Annotated[
        bool, typer.Option("--apply", help="Also write study.toml with the named effect modelled.")
    ] = False,
    seed: Seed = 1,
    jobs: Jobs = PROCESSORS,
    json: Json = False,
) -> None:
    """Say what physics the model left out, where, and how sure that is; writes diagnosis.json and report.html."""
    one_thread_each()
    from statorhom.api import Study
    from statorhom.command_line.tables import print_diagnosis

    loaded = Study.load(study)
    with progress_bars(quiet=json) as announce:
        found = loaded.diagnose(out, seed=seed, jobs=jobs, apply=apply, announce=announce)
    if json:
        typer.echo(found.model_dump_json(by_alias=True))
    else:
        print_diagnosis(found)
        typer.echo(f"wrote {(out or loaded.default_folder) / 'diagnosis.json'}", err=True)


@app.command()
def batch(
    studies: Annotated[
        list[Path], typer.Argument(metavar="STUDIES…", help="Study files of machines of one geometry.")
    ],
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for results.")] = Path(
        "fleet-results"
    ),
    seed: Seed = 1,
    jobs: Jobs = PROCESSORS,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="dask.distributed scheduler whose workers fit, instead of own processes.",
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Identify many machines of one geometry, such as a production line, into one table."""
    from statorhom.fleet.batch import fit_fleet
    from statorhom.fleet.dask_cluster import DaskCluster
    from statorhom.fleet.local import LocalProcesses

    executor = LocalProcesses(jobs) if scheduler is None else DaskCluster(scheduler)
    with progress_bars(quiet=json) as announce:
        fleet = fit_fleet(studies, out, executor, seed=seed, announce=announce)
    if json:
        typer.echo(fleet.table.to_json(orient="records"))
    else:
        print_fleet(fleet.table, fleet.errors)
        for path in fleet.files:
            typer.echo(f"wrote {path}", err=True)
    fleet.check()


@app.command()
def conceal(
    study: StudyPath,
    effect: Annotated[
        list[str],
        typer.Option("--effect", metavar="NAME", help='What to conceal, "none" for nothing; once or twice.'),
    ],
    out: Out = None,
    given: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="NAME=VALUE", help="A parameter instead of drawing it; EFFECT.NAME of two."
        ),
    ] = None,
    strength: Annotated[
        float | None,
        typer.Option("--strength", min=0.0, max=1.0, help="From hardly felt to strong [default: drawn]."),
    ] = None,
    stage: Annotated[str | None, typer.Option("--stage", metavar="NAME", help="The step it is in.")] = None,
    test: Annotated[str | None, typer.Option("--test", metavar="NAME", help="The test it is in.")] = None,
    tables: Annotated[
        bool | None,
        typer.Option(
            "--tables/--frfs", show_default=False, help="Kind of recordings [default: as the study's tests]."
        ),
    ] = None,
    materials: Annotated[
        Path | None,
        typer.Option(
            "--materials", metavar="DIR", help="Results whose identified materials are the true ones."
        ),
    ] = None,
    wide: Annotated[
        bool,
        typer.Option("--wide", help="True materials from all that is typical, not a well-made stator's."),
    ] = False,
    seed: Seed = 1,
) -> None:
    """Make a study whose recordings conceal an effect; the truth lies in DIR/sealed/truth.json."""
    from statorhom.conceal.conceal_study import conceal_study
    from statorhom.conceal.wishes import wishes_from

    wishes = wishes_from(effect, given or [], strength, stage, test)
    path, _ = conceal_study(study, wishes, out, seed=seed, tables=tables, wide=wide, materials=materials)
    typer.echo(f"wrote {path}")


@app.command()
def suspension(
    cords: Annotated[
        Path,
        typer.Argument(
            metavar="CORDS", help="CSV: x_mm, y_mm, z_mm, stiffness_n_per_m, optional length_mm, dx, dy, dz."
        ),
    ],
    mass: Annotated[float, typer.Option("--mass-kg", help="Of the body on the cords.")],
    elastic: Annotated[float, typer.Option("--elastic-hz", help="First elastic mode of the body.")],
    inertia: Annotated[
        tuple[float, float, float] | None,
        typer.Option(
            "--inertia-kg-m2",
            metavar="IX IY IZ",
            help="About the centre of gravity [default: the mass lies where the cords hold].",
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Say whether a body on cords is as good as free: its rigid-body modes against the first elastic one."""
    from statorhom.ground_test import check_suspension

    verdict, table = check_suspension(cords, mass, elastic, inertia)
    if json:
        typer.echo(table.to_json(orient="records"))
    else:
        print_modes(table)
        typer.echo(verdict)


@app.command()
def compare(
    measured: Annotated[Path, typer.Argument(metavar="MEASURED", help="Universal file with shapes.")],
    simulated: Annotated[Path, typer.Argument(metavar="SIMULATED", help="Another one, at the same nodes.")],
    least_mac: Annotated[
        float, typer.Option("--least-mac", help="Of shapes that are called the same.")
    ] = 0.5,
    json: Json = False,
) -> None:
    """Pair the modes of two files of shapes by MAC and list the differences of their frequencies."""
    from statorhom.ground_test import compare_shapes

    table = compare_shapes(measured, simulated, least_mac)
    if json:
        typer.echo(table.to_json(orient="records"))
    else:
        print_modes(table)


@app.command()
def report(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="A folder with results.json.")],
) -> None:
    """Write report.html and report.pdf again from what is in a results folder."""
    from statorhom.report import write_report

    for path in write_report(folder):
        typer.echo(f"wrote {path}")


def _show(text: str | None, results: object) -> None:
    if text is not None:
        typer.echo(text)
    else:
        print_materials(results)  # type: ignore[arg-type]


def main() -> None:
    """Entry point: our own errors are one line and exit code 2, an interruption is 130."""
    sys.exit(guarded(app))


__all__ = ["app", "main"]

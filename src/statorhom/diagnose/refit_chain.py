"""The chain of steps identified without and with what was left out, and how the constants changed."""

from __future__ import annotations

from pathlib import Path

from statorhom.errors import StatorhomError
from statorhom.identify.chain import chain
from statorhom.identify.processes.announce import Announce
from statorhom.identify.stages.recorded_tests import with_recorded_tables
from statorhom.identify.stages.settings import Settings
from statorhom.results.diagnosis import Details, RefittedRow
from statorhom.results.schema import Results
from statorhom.study.study import StudyFiles, load_study

FOLDER = "amended"  # within the results folder: results.json of the amended study


def with_refitted_chain(
    details: Details, files: StudyFiles, amended: Path, folder: Path, settings: Settings, announce: Announce
) -> Details:
    """Details with the constants of both chains; where one cannot be identified, with the reason.

    Parameters
    ----------
    files : the study as declared; its results go into `folder`.
    amended : study file with the effect; its results go into `folder`/amended.
    """
    try:
        before = _identified(files, folder, settings, announce)
        after = _identified(load_study(amended), folder / FOLDER, settings, announce)
    except StatorhomError as error:
        return details.model_copy(update={"refit_note": f"The chain was not identified anew: {error}"})
    note = f"The amended study is {amended.name}; its own results stand in the folder {FOLDER}."
    return details.model_copy(update={"refitted": changed_constants(before, after), "refit_note": note})


def changed_constants(before: Results, after: Results) -> tuple[RefittedRow, ...]:
    """Constants that both chains identified, each in the step that identified it last changed its material."""
    rows = []
    later = {stage.name: stage for stage in after.stages}
    told: dict[str, tuple[object, object]] = {}
    for stage in before.stages:
        if stage.name not in later:
            continue
        for region, result in stage.regions.items():
            new = later[stage.name].regions.get(region)
            if new is None or told.get(region) == (result.engineering, new.engineering):
                continue
            told[region] = (result.engineering, new.engineering)
            for name, constant in result.engineering.items():
                twin = new.engineering.get(name)
                if twin is None or "fixed" in (constant.status, twin.status):
                    continue
                rows.append(
                    RefittedRow(
                        stage=stage.name,
                        name=f"{region}.{name}",
                        before=constant.value,
                        before_ci90=constant.ci90,
                        before_status=constant.status,
                        after=twin.value,
                        after_ci90=twin.ci90,
                        after_status=twin.status,
                    )
                )
    return tuple(rows)


def _identified(files: StudyFiles, folder: Path, settings: Settings, announce: Announce) -> Results:
    recorded = with_recorded_tables(files, folder, None, announce)
    return chain(recorded.files, folder, settings, measured=recorded.shapes).run(None, announce)

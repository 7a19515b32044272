"""The declared model of the template's stack, on a coarse mesh, as a diagnosis sees it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from statorhom import Study
from statorhom.command_line.template import write_template
from statorhom.diagnose.features.mode_features import SCATTER_SD
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.measured.recorded import measured_tests
from statorhom.diagnose.stages.constants import held_by_lines, study_constants
from statorhom.diagnose.stages.stage_model import stage_model
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.geometry.stator import stator_geometry
from statorhom.identify.stages.stage_setup import stage_setup
from statorhom.mesh import uniform

LENGTH_MM = 80.5  # of the template's core


def template_hypothesis(
    folder: Path,
    tables: dict[str, str],
    more: str = "",
    *,
    with_losses: bool = False,
    length_mm: float = LENGTH_MM,
) -> Hypothesis:
    """Of a study with modal tables of these names; `more` is added to its file, the core's length is what is typed."""
    write_template(folder)
    drawing = folder / "geometry.toml"
    drawing.write_text(drawing.read_text().replace(f"length_mm = {LENGTH_MM}", f"length_mm = {length_mm}"))
    for name, table in tables.items():
        (folder / name).write_text(table)
    with (folder / "study.toml").open("a") as study:
        study.write(more)
    files = Study.load(folder / "study.toml").files
    files, tests = measured_tests(files, folder)
    geometry = stator_geometry(files.geometry, files.geometry_path)
    setup = stage_setup(files, geometry, 0)
    on_lines = held_by_lines(files, [setup])
    constants = study_constants([setup], [2, 3], SCATTER_SD, with_losses=with_losses, on_lines=on_lines)
    model = StudyModel(files, geometry, constants, ())
    values = constants.values(np.zeros(len(constants)))
    materials = model.declared(setup, values, model.masses(values, {}))
    stage = stage_model(setup, list(tests.values()), [materials], uniform(1))
    return Hypothesis(model.with_stages((stage,)))

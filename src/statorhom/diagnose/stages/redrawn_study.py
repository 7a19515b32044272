"""A study's model of a machine with other dimensions: meshes, bases, names and mesh factors of its own.

What a dimension does is a cubic about the machine that is drawn, at the reference's materials. Where it is off by much
nothing of that holds: modes of one order turn into one another and are called otherwise, and the reference had made up
for the wrong dimension.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from statorhom.diagnose.stages.dimension_response import changed_drawing, changed_geometry
from statorhom.diagnose.stages.stage_model import StageModel, mesh_error, stage_model
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.identify.stages.stage_setup import stage_setup
from statorhom.model.affine import Materials
from statorhom.physics.ring import ring_of


def redrawn(
    study: StudyModel,
    dimensions: Mapping[str, float],
    materials: Callable[[StudyModel, StageModel], Sequence[Materials]],
) -> StudyModel:
    """The study with other dimensions in its drawing.

    Parameters
    ----------
    study : as its files have it, or redrawn already.
    dimensions : "section.key" → value, in the drawing's unit.
    materials : of a stage of the redrawn study, its own ones first and further ones, all of which its basis knows.

    Raises
    ------
    StatorhomError
        If there is no such machine, or none with these materials.
    """
    typed = study.as_typed or study
    files = replace(typed.files, drawing=changed_drawing(typed, dimensions))
    geometry = changed_geometry(typed, dimensions)
    begun = replace(
        typed, files=files, geometry=geometry, stages=(), dimensions=dimensions, as_typed=typed, _volumes={}
    )
    length, stages = ring_of(files).length, []
    for stage in typed.stages:
        setup = stage_setup(files, geometry, stage.setup.index)
        tests = [test.on_core(length) for test in stage.tests]
        known = materials(begun, replace(stage, setup=setup))
        made = stage_model(setup, tests, known, stage.density)
        stages.append(made.with_error(mesh_error(made, made.reference)))
    return begun.with_stages(tuple(stages))

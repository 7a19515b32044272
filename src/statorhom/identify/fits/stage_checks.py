"""What a stage's keys promise and cannot keep, told before anything is computed."""

from __future__ import annotations

from statorhom.errors import IdentificationError, MaterialError
from statorhom.identify.fits.priors import Carried, stage_space
from statorhom.identify.fits.stage_fit import search_space
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.identify.surface.search import check_points
from statorhom.study.message import input_error
from statorhom.study.response_surface import SurfaceKeys
from statorhom.study.study import StudyFiles


def check_materials(files: StudyFiles, setup: StageSetup) -> None:
    """Refuse prescribed constants that no material has, with the others in the middle of their ranges.

    Raises
    ------
    InputFileError
        One line with the stage, the region and the condition that is broken.
    """
    prescribed = setup.keys.identify.fixed
    space = _space(setup)
    values = space.values(space.start)
    for region in setup.materials.regions:
        if region.source not in setup.new or region.source not in prescribed:
            continue
        try:
            region.material(values)
        except MaterialError as error:
            raise input_error(
                files.path,
                f"stages[{setup.keys.name}].identify.fixed.{region.source}",
                f"no material has these constants ({error})",
                "correct them",
            ) from None


def check_design(files: StudyFiles, setup: StageSetup) -> None:
    """Refuse a design of experiments with fewer points than its surface has coefficients.

    Raises
    ------
    InputFileError
        One line with the stage and both numbers.
    """
    keys = setup.keys.identify
    if keys.method != "response_surface" or not setup.fitted:
        return
    surface = keys.response_surface or SurfaceKeys()
    try:
        check_points(surface, search_space(_space(setup)).dimension)
    except IdentificationError as error:
        problem, _, remedy = str(error).partition("; ")
        where = f"stages[{setup.keys.name}].identify.response_surface"
        raise input_error(files.path, where, problem, remedy) from None


def _space(setup: StageSetup) -> ParameterSpace:
    return stage_space(setup.keys, setup.materials, setup.new, setup.densities, Carried(), {})

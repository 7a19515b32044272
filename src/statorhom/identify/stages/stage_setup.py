"""What a stage's fit starts from: geometry, regions, densities and the modes of its tests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from statorhom.errors import IdentificationError, MassError, MaterialError
from statorhom.geometry.block import BlockGeometry
from statorhom.geometry.stator import StatorGeometry
from statorhom.geometry.tested_object import ObjectGeometry, ObjectStep
from statorhom.geometry.wing import WingGeometry
from statorhom.identify.optimizers.base import MIN_EVALUATIONS
from statorhom.identify.stages.stage_materials import RegionModel, StageMaterials
from statorhom.materials.analytic import analytic_lamination, analytic_winding
from statorhom.materials.density import (
    REGION_OF_STEP,
    RegionDensity,
    Weighing,
    check_no_loss,
    densities,
    shared_densities,
    whole_density,
)
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.study.inherited_identify import with_inherited_identify
from statorhom.study.message import input_error, one_line
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.modal_tests import ModalTestKeys
from statorhom.study.regions import COUPON
from statorhom.study.stages import StageKeys
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE
from statorhom.study.wing_file import LUMPS


@dataclass(frozen=True)
class TestModes:
    """The measured modes of one test.

    Parameters
    ----------
    name, support : of the test.
    fitted : modes that the fit sees.
    held_out : modes that it only predicts.
    """

    __test__ = False  # the name is the field's; pytest must not collect it

    name: str
    support: str
    fitted: tuple[MeasuredMode, ...]
    held_out: tuple[MeasuredMode, ...]

    @property
    def modes(self) -> tuple[MeasuredMode, ...]:
        """All modes, by frequency."""
        return tuple(sorted((*self.fitted, *self.held_out), key=lambda mode: mode.frequency_hz))


@dataclass(frozen=True)
class StageSetup:
    """A stage before its fit.

    Parameters
    ----------
    index : number of the stage.
    keys : its table in the study file.
    step : its geometry, None where no test needs it and the geometry file lacks it.
    materials : regions and symmetries.
    new : regions whose constants the stage identifies.
    densities : region → density.
    tests : with their measured modes.
    """

    index: int
    keys: StageKeys
    step: ObjectStep | None
    materials: StageMaterials
    new: frozenset[str]
    densities: Mapping[str, RegionDensity]
    tests: tuple[TestModes, ...]

    @property
    def fitted(self) -> tuple[MeasuredMode, ...]:
        """Modes of all tests that the fit sees."""
        return tuple(mode for test in self.tests for mode in test.fitted)

    @property
    def free_modes(self) -> tuple[MeasuredMode, ...]:
        """All measured modes of free tests, held out or not."""
        return tuple(mode for test in self.tests if test.support == FREE for mode in test.modes)


def stage_setup(files: StudyFiles, geometry: ObjectGeometry, index: int) -> StageSetup:
    """Collect what a stage needs.

    Raises
    ------
    StatorhomError
        If masses, geometry or tests of the stage contradict each other.
    """
    keys = with_inherited_identify(files.study, index)
    tests = tuple(_test_modes(files, test, geometry) for test in keys.tests)
    kinds = tuple(stage.kind for stage in files.study.stages[: index + 1])
    step = geometry.step(kinds) if tests or _described(geometry, kinds) else None
    found = _densities(files, index, step)
    new = frozenset() if step is None else _new_regions(files, index)
    materials = StageMaterials(() if step is None or not tests else _regions(files, index, step))
    return StageSetup(index, keys, step, materials, new, found, tests)


def check_fit(files: StudyFiles, setup: StageSetup) -> None:
    """Refuse what a stage's fit cannot start from.

    Raises
    ------
    StatorhomError
        If no mode is left to fit or the search has too few evaluations.
    """
    stage = f"stages[{setup.keys.name}]"
    if setup.tests and not setup.fitted:
        raise input_error(
            files.path,
            stage,
            "no mode is left to fit",
            "give it a free test with modes that are not held out",
        )
    keys = setup.keys.identify
    if setup.tests and keys.evaluations < MIN_EVALUATIONS * keys.chains:
        raise input_error(
            files.path,
            f"{stage}.identify.evaluations",
            f"{keys.evaluations} are too few for {keys.chains} chains",
            f"use at least {MIN_EVALUATIONS * keys.chains}, {MIN_EVALUATIONS} per chain",
        )


def weighings(files: StudyFiles, index: int) -> tuple[Weighing, ...]:
    """Weights of all steps up to one."""
    stages = files.study.stages[: index + 1]
    return tuple(Weighing(s.name, s.kind, s.mass_kg, s.mass_sd_kg) for s in stages)


def _new_regions(files: StudyFiles, index: int) -> frozenset[str]:
    """Regions that no tested step has identified as they are now: this step's, and those of untested ones before it."""
    new: set[str] = set()
    for stage in reversed(files.study.stages[: index + 1]):
        if new and stage.tests:
            break
        weighed = () if stage.kind == COUPON else (REGION_OF_STEP[stage.kind],)
        new |= {*weighed, *stage.model.declared}
    return frozenset(new)


def _described(geometry: ObjectGeometry, kinds: tuple[str, ...]) -> bool:
    if not isinstance(geometry, StatorGeometry):
        return True
    d = geometry.dimensions
    tables = {"wound": d.overhang, "impregnated": d.overhang, "framed": d.frame, "machine": d.shields}
    return all(tables.get(kind, True) is not None for kind in kinds)


def _densities(files: StudyFiles, index: int, step: ObjectStep | None) -> dict[str, RegionDensity]:
    weights = weighings(files, index)
    try:
        if isinstance(step, WingGeometry):
            found = shared_densities(weights[0], step.exact_volumes(), step.densities, step.lump_mass)
            return {density.region: density for density in found}
        if weights[0].kind == COUPON and step is not None:
            return {
                region: whole_density(weights[0], region, v) for region, v in step.exact_volumes().items()
            }
        check_no_loss(weights)
        found = () if step is None else densities(weights, step.exact_volumes())
    except MassError as error:
        raise MassError(one_line(f"{files.path}: {error}")) from None
    return {density.region: density for density in found}


def _regions(files: StudyFiles, index: int, step: ObjectStep) -> tuple[RegionModel, ...]:
    regions = []
    for region in step.regions:
        source = region
        symmetry = files.study.symmetry(index, region)
        if symmetry is None and region == "overhang":
            source, symmetry = "winding", files.study.symmetry(index, "winding")
        if symmetry is None:
            stage = files.study.stages[index].name
            raise IdentificationError(
                f"{files.path}: stage {stage!r}: stages.model.{region} is missing; declare the region's symmetry"
            )
        numbered = files.study.stages[index].kind == COUPON
        regions.append(RegionModel(region, symmetry, source, numbered))
    if isinstance(step, WingGeometry) and step.lumps:
        regions.append(replace(regions[0], region=LUMPS, density=1.0))
    return tuple(regions)


def _test_modes(files: StudyFiles, test: ModalTestKeys, geometry: ObjectGeometry) -> TestModes:
    table = files.tables.get(test.name)
    modes = () if table is None else table.modes
    held = {str(number) for number in test.hold_out}
    if isinstance(geometry, BlockGeometry | WingGeometry):
        # only round objects have modes (r, n)
        modes = tuple(replace(mode, order=None, axial=None) for mode in modes)
    elif test.modal_table is None and isinstance(geometry, StatorGeometry):
        # the shape was seen and has no name: which simulated mode it is would be a guess
        held |= {mode.label for mode in modes if mode.order is None}
    predict = test.role == "predict" or (test.role is None and test.support != FREE)
    if test.role == "fit" and test.support != FREE:
        raise IdentificationError(
            f'{files.path}: test {test.name!r}: role = "fit" on the support {test.support!r}: constants are fitted to '
            f'free tests, supported ones are predicted; use role = "predict"'
        )
    fitted = tuple(m for m in modes if not predict and m.label not in held)
    return TestModes(test.name, test.support, fitted, tuple(m for m in modes if m not in fitted))


def analytic_values(
    files: StudyFiles, setup: StageSetup, earlier: Mapping[str, RegionDensity]
) -> dict[str, TransverselyIsotropic | None]:
    """Homogenized start values where the geometry file tells sheets or wires; None where they are impossible.

    Parameters
    ----------
    files : the study.
    setup : the stage.
    earlier : densities of the regions before this step.
    """
    if setup.keys.kind == COUPON:
        return {}
    sheets, wires = files.geometry.lamination, files.geometry.winding
    found: dict[str, TransverselyIsotropic | None] = {}
    if "lamination" in setup.new and sheets is not None:
        found["lamination"] = analytic_lamination(
            sheets.sheet_thickness_mm / 1e3, sheets.coating_thickness_mm / 1e3
        )
    if setup.keys.kind == "impregnated" and wires is not None and "winding" in earlier:
        radii = wires.wire_radius_mm, wires.insulated_radius_mm
        if radii[0] is not None and radii[1] is not None:
            found["winding"] = _analytic_winding(setup, earlier["winding"], radii[0], radii[1])
    return found


def _analytic_winding(
    setup: StageSetup, dry: RegionDensity, wire_mm: float, insulated_mm: float
) -> TransverselyIsotropic | None:
    density = setup.densities["winding"].density_kg_m3
    try:
        return analytic_winding(dry.density_kg_m3, density, wire_mm / 1e3, insulated_mm / 1e3)
    except MaterialError:
        return None  # a weight that contradicts the wires is the density warning's business

"""What the sections are written from: each step's results, its forerunner and its shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from statorhom.errors import ResultsError
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.report.figures.block_picture import DrawnBlock
from statorhom.report.figures.shape_picture import DrawnStator
from statorhom.results import Constant, ModeResult, RegionResult, Results, StageResult
from statorhom.results.full_surface import full_surface
from statorhom.results.shape_file import ShapeFile, read_shape_file
from statorhom.study.message import one_line
from statorhom.study.regions import COUPON


@dataclass(frozen=True)
class DrawnShapes:
    """A step's shape file and the surface its pictures share."""

    file: ShapeFile
    body: DrawnStator | DrawnBlock

    def picture(self, number: int) -> bytes:
        """PNG of a mode."""
        return self.body.picture(self.file.displacement(self.body.surface, self.file.modes[number]))


@dataclass(frozen=True)
class Step:
    """One fabrication step; `coupon` says what a coupon is: a plate, a beam, a tube or a wing, None of a stator."""

    result: StageResult
    before: StageResult | None
    shapes: DrawnShapes | None
    coupon: str | None

    @property
    def is_block(self) -> bool:
        """Whether it is a coupon whose modes have no orders around a circumference."""
        return self.coupon is not None and self.coupon != "tube"

    @property
    def new_regions(self) -> dict[str, RegionResult]:
        """Regions whose material this step determined; the others are as they were a step before."""
        earlier = {} if self.before is None else self.before.regions
        return {
            name: region
            for name, region in self.result.regions.items()
            if name not in earlier or not _same_material(region, earlier[name])
        }

    @property
    def new_constants(self) -> list[tuple[str, str, Constant]]:
        """Region, name and figures of every constant that this step determined."""
        return [
            (region, name, constant)
            for region, material in self.new_regions.items()
            for name, constant in material.engineering.items()
        ]

    @property
    def paired(self) -> list[ModeResult]:
        """Modes both measured and simulated."""
        return [m for m in self.result.modes if m.measured_hz is not None and m.simulated_hz is not None]

    @property
    def drawn_modes(self) -> list[ModeResult]:
        """Paired modes that have a shape, each shape once."""
        found: dict[int, ModeResult] = {}
        count = 0 if self.shapes is None else len(self.shapes.file.modes)
        for mode in self.paired:
            if mode.shape is not None and 0 <= mode.shape < count:
                found.setdefault(mode.shape, mode)
        return sorted(found.values(), key=lambda m: (_test_index(self.result, m.test), m.simulated_hz or 0.0))


def steps_of(results: Results, folder: Path) -> tuple[Step, ...]:
    """All steps with their shapes.

    Raises
    ------
    ResultsError
        If a shape file lies outside the folder or is damaged; a missing one only leaves out its pictures.
    """
    befores = (None, *results.stages[:-1])
    kind = str(results.geometry.get("kind", COUPON))
    return tuple(
        Step(stage, before, _shapes(stage, folder), kind if stage.kind == COUPON else None)
        for stage, before in zip(results.stages, befores, strict=False)
    )


def coupon_of(steps: Sequence[Step]) -> str | None:
    """What the coupon of a study is; None for a stator's."""
    return steps[0].coupon if steps else None


def are_blocks(steps: Sequence[Step]) -> bool:
    """Whether the study is of a plate, a beam or a wing."""
    return bool(steps) and steps[0].is_block


def tests_of(modes: Sequence[ModeResult]) -> list[str]:
    """Names of the tests, in the order in which they appear."""
    return list(dict.fromkeys(mode.test for mode in modes))


def _test_index(stage: StageResult, test: str) -> int:
    return tests_of(stage.modes).index(test)


def _same_material(a: RegionResult, b: RegionResult) -> bool:
    return a.engineering == b.engineering and a.density_kg_m3 == b.density_kg_m3 and a.symmetry == b.symmetry


def _shapes(stage: StageResult, folder: Path) -> DrawnShapes | None:
    if stage.shapes is None:
        return None
    try:
        path = (folder / stage.shapes).resolve()
        inside = path.is_relative_to(folder.resolve())
        there = inside and path.is_file()
    except (OSError, ValueError):
        inside, there = False, False
    if not inside:
        raise ResultsError(
            one_line(
                f"{folder / 'results.json'}: stages.{stage.name}.shapes: {stage.shapes} is not a file of "
                "the results folder; run the study again"
            )
        )
    if not there:
        return None
    file = read_shape_file(path)
    surface = full_surface(file.mesh)
    body = DrawnBlock.of(surface) if isinstance(file.mesh, MirrorMesh) else DrawnStator.of(surface)
    return DrawnShapes(file, body)

"""The study file: steps of fabrication with their weights, tests and assumptions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from statorhom.study.identify_checks import check_identify
from statorhom.study.keys import Keys, Name, Title
from statorhom.study.material_tests import check_material_tests
from statorhom.study.message import quoted
from statorhom.study.nearest import hint
from statorhom.study.regions import (
    CONSTANTS,
    COUPON,
    COUPON_CONSTANTS,
    REGIONS,
    REGIONS_OF_KIND,
    STAGE_KINDS,
    Region,
    Symmetry,
)
from statorhom.study.stages import StageKeys
from statorhom.study.supports import SupportKeys
from statorhom.study.toml_file import read_toml

FREE = "free"


class StudyFile(Keys):
    """A study file."""

    schema_version: Literal[1] = Field(alias="schema")
    name: Name
    geometry: Title
    supports: tuple[Annotated[SupportKeys, Field(discriminator="kind")], ...] = ()
    stages: Annotated[tuple[StageKeys, ...], Field(min_length=1)]

    def support(self, name: str) -> SupportKeys | None:
        """The support of that name; None for "free".

        Raises
        ------
        KeyError
            Where there is none (in a validated study every test's support exists).
        """
        if name == FREE:
            return None
        return {support.name: support for support in self.supports}[name]

    def regions(self, stage_index: int) -> tuple[Region, ...]:
        """Regions that exist after a stage; the overhang always comes with the winding."""
        if self.stages[stage_index].kind == COUPON:
            return tuple(self.stages[stage_index].model.declared)
        present: set[Region] = {"lamination"}
        for stage in self.stages[: stage_index + 1]:
            present.update(REGIONS_OF_KIND[stage.kind], stage.model.declared)
        if "winding" in present:
            present.add("overhang")
        return tuple(region for region in REGIONS if region in present)

    def symmetry(self, stage_index: int, region: Region) -> Symmetry | None:
        """What is believed of a region at a stage: the latest declaration.

        Returns
        -------
        str or None
            None where nothing is declared; for an overhang this means the winding's own material.
        """
        for stage in reversed(self.stages[: stage_index + 1]):
            if region in stage.model.declared:
                return stage.model.declared[region]
        return None

    @model_validator(mode="after")
    def _consistent(self) -> StudyFile:
        _refuse_repeated("supports", [support.name for support in self.supports])
        _refuse_repeated("stages", [stage.name for stage in self.stages])
        _refuse_repeated("tests", [test.name for stage in self.stages for test in stage.tests])
        if any(stage.kind == COUPON for stage in self.stages):
            _check_coupon(self)
        else:
            _check_order(self)
        for index in range(len(self.stages)):
            _check_stage(self, index)
        return self


def read_study_file(path: Path) -> StudyFile:
    """Read a study file alone, without the files that it names.

    Parameters
    ----------
    path : Path
        The TOML file.

    Returns
    -------
    StudyFile

    Raises
    ------
    InputFileError
        One line with file, key and remedy.
    """
    return read_toml(path, StudyFile)


def _refuse_repeated(what: str, names: list[str]) -> None:
    for name in names:
        # results files are named after them, and some file systems ignore case
        if [other.casefold() for other in names].count(name.casefold()) > 1:
            raise ValueError(
                f"two {what} are named {quoted(name)}; give each its own name (case does not count)"
            )


def _check_coupon(study: StudyFile) -> None:
    """A test piece is made in one step and hangs free."""
    stage = next(stage for stage in study.stages if stage.kind == COUPON)
    if len(study.stages) > 1:
        raise ValueError(
            f"stages[{stage.name}].kind: a coupon is the one stage of its study; delete the other stages or use "
            f"one of {', '.join(STAGE_KINDS)}"
        )
    if not stage.model.declared:
        regions = " or ".join(REGIONS_OF_KIND[COUPON])
        raise ValueError(
            f'stages[{stage.name}].model: nothing is declared; say {regions} = "isotropic" (or another symmetry), '
            "or list a wing's materials in [stages.model.wing]"
        )
    for test in stage.tests:
        if test.support != FREE:
            raise ValueError(
                f"stages[{stage.name}].tests[{test.name}].support: coupons are computed free only; "
                f'hang it on soft cords and write support = "free"'
            )


def _check_order(study: StudyFile) -> None:
    ranks = [STAGE_KINDS.index(stage.kind) for stage in study.stages]
    for index in range(1, len(ranks)):
        if ranks[index] <= ranks[index - 1]:
            here, before = study.stages[index], study.stages[index - 1]
            raise ValueError(
                f"stages[{here.name}].kind: {here.kind} cannot follow {before.kind}; "
                f"list each step once in the order {', '.join(STAGE_KINDS)}"
            )


def _check_stage(study: StudyFile, index: int) -> None:
    stage = study.stages[index]
    known = [FREE, *(support.name for support in study.supports)]
    for test in stage.tests:
        if test.support not in known:
            raise ValueError(
                f"stages[{stage.name}].tests[{test.name}].support: there is no support "
                f"{quoted(test.support)}; {hint(test.support, known)}"
            )
    _check_declared_regions(study, index)
    if stage.tests:
        _check_all_declared(study, index)
    names = COUPON_CONSTANTS if stage.kind == COUPON else CONSTANTS
    check_identify(f"stages[{stage.name}]", stage.identify, _symmetries(study, index), names)
    check_material_tests(f"stages[{stage.name}]", stage.material_tests, _symmetries(study, index), names)


def _check_declared_regions(study: StudyFile, index: int) -> None:
    """A stage speaks of what it adds or changes, and of what skipped steps before it would have added."""
    stage = study.stages[index]
    if stage.kind == COUPON:
        return  # which region it has is told by the geometry file
    earlier = study.regions(index - 1) if index else ()
    rank = STAGE_KINDS.index(stage.kind)
    skipped = {region for kind in STAGE_KINDS[:rank] for region in REGIONS_OF_KIND[kind]} - set(earlier)
    allowed = [region for region in REGIONS if region in skipped or region in REGIONS_OF_KIND[stage.kind]]
    for region in stage.model.declared:
        if region not in allowed:
            raise ValueError(
                f"stages[{stage.name}].model.{region}: a {stage.kind} step does not change this region; "
                f"declare it in the step that does (here: {', '.join(allowed)})"
            )


def _check_all_declared(study: StudyFile, index: int) -> None:
    for region in study.regions(index):
        if region != "overhang" and study.symmetry(index, region) is None:
            name = study.stages[index].name
            raise ValueError(
                f"stages[{name}].model: nothing is declared for {region}, but the stage has tests; "
                f'add {region} = "isotropic" (or another symmetry) where the region is added'
            )


def _symmetries(study: StudyFile, index: int) -> dict[str, Symmetry]:
    found = {region: study.symmetry(index, region) for region in study.regions(index)}
    return {region: symmetry for region, symmetry in found.items() if symmetry is not None}

"""The true machine before anything is concealed in it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.conceal.identified import Known
from statorhom.conceal.scatter import scatter
from statorhom.conceal.true_materials import drawn_density, drawn_material
from statorhom.conceal.truth import Case, TrueMaterial, TrueStage, TrueTest
from statorhom.errors import InputFileError
from statorhom.geometry.stator import StatorGeometry, stator_geometry
from statorhom.materials.density import REGION_OF_STEP
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.regions import Region
from statorhom.study.study_file import StudyFile

SCALE_KG = 1e-3  # what the scale shows


def start_case(
    path: Path,
    study: StudyFile,
    geometry: GeometryFile,
    rng: np.random.Generator,
    *,
    tables: bool | None = None,
    wide: bool = False,
    known: Known | None = None,
) -> Case:
    """Draw a machine whose regions are as the study declares them.

    Parameters
    ----------
    path : of the study, for messages.
    study, geometry : contents of the files.
    rng : source of the numbers.
    tables : whether tests become modal tables; None: as in the study.
    wide : see `statorhom.conceal.true_materials.drawn_material`.
    known : materials that are not drawn, by stage and region.

    Raises
    ------
    StatorhomError
        If the study has no tests, or the geometry does not allow its steps.
    """
    if not any(stage.tests for stage in study.stages):
        raise InputFileError(
            f"{path}: no stage has tests, so there is nothing to conceal an effect in; add a test"
        )
    true = stator_geometry(geometry, path.parent / study.geometry)
    materials = _Materials(study, rng, wide, known or {})
    waves = scatter(rng)
    stages = []
    for index, keys in enumerate(study.stages):
        kinds = tuple(stage.kind for stage in study.stages[: index + 1])
        materials.step(index)
        tests = tuple(
            TrueTest(
                test.name,
                study.support(test.support),
                (test.modal_table is not None) if tables is None else tables,
                force_n=test.force_level_n or 1.0,
            )
            for test in keys.tests
        )
        scale = _mass(true, kinds, materials.found)
        stages.append(TrueStage(keys, kinds, dict(materials.found), scale, waves, tests))
    typed = study.model_dump(mode="json", by_alias=True, exclude_unset=True)
    case = Case(
        true, tuple(stages), typed, geometry.model_dump(mode="json", by_alias=True, exclude_unset=True)
    )
    return _weighed(case, rng)


class _Materials:
    """Regions' materials as the steps add and change them."""

    def __init__(self, study: StudyFile, rng: np.random.Generator, wide: bool, known: Known) -> None:
        self.study, self.rng, self.wide, self.known = study, rng, wide, known
        self.found: dict[str, TrueMaterial] = {}
        self.copper = 0.0

    def step(self, index: int) -> None:
        """Add what a stage adds."""
        kind = self.study.stages[index].kind
        region = REGION_OF_STEP[kind]
        density = drawn_density(kind, self.rng)
        if region == "winding":
            self.copper = self.copper or (density if kind == "wound" else drawn_density("wound", self.rng))
            density = self.copper if kind == "wound" else self.copper + density
        self.found[region] = self._drawn(index, region, density)
        if region == "winding":
            has_own = self.study.symmetry(index, "overhang") is not None
            self.found["overhang"] = (
                self._drawn(index, "overhang", density) if has_own else self.found["winding"]
            )

    def _drawn(self, index: int, region: Region, density: float) -> TrueMaterial:
        keys = self.study.stages[index]
        if (keys.name, region) in self.known:
            return self.known[keys.name, region]
        kind = keys.kind
        symmetry = self.study.symmetry(index, region) or "isotropic"
        return drawn_material(kind, region, symmetry, density, self.rng, wide=self.wide)


def _mass(geometry: StatorGeometry, kinds: tuple[str, ...], materials: Mapping[str, TrueMaterial]) -> float:
    volumes = geometry.step(kinds).exact_volumes()
    return float(sum(materials[region].density * volume for region, volume in volumes.items()))


def _weighed(case: Case, rng: np.random.Generator) -> Case:
    """Type what the scale shows."""
    stages: list[dict[str, Any]] = []
    for stage, keys in zip(case.stages, case.study["stages"], strict=True):
        reading = stage.scale_kg + stage.keys.mass_sd_kg * float(rng.uniform(-0.5, 0.5))
        shown = round(reading / SCALE_KG) * SCALE_KG
        stages.append({**keys, "mass_kg": round(shown, 6), "mass_sd_kg": stage.keys.mass_sd_kg})
    return case.with_study({**case.study, "stages": stages})

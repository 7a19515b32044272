"""All tested steps of a study with their common constants."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.stages.constants import Constants
from statorhom.diagnose.stages.masses import stage_densities
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.geometry.tested_object import RingGeometry
from statorhom.identify.stages.stage_materials import DENSITY
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.model.affine import Materials
from statorhom.model.kept import Kept
from statorhom.physics.action import Action
from statorhom.study.study import StudyFiles

MATERIALS = 16  # that are kept
FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StudyModel:
    """What predictions come from.

    Parameters
    ----------
    files : the study.
    geometry : of the stator or tube.
    constants : of all steps.
    stages : the tested ones.
    effects : what the study declares beside materials and supports.
    dimensions : "section.key" → value, which the files have otherwise (`statorhom.diagnose.stages.redrawn_study`).
    as_typed : the study as they have it; None where this is that.
    """

    files: StudyFiles
    geometry: RingGeometry
    constants: Constants
    stages: tuple[StageModel, ...]
    effects: tuple[Action, ...] = ()
    dimensions: Mapping[str, float] = field(default_factory=dict)
    as_typed: StudyModel | None = None
    _volumes: dict[int, Mapping[str, float]] = field(default_factory=dict, repr=False)
    # predictions, damping and slopes ask for the same ones in turn
    _latest: Kept = field(default_factory=partial(Kept, MATERIALS), init=False, repr=False)

    def masses(self, values: Mapping[str, float], corrected: Mapping[str, float]) -> dict[str, float]:
        """Stage → weight, corrected where an effect says so."""
        weights = {s.name: values[f"{s.name}:mass_kg"] for s in self.files.study.stages}
        return weights | dict(corrected)

    def materials(
        self, stage: StageModel, values: Mapping[str, float], masses: Mapping[str, float]
    ) -> Materials:
        """Declared materials of a stage.

        Raises
        ------
        MassError, MaterialError
            If no material has these constants.
        """
        return self.declared(stage.setup, values, masses)

    def declared(
        self, setup: StageSetup, values: Mapping[str, float], masses: Mapping[str, float]
    ) -> Materials:
        """The same before the stage has a model; the last ones are kept."""
        mark = setup.index, tuple(values.values()), tuple(masses.values())
        return self._latest.once(mark, lambda: self._materials(setup, values, masses))

    def _materials(
        self, setup: StageSetup, values: Mapping[str, float], masses: Mapping[str, float]
    ) -> Materials:
        index = setup.index
        density = stage_densities(self.files, masses, index, self.volumes(setup))
        own = self.constants.stage_values(values, index)
        sources = {region.source for region in setup.materials.regions}
        weighed = {s: density["winding" if s == "overhang" else s] for s in sources}
        return setup.materials.of(own | {f"{s}.{DENSITY}": rho for s, rho in weighed.items()})

    def volumes(self, setup: StageSetup) -> Mapping[str, float]:
        """Volumes of a step's regions (m³), computed once."""
        if setup.index not in self._volumes:
            assert setup.step is not None
            self._volumes[setup.index] = setup.step.exact_volumes()
        return self._volumes[setup.index]

    def with_stages(self, stages: tuple[StageModel, ...]) -> StudyModel:
        """The same with other stages."""
        return replace(self, stages=stages)

"""The study of a coupon or a wing with its constants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from statorhom.diagnose.coupons.body_stage import BodyStage
from statorhom.diagnose.stages.constants import Constants
from statorhom.identify.stages.stage_materials import DENSITY
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.model.affine import Materials
from statorhom.physics.action import Action
from statorhom.study.study import StudyFiles

AXES = {"length_mm": 0, "width_mm": 1, "thickness_mm": 2, "height_mm": 2}
Scale = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class BodyStudy:
    """What predictions come from.

    Parameters
    ----------
    files : the study.
    constants : of its one stage.
    stages : the stage, once it has a model.
    effects : what the study declares beside materials.
    """

    files: StudyFiles
    constants: Constants
    stages: tuple[BodyStage, ...] = ()
    effects: tuple[Action, ...] = ()

    def with_stages(self, stages: tuple[BodyStage, ...]) -> BodyStudy:
        """The same with another model."""
        return replace(self, stages=stages)

    def materials(
        self, setup: StageSetup, values: Mapping[str, float], actions: Sequence[Action] = ()
    ) -> Materials:
        """Materials as the actions make them: what was weighed fills the body's true volume.

        Raises
        ------
        MassError, MaterialError
            If no material has these constants.
        """
        weighed = values[f"{setup.keys.name}:mass_kg"]
        for action in actions:
            weighed = action.masses.get(setup.keys.name, weighed)
        x, y, z = self.scale(actions)
        more = (weighed - setup.keys.mass_kg) / setup.keys.mass_sd_kg
        own = self.constants.stage_values(values, setup.index)
        sources = {region.source for region in setup.materials.regions}
        # a density's standard deviation is the weight's, per volume that takes up what the weight changes by
        dense = {
            f"{s}.{DENSITY}": (d.density_kg_m3 + more * d.density_sd_kg_m3) / (x * y * z)
            for s, d in setup.densities.items()
            if s in sources
        }
        return setup.materials.of(own | dense)

    def scale(self, actions: Sequence[Action]) -> Scale:
        """By which the body is longer along x, y, z than its file says."""
        found = [1.0, 1.0, 1.0]
        for action in actions:
            for place, value in action.dimensions.items():
                section, _, key = place.partition(".")
                found[AXES[key]] *= value / getattr(getattr(self.files.drawing, section), key)
        return found[0], found[1], found[2]

"""One explanation of all tests of a coupon or a wing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.coupons.body_features import body_features
from statorhom.diagnose.coupons.body_pairing import Partners, body_partners, missed
from statorhom.diagnose.coupons.body_prediction import PredictedBody, predicted_body
from statorhom.diagnose.coupons.body_stage import BodyStage
from statorhom.diagnose.coupons.body_study import BodyStudy
from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BodyHypothesis(AnyHypothesis):
    """Of a body without circumferential order: an effect acts by its K and M on the modal basis.

    Parameters
    ----------
    study : the model.
    held : test → number of the predicted mode of every measured one; None to pair anew.
    """

    study: BodyStudy
    held: Mapping[str, Partners] | None = None

    def paired(self, z: FloatArray) -> BodyHypothesis:
        """With the pairing held as it is at z.

        Raises
        ------
        StatorhomError
            If no body has these constants.
        """
        held: dict[str, Partners] = {}
        cost = 0.0
        for stage in self.study.stages:
            for test in stage.tests:
                predicted = self._predicted(stage, test, z)
                held[test.name] = body_partners(test, predicted, by_rank=self.discrepancy > 0)
                cost += missed(test, predicted, held[test.name])
        return replace(self, held=held, missed=cost)

    def sees(self, feature: Feature) -> bool:
        """Shapes too where valleys are wide: a body has fewer frequencies than places where something may be."""
        if self.discrepancy and feature.kind == "shape":
            return feature.group not in self.left_out
        return super().sees(feature)

    @property
    def tests(self) -> tuple[tuple[BodyStage, str], ...]:
        """Stage and name of every test."""
        return tuple((stage, test.name) for stage in self.study.stages for test in stage.tests)

    def test(self, name: str) -> MeasuredTest:
        """The test of a name."""
        return next(t for stage in self.study.stages for t in stage.tests if t.name == name)

    def predictions(self, z: FloatArray) -> dict[str, PredictedBody]:
        """Modes of every test.

        Raises
        ------
        StatorhomError
            If no body has these constants.
        """
        return {name: self._predicted(stage, self.test(name), z) for stage, name in self.tests}

    def features_of_all(self, z: FloatArray) -> list[Feature]:
        """Features whether seen or not, at a held pairing."""
        return self.features_told(z, self.predictions(z))

    def features_told(self, z: FloatArray, told: Mapping[str, PredictedBody]) -> list[Feature]:
        """The same from predictions that are known."""
        assert self.held is not None
        found: list[Feature] = []
        actions = self.actions(z)
        for stage, name in self.tests:
            sensor = sum(a.sensor_kg for a in actions if a.touches(stage.name, name))
            found += body_features(
                stage, self.test(name), self.held[name], told[name], sensor, self.discrepancy
            )
        return found

    def _predicted(self, stage: BodyStage, test: MeasuredTest, z: FloatArray) -> PredictedBody:
        values = self.study.constants.values(z[: self.constants])
        return predicted_body(self.study, stage, test, values, self.actions(z))

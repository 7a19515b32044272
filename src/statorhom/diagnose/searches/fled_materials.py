"""Materials that have fled from what they are: they explain by being unusual, or by being sure of nothing.

A winding so soft that no mesh shows its modes well is sure of none of them. There is nothing left to explain then, and
only the evidence tells that it says nothing.
"""

from __future__ import annotations

from statorhom.diagnose.features.mode_features import doubt_by
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.searches.typical_materials import with_typical_materials
from statorhom.diagnose.stages.constants import new_constants
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.identify.residuals.model_error import ModelError
from statorhom.study.study_file import FREE


def typical_where_fled(
    of: Refit[Hypothesis], stage: StageModel, least: float, gross: int = 0
) -> Refit[Hypothesis] | None:
    """The same in the model of a step's typical materials; None where its own have not fled, or no stator has those.

    Parameters
    ----------
    of, stage : a refit, and one of its steps.
    least : log evidence that typical materials have to gain, to first order, if they explain as much.
    gross : how many of the rows that are off most are errors of the measurement, which no material explains.
    """
    # a typical model takes seconds
    if _loss(of, stage, gross) <= least:
        return None
    typical = with_typical_materials(of, stage.name)
    if typical is None or _loss(of, stage, gross, _same_stage(typical, stage).error) <= least:
        return None
    return typical


def _loss(of: Refit[Hypothesis], stage: StageModel, gross: int, typical: ModelError | None = None) -> float:
    """Log evidence that a step's own materials lose against typical ones that explain its free frequencies.

    They are unusual, they leave more than noise does, and the mesh may be less sure of their modes.

    Parameters
    ----------
    of, stage : a refit, and the step.
    gross : as of `typical_where_fled`.
    typical : the mesh's error with typical materials; one that is sure of every mode by default.
    """
    own = new_constants(of.hypothesis.study.constants, stage.name)
    free = {t.name for t in stage.tests if t.support == FREE}
    unusual = 0.5 * float(of.hypothesis.prior_weights[own] @ of.z[own] ** 2)
    seen = [f for f in of.hypothesis.features(of.z) if f.test in free and f.kind == "frequency"]
    left = sorted((0.5 * max(0.0, f.residual**2 - 1.0) for f in seen), reverse=True)
    return (
        unusual
        + sum(left[gross:])
        + sum(f.doubt - (0.0 if typical is None else doubt_by(f, typical)) for f in seen)
    )


def _same_stage(of: Refit[Hypothesis], stage: StageModel) -> StageModel:
    return next(s for s in of.hypothesis.study.stages if s.name == stage.name)

"""Constants of materials whose stiffness varies from place to place: what varies is in proportion to them.

Frequencies may tell little of such a constant (E_z of a stack) while the shapes of a graded one tell much.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.any_hypothesis import AnyHypothesis
from statorhom.diagnose.hypothesis import Hypothesis

FloatArray = npt.NDArray[np.float64]


def graded_constants(h: AnyHypothesis, z: FloatArray) -> frozenset[int]:
    """Numbers of the constants that a hypothesis grades."""
    if not isinstance(h, Hypothesis):
        return frozenset()
    graded = [a for a in h.actions(z) if a.graded]
    stages = [s for s in h.study.stages if any(a.touches(s.name, t.name) for a in graded for t in s.tests)]
    owned = {name for stage in stages for name in h.study.constants.owners[stage.setup.index].values()}
    return frozenset(j for j, name in enumerate(h.study.constants.names) if name in owned)

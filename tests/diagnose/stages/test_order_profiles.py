"""What of a basis's motion is seen on the surface."""

from __future__ import annotations

import numpy as np
import pytest
from small_stage import stage_of

from statorhom.diagnose.stages.order_profiles import radial_motion
from statorhom.model.free_modes import total_mass


def test_it_is_what_makes_named_modes_visible() -> None:
    """The named modes' visibility comes from another basis, of which every harmonic is solved by itself."""
    stage = stage_of(("stack",), 9000.0)
    trained = stage.trained(())
    seen = radial_motion(stage, trained)
    assert seen.shape == trained.basis.values.shape
    mass = total_mass(stage.model, stage.reference)
    found = {key: mass * seen[place.numbers] for key, place in trained.columns.items()}
    visible = {key: mode.visibility for key, mode in stage.reference_keys.items()}
    assert min(visible.values()) < 0.5 < max(visible.values())
    for key, motion in found.items():
        # both families of a doublet move the surface alike
        assert np.minimum(1.0, motion) == pytest.approx([visible[key]] * len(motion), rel=0.02, abs=1e-4)
    assert radial_motion(stage, trained) is seen

"""How far a held line sinks in, against meshes that let it sink in farther."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from small_stage import stage_of
from small_stators import stator_mesh

from statorhom.diagnose.features.mode_features import own_sd
from statorhom.diagnose.features.supported import OWN, SupportedReference, elastic_keys, supported_reference
from statorhom.diagnose.predicted.sinking import held_shares, sinking
from statorhom.identify.residuals.model_error import ModelError
from statorhom.materials.hooke import Hooke
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.mesh import uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.broken.attachments import lump, springs
from statorhom.model.broken.solve import solve_broken
from statorhom.model.supported_modes import solve_supported
from statorhom.model.supports import support_on
from statorhom.study.supports import FaceSupport, LineSupport

METAL = Isotropic(2e11, 0.3).hooke()
LOOSE = TransverselyIsotropic(180e9, 6e9, 0.28, 0.3, 3e9).hooke()
RIGID = LineSupport(name="clamped", kind="lines", angles_deg=(150.0, 210.0), declared="rigid")
ACROSS, ALONG = np.array([[0.0, 0.5], [0.0, 0.0]]), np.array([[0.0, 0.0], [0.0, 0.5]])


def line(stiffness: float, ratio: float = 1.0) -> LineSupport:
    return LineSupport(
        name="clamp",
        kind="lines",
        angles_deg=(0.0,),
        declared="elastic",
        normal_stiffness_n_per_m2=stiffness,
        tangential_ratio=ratio,
    )


def test_a_line_that_nothing_bends_sinks_into_the_metal() -> None:
    assert sinking(line(1e9), ACROSS, METAL) == pytest.approx([0.0, 0.0], abs=0.3 * OWN)
    # the same force in a rigid line: its springs hold the less of the energy the stiffer they are
    rigid = [sinking(line(k), ACROSS * 1e11 / k, METAL)[1] for k in (1e12, 1e14)]
    assert rigid[0] == pytest.approx(rigid[1]) and rigid[0] > 5 * OWN
    face = FaceSupport(name="clamp", kind="faces", faces=("lower_end",), declared="rigid")
    assert sinking(face, ACROSS, METAL).tolist() == [0.0, 0.0]


def test_what_is_dragged_along_the_axis_sinks_in_between_the_sheets() -> None:
    across, along = (sinking(line(1e11), held, METAL)[1] for held in (ACROSS, ALONG))
    assert along == pytest.approx(across, rel=0.4)
    across, along = (sinking(line(1e11), held, LOOSE)[1] for held in (ACROSS, ALONG))
    assert along == pytest.approx(across * 2e11 / (2 * 3e9))


def reference(core: Hooke, error: ModelError | None = None) -> SupportedReference:
    stage = stage_of(("stack",), 9000.0, {"lamination": Material(core, 7650.0)})
    object.__setattr__(stage, "error", error or ModelError())
    test = SimpleNamespace(
        name="held", support="clamped", shapes=None, modes=(SimpleNamespace(frequency_hz=2500.0),)
    )
    found = supported_reference(stage, test, elastic_keys(RIGID), [], "held")  # type: ignore[arg-type]
    assert found is not None
    return found


def test_a_finer_mesh_lets_a_loose_stack_sink_in_where_it_is_said_to() -> None:
    """Beyond what the finer mesh takes off all modes alike."""
    found, logs = reference(LOOSE), []
    for mesh in (stator_mesh(12), stator_mesh(12, ("stack",), uniform(2))):
        support = support_on(mesh, elastic_keys(RIGID))
        solved = solve_supported(
            assemble(mesh), {"lamination": Material(LOOSE, 7650.0)}, support, highest_hz=3000.0
        )
        logs.append(np.log(solved.frequencies_hz[:9]))
    falls, said = logs[0] - logs[1], found.sinking[:9]
    assert logs[0] == pytest.approx(found.log_f[:9], abs=1e-3)
    assert np.corrcoef(falls, said)[0, 1] > 0.85
    assert 0.3 < np.polyfit(said, falls, 1)[0] < 2.0  # standard deviations from one mesh to the other


def test_a_supported_mode_is_known_no_better_than_the_free_modes_it_is_made_of() -> None:
    coarse = ModelError.of_factors({(2, 0, 0): 0.9})
    sure, unsure = reference(METAL), reference(METAL, coarse)
    share = unsure.shares[(2, 0, 0)]
    added = unsure.own**2 - sure.own**2
    assert np.max(share) > 0.5
    of_mode = own_sd(coarse, (2, 0, 0)) ** 2 - own_sd(ModelError(), (2, 0, 0)) ** 2
    assert np.all(added >= share**2 * of_mode * (1 - 1e-9))


@pytest.mark.parametrize("ratio", [0.7, 0.0])
def test_shares_of_springs_are_their_energies(ratio: float) -> None:
    """Also of springs that hold nothing tangentially, whose motion the coupled modes do not know."""
    stage = stage_of(("stack",), 9000.0)
    keys = RIGID.model_copy(
        update={"declared": "elastic", "normal_stiffness_n_per_m2": 1e10, "tangential_ratio": ratio}
    )
    held = springs(stage.model.mesh, support_on(stage.model.mesh, keys).points)
    attached = [held, lump(stage.model.mesh, 0.3, 0.02, 0.05)]
    modes = solve_broken(stage.below(5000.0).basis, attached, tolerance=None)
    motion = modes.motion(held.points)
    energy = np.einsum(
        "pdm,pdm->dm", motion, (held.stiffness @ motion.reshape(-1, len(modes))).reshape(motion.shape)
    )
    found = held_shares(modes, attached)
    assert found[0] == pytest.approx((energy[0] + energy[1]) / modes.eigenvalues, rel=1e-3, abs=1e-6)
    assert found[1] == pytest.approx(energy[2] / modes.eigenvalues, rel=1e-3, abs=1e-6)
    assert np.all(found[1] == 0.0) == (ratio == 0.0)

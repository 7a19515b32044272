"""Shapes that lean to one end: predicted by amplitudes of a basis, checked by the motion of points."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from small_stage import stage_of

from statorhom.diagnose.features.lean import MOST_SD, lean_features, profile_lean
from statorhom.diagnose.measured.feature import MOST
from statorhom.diagnose.measured.measured_test import MeasuredTest, PlaneShifts, Sideband
from statorhom.diagnose.stages.broken_response import responses
from statorhom.diagnose.stages.order_profiles import reference_profiles
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.broken.attachments import lump
from statorhom.model.broken.named_response import nearest_pair
from statorhom.model.broken.solve import solve_broken
from statorhom.model.surface import surface_points

HIGHEST_HZ = 9000.0
KEY = (2, 0, 0)
PLANES, ANGLES = 4, 24


@pytest.fixture(scope="module")
def stage() -> StageModel:
    """A stack on which shapes were measured in four planes."""
    bare = stage_of(("stack",), HIGHEST_HZ)
    z_m = np.linspace(0.1, 0.9, PLANES) * bare.model.mesh.length
    shapes: Any = SimpleNamespace(z_m=z_m)
    return replace(bare, tests=(MeasuredTest(0, "t", "free", (), shapes=shapes),))


def seen_lean(stage: StageModel, mass_kg: float, z_m: float) -> float:
    """Of (2, 0) with a lump: the mean of its two modes, by a transform of the motion of points around every plane."""
    trained = stage.trained(())
    modes = solve_broken(trained.basis, [lump(stage.model.mesh, 0.4, z_m, mass_kg)], tolerance=None)
    theta = 2 * np.pi * np.arange(ANGLES) / ANGLES
    z, around = (a.ravel() for a in np.meshgrid(stage.heights_m, theta, indexing="ij"))
    radial = modes.motion(surface_points(stage.model.mesh, around, z))[:, 0].reshape(PLANES, ANGLES, -1)
    waves = np.einsum("pam,a->pm", radial, np.exp(-2j * theta))
    pair = nearest_pair(modes, trained.columns[KEY])
    assert pair is not None
    leans = []
    for i in pair.modes:
        along = (waves[:, i] * np.exp(-0.5j * np.angle(np.sum(waves[:, i] ** 2)))).real
        mean, slope = np.mean(along), np.polyfit(np.linspace(-1, 1, PLANES), along, 1)[0]
        leans.append(slope / mean)
    return float(np.mean(leans))


@pytest.mark.parametrize("part", [0.1, 0.9])
def test_a_lump_near_an_end_makes_shapes_lean(stage: StageModel, part: float) -> None:
    z_m, mass = part * stage.model.mesh.length, 0.02
    profile = responses(stage, [lump(stage.model.mesh, 0.4, z_m, mass)])[KEY].profile
    assert profile is not None
    heights = np.array(stage.heights_m)
    lean, seen = profile_lean(profile, heights, heights), seen_lean(stage, mass, z_m)
    assert abs(lean) > 0.003  # what it has to show
    assert lean == pytest.approx(seen, rel=0.05)


def test_a_stator_that_is_its_own_mirror_image_does_not_lean(stage: StageModel) -> None:
    heights = np.array(stage.heights_m)
    for key, profile in reference_profiles(stage, stage.heights_m).items():
        if key[0] >= 2 and key[1] == 0:
            assert abs(profile_lean(profile, heights, heights)) < 1e-6


def sideband(lean: float, sd: float = 1e-3) -> Sideband:
    """Of (2, 0): its own amplitude 1 at 30°, and a lean."""
    turned = np.array([np.cos(np.pi / 3), np.sin(np.pi / 3)])
    parts = np.zeros((2, 2, 5))
    parts[:, 0, 2], parts[:, 1, 2] = turned, lean * turned
    z_m = np.linspace(0.0, 0.1, PLANES)
    return Sideband("1", 2, np.pi / 6, *parts, np.full((2, 5), sd), z_m)


def features(
    shape: Sideband,
    profile: np.ndarray | None,
    *,
    axial: int = 0,
    loss_factor: float = 0.01,
    shift: float = 0.0,
    shift_sd: float = 1e-6,
) -> list[Any]:
    mode: Any = SimpleNamespace(label="1", axial=axial, loss_factor=loss_factor)
    moved = PlaneShifts(
        "1", shape.z_m, shift * np.array([1.0, -1.0, -1.0, 1.0]), np.full(PLANES, shift_sd), 0.0
    )
    test = MeasuredTest(0, "t", "free", (mode,), shifts=(moved,), sidebands=(shape,))
    predicted: Any = {KEY: SimpleNamespace(profile=profile)}
    return lean_features(test, [mode], [KEY], predicted, shape.z_m.tolist())


def test_the_lean_of_a_shape_is_its_odd_part_over_the_even_one() -> None:
    (found,) = features(sideband(0.03), 5.0 * (1 + 0.02 * np.linspace(-1, 1, PLANES)))
    assert (found.kind, found.measured) == ("lean", pytest.approx(0.03))
    assert found.predicted == pytest.approx(0.02)
    assert found.sd == pytest.approx(np.linalg.norm([1e-3, 0.004, 0.006, 0.003]))


def test_a_lean_that_is_far_off_pulls_no_harder_than_one_that_is_hardly_off() -> None:
    """Near (2, 2) a lump of 0.8 times its mass made (4, 0) lean by 0.13 instead of 0.01: 12 standard deviations."""
    (found,) = features(sideband(0.01), 5.0 * (1 + 0.2 * np.linspace(-1, 1, PLANES)))
    assert abs(found.measured - found.predicted) > 20 * found.sd
    assert found.residual == pytest.approx(-MOST["lean"], rel=0.01)


def test_noisy_shapes_and_those_counted_otherwise_have_none() -> None:
    straight = np.ones(PLANES)
    assert not features(sideband(0.03, sd=1.1 * MOST_SD), straight)
    assert not features(sideband(0.03), straight, axial=1)


def test_what_leans_too_much_is_broad_or_taken_at_poles_that_move_has_none() -> None:
    """Two modes under one broad peak showed a lean of -0.93; a sensor of 8 g on 10 kg made (4, 0) lean by 0.026."""
    straight = np.ones(PLANES)
    assert len(features(sideband(0.03), straight)) == 1
    assert not features(sideband(-0.93), straight)
    assert not features(sideband(0.03), straight, loss_factor=0.09)
    assert len(features(sideband(0.03), straight, shift=1e-6)) == 1
    assert not features(sideband(0.03), straight, shift=5e-4)


def test_poles_that_only_noise_moves_say_nothing_against_a_lean() -> None:
    """A weak (4, 0) whose poles were known to 6e-5 differed by 1.9e-4 from plane to plane: leans of 0.2 were lost."""
    straight = np.ones(PLANES)
    assert len(features(sideband(0.03), straight, shift=1e-4, shift_sd=6e-5)) == 1
    assert not features(sideband(0.03), straight, shift=5e-4, shift_sd=6e-5)


def test_points_beyond_the_drawn_core_are_moved_to_its_end() -> None:
    """A length that is too short in the drawing has to be found, so the diagnosis must begin."""
    test = MeasuredTest(0, "t", "free", (), sidebands=(sideband(0.03),))
    assert test.on_core(0.08).sidebands[0].z_m == pytest.approx([0.0, 0.1 / 3, 0.2 / 3, 0.08])
    assert test.on_core(0.2).sidebands[0].z_m == pytest.approx(test.sidebands[0].z_m)


def test_a_partner_that_vanishes_says_nothing_of_shapes() -> None:
    (found,) = features(sideband(0.03), None)
    assert found.lost
    assert found.residual == 0.0

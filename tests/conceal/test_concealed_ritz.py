"""Modes of true stators against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from concealed_rings import COARSE, RING, free_test, stage, study_keys
from statorhom.conceal.ground import StageGround, stage_ground
from statorhom.conceal.ritz import Losses, RitzModes, ritz_modes
from statorhom.conceal.start import start_case
from statorhom.conceal.truth import Absorber
from statorhom.model.broken.attachments import point_springs
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.study_file import StudyFile

LOSSES = Losses({"lamination": 0.006}, {0: 0.05})


@pytest.fixture(scope="module")
def ground(tmp_path_factory: pytest.TempPathFactory) -> StageGround:
    study = StudyFile.model_validate(study_keys([stage("stack", [free_test("t", is_table=True)], 2.0)]))
    geometry = GeometryFile.model_validate(RING)
    path = tmp_path_factory.mktemp("ring") / "study.toml"
    case = start_case(path, study, geometry, np.random.default_rng(2))
    return stage_ground(case.geometry, case.stages[0], COARSE)


@pytest.fixture(scope="module")
def plain(ground: StageGround) -> RitzModes:
    return ritz_modes(ground, [], [], LOSSES)


def test_bodies_weigh_what_the_stator_weighs(ground: StageGround, plain: RitzModes) -> None:
    """A static push at the centre's height moves the mass as Newton says: Σ φ² of the six bodies is (1/m + …)."""
    mass = sum(m.density * ground.model.volumes[r] for r, m in ground.materials.items())
    angles = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    motion = plain.motion(angles, np.full(8, ground.mesh.length / 2))[:, 0]
    bodies = plain.eigenvalues == 0
    assert np.count_nonzero(bodies) == 6
    assert np.sum(motion[:, bodies] ** 2, axis=1) == pytest.approx(np.full(8, 1 / mass), rel=1e-5)


def test_without_springs_all_modes_have_the_regions_loss(plain: RitzModes) -> None:
    assert plain.loss_factors[plain.in_band] == pytest.approx(0.006)
    assert np.all(plain.loss_factors[plain.eigenvalues == 0] == 0)


def test_springs_add_their_share_of_loss(ground: StageGround) -> None:
    spring = point_springs(ground.mesh, np.array([0.3]), np.array([0.02]), np.array([1e8, 0.0, 0.0]))
    eta = ritz_modes(ground, [spring], [], LOSSES).loss_factors
    assert np.all((eta < 0.05 + 1e-9) & (eta >= 0))
    assert eta.max() > 0.012


def test_an_absorber_obeys_its_secular_equation(ground: StageGround, plain: RitzModes) -> None:
    absorber = Absorber(0.7, 0.02, 0.02, 1.4, 0.05)
    found = ritz_modes(ground, [], [], LOSSES, [absorber])
    phi = plain.motion(np.array([absorber.angle]), np.array([absorber.z]))[0, 0]
    own = (2 * np.pi * 1.4 * ground.elliptic_hz) ** 2
    elastic = found.eigenvalues[found.in_band]
    near = elastic[np.argsort(np.abs(elastic - own))[:4]]
    checked = 0
    for value in near:
        gap = np.abs(plain.eigenvalues - value).min() / value
        if gap < 1e-6:
            continue  # a mode with its node at the absorber
        flexibility = np.sum(phi**2 / (plain.eigenvalues - value))
        assert value * absorber.mass_kg * flexibility == pytest.approx(1 - value / own, rel=1e-4, abs=1e-6)
        checked += 1
    assert checked >= 2


def test_a_modulus_that_grows_with_frequency_meets_every_mode_at_its_own(
    ground: StageGround, plain: RitzModes
) -> None:
    slope = 0.3
    found = ritz_modes(ground, [], [], LOSSES, slopes={"lamination": slope})
    before = plain.modes.frequencies_hz[plain.in_band]
    after = found.modes.frequencies_hz[found.in_band][: len(before)]
    factor = 1 + slope * np.log10(after / 1000.0)
    # all of the stator is one material: λ follows its modulus
    assert after[:6] == pytest.approx((before[: len(after)] * np.sqrt(factor))[:6], rel=1e-6)

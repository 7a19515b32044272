"""A plate's residuals: slopes, pairing with and without shapes, and what a lump does to them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from body_studies import plate_hypothesis, write_plate

from statorhom.diagnose.coupons.body_hypothesis import BodyHypothesis
from statorhom.diagnose.fits.derivatives import difference, jacobian
from statorhom.diagnose.measured.measured_test import MeasuredPoints
from statorhom.diagnose.stages.constants import new_constants, study_constants
from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.stages.stage_setup import stage_setup
from statorhom.physics.library import all_candidates
from statorhom.study.study import load_study

FREQUENCIES = np.array([146.7, 277.9, 387.2, 407.7, 481.4])
GRID = np.array([[x, y, 0.004] for x in np.linspace(0.02, 0.28, 6) for y in np.linspace(0.02, 0.18, 4)])
LUMP = {"mass_kg": 0.01, "x_m": 0.22, "y_m": 0.13}


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> BodyHypothesis:
    return plate_hypothesis(tmp_path_factory.mktemp("plain"), FREQUENCIES)


@pytest.fixture(scope="module")
def seen(plain: BodyHypothesis) -> BodyHypothesis:
    """The same with shapes at points, those of the model itself with a lump."""
    upwards = np.tile([0.0, 0.0, 1.0], (len(GRID), 1))
    blank = MeasuredPoints(GRID, upwards, np.ones((5, len(GRID))), np.full((5, len(GRID)), 1e-3))
    [stage] = plain.study.stages
    bare = replace(stage.tests[0], points=blank)
    lumped = with_lump(replace(plain, study=plain.study.with_stages((replace(stage, tests=(bare,)),))))
    told = lumped.predictions(lumped_at(lumped))["free"]
    assert told.motion is not None
    motion = told.motion[:, :5].T.copy()
    motion /= np.abs(motion).max(axis=1, keepdims=True)
    modes = tuple(
        replace(mode, frequency_hz=float(np.exp(f))) for mode, f in zip(bare.modes, told.log_f, strict=False)
    )
    test = replace(bare, modes=modes, points=replace(blank, motion=motion))
    return replace(plain, study=plain.study.with_stages((replace(stage, tests=(test,)),)))


def with_lump(h: BodyHypothesis) -> BodyHypothesis:
    lump, _ = [c for c in all_candidates(h.study.files) if c.effect == "attached_mass"]
    return replace(h, candidates=(lump,), held=None)


def lumped_at(h: BodyHypothesis, **changes: float) -> np.ndarray:
    values = LUMP | changes
    own = [p.internal(values[p.name]) for p in h.candidates[0].parameters]
    return np.r_[np.zeros(h.constants), own]


def test_slopes_are_those_of_differences(seen: BodyHypothesis, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.diagnose.fits.derivatives.EFFECT_STEP", 1e-4)
    h = with_lump(seen)
    z = lumped_at(h, mass_kg=0.008)
    h = h.paired(z)
    found = jacobian(h, z)
    start = h.features(z)
    exact = np.array([difference(h, z, j, start) for j in range(len(z))]).T
    linear = np.array([abs(f.residual) < 8 for f in start])
    assert linear.sum() > 20
    # amplitudes in modes beyond those that are solved are missing from the slopes
    np.testing.assert_allclose(
        found[linear], exact[linear], rtol=0.03, atol=0.03 * np.abs(exact[linear]).max()
    )


def test_without_shapes_modes_pair_by_frequency(plain: BodyHypothesis) -> None:
    z = np.zeros(plain.constants)
    held = plain.paired(z).held
    assert held is not None
    assert held["free"] == (0, 1, 2, 3, 4)


def test_with_shapes_modes_pair_by_shape(seen: BodyHypothesis) -> None:
    [stage] = seen.study.stages
    test = stage.tests[0]
    assert test.points is not None
    # the shapes of the third and fourth mode, which lie near each other, in each other's place
    turned = test.points.motion[[0, 1, 3, 2, 4]]
    mixed = replace(test, points=replace(test.points, motion=turned))
    h = replace(seen, study=seen.study.with_stages((replace(stage, tests=(mixed,)),)))
    held = h.paired(np.zeros(h.constants)).held
    assert held is not None
    assert held["free"] == (0, 1, 3, 2, 4)


def test_shapes_tell_a_lump_from_its_mirror_images(seen: BodyHypothesis) -> None:
    h = with_lump(seen)
    misfit = {}
    for x, y in ((0.22, 0.13), (0.08, 0.13), (0.22, 0.07), (0.08, 0.07)):
        z = lumped_at(h, x_m=x, y_m=y)
        residuals = h.paired(z).features(z)
        misfit[x, y] = sum(f.residual**2 for f in residuals if f.kind == "shape")
        frequencies = [f.residual for f in residuals if f.kind == "frequency"]
        assert np.abs(frequencies).max() < 1e-6  # which do not tell them apart
    assert misfit[0.22, 0.13] < 1e-9
    assert min(value for place, value in misfit.items() if place != (0.22, 0.13)) > 20


def _shape_sds(h: BodyHypothesis) -> np.ndarray:
    z = np.zeros(h.constants)
    return np.array([f.sd for f in h.paired(z).features(z) if f.kind == "shape"])


def test_shapes_count_where_valleys_are_wide_but_for_less(seen: BodyHypothesis) -> None:
    sharp, wide = _shape_sds(seen), _shape_sds(replace(seen, discrepancy=0.03))
    assert len(wide) == len(sharp)
    assert np.all(wide >= 0.15)
    assert sharp.min() < 0.03


def test_modes_that_the_mesh_gets_wrong_may_be_mixed_with_their_neighbours(seen: BodyHypothesis) -> None:
    [stage] = seen.study.stages
    rough = replace(stage, known=replace(stage.known, own=stage.known.own + 0.02), _projectors={})
    sharp, blurred = (_shape_sds(h) for h in (seen, replace(seen, study=seen.study.with_stages((rough,)))))
    assert np.all(blurred >= sharp)
    # the third and the fourth mode are five percent apart
    assert np.max(blurred / sharp) > 5.0


def test_a_wrong_weight_is_no_other_frequency_than_a_softer_plate(plain: BodyHypothesis) -> None:
    """All moduli and the weight in one ratio: the shared slope that a scan projects out."""
    z = np.zeros(plain.constants)
    J = jacobian(plain.paired(z), z)
    names = plain.study.constants.names
    moduli = [i for i, n in enumerate(names) if n.endswith("_pa")]
    weight = J[:, names.index("plate:mass_kg")]
    sd = np.array([plain.study.constants.items[i].sd for i in moduli])
    together = J[:, moduli] @ (1 / sd)  # d residuals / d ln E
    relative = plain.study.constants.items[names.index("plate:mass_kg")]
    np.testing.assert_allclose(together, -weight * relative.median / relative.sd, rtol=1e-3)


def test_prescribed_constants_are_not_sought(tmp_path: Path) -> None:
    known = "[stages.identify.fixed.plate]\nE_3_pa = 11e9\nnu_12 = 0.28\nG_13_pa = 4.5e9\n"
    files = load_study(write_plate(tmp_path, FREQUENCIES, identify=known))
    setup = stage_setup(files, object_geometry(files.drawing, files.geometry_path), 0)
    constants = study_constants([setup], (), 0.0)
    sought = {constants.names[i].partition(".")[2] for i in new_constants(constants, setup.keys.name)}
    assert sought == {"E_1_pa", "E_2_pa", "nu_13", "nu_23", "G_12_pa", "G_23_pa"}
    assert {i.name for i in constants.items if i.fixed} == {
        f"plate:plate.{name}" for name in ("E_3_pa", "nu_12", "G_13_pa")
    }

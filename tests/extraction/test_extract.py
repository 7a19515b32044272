"""Extraction against systems whose modes are prescribed."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest

from statorhom.errors import ExtractionError
from statorhom.extraction import Extraction, extract, mode_search
from statorhom.extraction.measured_modes import _named
from statorhom.extraction.set_up_shifts import SetUps
from statorhom.extraction.stabilization import LEAST_SHARE
from statorhom.modes.mac import mac, subspace_mac
from statorhom.recordings.frf_set import FrfSet
from synthetic_frfs import frf_set, ring_points, ring_shape

POINTS = ring_points(12, 2)
AXIS = np.arange(800.0, 1600.0)
SHAPES = np.array(
    [ring_shape(POINTS, 2, 0.2), ring_shape(POINTS, 3, 0.1), ring_shape(POINTS, 2, 0.3, axial=1)]
)
POLES = [(1000.0, 0.01), (1150.0, 0.02), (1400.3, 0.008)]


def measured(**options: object) -> FrfSet:
    return frf_set(AXIS, POINTS, [0], POLES, SHAPES, **options)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def noisy() -> Extraction:
    return extract(measured(noise=0.005))


def frequencies(extraction: Extraction) -> np.ndarray:
    return np.array([mode.frequency_hz for mode in extraction.modes])


def test_exact_data_give_the_exact_modes() -> None:
    found = extract(measured())
    np.testing.assert_allclose(frequencies(found), [pole[0] for pole in POLES], rtol=1e-5)
    np.testing.assert_allclose(
        [mode.loss_factor for mode in found.modes], [pole[1] for pole in POLES], rtol=1e-3
    )
    for mode, shape in zip(found.modes, SHAPES, strict=True):
        assert mac(mode.shape, shape) > 1 - 1e-5
        assert mode.modal_constant_per_kg == pytest.approx(shape[0] ** 2, rel=1e-3)
        assert mode.phase_collinearity > 1 - 1e-5


def test_noise_moves_the_modes_by_what_their_standard_deviations_say(noisy: Extraction) -> None:
    assert len(noisy.modes) == 3
    for mode, (frequency, loss), shape in zip(noisy.modes, POLES, SHAPES, strict=True):
        assert abs(mode.frequency_hz - frequency) < 4 * mode.frequency_sd_hz
        assert mode.frequency_sd_hz < 1e-4 * frequency
        assert abs(mode.loss_factor - loss) < 4 * mode.loss_factor_sd
        assert mac(mode.shape, shape) > 0.999
        assert mode.misfit == pytest.approx(1.0, abs=0.2)


def test_modes_regenerate_the_frfs(noisy: Extraction) -> None:
    exact = measured().receptance
    deviation = np.abs(noisy.regenerate(AXIS) - exact) / np.abs(exact).max()
    assert deviation.max() < 2e-3


def test_noise_alone_has_no_modes() -> None:
    rng = np.random.default_rng(4)
    empty = measured()
    values = rng.normal(size=(2, *empty.accelerance.shape))
    assert extract(replace(empty, accelerance=values[0] + 1j * values[1])).modes == ()


def test_order_units_and_phase_of_the_frfs_do_not_matter(noisy: Extraction) -> None:
    frfs = measured(noise=0.005)
    order = np.random.default_rng(1).permutation(len(frfs))
    shuffled = FrfSet(
        AXIS,
        tuple(frfs.responses[i] for i in order),
        tuple(frfs.references[i] for i in order),
        1e4 * np.exp(0.7j) * frfs.accelerance[order],
    )
    found = extract(shuffled)
    np.testing.assert_allclose(frequencies(found), frequencies(noisy), rtol=1e-7)
    place = {dof: i for i, dof in enumerate(found.points)}
    back = [place[dof] for dof in noisy.points]
    for one, other in zip(found.modes, noisy.modes, strict=True):
        assert mac(one.shape[back], other.shape) > 1 - 1e-6
        assert one.modal_constant_per_kg is not None
        assert other.modal_constant_per_kg is not None
        ratio = one.modal_constant_per_kg / other.modal_constant_per_kg
        assert ratio == pytest.approx(1e4 * np.exp(0.7j), rel=1e-3)


def test_a_roving_hammer_tells_the_same_as_a_roving_sensor(noisy: Extraction) -> None:
    frfs = measured(noise=0.005)
    swapped = replace(frfs, responses=frfs.references, references=frfs.responses)
    found = extract(swapped)
    assert found.hammer_roved
    np.testing.assert_allclose(frequencies(found), frequencies(noisy), rtol=1e-9)


def test_the_window_s_damping_is_taken_off() -> None:
    found = extract(measured(noise=0.003, decay_per_s=12.0))
    for mode, (_, loss) in zip(found.modes, POLES, strict=True):
        assert abs(mode.loss_factor - loss) < 4 * mode.loss_factor_sd


@pytest.mark.parametrize("split_hz", [0.0, 5.0, 10.0])
def test_doublets_stay_two_with_two_references(split_hz: float) -> None:
    shapes = np.array([ring_shape(POINTS, 2, 0.2), ring_shape(POINTS, 2, 0.2 + np.pi / 4)])
    poles = [(1200.0, 0.01), (1200.0 + split_hz, 0.01)]
    found = extract(frf_set(AXIS, POINTS, [0, 2], poles, shapes, noise=0.005))
    assert len(found.modes) == 2
    np.testing.assert_allclose(frequencies(found), [pole[0] for pole in poles], rtol=5e-5)
    assert subspace_mac(np.array([mode.shape for mode in found.modes]).T, shapes.T) > 0.999
    if split_hz:
        for mode, shape in zip(found.modes, shapes, strict=True):
            assert mac(mode.shape, shape) > 0.99


def test_one_reference_sees_one_mode_of_a_perfect_doublet_and_both_of_a_split_one() -> None:
    shapes = np.array([ring_shape(POINTS, 2, 0.2), ring_shape(POINTS, 2, 0.2 + np.pi / 4)])
    for split_hz, count in ((0.0, 1), (6.0, 2)):
        poles = [(1200.0, 0.01), (1200.0 + split_hz, 0.01)]
        found = extract(frf_set(AXIS, POINTS, [0], poles, shapes, noise=0.005))
        assert len(found.modes) == count
        np.testing.assert_allclose(frequencies(found), [p[0] for p in poles[:count]], rtol=5e-5)


def test_heavily_damped_modes() -> None:
    poles = [(1000.0, 0.06), (1150.0, 0.09), (1400.0, 0.05)]
    found = extract(frf_set(np.arange(500.0, 2000.0), POINTS, [0], poles, SHAPES, noise=0.005))
    np.testing.assert_allclose(frequencies(found), [pole[0] for pole in poles], rtol=5e-4)
    np.testing.assert_allclose([mode.loss_factor for mode in found.modes], [p[1] for p in poles], rtol=0.05)


@pytest.mark.slow
def test_standard_deviations_are_honest() -> None:
    scores = []
    for seed in range(30):
        found = extract(measured(noise=0.01, seed=seed))
        assert len(found.modes) == 3
        for mode, (frequency, loss) in zip(found.modes, POLES, strict=True):
            scores.append((mode.frequency_hz - frequency) / mode.frequency_sd_hz)
            scores.append((mode.loss_factor - loss) / mode.loss_factor_sd)
    # 180 scores: the standard deviation of a standard deviation is 5 %
    assert 0.75 < np.std(scores) < 1.2


def test_missing_pairs_and_lines_are_left_out() -> None:
    frfs = measured(noise=0.005)
    values = frfs.accelerance.copy()
    values[3, 100:300] = np.nan
    found = extract(replace(frfs, accelerance=values))
    np.testing.assert_allclose(frequencies(found), [pole[0] for pole in POLES], rtol=5e-5)


def test_too_few_lines_are_refused() -> None:
    with pytest.raises(ExtractionError, match="lines lie in the band"):
        extract(measured(), band_hz=(1000.0, 1005.0))


def test_sets_on_different_axes_are_refused() -> None:
    other = frf_set(AXIS + 0.5, POINTS, [0], POLES, SHAPES)
    with pytest.raises(ExtractionError, match="frequency axis"):
        extract([measured(), other])


@pytest.mark.slow
def test_shapes_and_names_of_a_stator_s_doublets() -> None:
    """24 × 4 points, two hammer points, eight doublets split by a quarter of their bandwidth, 1 % noise."""
    points = ring_points(24, 4)
    names, poles, shapes = [], [], []
    for order, axial, frequency in (
        (2, 0, 900.0),
        (2, 1, 1250.0),
        (3, 0, 1700.0),
        (3, 1, 2100.0),
        (4, 0, 2500.0),
    ):
        for turn in (0.0, np.pi / (2 * order)):
            names.append((order, axial))
            poles.append((frequency * (1 + 2.5e-3 * (turn > 0)), 0.01))
            shapes.append(ring_shape(points, order, 0.3 + turn, axial))
    frfs = frf_set(np.arange(500.0, 2900.0), points, [0, 27], poles, np.array(shapes), noise=0.01)
    found = extract(frfs)
    named, _ = _named(found)
    assert [(one.order, one.axial) for one in named] == names
    for mode, shape, (frequency, loss) in zip(found.modes, shapes, poles, strict=True):
        assert mac(mode.shape, shape) >= 0.98
        assert mode.frequency_hz == pytest.approx(frequency, rel=5e-4)
        assert mode.loss_factor == pytest.approx(loss, rel=0.08)


def test_the_other_half_of_a_doublet_is_listed_though_the_hammer_stands_near_its_node() -> None:
    # the start estimator spends its orders on the stronger half
    angle = np.arcsin(0.01) / 2
    shapes = np.array([ring_shape(POINTS, 2, angle), ring_shape(POINTS, 2, angle + np.pi / 4)])
    poles = [(1200.0, 0.009), (1238.0, 0.009)]
    found = extract(frf_set(AXIS, POINTS, [0], poles, shapes, noise=0.005))
    assert len(found.modes) == 2
    assert found.modes[1].stability < LEAST_SHARE
    assert found.modes[1].frequency_hz == pytest.approx(1238.0, abs=4 * found.modes[1].frequency_sd_hz)


def test_no_load_is_looked_for_where_modes_that_stay_explain_the_recording(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # modes that lie close look from afar like modes that move, and a load would explain them too
    def no_load(*_: object) -> None:
        raise AssertionError("a load was looked for")

    monkeypatch.setattr(mode_search, "moving_set_ups", lambda _: SetUps.POINTS)
    monkeypatch.setattr(sys.modules[extract.__module__], "find_load", no_load)
    poles = [(f, 0.008) for f in (900.0, 1050.0, 1200.0, 1350.0, 1500.0)]
    shapes = np.array([ring_shape(POINTS, order, 0.1) for order in (2, 3, 4, 5, 1)])
    found = extract(frf_set(AXIS, POINTS, [0], poles, shapes, noise=0.005))
    np.testing.assert_allclose(frequencies(found), [f for f, _ in poles], rtol=1e-4)
    assert found.loaded is None

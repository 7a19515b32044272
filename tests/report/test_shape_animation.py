"""What moves in the animation is what was measured."""

import io

import numpy as np
import pytest
from PIL import Image

from measured_points import cylinder, radial_values
from statorhom.errors import IdentificationError
from statorhom.modes.measured_shape import measured_shapes
from statorhom.modes.point_layout import lay_out
from statorhom.report.figures.ring_motion import RingMotion, at_phase
from statorhom.report.figures.shape_animation import animate_shape

ANGLES = 2 * np.pi * np.arange(12) / 12


def shape(motion, count=12):
    dofs = cylinder(2 * np.pi * np.arange(count) / count)
    (found,) = measured_shapes(lay_out(dofs), radial_values(dofs, motion))
    return found


def standing(a, z):
    return 3e-7 * np.exp(2.1j) * np.cos(2 * a) + 0 * z


def test_equation_8():
    h = np.array([1.0 + 2.0j])
    assert at_phase(h, 0.0)[0] == 1.0
    assert at_phase(h, np.pi / 2)[0] == pytest.approx(2.0)


def test_a_standing_wave_begins_at_its_largest_and_keeps_its_nodes():
    motion = RingMotion.of(shape(standing))
    largest = [np.abs(motion.rings(motion.phase + t)[0, :, :2]) for t in (0.0, np.pi / 2)]
    reach = [np.ptp(np.linalg.norm(ring, axis=-1)) for ring in largest]
    assert reach[0] == pytest.approx(2 * 0.18, rel=0.05)
    assert reach[1] < 1e-9


def test_a_travelling_wave_keeps_its_form():
    motion = RingMotion.of(shape(lambda a, z: np.exp(2j * a) + 0 * z))
    reach = [np.ptp(np.linalg.norm(motion.rings(t)[0, :, :2], axis=-1)) for t in np.linspace(0, 3, 7)]
    assert reach == pytest.approx(np.full(7, reach[0]), rel=1e-2)


def test_smooth_rings_go_through_the_points():
    motion = RingMotion.of(shape(standing))
    every_twelfth = motion.rings(0.3)[:, :-1:12]
    np.testing.assert_allclose(every_twelfth, motion.places(0.3), atol=1e-12)


def test_the_gif_moves_and_repeats():
    image = Image.open(io.BytesIO(animate_shape(shape(standing), "(2, 0) at 1432 Hz", "$x$ → 日")))
    assert image.n_frames == 24
    assert image.info["loop"] == 0
    pictures = []
    for frame in range(24):
        image.seek(frame)
        pictures.append(np.asarray(image.convert("RGB"), dtype=float))
    half = pictures[12]
    assert np.abs(pictures[0] - half).max() > 50  # a blue place has become red
    # a quarter of the period away all is white and round, at both passages alike
    np.testing.assert_allclose(pictures[6], pictures[18], atol=60)
    assert np.mean(np.abs(pictures[6] - pictures[18])) < 0.1 * np.mean(np.abs(pictures[0] - half))


def test_points_without_orders_cannot_be_animated():
    with pytest.raises(IdentificationError, match="different angles"):
        animate_shape(shape(standing, count=2), "?")

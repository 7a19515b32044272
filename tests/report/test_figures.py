"""Pictures show what the figures say."""

import io
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from statorhom.report.figures.canvas import new_figure, png, safe
from statorhom.report.figures.convergence_plot import convergence_plot
from statorhom.report.figures.interval_bar import interval_bar, modulus_axis
from statorhom.report.figures.mode_comparison import _spread, error_half_width, mode_comparison
from statorhom.report.figures.spectrum_map import order_shares, real_amplitudes, shown_orders, spectrum_map
from statorhom.report.figures.surface_drawing import View, draw_smooth, fit_view
from statorhom.results import Convergence, ModeResult

SVG = "{http://www.w3.org/2000/svg}"


@settings(deadline=None)
@given(st.lists(st.floats(0.0, 100.0), min_size=1, max_size=30), st.floats(0.1, 5.0))
def test_labels_keep_their_distance_and_order(wanted: list[float], distance: float) -> None:
    places = _spread(np.sort(wanted), distance)
    assert np.all(np.diff(places) >= distance * (1 - 1e-9))
    if np.all(np.diff(np.sort(wanted)) >= distance):
        np.testing.assert_allclose(places, np.sort(wanted))


def test_error_bars_join_measurement_and_model() -> None:
    mode = ModeResult(test="t", measured_hz=1000.0, measured_sd_hz=3.0, model_sd_hz=4.0, role="fitted")
    assert error_half_width(mode) == pytest.approx(1.645 * 0.5)
    assert error_half_width(mode.model_copy(update={"measured_sd_hz": None, "model_sd_hz": None})) is None


def test_a_test_without_pairs_can_be_drawn() -> None:
    alone = ModeResult(test="t", measured_hz=1000.0, role="unmatched")
    assert ET.fromstring(mode_comparison([alone])).tag == f"{SVG}svg"


def test_same_figure_same_bytes() -> None:
    mode = ModeResult(test="t", measured_hz=9.0, simulated_hz=9.1, error_percent=1.1, role="fitted")
    assert mode_comparison([mode]) == mode_comparison([mode])


@settings(deadline=None)
@given(st.lists(st.floats(1e6, 1e12), min_size=1, max_size=4))
def test_axis_holds_its_values_and_has_few_marks(values: list[float]) -> None:
    axis = modulus_axis(*values)
    assert all(axis.low < value < axis.high for value in values)
    assert 1 <= len(axis.marks) <= 6
    places = [axis.position(at) for at, _ in axis.marks]
    assert places == sorted(places)


def test_an_interval_stands_left_of_a_higher_value() -> None:
    bar = ET.fromstring(interval_bar("E_pa", 2e9, (1e9, 4e9), (0.5e9, 8e9), "identified").content)
    dot = bar.find(f"{SVG}circle")
    band = bar.find(f"{SVG}rect")
    assert dot is not None and band is not None
    middle = float(band.attrib["x"]) + float(band.attrib["width"]) / 2
    assert float(dot.attrib["cx"]) == pytest.approx(
        middle, abs=0.05
    )  # 2 is the logarithmic middle of 0.5 and 8


def test_prescribed_constants_have_no_interval() -> None:
    paths = [
        len(ET.fromstring(interval_bar("nu", 0.3, (0.2, 0.4), None, status).content).findall(f"{SVG}path"))
        for status in ("fixed", "identified")
    ]
    assert paths[1] == paths[0] + 1


def test_shares_are_those_of_the_mean_square() -> None:
    spectrum = np.array([[1.0, 0.0, 2.0], [1.0, 0.0, -2.0]])
    np.testing.assert_allclose(order_shares(spectrum), [1 / 3, 0.0, 2 / 3])


def test_amplitudes_lose_their_common_phase_only() -> None:
    signed = np.array([[0.0, 1.0], [0.0, -0.5]])
    turned = real_amplitudes(signed * np.exp(0.7j))
    np.testing.assert_allclose(np.abs(turned), np.abs(signed), atol=1e-12)
    assert turned[0, 1] * turned[1, 1] < 0


def test_empty_columns_are_left_out() -> None:
    spectrum = np.zeros((3, 20))
    spectrum[:, 2] = 1.0
    assert shown_orders([spectrum]) == 7
    spectrum[:, 11] = 1.0
    assert shown_orders([spectrum]) == 13


def test_a_plane_is_a_row_and_an_order_a_column() -> None:
    spectrum = np.zeros((3, 7))
    spectrum[:, 2] = (1.0, 0.0, -1.0)
    drawn = ET.fromstring(spectrum_map(spectrum, np.array([0.0, 40.0, 80.0]), 7)).findall(f"{SVG}rect")
    cells = [r for r in drawn if r.get("stroke")]
    assert len(cells) == 21
    coloured = [r for r in cells if r.get("fill") not in {cells[0].get("fill")}]
    assert len({r.get("x") for r in coloured}) == 1
    lowest, highest = sorted(coloured, key=lambda r: -float(r.attrib["y"]))
    red, blue = (int(lowest.attrib["fill"][i : i + 2], 16) for i in (1, 5))
    assert red > blue  # the plane at z = 0 moves outwards and stands at the bottom
    assert highest.get("fill") != lowest.get("fill")


def unit_square(z: float, shift: float = 0.0) -> np.ndarray:
    corners = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    eight = np.concatenate([corners, (corners + np.roll(corners, -1, axis=0)) / 2]) + shift
    return np.column_stack([eight, np.full(8, z)])


def test_what_is_nearer_hides_what_is_behind() -> None:
    positions = np.concatenate([unit_square(1.0), unit_square(0.0)])
    rgb = np.repeat([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], 8, axis=0)
    for quads in (np.arange(16).reshape(2, 8), np.arange(16).reshape(2, 8)[::-1]):
        assert colour_in_the_middle(positions, quads, rgb) == "green"


def test_faces_that_look_away_are_not_drawn() -> None:
    turned = np.array([[0, 3, 2, 1, 7, 6, 5, 4]])
    assert colour_in_the_middle(unit_square(0.0), turned, np.tile([1.0, 0.0, 0.0], (8, 1))) == "white"


def colour_in_the_middle(positions: np.ndarray, quads: np.ndarray, rgb: np.ndarray) -> str:
    view = View(azimuth=-90.0, elevation=90.0)
    figure = new_figure(20, 20, placed=True)
    axes = figure.add_axes((0, 0, 1, 1))
    draw_smooth(axes, view, positions, quads, rgb)
    fit_view(axes, view.project(positions))
    image = Image.open(io.BytesIO(png(figure, dpi=50)))
    pixel = image.getpixel((image.width // 2, image.height // 2))
    assert isinstance(pixel, tuple)
    r, g, b = pixel
    return "white" if min(r, g, b) > 250 else "green" if g > r else "red"


@pytest.mark.parametrize(
    ("label", "shown"), [("a$b$", r"a\$b\$"), ("日x\n", "□x□"), ("x" * 50, "x" * 39 + "…")]
)
def test_labels_hold_no_mathematics_and_only_known_letters(label: str, shown: str) -> None:
    assert safe(label) == shown


def test_many_modes_leave_room_for_the_lines() -> None:
    # a wound stator has dozens of modes on the meshes; a legend of all would leave none (matplotlib warns)
    modes = [
        Convergence(
            order=r, axial=n, dof=(80_000, 290_000), frequency_hz=(1010.0, 1004.0),
            extrapolated_hz=1000.0, sd_percent=0.2,
        )
        for r in range(14) for n in range(3)
    ]  # fmt: skip
    drawing = ET.fromstring(convergence_plot(modes))
    legend = [group for group in drawing.iter(f"{SVG}g") if group.attrib.get("id", "").startswith("legend")]
    assert len(legend) == 1
    assert len(convergence_plot(modes[:3])) < len(convergence_plot(modes))

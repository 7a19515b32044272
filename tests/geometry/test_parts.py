import pytest

from example_stators import STEPS, stator

FRAMED = ("stack", "framed")


def spans(geometry, region, kinds):
    parts = [part for part in geometry.step(kinds).parts if part.region == region]
    return [(1e3 * s.low, 1e3 * s.high, s.division, s.share) for part in parts for s in part.spans]


def approx(rows):
    return [(pytest.approx(a, abs=1e-9), pytest.approx(b), name, pytest.approx(c)) for a, b, name, c in rows]


def test_the_core_spans_its_length():
    assert spans(stator(), "lamination", ("stack",)) == approx([(0.0, 80.5, "core", 1.0)])


def test_the_overhangs_lie_beyond_both_ends():
    expected = [(-25.0, 0.0, "overhang", 1.0), (80.5, 105.5, "overhang", 1.0)]
    assert spans(stator(), "overhang", STEPS["wound"]) == approx(expected)


def test_a_longer_frame_has_the_cores_cells_where_it_lies_on_it():
    expected = [(-34.75, 0.0, "frame_end", 1.0), (0.0, 80.5, "core", 1.0), (80.5, 115.25, "frame_end", 1.0)]
    assert spans(stator(), "frame", FRAMED) == approx(expected)


def test_a_shorter_frame_cuts_core_and_winding_and_shares_their_cells():
    geometry = stator(frame={"offset_mm": 16.1, "length_mm": 40.25}, machine=None)
    cut = [(0.0, 16.1, "core", 0.2), (16.1, 56.35, "core", 0.5), (56.35, 80.5, "core", 0.3)]
    for region in ("lamination", "winding"):
        assert spans(geometry, region, STEPS["framed"]) == approx(cut)
    assert spans(geometry, "frame", STEPS["framed"]) == approx(cut[1:2])


def test_a_frame_that_is_not_yet_there_does_not_cut_the_core():
    geometry = stator(frame={"offset_mm": 16.1, "length_mm": 40.25}, machine=None)
    assert spans(geometry, "lamination", ("stack",)) == approx([(0.0, 80.5, "core", 1.0)])


def test_the_shields_lie_on_the_frames_ends():
    expected = [(-42.75, -34.75, "shield_axial", 1.0), (115.25, 123.25, "shield_axial", 1.0)]
    assert spans(stator(), "machine", STEPS["machine"]) == approx(expected)

"""pyuff, a general library, reads what is written here and writes what is read here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyuff

from example_recordings import ring_recording
from statorhom.recordings.uff.reader import read_uff
from statorhom.recordings.uff.writer import write_uff

SHARED = Path(__file__).resolve().parents[3].parent / "shared"
REAL = [SHARED / "recordings" / "beam-hammer.uff", *sorted((SHARED / "cases").glob("*/*.uff"))[:2]]


def datasets(path: Path) -> list[dict[str, Any]]:
    return pyuff.UFF(str(path)).read_sets()


@pytest.mark.parametrize("path", REAL, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_recordings_of_others(path):
    if not path.is_file():
        pytest.skip(f"{path} is not there")
    functions = [dataset for dataset in datasets(path) if dataset["type"] == 58]
    [frf_set] = read_uff(path).frf_sets
    assert len(frf_set) == len(functions)
    for row, function in enumerate(functions):
        np.testing.assert_array_equal(frf_set.accelerance[row], function["data"])
        assert frf_set.responses[row].node == function["rsp_node"]
        assert frf_set.references[row].node == function["ref_node"]
    np.testing.assert_allclose(frf_set.frequency_hz, functions[0]["x"], rtol=1e-12)


def test_the_real_beam_is_six_hammer_points_by_seven_sensors():
    if not REAL[0].is_file():
        pytest.skip(f"{REAL[0]} is not there")
    [frf_set] = read_uff(REAL[0]).frf_sets
    pairs = {(a.node, b.node) for a, b in zip(frf_set.responses, frf_set.references, strict=True)}
    assert pairs == {(response, reference) for response in range(1, 8) for reference in range(101, 107)}


@pytest.mark.parametrize("path", REAL[1:], ids=lambda path: path.parent.name)
def test_directions_of_a_case_are_radial(path):
    if not path.is_file():
        pytest.skip(f"{path} is not there")
    [frf_set] = read_uff(path).frf_sets
    directions = [dof.cylindrical_direction for dof in frf_set.responses]
    np.testing.assert_allclose(directions, [(1, 0, 0)] * len(frf_set), atol=1e-12)
    inwards = [dataset["ref_dir"] for dataset in datasets(path) if dataset["type"] == 58]
    radial = [dof.cylindrical_direction[0] for dof in frf_set.references]
    np.testing.assert_allclose(radial, np.sign(inwards), atol=1e-12)


@pytest.mark.parametrize("binary", [True, False])
def test_pyuff_reads_what_is_written(tmp_path, binary):
    recording = ring_recording()
    write_uff(tmp_path / "ring.uff", recording, binary=binary)
    found = datasets(tmp_path / "ring.uff")
    by_type = {kind: [d for d in found if d["type"] == kind] for kind in (151, 164, 2420, 2411, 82, 58, 55)}
    assert by_type[151][0]["model_name"] == "ring"
    assert (by_type[164][0]["length"], by_type[164][0]["force"]) == (1.0, 1.0)
    assert by_type[2420][0]["CS_types"] == [0, 1]
    np.testing.assert_array_equal(by_type[2411][0]["node_nums"], [node.number for node in recording.nodes])
    np.testing.assert_array_equal(by_type[2411][0]["disp_cs"], 2)
    np.testing.assert_allclose(by_type[2411][0]["z"], [node.position[2] for node in recording.nodes])
    np.testing.assert_array_equal(by_type[82][0]["nodes"], recording.trace_lines[0])
    frfs = [d for d in by_type[58] if d["func_type"] == 4]
    [frf_set] = recording.frf_sets
    np.testing.assert_allclose([d["data"] for d in frfs], frf_set.accelerance, rtol=1e-11)
    assert {(d["rsp_dir"], d["ref_dir"]) for d in frfs} == {(1, -1)}
    np.testing.assert_allclose(frfs[0]["x"], frf_set.frequency_hz)
    records = [d for d in by_type[58] if d["func_type"] == 1]
    assert [d["ordinate_spec_data_type"] for d in records] == [13, 12, 12]
    assert {d["load_case_id"] for d in records} == {3}
    [shape] = by_type[55]
    assert abs(shape["eig"]) / (2 * np.pi) == pytest.approx(1432.5, rel=1e-5)
    np.testing.assert_allclose(shape["r1"], recording.shapes[0].displacement[:, 0], rtol=1e-5)


# pyuff leaves files open
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning", "ignore::ResourceWarning")
@pytest.mark.parametrize("even", [0, 1])
@pytest.mark.parametrize("binary", [0, 1])
@pytest.mark.parametrize("form", [4, 5, 6])
def test_what_pyuff_writes_is_read(tmp_path, even, binary, form):
    if form == 5 and binary:
        pytest.skip("pyuff writes single precision in text only")
    rng = np.random.default_rng(1)
    x = 10 + 2.5 * np.arange(7)
    data = rng.standard_normal(7) + (1j * rng.standard_normal(7) if form > 4 else 0)
    uff = pyuff.UFF(str(tmp_path / "p.uff"))
    uff.write_sets(pyuff.prepare_164(1, "SI", 1, 1.0, 1.0, 1.0, 273.15), "overwrite")
    nodes = {"type": 15, "node_nums": [1, 2], "x": [0.1, 0.2], "y": [0.0, 0.3], "z": [0.5, 0.6]}
    function = {
        "type": 58, "func_type": 4, "rsp_node": 1, "rsp_dir": 1, "ref_node": 2, "ref_dir": -2, "binary": binary,
        "x": x, "data": data, "abscissa_spacing": even, "abscissa_spec_data_type": 18, "ord_data_type": form,
        "ordinate_spec_data_type": 12, "orddenom_spec_data_type": 13,
    }  # fmt: skip
    uff.write_sets([nodes, function], "add", force_double=form != 5)
    [frf_set] = read_uff(tmp_path / "p.uff").frf_sets
    tolerance = 1e-5 if form == 5 else 1e-11
    np.testing.assert_allclose(frf_set.accelerance, [data], rtol=tolerance)
    np.testing.assert_allclose(frf_set.frequency_hz, x)
    assert frf_set.responses[0].position == pytest.approx((0.1, 0.0, 0.5))
    assert frf_set.references[0].direction == (0.0, -1.0, 0.0)

"""Universal files of all dialects are read right, or refused in one line."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from example_recordings import THREE, function, ring_recording, units, write
from statorhom.errors import RecordingError
from statorhom.recordings.uff.reader import read_uff
from statorhom.recordings.uff.writer import write_uff

VALUES = np.array([1 + 2j, 3 + 4j, 5 + 6j])
NODES = "    -1\n  2411\n         1         1         1        11\n   1.0D+00  2.0D+00  3.0D+00\n    -1\n"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "test.uff"


def only_frf(path: Path) -> np.ndarray:
    [frf_set] = read_uff(path).frf_sets
    [row] = frf_set.accelerance
    return row


def refusal(path: Path) -> str:
    with pytest.raises(RecordingError) as caught:
        read_uff(path)
    message = str(caught.value)
    assert message.startswith(str(path)) and message.isprintable() and "; " in message
    return message


def test_frf_with_its_axis_and_directions(path):
    write(path, units(), function(THREE, response=(1, -2), reference=(7, 0)))
    [frf_set] = read_uff(path).frf_sets
    np.testing.assert_array_equal(frf_set.frequency_hz, [10.0, 12.0, 14.0])
    np.testing.assert_array_equal(frf_set.accelerance, [VALUES])
    assert frf_set.responses[0].node == 1 and frf_set.responses[0].direction == (0.0, -1.0, 0.0)
    assert frf_set.references[0].direction is None
    assert frf_set.coherence is None


def test_coherence_joins_the_frf_of_its_pair(path):
    coherence = function("  9.00000E-01  8.00000E-01  7.00000E-01", kind=6, form=2, ordinate=(0, ""))
    other = function(THREE, response=(5, 1))
    write(path, units(), function(THREE), coherence, other)
    [frf_set] = read_uff(path).frf_sets
    np.testing.assert_allclose(frf_set.coherence[0], [0.9, 0.8, 0.7])
    assert np.isnan(frf_set.coherence[1]).all()


@pytest.mark.parametrize(
    ("text", "form", "even"),
    [
        ("   1.0D+00      2.0D+00      3.0D+00\n   4.0D+00      5.0d+00      6.0D+00", 5, 1),
        ("  1.000000000000E+00  2.000000000000E+00  3.000000000000E+00  4.000000000000E+00\n"
         "  5.000000000000E+00  6.000000000000E+00", 6, 1),
        ("  1.00000E+01  1.00000E+00  2.00000E+00  1.20000E+01  3.00000E+00  4.00000E+00\n"
         "  1.40000E+01  5.00000E+00  6.00000E+00", 5, 0),
        ("  1.00000E+01  1.000000000000E+00  2.000000000000E+00\n"
         "  1.20000E+01  3.000000000000E+00  4.000000000000E+00\n"
         "  1.40000E+01  5.000000000000E+00  6.000000000000E+00", 6, 0),
    ],
    ids=["Fortran D", "double even", "single uneven", "double uneven"],
)  # fmt: skip
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_ways_to_write_text(path, text, form, even, end):
    content = units() + function(text, form=form, even=even)
    write(path, content.replace("\n", end))
    np.testing.assert_array_equal(only_frf(path), VALUES)
    np.testing.assert_array_equal(read_uff(path).frf_sets[0].frequency_hz, [10.0, 12.0, 14.0])


def test_columns_that_touch_and_exponents_without_letter(path):
    touching = "-1.23456E+100-1.00000E-100  1.0000-101   2.0000+02  3.00000E+00  4.00000E+00"
    write(path, units(), function(touching))
    np.testing.assert_allclose(only_frf(path), [-1.23456e100 - 1e-100j, 1e-101 + 200j, 3 + 4j])


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("form", [5, 6])
@pytest.mark.parametrize("layout", ["even", "uneven", "uneven as the format says"])
def test_ways_to_write_binary(path, order, form, layout):
    mark, real = "<>"[order - 1], "fd"[form - 5]
    abscissa = {"even": "", "uneven": real, "uneven as the format says": "f"}[layout]
    # the second value begins with bytes that look like the end of a dataset
    values = [(1.0, 2.0), (3.0, 4.0), struct.unpack(f"{mark}2d", b"\n    -1\n        ")] if real == "d" else [
        (1.0, 2.0), (3.0, 4.0), struct.unpack(f"{mark}2f", b"\n    -1\n")]  # fmt: skip
    body = b"".join(
        struct.pack(f"{mark}{abscissa}{real}{real}", *([10.0 + 2 * i] if abscissa else []), *pair)
        for i, pair in enumerate(values)
    )
    text = function("", form=form, even=int(layout == "even"))
    form_line = f"    58b{order:6d}{2:6d}{11:12d}{0:12d}{0:6d}{0:6d}{0:12d}{0:12d}"
    head = (units() + text).replace("    58\n", form_line + "\n").encode()
    head, tail = head[: -len("\n    -1\n")], b"    -1\n"
    path.write_bytes(head + body + tail + function(THREE, response=(9, 1)).encode())
    [frf_set] = read_uff(path).frf_sets
    np.testing.assert_array_equal(frf_set.accelerance[0], [complex(*pair) for pair in values])
    np.testing.assert_array_equal(frf_set.frequency_hz, [10.0, 12.0, 14.0])
    np.testing.assert_array_equal(frf_set.accelerance[1], VALUES)


def test_mobility_and_receptance_become_accelerance(path):
    omega = 2 * np.pi * np.array([10.0, 12.0, 14.0])
    write(path, units(), function(THREE, ordinate=(11, "m/s")))
    np.testing.assert_allclose(only_frf(path), 1j * omega * VALUES)
    write(path, units(), function(THREE, ordinate=(8, "m")))
    np.testing.assert_allclose(only_frf(path), -(omega**2) * VALUES)


def test_quantity_that_only_the_unit_tells(path):
    write(path, units(), function(THREE, ordinate=(0, "(m/s²)/N"), denominator=(0, "NONE")))
    np.testing.assert_array_equal(only_frf(path), VALUES)


@pytest.mark.parametrize("first", ["1 SI", "         1SI                           2", "1"])
def test_ways_to_name_the_unit_system(path, first):
    text = units().replace(f"{1:10d}{'units':20s}{2:10d}", first)
    assert first in text
    write(path, text, function(THREE))
    np.testing.assert_array_equal(only_frf(path), VALUES)


def test_a_unit_that_says_nothing_is_mentioned(path):
    write(path, units(), function(THREE, ordinate=(12, "EU")))
    assert 'unit "EU" is taken for that of the file' in read_uff(path).remarks


def test_real_frfs_are_kept_and_mentioned(path):
    write(path, units(), function("".join(f"{x:13.5e}" for x in (1, 2, 3)), form=2))
    np.testing.assert_array_equal(only_frf(path), [1, 2, 3])
    assert "1 FRFs are real (kept, without phase)" in read_uff(path).remarks


def test_units_of_the_file_are_converted(path):
    trace = function(THREE, ordinate=(12, "mm/s^2"), denominator=(13, "mN"))
    write(path, units(5, 1e3, 1e3), NODES, trace)
    recording = read_uff(path)
    np.testing.assert_allclose(recording.frf_sets[0].accelerance[0], VALUES)
    assert recording.nodes[0].position == pytest.approx((0.001, 0.002, 0.003))
    assert any("converted" in remark for remark in recording.remarks)
    write(path, units(10, 1e3, 1.0), function(THREE, ordinate=(12, "")))
    np.testing.assert_allclose(only_frf(path), VALUES / 1000)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ((function(THREE),), "has no units"),
        ((units(5, 1.0, 1.0), function(THREE)), "dataset 1 (type 164), line 3"),
        ((units(1, 1e3, 1.0), function(THREE)), "unit system 1"),
        ((units(1, 0.0, 1.0), function(THREE)), "greater than 0"),
        ((units(), units(5, 1e3, 1e3), function(THREE)), "differ"),
        ((units(), function(THREE, ordinate=(12, "g"))), 'line 10: unit "g"'),
        ((units(), function(THREE, ordinate=(12, "mm/s²"))), "line 10"),
        ((units(), function(THREE, ordinate=(12, "mV"))), "line 10"),
        ((units(), function(THREE, denominator=(13, "lbf"))), "line 11"),
        ((units(), function(THREE, abscissa=(18, "kHz"))), "not a frequency in Hz"),
        ((units(), function(THREE, step=-2.0)), "do not ascend"),
        ((units(), function(THREE, count=4)), "holds 6 numbers, but promises 8"),
        ((units(), function(THREE, count=10**9)), "promises 1000000000 values"),
        ((units(), function(THREE, count=0)), "promises 0 values"),
        ((units(), function(THREE, form=3)), "no type of data"),
        ((units(), function(THREE.replace("3.0", "3.x"))), "line 13"),
        ((units(), function(THREE)[:300]), "ends within its header"),
        ((units(), function(THREE)[:-60]), "but promises"),
        ((units(), NODES.replace("2.0D", "?.0D")), "line 3"),
        ((units(), NODES, NODES.replace("2.0D", "4.0D")), "node 1 is defined twice"),
        ((units(), "    -1\nnonsense\n    -1\n"), "is no type of a dataset"),
        (("",), "is empty"),
        (("frequency,real,imag\n1,2,3\n",), "no universal file"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_in_one_line(path, content, says):
    write(path, *content)
    assert says in refusal(path)


def test_binary_garbage_and_truncated_binary(path):
    path.write_bytes(bytes(range(256)) * 8)
    assert "no universal file" in refusal(path)
    write_uff(path, ring_recording())
    content = path.read_bytes()
    path.write_bytes(content[: content.index(b"58b") + 1100])
    assert "truncated" in refusal(path)


def test_missing_file_and_folder(path):
    assert "cannot be read" in refusal(path)
    path.mkdir()
    assert "cannot be read" in refusal(path)


def test_lines_that_are_not_numbers(path):
    nan = THREE.replace("1.00000e+00", "        nan")
    both = write(path, units(), function(nan), function(nan, response=(5, 1)))
    recording = read_uff(both)
    assert recording.frf_sets[0].accelerance.shape == (2, 2)
    assert "1 lines at which no FRF is a number" in " ".join(recording.remarks)
    one = write(path, units(), function(THREE), function(nan, response=(5, 1)))
    recording = read_uff(one)
    assert [dof.node for dof in recording.frf_sets[0].responses] == [1]
    assert "response 5" in " ".join(recording.remarks)


def test_different_frequency_axes_are_kept_apart(path):
    write(path, units(), function(THREE), function(THREE, step=3.0), function(THREE, response=(5, 1)))
    recording = read_uff(path)
    assert [len(frf_set) for frf_set in recording.frf_sets] == [2, 1]
    assert "2 different frequency axes" in " ".join(recording.remarks)


def test_repeated_nodes_and_an_open_end_are_tolerated(path):
    write(path, units(), NODES, NODES, function(THREE)[: -len("    -1\n")])
    recording = read_uff(path)
    np.testing.assert_array_equal(recording.frf_sets[0].accelerance[0], VALUES)
    assert len(recording.nodes) == 1
    assert len(recording.remarks) == 2


def test_a_missing_delimiter_is_tolerated(path):
    write(path, units()[: -len("    -1\n")], function(THREE), "\n\n")
    np.testing.assert_array_equal(only_frf(path), VALUES)


def test_what_is_no_translation_over_force_is_left_out(path):
    content = [
        function(THREE, response=(1, 5)),
        function(THREE, denominator=(12, "m/s^2")),
        function(THREE, ordinate=(15, "Pa")),
        function(THREE, kind=2),
        "    -1\n  2412\n    -1\n",
    ]
    recording = read_uff(write(path, units(), *content))
    assert recording.frf_sets == () and len(recording.remarks) == 5


def test_directions_in_a_tilted_cylinder(path):
    # the cylinder's axis is x, its angle counts from y; rows of the matrix are its axes
    matrix = ["0.0 1.0 0.0", "0.0 0.0 1.0", "1.0 0.0 0.0", "0.5 0.0 0.0"]
    system = "\n".join(
        ["    -1", "  2420", "         1", "part", "         4         1         8", "c", *matrix]
    )
    node = NODES.replace("1        11", "4        11").replace("2.0D+00  3.0D+00", "0.0D+00  3.0D+00")
    functions = [function(THREE, response=(1, d), reference=(1, -1)) for d in (1, 2, 3)]
    write(path, units(), system, "\n    -1\n", node, *functions)
    [frf_set] = read_uff(path).frf_sets
    np.testing.assert_allclose(
        [dof.direction for dof in frf_set.responses], [[0, 0, 1], [0, -1, 0], [1, 0, 0]]
    )
    np.testing.assert_allclose(frf_set.references[0].direction, [0, 0, -1])
    on_axis = node.replace("3.0D+00", "0.0D+00")
    write(path, units(), system, "\n    -1\n", on_axis, *functions)
    directions = [dof.direction for dof in read_uff(path).frf_sets[0].responses]
    assert directions == [None, None, (1.0, 0.0, 0.0)]
    write(path, units(), system.replace("0.0 1.0 0.0", "0.0 1.1 0.0"), "\n    -1\n")
    assert "not orthogonal" in refusal(path)
    write(path, units(), system, "\n    -1\n", node.replace("4        11", "5        11"), *functions)
    assert "coordinate system 5, which is not defined" in refusal(path)


def test_dataset_15_and_trace_lines(path):
    node = (
        "    -1\n    15\n" + f"{7:10d}{0:10d}{0:10d}{1:10d}{0.1:13.5E}{-0.2:13.5E}{0.3:13.5E}\n" + "    -1\n"
    )
    trace = (
        "    -1\n    82\n" + f"{1:10d}{5:10d}{1:10d}\nNONE\n" + "%10i" * 5 % (7, 8, 0, 9, 7) + "\n    -1\n"
    )
    recording = read_uff(write(path, units(), node, trace))
    assert recording.nodes[0].number == 7
    assert recording.nodes[0].position == pytest.approx((0.1, -0.2, 0.3))
    assert recording.trace_lines == ((7, 8), (9, 7))


def test_real_mode_shapes_with_rotations(path):
    head = "    -1\n    55\n" + "NONE\n" * 5
    form = "%10i" * 6 % (1, 2, 3, 8, 2, 6) + "\n" + "%10i" * 4 % (2, 4, 0, 1) + "\n"
    data = (
        "%13.5E" * 4 % (1432.0, 1.0, 0.0, 0.006) + "\n         7\n" + "%13.5E" * 6 % (1, 2, 3, 4, 5, 6) + "\n"
    )
    [shape] = read_uff(write(path, units(), head + form + data + "    -1\n")).shapes
    assert (shape.frequency_hz, shape.damping_ratio, shape.nodes) == (1432.0, 0.003, (7,))
    np.testing.assert_array_equal(shape.displacement, [[1, 2, 3]])


def time_record(values: str, load_case: int, name: str, **keys) -> str:
    ordinate = {"force": (13, "N"), "acceleration": (12, "m/s^2")}[name]
    keys = {"response": (901, -1)} | keys if name == "force" else {"reference": (901, -1)} | keys
    return function(
        values, kind=1, form=2, even=1, start=0.0, step=1 / 48000, load_case=load_case,
        abscissa=(17, "s"), ordinate=ordinate, denominator=(0, "NONE"), **{"reference": (0, 0)} | keys,
    )  # fmt: skip


def test_hits_by_load_case(path):
    zero, pulse = "  0.00000E+00" * 3, "  0.00000E+00  2.00000E+01  0.00000E+00"
    records = [
        time_record(pulse, 2, "force"),
        time_record(zero, 2, "acceleration", response=(1, 1)),
        time_record(zero, 1, "acceleration", response=(1, 1)),
        time_record(zero, 1, "acceleration", response=(2, 1)),
        time_record(zero, 1, "force"),
        time_record(zero, 3, "force"),
    ]
    recording = read_uff(write(path, units(), *records))
    first, second = recording.hits
    assert (first.number, second.number) == (1, 2)
    assert [dof.node for dof in first.responses] == [1, 2]
    np.testing.assert_array_equal(second.force_n, [0.0, 20.0, 0.0])
    # printed with six digits, the increment means 48 kHz and not 48000.77 Hz
    assert first.sample_rate_hz == 48000.0
    assert (first.reference.node, first.reference.direction) == (901, (-1.0, -0.0, -0.0))
    assert "1 load cases lack" in " ".join(recording.remarks)
    write(path, units(), records[0], records[0], records[1])
    assert "second force of load case 2" in refusal(path)
    write(path, units(), records[0], records[1].replace("2.08333e-05", "2.08333e-04"))
    assert "another length or sample rate" in refusal(path)

from __future__ import annotations

from pathlib import Path

import pytest

from statorhom.errors import InputFileError
from statorhom.study.modal_table import MeasuredMode, read_modal_table


def table(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "modes.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_every_column_arrives(tmp_path: Path) -> None:
    header = (
        "axial,order,frequency_hz,frequency_sd_hz,loss_factor,"
        "modal_constant_per_kg,modal_constant_phase_deg,mode"
    )
    [mode] = read_modal_table(table(tmp_path, f"{header}\n1,2,1766,0.9,0.007,0.0196,-19,2a\n")).modes
    assert mode == MeasuredMode(1, "2a", 1766.0, 0.9, 0.007, 2, 1, 0.0196, -19.0)
    assert mode.label == "2a"


def test_loss_factor_is_twice_the_damping_ratio(tmp_path: Path) -> None:
    [mode] = read_modal_table(table(tmp_path, "frequency_hz,damping_ratio\n1432,0.003\n")).modes
    assert mode.loss_factor == 0.006


def test_comments_blank_lines_and_foreign_line_ends_do_not_count(tmp_path: Path) -> None:
    path = tmp_path / "modes.csv"
    path.write_bytes(
        b"\xef\xbb\xbf# a, b\r\n\r\nfrequency_hz , order\r\n 1432 , 2 \r\n  # middle\r\n3770,\r\n"
    )
    modes = read_modal_table(path).modes
    assert [(mode.row, mode.label, mode.frequency_hz, mode.order) for mode in modes] == [
        (1, "1", 1432.0, 2),
        (2, "2", 3770.0, None),
    ]


def test_resolved_doublet_stands_twice(tmp_path: Path) -> None:
    modes = read_modal_table(table(tmp_path, "frequency_hz,order,axial\n1432,2,0\n1433,2,0\n")).modes
    assert len(modes) == 2


@pytest.mark.parametrize(
    ("text", "fragments"),
    [
        ("order,axial\n2,0\n", ["line 1", "column frequency_hz is missing", "add it"]),
        (
            "frequency_khz\n1.432\n",
            ["line 1", 'unknown column "frequency_khz"', 'did you mean "frequency_hz"?'],
        ),
        ("frequency_hz,frequency_hz\n1,1\n", ["line 1", "occurs twice", "delete"]),
        ("frequency_hz\nnan\n", ["line 2, column frequency_hz", '"nan" is not a number', "type a number"]),
        ("frequency_hz\n1e999\n", ["line 2, column frequency_hz", '"1e999" is not a number']),
        ("frequency_hz\n1_432\n", ["line 2, column frequency_hz", '"1_432" is not a number']),
        ("frequency_hz\n1432 Hz\n", ["line 2, column frequency_hz", '"1432 Hz" is not a number']),
        ("frequency_hz,order\n,2\n", ["line 2, column frequency_hz", "is empty", "type the frequency"]),
        ("frequency_hz\n-1432\n", ["line 2, column frequency_hz", "greater than 0", "-1432"]),
        ("frequency_hz,order\n1432,2.5\n", ["line 2, column order", "whole number", "2.5"]),
        ("frequency_hz,order\n1432,-2\n", ["line 2, column order", "whole number", "-2"]),
        ("frequency_hz,loss_factor\n1432,5.13\n", ["line 2, column loss_factor", "5.13", "percent"]),
        ("frequency_hz,damping_ratio\n1432,nan\n", ["line 2, column damping_ratio", '"nan" is not a number']),
        (
            "frequency_hz,damping_ratio,loss_factor\n1432,0.1,0.2\n",
            ["header", "both damping_ratio and loss_factor", "keep one"],
        ),
        (
            "frequency_hz\n1.432\n3.77\n6.148\n",
            ["column frequency_hz", "below 50 Hz", "kHz", "multiply the column by 1000"],
        ),
        (
            "frequency_hz,order,axial\n1432,2,0\n1432,2,0\n",
            ["rows 1 and 2", "duplicate mode", "delete one of the rows"],
        ),
        ("frequency_hz\n1432\n1500\n1432.0\n", ["rows 1 and 3", "duplicate mode"]),
        (
            "frequency_hz,order\n1432,5,2\n",
            ["line 2", "has 3 cells, but the header has 2", "decimals with a point"],
        ),
        ("frequency_hz;order\n1432;2\n", ["line 1", "not separated by commas", "save the table with commas"]),
        ('frequency_hz\n"1432\n1500\n', ["line 2", "is not CSV", "remove stray quotes"]),
        ("", ["is empty", "write a header"]),
        ("# only a comment\n", ["is empty", "write a header"]),
        ("frequency_hz\n", ["has a header but no rows", "add one row per mode"]),
    ],
)
def test_every_fault_is_one_line_with_place_and_remedy(
    tmp_path: Path, text: str, fragments: list[str]
) -> None:
    path = table(tmp_path, text)
    with pytest.raises(InputFileError) as caught:
        read_modal_table(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert "\n" not in message and "; " in message
    for fragment in fragments:
        assert fragment in message


def test_unreadable_encoding_is_told(tmp_path: Path) -> None:
    path = tmp_path / "modes.csv"
    path.write_bytes("# für\nfrequency_hz\n1432\n".encode("latin-1"))
    with pytest.raises(InputFileError, match="is not text in UTF-8; save the file with the encoding UTF-8"):
        read_modal_table(path)


def test_control_characters_of_a_cell_do_not_reach_the_terminal(tmp_path: Path) -> None:
    with pytest.raises(InputFileError) as caught:
        read_modal_table(table(tmp_path, "frequency_hz\n\x1b[31mred\n"))
    assert str(caught.value).isprintable()


def test_uncertainties_and_frequencies_without_the_sensor_arrive(tmp_path: Path) -> None:
    text = (
        "frequency_hz,damping_ratio,damping_ratio_sd,frequency_without_sensor_hz,frequency_without_sensor_sd_hz\n"
        "1926.1,0.002,0.0001,1936.3,0.6\n1407.8,0.002,,,\n"
    )
    first, second = read_modal_table(table(tmp_path, text)).modes
    assert (first.loss_factor, first.loss_factor_sd) == (0.004, 0.0002)
    assert (first.frequency_without_sensor_hz, first.frequency_without_sensor_sd_hz) == (1936.3, 0.6)
    assert second.loss_factor_sd is second.frequency_without_sensor_hz is None


def test_two_kinds_of_uncertainty_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputFileError, match="damping_ratio_sd and loss_factor_sd; keep one"):
        read_modal_table(table(tmp_path, "frequency_hz,damping_ratio_sd,loss_factor_sd\n1,0.1,0.1\n"))

from __future__ import annotations

import os
from pathlib import Path

import pytest

from statorhom.errors import InputFileError
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.keys import Keys, Number
from statorhom.study.toml_file import read_toml


class Point(Keys):
    x_mm: Number
    y_mm: Number = 0.0


def point(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "point.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_values_and_defaults(tmp_path: Path) -> None:
    assert read_toml(point(tmp_path, "x_mm = 3\n"), Point) == Point(x_mm=3.0, y_mm=0.0)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("x_mm = \n", "is not valid TOML"),
        ("x_mm = " + "[" * 10_000, "is nested too deeply"),
        ("x_mm = " + "9" * 10_000, "is not valid TOML"),
        ("x_mm = 1" + "0" * 400, "x_mm: "),
        ('"x\\nmm" = 1', r"unknown key \"x\\nmm\"; did you mean \"x_mm\"\?"),
        ('x_mm = "' + "a" * 500 + '"', 'x_mm: must be a number, but is "a{59}…"'),
        ("x_mm = 2026-11-21", "x_mm: must be a number"),
    ],
    ids=["no value", "deep", "long", "large", "line break in key", "long text", "date"],
)
def test_unusual_text_is_one_short_line(tmp_path: Path, text: str, problem: str) -> None:
    path = point(tmp_path, text)
    with pytest.raises(InputFileError, match=problem) as caught:
        read_toml(path, Point)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert message.isprintable() and len(message) < len(str(path)) + 300


def test_unreadable_encoding(tmp_path: Path) -> None:
    path = tmp_path / "geometry.toml"
    path.write_bytes(b'name = "\xff"')
    with pytest.raises(InputFileError, match="byte 9: is not text in UTF-8"):
        read_toml(path, GeometryFile)


@pytest.mark.skipif(os.name != "posix", reason="needs a special file")
def test_special_files_are_not_opened(tmp_path: Path) -> None:
    path = tmp_path / "pipe.toml"
    os.mkfifo(path)
    with pytest.raises(InputFileError, match="there is no such file"):
        read_toml(path, Point)

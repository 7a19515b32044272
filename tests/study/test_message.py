from __future__ import annotations

import pytest

from statorhom.study.message import input_error, one_line, quoted


@pytest.mark.parametrize(
    ("raw", "shown"),
    [
        ("a\nb", "a\\nb"),
        ("\x1b[2J", "\\x1b[2J"),
        ("\u202e", "\\u202e"),
        ("Ø 5 mm", "Ø 5 mm"),
        ("\udc80", "\\udc80"),
    ],
)
def test_only_printable_characters_are_shown(raw: str, shown: str) -> None:
    assert one_line(raw) == shown


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (True, "true"),
        (3.0, "3.0"),
        ("a", '"a"'),
        ("b" * 100, '"' + "b" * 59 + '…"'),
        (["\n"], "['\\\\n']"),
    ],
)
def test_values_are_shown_short(value: object, shown: str) -> None:
    assert quoted(value) == shown.replace("\\\\", "\\")


def test_giant_numbers_are_not_written_out() -> None:
    assert quoted(10**5000) == "a number of more than 60 digits"


def test_error_has_place_problem_and_remedy() -> None:
    assert str(input_error("a.toml", "core", "is bad", "mend it")) == "a.toml: core: is bad; mend it"
    assert str(input_error("a.toml", "", "is bad", "mend it")) == "a.toml: is bad; mend it"

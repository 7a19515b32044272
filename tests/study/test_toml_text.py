"""What is written as TOML reads as what it was."""

from __future__ import annotations

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.study.toml_text import toml_text

texts = st.text(st.characters(codec="utf-8", exclude_categories=["Cs"]), max_size=8)
numbers = st.floats(allow_nan=False, allow_infinity=False) | st.integers(-(2**62), 2**62) | st.booleans()
plain = texts | numbers | st.lists(numbers, max_size=3) | st.lists(texts, max_size=3)
tables = st.recursive(
    st.dictionaries(texts, plain, max_size=4),
    lambda inner: st.dictionaries(texts, plain | inner | st.lists(inner, min_size=1, max_size=3), max_size=4),
    max_leaves=8,
)


@given(tables)
def test_reads_as_it_was(table: dict) -> None:
    assert tomllib.loads(toml_text(table)) == table


def test_keys_without_value_are_left_out() -> None:
    assert toml_text({"a": None, "b": 1}) == "b = 1\n"


def test_refuses_what_has_no_form() -> None:
    with pytest.raises(ValueError, match="set"):
        toml_text({"a": {1, 2}})

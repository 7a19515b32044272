"""TOML that is written is TOML that is read."""

from __future__ import annotations

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from statorhom.diagnose.apply import toml_text

VALUES = st.one_of(
    st.booleans(),
    st.integers(-(10**6), 10**6),
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(st.characters(exclude_categories=("Cs",)), max_size=12),
    st.lists(st.integers(0, 9), max_size=3),
)
KEYS = st.text("abcdefgh_", min_size=1, max_size=6)
TABLES = st.dictionaries(KEYS, st.one_of(VALUES, st.dictionaries(KEYS, VALUES, max_size=3)), max_size=4)


@given(TABLES, st.lists(TABLES, min_size=1, max_size=2))
def test_written_tables_read_back(table: dict[str, object], rows: list[dict[str, object]]) -> None:
    whole = {**table, "stages": [{"name": "x", **row} for row in rows]}
    assert tomllib.loads(toml_text(whole)) == whole

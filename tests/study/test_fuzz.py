"""Whatever stands in a file: it is read, or a StatorhomError says in one line why not."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from statorhom.errors import StatorhomError
from statorhom.study import load_study, read_geometry, read_modal_table
from statorhom.study.modal_table import ModalTable
from statorhom.study.study_file import read_study_file

FUZZ = settings(
    deadline=None,
    max_examples=150,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
    derandomize=True,
)

CELLS = st.one_of(
    st.sampled_from(
        ["", "1432", "0.006", "2", "-1", "nan", "inf", "1e999", "1,5", '"', "#", "\x1b[2J", "²", "٣"]
    ),
    st.floats().map(str),
    st.text(max_size=8),
)
COLUMNS = st.sampled_from(
    [
        "frequency_hz",
        "order",
        "axial",
        "damping_ratio",
        "loss_factor",
        "frequency_sd_hz",
        "mode",
        "frequency",
        "",
    ]
)
VALUES = st.recursive(
    st.one_of(
        st.sampled_from(
            ["true", "1", "-3.0", "nan", "inf", '""', '"free"', '"x\\u0000"', "1979-05-27", "[]", "{}"]
        ),
        st.integers().map(str),
        st.floats(allow_nan=False, allow_infinity=False).map(str),
        # JSON's quoting of printable text is TOML's
        st.text(st.characters(min_codepoint=32, max_codepoint=0x2FF, exclude_characters="\x7f")).map(
            json.dumps
        ),
    ),
    lambda inner: st.lists(inner, max_size=3).map(lambda items: f"[{', '.join(items)}]"),
    max_leaves=4,
)


def survives(read: Callable[[Path], Any], path: Path) -> Any:
    """The result, or None after a proper error."""
    try:
        return read(path)
    except StatorhomError as error:
        message = str(error)
        assert message.startswith(str(path.parent))
        assert message.isprintable()
        return None


@pytest.mark.parametrize("read", [read_geometry, read_study_file, read_modal_table])
@FUZZ
@given(
    content=st.one_of(
        st.binary(max_size=200), st.text(max_size=200).map(lambda text: text.encode("utf-8", "replace"))
    )
)
def test_any_bytes(folder: Any, read: Callable[[Path], Any], content: bytes) -> None:
    folder.study.write_bytes(content)
    survives(read, folder.study)


@FUZZ
@given(
    header=st.lists(COLUMNS, min_size=1, max_size=4), rows=st.lists(st.lists(CELLS, max_size=5), max_size=4)
)
def test_any_table(folder: Any, header: list[str], rows: list[list[str]]) -> None:
    lines = [",".join(header), *(",".join(row) for row in rows)]
    folder.table.write_text("\n".join(lines), encoding="utf-8", errors="replace", newline="")
    table = survives(read_modal_table, folder.table)
    if table is not None:
        assert isinstance(table, ModalTable) and table.modes
        assert all(mode.frequency_hz > 0 for mode in table.modes)
        assert all(mode.loss_factor is None or 0 < mode.loss_factor < 2 for mode in table.modes)


@pytest.mark.parametrize("file", ["study.toml", "ring.toml"])
@FUZZ
@given(data=st.data())
def test_any_value_of_any_key(folder: Any, file: str, data: st.DataObject) -> None:
    type(folder)(folder.root)
    path = folder.root / file
    lines = path.read_text(encoding="utf-8").split("\n")
    keyed = [index for index, line in enumerate(lines) if " = " in line]
    index = data.draw(st.sampled_from(keyed))
    key = lines[index].split(" = ")[0]
    lines[index] = f"{key} = {data.draw(VALUES)}"
    path.write_text("\n".join(lines), encoding="utf-8")
    survives(load_study, folder.study)


@pytest.mark.parametrize("file", ["study.toml", "ring.toml"])
@FUZZ
@given(data=st.data())
def test_lines_lost_doubled_or_exchanged(folder: Any, file: str, data: st.DataObject) -> None:
    type(folder)(folder.root)
    path = folder.root / file
    lines = path.read_text(encoding="utf-8").split("\n")
    picked = data.draw(st.lists(st.sampled_from(lines), max_size=2 * len(lines)))
    cut = data.draw(st.integers(0, len(lines)))
    path.write_text("\n".join(lines[:cut] + picked), encoding="utf-8")
    survives(load_study, folder.study)

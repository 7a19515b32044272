from __future__ import annotations

from pathlib import Path

import pytest

from statorhom.command_line.template import FILES, write_template
from statorhom.errors import InputFileError
from statorhom.study import load_study


def test_is_a_valid_study(tmp_path: Path) -> None:
    paths = write_template(tmp_path / "deep" / "new")
    assert [path.name for path in paths] == list(FILES)
    files = load_study(tmp_path / "deep" / "new" / "study.toml")
    (stage,) = files.study.stages
    assert [mode.order for mode in files.tables["stack-free"].modes] == [2, 2, 3]
    assert stage.mass_kg == 3.08


@pytest.mark.parametrize("name", FILES)
def test_replaces_nothing(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text("mine", encoding="utf-8")
    with pytest.raises(InputFileError, match="exists already; choose another folder"):
        write_template(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert (tmp_path / name).read_text(encoding="utf-8") == "mine"

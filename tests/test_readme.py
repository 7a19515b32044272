"""The README tells the truth: its files exist, its study is one, its commands are the program's."""

import re
import tomllib
from pathlib import Path

import pytest

from statorhom.cli import app
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.stages import IdentifyKeys
from statorhom.study.study import load_study

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
FOLDERS = ("scripts", "measurements", "geometries", "notebooks", "benchmarks", "src", "tests", "reports")


def blocks(language: str) -> list[str]:
    """Fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", README, flags=re.MULTILINE | re.DOTALL)


def test_its_files_exist() -> None:
    named = set(re.findall(rf"\b(?:{'|'.join(FOLDERS)})/[\w./-]*\w", README))
    assert len(named) >= 5
    assert {path for path in named if not (ROOT / path).exists()} == set()


def test_its_study_can_be_loaded(tmp_path: Path) -> None:
    (study,) = blocks("toml")
    (table,) = blocks("csv")
    (tmp_path / "study.toml").write_text(study, encoding="utf-8")
    (tmp_path / "stack-free.csv").write_text(table, encoding="utf-8")
    machine = (ROOT / "geometries" / "550w-induction-36-slots.toml").read_bytes()
    (tmp_path / "geometry.toml").write_bytes(machine)
    files = load_study(tmp_path / "study.toml")
    assert [mode.order for mode in files.tables["stack-free"].modes] == [2, None, None]


def test_its_table_names_all_commands() -> None:
    named = set(re.findall(r"^\| `statorhom (\w+) ", README, flags=re.MULTILINE))
    assert named == {command.callback.__name__ for command in app.registered_commands if command.callback}


@pytest.mark.parametrize("key", sorted(IdentifyKeys.model_fields))
def test_its_table_names_all_keys_of_the_search(key: str) -> None:
    assert re.search(rf"`(stages\.identify)?\.{key}[.`]", README)


def test_it_names_all_slot_shapes() -> None:
    slots = GeometryFile.model_json_schema()["properties"]["slots"]["discriminator"]["mapping"]
    rows = set(re.findall(r"^\| `(\w+)` \|", README, flags=re.MULTILINE))
    statuses = {"identified", "prior_dominated", "fixed"}
    assert rows - statuses == set(slots)
    assert statuses < rows


def test_the_environment_is_the_one_that_it_states() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["requires-python"] == ">=3.11" and "Python 3.11 or newer" in README
    assert project["license"]["text"] in README

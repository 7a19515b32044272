"""The way through the house: who may import whom, and how long a file and a function may be."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[1] / "src" / "statorhom"
FILES = sorted(SOURCE.rglob("*.py"))
PIPELINE = (
    "errors",
    "study",
    "geometry",
    "mesh",
    "materials",
    "model",
    "physics",
    "recordings",
    "modes",
    "extraction",
)
# a part may import itself and these
ALLOWED: dict[str, set[str]] = {part: set(PIPELINE[:i]) for i, part in enumerate(PIPELINE)}
ALLOWED["results"] = {"errors", "study", "geometry", "mesh"}
ALLOWED["identify"] = {*PIPELINE, "results"}
ALLOWED["diagnose"] = {*PIPELINE, "results", "identify"}
ALLOWED["conceal"] = {*PIPELINE, "results"}
ALLOWED["fleet"] = {*PIPELINE, "results", "identify"}
ALLOWED["report"] = {*PIPELINE, "results"}
ALLOWED["simulate"] = {*PIPELINE, "results", "identify"}
ALLOWED["measure"] = {*PIPELINE, "results", "identify", "report"}
ALLOWED["ground_test"] = set(PIPELINE)
ALLOWED["api"] = {*PIPELINE, "results", "identify", "report", "diagnose"}
ALLOWED["command_line"] = {*PIPELINE, "results", "identify", "report"}
ALLOWED["cli"] = {
    *PIPELINE,
    "results",
    "identify",
    "report",
    "diagnose",
    "conceal",
    "fleet",
    "simulate",
    "measure",
    "ground_test",
    "api",
    "command_line",
}
ALLOWED["__init__"] = {"errors", "api"}
ALLOWED["__main__"] = {"cli"}

# folders of a part, in the order in which data goes through them; the part's own files stand above all of these
FOLDERS = {
    "identify": (
        "processes",
        "parameters",
        "optimizers",
        "inference",
        "stages",
        "residuals",
        "bases",
        "surface",
        "fits",
        "comparison",
        "results",
    ),
    "diagnose": (
        "processes",
        "measured",
        "bases",
        "contacts",
        "stages",
        "predicted",
        "features",
        "fits",
        "located",
        "next_measurement",
        "evidence",
        "searches",
        "coupons",
    ),
}

LONGEST_FILE, LONGEST_FUNCTION = 350, 60


def part(path: Path) -> str:
    """Folder or file of the package that a source file belongs to."""
    return path.relative_to(SOURCE).parts[0].removesuffix(".py")


def imports(path: Path) -> Iterator[str]:
    """Parts of the package that a file imports, inside functions too."""
    return (name.split(".")[0] for name in imported(path))


def imported(path: Path) -> Iterator[str]:
    """Names below the package that a file imports, inside functions too."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: imports are absolute"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        for name in names:
            head, *rest = name.split(".")
            if head == "statorhom":
                yield ".".join(rest) or "__init__"


def identified(path: Path) -> str:
    return str(path.relative_to(SOURCE))


def test_every_part_has_its_place() -> None:
    assert {part(path) for path in FILES} <= set(ALLOWED)


def test_every_folder_is_a_package() -> None:
    """setuptools leaves a folder without __init__.py out of what it installs."""
    assert [f for f in {path.parent for path in FILES} if not (f / "__init__.py").exists()] == []


@pytest.mark.parametrize("path", FILES, ids=identified)
def test_imports_only_what_lies_before(path: Path) -> None:
    mine = part(path)
    assert set(imports(path)) - {mine} <= ALLOWED[mine]


@pytest.mark.parametrize("name", FOLDERS)
def test_a_part_has_no_other_folders(name: str) -> None:
    folders = {path.parent.relative_to(SOURCE / name).parts for path in FILES if part(path) == name}
    assert folders == {(), *((folder,) for folder in FOLDERS[name])}


@pytest.mark.parametrize("path", [f for f in FILES if part(f) in FOLDERS], ids=identified)
def test_data_goes_through_folders_one_way(path: Path) -> None:
    mine, *folder, _ = path.relative_to(SOURCE).parts
    order = FOLDERS[mine]
    own_files = {file.stem for file in (SOURCE / mine).glob("*.py")}
    before = order[: order.index(folder[0]) + 1] if folder else {*order, *own_files}
    within = {name.split(".")[1] for name in imported(path) if name.startswith(f"{mine}.")}
    assert within <= set(before)


def test_parts_do_not_go_in_circles() -> None:
    needs = {name: {i for path in FILES if part(path) == name for i in imports(path)} for name in ALLOWED}
    left = {name: set(needs[name]) - {name} for name in needs}
    while free := [name for name, others in left.items() if not others]:
        for name in free:
            del left[name]
        for others in left.values():
            others.difference_update(free)
    assert left == {}


@pytest.mark.parametrize("path", FILES, ids=identified)
def test_files_and_functions_are_readable_at_once(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= LONGEST_FILE
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            assert node.end_lineno is not None
            documented = ast.get_docstring(node, clean=False) is not None
            first = node.body[0]
            prose = (first.end_lineno or 0) - first.lineno + 1 if documented else 0
            assert node.end_lineno - node.lineno + 1 - prose <= LONGEST_FUNCTION, node.name


@pytest.mark.parametrize("path", FILES, ids=identified)
def test_no_machine_or_case_is_known_by_name(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for name in ("van-der-giet", "550w", "machine-a", "p1-clean", "p7-clean"):
        assert name not in text.replace("measurements/van-der-giet-550w/study.toml", "")


def test_no_two_test_files_share_a_name() -> None:
    """Pytest imports them by name alone: one of two would not be collected."""
    names = [path.name for path in Path(__file__).parent.rglob("test_*.py")]
    assert sorted(names) == sorted(set(names))

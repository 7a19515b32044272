from __future__ import annotations

from typing import Any

import pytest

from statorhom.study import load_study
from statorhom.study.digest import stage_digest


def digests(folder: Any, seed: int = 1) -> tuple[str, str]:
    files = load_study(folder.study)
    return stage_digest(files, 0, {"seed": seed}), stage_digest(files, 1, {"seed": seed})


@pytest.mark.parametrize(
    ("file", "old", "new", "stack_changes", "wound_changes"),
    [
        ("study.toml", 'name = "small"', 'name = "other"', False, False),
        ("study.toml", "schema = 1", "# a comment\nschema = 1", False, False),
        ("ring.toml", 'name = "small ring"', 'name = "same ring"', False, False),
        ("modes.csv", "# first resonances", "# resonances", False, False),
        ("study.toml", "mass_kg = 3.08", "mass_kg = 3.09", True, True),
        ("study.toml", "nu_p = 0.3", "nu_p = 0.31", True, True),
        ("study.toml", "high = 2.05e11", "high = 2.1e11", True, True),
        ("study.toml", "mass_kg = 4.36", "mass_kg = 4.37", False, True),
        ("study.toml", "202.0", "203.0", False, True),
        ("ring.toml", "80.5", "80.6", True, True),
        ("modes.csv", "1766", "1767", True, True),
        ("wound.uff", "-1", "-2", False, True),
    ],
)
def test_changes_exactly_with_what_decides_the_stage(
    folder: Any, file: str, old: str, new: str, stack_changes: bool, wound_changes: bool
) -> None:
    before = digests(folder)
    folder.edit(file, old, new)
    after = digests(folder)
    assert (before[0] != after[0], before[1] != after[1]) == (stack_changes, wound_changes)


def test_depends_on_the_seed_and_on_nothing_else(folder: Any) -> None:
    assert digests(folder, seed=1) == digests(folder, seed=1)
    assert set(digests(folder, seed=1)).isdisjoint(digests(folder, seed=2))

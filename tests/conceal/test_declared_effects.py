"""A study that declares effects is no template of a truth."""

from __future__ import annotations

from pathlib import Path

import pytest

from concealed_rings import write_ring
from statorhom.conceal.conceal_study import conceal_study
from statorhom.errors import InputFileError


def test_declared_effects_are_refused_before_any_work(tmp_path: Path) -> None:
    path = write_ring(tmp_path)
    with path.open("a", encoding="utf-8") as file:
        file.write(
            '\n[[stages.effects]]\neffect = "ovality"\nharmonic = 4\nrelative_amplitude = 0.01\nangle_deg = 0.0\n'
        )
    with pytest.raises(InputFileError, match="no declared effects; delete them"):
        conceal_study(path, [], tmp_path / "out")
    assert not (tmp_path / "out").exists()

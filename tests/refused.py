"""Studies that are refused, with one line."""

from __future__ import annotations

from pathlib import Path

import pytest

from statorhom.errors import InputFileError
from statorhom.study.study import load_study


def refused_study(path: Path, *fragments: str) -> None:
    """Assert that a study's files raise one line that says all fragments and a remedy."""
    with pytest.raises(InputFileError) as caught:
        load_study(path)
    message = str(caught.value)
    assert "\n" not in message and "; " in message
    for fragment in fragments:
        assert fragment in message

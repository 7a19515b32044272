"""What fails inside the diagnosis reaches the user as one line."""

from __future__ import annotations

import pytest

from statorhom.diagnose.processes.one_line_errors import one_line_errors
from statorhom.errors import IdentificationError, SolverError


@pytest.mark.parametrize("inner", [ValueError("a\nb"), KeyError("k"), ZeroDivisionError(), RuntimeError("r")])
def test_unexpected_errors_become_one_line(inner: Exception) -> None:
    with pytest.raises(IdentificationError, match=r"^study.toml: ") as caught, one_line_errors("study.toml"):
        raise inner
    assert "\n" not in str(caught.value)
    assert caught.value.__cause__ is inner


def test_own_errors_stay_as_they_are() -> None:
    with pytest.raises(SolverError, match="own words"), one_line_errors("study.toml"):
        raise SolverError("own words")

"""Errors from inside a computation in the program's own words."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from statorhom.errors import IdentificationError


@contextmanager
def one_line_errors(path: str) -> Iterator[None]:
    """What numbers nobody thought of lead to, in the program's own words.

    Raises
    ------
    IdentificationError
        For every arithmetic error, lookup or value that fails inside.
    """
    try:
        yield
    except (ArithmeticError, LookupError, ValueError, RuntimeError) as error:
        said = " ".join(f"{type(error).__name__} {error}".split())
        raise IdentificationError(
            f"{path}: the diagnosis cannot go on with these tests ({said}); run 'statorhom check', and leave out "
            "tests one by one to find the one at fault"
        ) from error

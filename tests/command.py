"""The command line, called in this process as its entry point calls it."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Sequence
from dataclasses import dataclass
from unittest import mock

from statorhom.cli import app
from statorhom.command_line.exit_codes import guarded


@dataclass(frozen=True)
class Outcome:
    """How a command ended: exit code and what it printed."""

    code: int
    stdout: str
    stderr: str


def statorhom(*arguments: object) -> Outcome:
    """Run `statorhom ARGUMENTS`; an exception that reaches the user is raised here."""
    words: Sequence[str] = ["statorhom", *map(str, arguments)]
    out, error = io.StringIO(), io.StringIO()
    with (
        mock.patch("sys.argv", list(words)),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(error),
    ):
        code = guarded(app)
    return Outcome(code, out.getvalue(), error.getvalue())

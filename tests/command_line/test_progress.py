from __future__ import annotations

import io

import pytest
from rich.console import Console

from statorhom.command_line import progress
from statorhom.command_line.progress import progress_bars


def shown(monkeypatch: pytest.MonkeyPatch, *, terminal: bool, quiet: bool) -> str:
    """What bars write while two of three units of work are done."""
    written = io.StringIO()
    console = Console(file=written, force_terminal=terminal, width=100)
    monkeypatch.setattr(progress, "Console", lambda stderr: console if stderr else pytest.fail("stdout"))
    with progress_bars(quiet=quiet) as announce:
        announce("search", 3)(2)
    return written.getvalue()


def test_bars_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    text = shown(monkeypatch, terminal=True, quiet=False)
    assert "search" in text and "2/3" in text


@pytest.mark.parametrize(("terminal", "quiet"), [(True, True), (False, False)])
def test_silence_where_nobody_watches(terminal: bool, quiet: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    assert shown(monkeypatch, terminal=terminal, quiet=quiet) == ""


def test_bars_let_errors_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    console = Console(file=io.StringIO(), force_terminal=True)
    monkeypatch.setattr(progress, "Console", lambda stderr: console)  # noqa: ARG005
    with pytest.raises(KeyboardInterrupt), progress_bars():
        raise KeyboardInterrupt

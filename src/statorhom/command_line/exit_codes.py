"""Exit codes: 0 done, 2 bad input or usage (one line on standard error), 130 interrupted."""

from __future__ import annotations

import sys

import typer

from statorhom.errors import StatorhomError

DONE, BAD_INPUT, INTERRUPTED = 0, 2, 130


def guarded(app: typer.Typer) -> int:
    """Run a command line and turn how it ends into an exit code."""
    try:
        code = app(standalone_mode=False)
    except StatorhomError as error:
        _say(str(error))
        return BAD_INPUT
    except (KeyboardInterrupt, typer.Abort):
        code = INTERRUPTED
    except Exception as error:
        # usage errors carry their message in a method; typer does not export their class
        message = getattr(error, "format_message", None)
        if message is None:
            raise
        # without any argument the message is the whole help, which has been shown
        _say(f"{message().rstrip('.') or 'no command given'}; see statorhom --help")
        return BAD_INPUT
    # newer versions of typer catch the interruption themselves and return its code
    if code == INTERRUPTED:
        _say("interrupted; the steps that are done stay in the results folder")
    return code if isinstance(code, int) else DONE


def _say(message: str) -> None:
    print("statorhom: " + " ".join(message.split()), file=sys.stderr)

from __future__ import annotations

import pytest
import typer

from statorhom.command_line.exit_codes import guarded
from statorhom.errors import GeometryError


def ends(behaviour: BaseException | int | None, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    """Exit code and standard error of a program whose one command raises, or returns."""
    app = typer.Typer(pretty_exceptions_enable=False)

    @app.command()
    def command() -> object:
        if isinstance(behaviour, BaseException):
            raise behaviour
        return behaviour

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.argv", ["statorhom"])
        code = guarded(app)
    captured = capsys.readouterr()
    assert captured.out == ""
    return code, captured.err


def test_done(capsys: pytest.CaptureFixture[str]) -> None:
    assert ends(None, capsys) == (0, "")


def test_own_errors_are_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert ends(GeometryError("ring.toml: a\nb"), capsys) == (2, "statorhom: ring.toml: a b\n")


@pytest.mark.parametrize("interruption", [KeyboardInterrupt(), typer.Abort()])
def test_interrupted(interruption: BaseException, capsys: pytest.CaptureFixture[str]) -> None:
    code, line = ends(interruption, capsys)
    assert code == 130
    assert line == "statorhom: interrupted; the steps that are done stay in the results folder\n"


def test_own_faults_show_their_traceback(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(ZeroDivisionError):
        ends(ZeroDivisionError(), capsys)


@pytest.mark.parametrize("code", [0, 3])
def test_an_exit_code_is_passed_on(code: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert ends(typer.Exit(code), capsys) == (code, "")

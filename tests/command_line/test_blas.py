"""Threads of BLAS are told before it is loaded, and the user has the last word."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from statorhom.command_line.blas import THREADS, one_thread_each


def test_one_thread_where_the_user_said_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    told = {THREADS[0]: "3"}
    monkeypatch.setattr(os, "environ", told)
    one_thread_each()
    assert [told[name] for name in THREADS] == ["3", "1", "1"]


def test_a_command_that_is_refused_has_told_blas_already() -> None:
    """In a process of its own: NumPy must not be there before."""
    code = (
        "import os, sys; from statorhom.cli import main; print('numpy' in sys.modules)\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "from threadpoolctl import threadpool_info as told\n"
        "print({library['num_threads'] for library in told() if library['user_api'] == 'blas'})"
    )
    plain = {key: value for key, value in os.environ.items() if key not in THREADS}
    done = subprocess.run(
        [sys.executable, "-c", code, "diagnose", "nothing.toml"],
        env=plain,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == ["False", "{1}"]

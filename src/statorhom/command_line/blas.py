"""What has to be said before NumPy is loaded."""

from __future__ import annotations

import os

THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")


def one_thread_each() -> None:
    """One thread of BLAS in every process of a command that forks; what the user has set stays.

    A library that could have more makes them anew after each fork, and they wait by computing: a tenth of the time of
    two processes on two processors. Limits that are set later keep them from work, not from waiting.
    """
    for name in THREADS:
        os.environ.setdefault(name, "1")

"""One gmsh session at a time, without its output and its signal handler."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

from statorhom.errors import MissingDependencyError
from statorhom.study.message import one_line

_LOCK = threading.Lock()  # gmsh keeps one global model

SYSTEM_PACKAGES = "libglu1-mesa libgl1 libxrender1 libxcursor1 libxft2 libxinerama1 libgomp1"
# silent, on one thread, elements with nodes on their edges only
OPTIONS = {
    "General.Terminal": 0,
    "General.NumThreads": 1,
    "Mesh.ElementOrder": 2,
    "Mesh.SecondOrderIncomplete": 1,
    "Mesh.SecondOrderLinear": 0,
}


def import_gmsh() -> ModuleType:
    """Import gmsh, or say in one line which system libraries it lacks.

    Raises
    ------
    MissingDependencyError
    """
    try:
        import gmsh
    except ModuleNotFoundError:
        raise MissingDependencyError("gmsh is not installed; run: pip install gmsh") from None
    except (ImportError, OSError) as error:
        raise MissingDependencyError(
            one_line(f"gmsh cannot be loaded ({error}); on Debian run: apt-get install {SYSTEM_PACKAGES}")
        ) from None
    return gmsh


@contextmanager
def gmsh_session() -> Iterator[ModuleType]:
    """An empty gmsh model that is gone again whatever happens.

    Where somebody has opened gmsh already, their model and options are as they were afterwards.
    """
    gmsh = import_gmsh()
    with _LOCK, _guest(gmsh) if gmsh.isInitialized() else _own(gmsh):
        for name, value in OPTIONS.items():
            gmsh.option.setNumber(name, value)
        gmsh.model.add("section")
        yield gmsh


@contextmanager
def _own(gmsh: ModuleType) -> Iterator[None]:
    gmsh.initialize(interruptible=False, readConfigFiles=False)
    try:
        yield
    finally:
        gmsh.finalize()


@contextmanager
def _guest(gmsh: ModuleType) -> Iterator[None]:
    model = gmsh.model.getCurrent()
    options = {name: gmsh.option.getNumber(name) for name in OPTIONS}
    try:
        yield
    finally:
        gmsh.model.remove()
        gmsh.model.setCurrent(model)
        for name, value in options.items():
            gmsh.option.setNumber(name, value)

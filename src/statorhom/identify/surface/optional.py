"""Libraries of the extra `surface`, imported where they are used."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from statorhom.errors import MissingDependencyError


def optional(module: str, library: str, use: str) -> ModuleType:
    """Import a module of an optional library.

    Parameters
    ----------
    module : its full name.
    library : what is to be installed.
    use : what needs it, for the message.

    Raises
    ------
    MissingDependencyError
        If it is not installed.
    """
    try:
        return import_module(module)
    except ImportError:
        raise MissingDependencyError(
            f"{use} needs {library}, which is not installed: pip install 'statorhom[surface]'"
        ) from None

"""Homogenized materials of electrical-machine stators, identified step by step from masses and measured modes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from statorhom.errors import StatorhomError

if TYPE_CHECKING:
    from statorhom.api import Study

__all__ = ["StatorhomError", "Study"]


def __getattr__(name: str) -> Any:
    """Load the program when it is asked for: a usage error is answered without it."""
    if name == "Study":
        from statorhom.api import Study

        return Study
    raise AttributeError(f"module 'statorhom' has no attribute {name!r}")

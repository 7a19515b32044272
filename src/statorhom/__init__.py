"""Homogenized materials of electrical-machine stators, identified step by step from masses and measured modes."""

from statorhom.api import Study
from statorhom.errors import StatorhomError

__all__ = ["StatorhomError", "Study"]

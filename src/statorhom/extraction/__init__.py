"""Modal extraction: poles, damping, modal constants and complex shapes from measured receptances."""

from __future__ import annotations

from statorhom.extraction.circle_fit import CircleFit, SdofModel, circle_fit, regenerate, sdof_model
from statorhom.extraction.cmif import cmif
from statorhom.extraction.extract import extract
from statorhom.extraction.extraction import ExtractedMode, Extraction
from statorhom.extraction.local_poles import LocalPoles, local_poles
from statorhom.extraction.stabilization import Stabilization

__all__ = [
    "CircleFit",
    "ExtractedMode",
    "Extraction",
    "LocalPoles",
    "SdofModel",
    "Stabilization",
    "circle_fit",
    "cmif",
    "extract",
    "local_poles",
    "regenerate",
    "sdof_model",
]

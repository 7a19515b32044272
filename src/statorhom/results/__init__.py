"""What a study found: the contents of results.json."""

from statorhom.results.files import read_results, write_results
from statorhom.results.schema import (
    BandSummary,
    Constant,
    Convergence,
    FitSummary,
    Interval,
    MaterialTest,
    ModeResult,
    Optimum,
    RegionResult,
    Results,
    Sensitivity,
    StageResult,
    SurfaceSummary,
    TestedFrequency,
    VerifiedMode,
)

__all__ = [
    "BandSummary",
    "Constant",
    "Convergence",
    "FitSummary",
    "Interval",
    "MaterialTest",
    "ModeResult",
    "Optimum",
    "RegionResult",
    "Results",
    "Sensitivity",
    "StageResult",
    "SurfaceSummary",
    "TestedFrequency",
    "VerifiedMode",
    "read_results",
    "write_results",
]

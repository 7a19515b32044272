"""What a study found: the contents of results.json."""

from statorhom.results.files import read_results, write_results
from statorhom.results.schema import (
    Constant,
    Convergence,
    FitSummary,
    Interval,
    ModeResult,
    Optimum,
    RegionResult,
    Results,
    Sensitivity,
    StageResult,
)

__all__ = [
    "Constant",
    "Convergence",
    "FitSummary",
    "Interval",
    "ModeResult",
    "Optimum",
    "RegionResult",
    "Results",
    "Sensitivity",
    "StageResult",
    "read_results",
    "write_results",
]

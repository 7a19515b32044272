"""The program's own exceptions.

Every message is one line that names what is wrong (file and key where there is one) and what to do
about it; the command line prints it on standard error and leaves with exit code 2.
"""

from __future__ import annotations


class StatorhomError(Exception):
    """Base of all errors that a user can mend."""


class InputFileError(StatorhomError):
    """A study, geometry or table file is missing, unreadable or breaks the file contract."""


class GeometryError(StatorhomError):
    """The dimensions contradict each other."""


class MassError(StatorhomError):
    """The weights of the steps contradict each other."""


class MaterialError(StatorhomError):
    """Elastic constants that no material can have."""


class SupportError(StatorhomError):
    """A support that the model cannot represent."""


class SolverError(StatorhomError):
    """A numerical method did not reach its accuracy."""


class RecordingError(StatorhomError):
    """A recording that cannot be read, or that does not hold what its use needs."""


class ExtractionError(StatorhomError):
    """Receptances from which modes cannot be extracted."""


class IdentificationError(StatorhomError):
    """The measurements do not allow the fit that was asked for."""


class ResultsError(StatorhomError):
    """A results folder is missing, damaged or belongs to another study."""


class MissingDependencyError(StatorhomError):
    """A library or one of its system parts is not installed."""

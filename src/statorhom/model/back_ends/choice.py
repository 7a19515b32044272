"""The back ends by name, and the best one that is installed."""

from __future__ import annotations

from contextlib import suppress
from types import MappingProxyType

from statorhom.errors import MissingDependencyError
from statorhom.model.back_ends import cholmod, pardiso
from statorhom.model.back_ends.superlu import superlu
from statorhom.model.eigen import Factorize

BACK_ENDS = MappingProxyType({"superlu": superlu, "cholmod": cholmod.cholmod, "pardiso": pardiso.pardiso})


def best_available() -> Factorize:
    """The best back end whose library can be loaded; benchmarks/README.md says why in this order."""
    for module, name in ((cholmod, "cholmod"), (pardiso, "pardiso")):
        with suppress(MissingDependencyError):
            module.library()
            return BACK_ENDS[name]
    return superlu

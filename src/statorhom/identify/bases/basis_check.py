"""The reduced model against the full one where it matters: at the result of a fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.model.convergence import mode_keys
from statorhom.model.free_modes import FreeModes
from statorhom.model.reduced_stator import ReducedModes

ROUNDING = 1e-6  # of a frequency: what two eigensolvers may differ by


@dataclass(frozen=True)
class BasisCheck:
    """Frequencies of the reduced model over those of the full one, at one material or at several.

    Parameters
    ----------
    deviation : largest relative deviation.
    certified : what the certificate promised for the same modes, the largest.
    broken : modes (order, axial) whose deviation exceeds their own certificate.
    """

    deviation: float
    certified: float
    broken: tuple[tuple[int, int], ...]

    @property
    def holds(self) -> bool:
        """No mode deviates by more than its certificate."""
        return not self.broken


def check_basis(reduced: ReducedModes, full: FreeModes) -> BasisCheck:
    """Compare the named modes that both have, up to the end of the band that the reduced model is made for."""
    exact = mode_keys(full.modes)
    deviations, bounds, broken = [0.0], [0.0], []
    for key, mode in mode_keys(reduced.modes).items():
        if key not in exact or mode.frequency_hz > reduced.stator.certified_hz:
            continue
        deviation = float(np.abs(mode.frequency_hz / exact[key].frequency_hz - 1.0))
        bound = reduced.certified_error(mode)
        deviations.append(deviation)
        bounds.append(bound)
        if deviation > bound + ROUNDING:
            broken.append(key[:2])
    return BasisCheck(max(deviations), max(bounds), tuple(broken))


def together(checks: Sequence[BasisCheck]) -> BasisCheck:
    """The worst of several, for as many materials."""
    broken = sorted({name for check in checks for name in check.broken})
    return BasisCheck(max(c.deviation for c in checks), max(c.certified for c in checks), tuple(broken))

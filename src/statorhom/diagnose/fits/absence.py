"""Whether an effect may as well be absent, and what the constants would be then."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.fits.explanations import Explanation, blank, refitted
from statorhom.diagnose.fits.refit import Refit
from statorhom.materials.typical_ranges import Z95


def differs_from_absence(explanation: Explanation) -> bool:
    """Whether each effect does what its absence does not, from the same constants, at 90 %.

    What may as well be absent only led the constants to where they explain everything. A magnitude's own interval may
    hold its absence though the effect is certain: of a strip the measurement tells what stiffness times size comes to,
    and neither of them. So it is asked how much more is left without the effect.
    """
    r = explanation.refit
    shown = shown_by_magnitudes(explanation)
    return all(shown[i] or _is_missed(r, i) for i in range(len(explanation.candidates)))


def shown_by_magnitudes(explanation: Explanation) -> list[bool]:
    """For each effect, whether some magnitude's 90 % interval holds no absence of it; so where it has no magnitude."""
    r = explanation.refit
    sds = np.sqrt(np.diag(r.covariance))[r.hypothesis.constants :]
    shown = [not candidate.magnitudes for candidate in explanation.candidates]
    for (i, j), z, sd in zip(r.hypothesis.parameters, r.z[r.hypothesis.constants :], sds, strict=True):
        candidate = explanation.candidates[i]
        if (p := candidate.parameters[j]) in candidate.magnitudes:
            shown[i] = shown[i] or p.absence is None or abs(p.absence - z) > Z95 * sd
    return shown


def _is_missed(r: Refit, number: int) -> bool:
    """Whether more is left without an effect, by as much as a 90 % interval that ends at its absence leaves."""
    starts = r.z[: r.hypothesis.constants], likeliest_without(r, [number])
    found = [again for z in starts if (again := without(r, number, z)) is not None]
    return min((again.cost for again in found), default=np.inf) > r.cost + Z95**2


def without(r: Refit, number: int, constants: np.ndarray | None = None) -> Refit | None:
    """The optimum without one of the effects, in the same model; None where no stator has the constants.

    Parameters
    ----------
    r, number : an optimum, and which of its effects is left out.
    constants : to begin from; those of the optimum where none are given.
    """
    hypothesis = r.hypothesis
    rest = tuple(c for i, c in enumerate(hypothesis.candidates) if i != number)
    kept = [i != number for i, _ in hypothesis.parameters]
    own = r.z[: hypothesis.constants] if constants is None else constants
    return refitted(blank(hypothesis, rest), np.r_[own, r.z[hypothesis.constants :][kept]])


def likeliest_without(r: Refit, numbers: Sequence[int]) -> np.ndarray:
    """The constants that are likeliest if some of the effects are absent, to first order.

    From where they stand with an effect that a step's materials make up for, taking it away leads to other valleys.
    """
    n, covariance = r.hypothesis.constants, r.covariance
    absent = {
        n + k: absence
        for k, (i, j) in enumerate(r.hypothesis.parameters)
        if i in numbers and (absence := r.hypothesis.candidates[i].parameters[j].absence) is not None
    }
    places = list(absent)
    away = np.array(list(absent.values())) - r.z[places]
    return np.asarray(
        r.z[:n] + covariance[:n, places] @ np.linalg.solve(covariance[np.ix_(places, places)], away)
    )

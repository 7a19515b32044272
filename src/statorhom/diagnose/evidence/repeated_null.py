"""The chance of the scan's largest gain when nothing is missing, pairing and refit repeated (physics.md §7).

Draws of noise alone leave the pairing as it is. But where lines lie close or bear no names, noise can make another
mode of a line, and what that leaves looks like physics. So tests are simulated from the declared model, paired anew
and refitted: to first order, and paired again at what that comes to; the few that gain most, wholly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.evidence.decision import MAX_T_P
from statorhom.diagnose.features.simulated_tests import is_line, simulated
from statorhom.diagnose.fits.derivatives import jacobian
from statorhom.diagnose.fits.explanations import refitted
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.scan import Row, Scan, Signature, freed, rows_of
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.errors import StatorhomError

FloatArray = npt.NDArray[np.float64]
DRAWS = 200  # one of them may gain more than what was measured
AGAIN = 1  # times that a draw is paired anew at what its refit comes to
MANY = 24  # draws that are worth a process
WHOLLY = 12  # draws with larger gains that are refitted wholly: of more of them no refit makes few


def with_repeated_null(base: Refit, found: Scan, seed: int) -> Scan:
    """The scan with the larger chance of the two: under noise alone, and with pairing and refit repeated.

    Where noise alone may explain the largest gain nothing is drawn; bodies without circumferential order, whose modes
    are paired by their shapes, keep the chance under noise alone.

    Parameters
    ----------
    base : the optimum that the scan was made at.
    found : the scan.
    seed : of the draws.
    """
    if found.p_value >= MAX_T_P or not found.signatures or not isinstance(base.hypothesis, Hypothesis):
        return found
    null = _Null(base, _repeated(base.hypothesis, base.z, lambda: 0.0).paired(base.z), found.signatures, seed)
    measured = found.signatures[0].gain
    gains = side_by_side(partial(_largest, null), range(DRAWS), least=MANY)
    larger = [number for number, gain in enumerate(gains) if gain >= measured]
    if len(larger) <= WHOLLY:
        # what a step leaves of a line that it cannot pair may be no optimum
        anew = side_by_side(partial(_largest_at_optimum, null), larger, least=2)
        larger = [number for number, gain in zip(larger, anew, strict=True) if gain >= measured]
    return replace(found, p_value=max(found.p_value, (1 + len(larger)) / (1 + DRAWS)))


@dataclass(frozen=True, eq=False)
class _Null:
    """What is drawn from.

    Parameters
    ----------
    base : the declared model at its optimum.
    quiet : the same of tests that repeat without noise: standard deviations follow what is measured.
    signatures : of all effects.
    seed : of the draws.
    """

    base: Refit
    quiet: Hypothesis
    signatures: Sequence[Signature]
    seed: int
    # most draws have the same features, and so the same that constants can take up of them
    _known: dict[tuple[int, ...], _Projected] = field(default_factory=dict, init=False, repr=False)

    @cached_property
    def places(self) -> dict[Row, int]:
        """Numbers of the features by what they are of."""
        features = self.base.hypothesis.features(self.base.z)
        return {row: place for place, row in enumerate(rows_of(features))}

    @cached_property
    def wholes(self) -> FloatArray:
        """(signatures, features) changes by the effects."""
        return np.array([s.whole for s in self.signatures])

    @property
    def prior(self) -> FloatArray:
        """(coordinates,) roots of the prior's weights."""
        return np.sqrt(self.base.hypothesis.prior_weights)

    def projected(self, paired: Hypothesis, places: Sequence[int | None], seen: Sequence[int]) -> _Projected:
        """Of a draw's features, of which `seen` are no penalties and `places` tells those that are known."""
        own = tuple(place for place in places if place is not None)
        if len(own) < len(places):
            return self._of(jacobian(paired, self.base.z)[list(seen)], places)
        if own not in self._known:
            self._known[own] = self._of(self.base.jacobian[list(own)], own)
        return self._known[own]

    def _of(self, J: FloatArray, places: Sequence[int | None]) -> _Projected:
        # of a mode that has become another one, no signature tells
        known = [(i, place) for i, place in enumerate(places) if place is not None]
        wholes = np.zeros((len(self.signatures), len(places)))
        wholes[:, [i for i, _ in known]] = self.wholes[:, [place for _, place in known]]
        augmented = np.vstack([J, np.diag(self.prior)])
        q, _ = np.linalg.qr(augmented)
        return _Projected(augmented, q, freed(wholes, q)[0])


@dataclass(frozen=True, eq=False)
class _Projected:
    """Features of a draw, and what refitted constants leave of them.

    Parameters
    ----------
    jacobian : (features + coordinates, coordinates), the prior's part below.
    q : the same, orthonormal.
    units : (signatures, features + coordinates) as of `statorhom.diagnose.located.scan.freed`.
    """

    jacobian: FloatArray
    q: FloatArray
    units: FloatArray

    def step(self, residuals: FloatArray) -> FloatArray:
        """To the optimum, to first order."""
        return np.asarray(np.linalg.lstsq(self.jacobian, -residuals, rcond=None)[0], dtype=float)

    def largest(self, residuals: FloatArray) -> float:
        """Largest gain at the optimum."""
        left = residuals - self.q @ (self.q.T @ residuals)
        return float(np.max(np.maximum(-self.units @ left, 0.0), initial=0.0)) ** 2


def _drawn(null: _Null, number: int) -> tuple[Hypothesis, FloatArray, FloatArray]:
    """One draw of the tests, of what is measured beside lines, and of what is known beforehand."""
    rng = np.random.default_rng([null.seed, number])
    own = _repeated(null.quiet, null.base.z, lambda: float(rng.standard_normal()))
    return own, rng.standard_normal(len(null.places)), null.prior * rng.standard_normal(len(null.prior))


def _largest_at_optimum(null: _Null, number: int) -> float:
    """Largest gain of one draw whose lines are paired as where a refit of them ends."""
    own, noise, prior = _drawn(null, number)
    best = refitted(own, null.base.z)
    if best is None:
        return np.inf
    projected, residuals = _as_drawn(null, best.hypothesis, noise, prior)
    return projected.largest(residuals)


def _largest(null: _Null, number: int) -> float:
    """Largest gain of one draw."""
    base = null.base
    own, noise, prior = _drawn(null, number)
    paired = own.paired(base.z)
    projected, residuals = _as_drawn(null, paired, noise, prior)
    for _ in range(AGAIN):
        try:
            there = np.clip(base.z + projected.step(residuals), *base.hypothesis.limits())
            again = own.paired(there)
        except (StatorhomError, KeyError):
            break
        if again.held == paired.held:
            break
        paired = again
        projected, residuals = _as_drawn(null, paired, noise, prior)
    return projected.largest(residuals)


def _repeated(hypothesis: Hypothesis, z: FloatArray, noise: Callable[[], float]) -> Hypothesis:
    """The same of tests that were repeated, at a held pairing."""
    features, held = hypothesis.features(z), hypothesis.held
    assert held is not None
    tests = [test for stage in hypothesis.study.stages for test in stage.tests]
    return hypothesis.with_tests({t.name: simulated(t, held[t.name], features, noise) for t in tests})


def _as_drawn(
    null: _Null, paired: Hypothesis, noise: FloatArray, prior: FloatArray
) -> tuple[_Projected, FloatArray]:
    """Features of a draw, and their residuals with the prior's below, at the constants that it was made with."""
    features = paired.features(null.base.z)
    rows = rows_of(features)
    seen = [i for i, feature in enumerate(features) if not feature.lost]
    places = [null.places.get(rows[i]) for i in seen]
    residuals = [
        features[i].residual if is_line(features[i]) else 0.0 if place is None else float(noise[place])
        for i, place in zip(seen, places, strict=True)
    ]
    return null.projected(paired, places, seen), np.r_[residuals, prior]

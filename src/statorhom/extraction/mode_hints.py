"""Hints that a mode is not linear, from the FRFs that show it best."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.modes.nonlinearity.circle_distortion import circle_distortion
from statorhom.modes.nonlinearity.combined import combined_probability
from statorhom.modes.nonlinearity.flank_asymmetry import flank_asymmetry
from statorhom.recordings.frf_set import FrfSet

STRONGEST = 6  # FRFs of a mode that are looked at: the others add noise, not evidence
RARE = 1e-3  # probability below which a hint is worth a remark: a test has dozens of modes and two hints each

BROAD = 0.04  # loss factor from which on the lines of a peak reach far into other modes' …
OVERLAP = 2.0  # … where these lie within so many half-power bandwidths
LEAST_DISTORTION, LEAST_ASYMMETRY = 0.01, 0.02  # what is worth a remark, however certain

Pole = tuple[float, float]  # frequency in Hz, loss factor


@dataclass(frozen=True)
class ModeHints:
    """How probable the FRFs around a mode are if the mode is linear.

    Attributes
    ----------
    circle_p : float
        Probability of Nyquist plots so far from circles; NaN where too few lines show the mode.
    distortion : float
        Largest distance from the circle beyond noise, over its radius.
    flank_p : float
        Probability of flanks so unequal; NaN where too few lines show the mode.
    asymmetry : float
        Median of the flanks' asymmetry.
    steeper : str
        The flank that is steeper in most FRFs: "upper" or "lower".
    """

    circle_p: float
    distortion: float
    flank_p: float
    asymmetry: float
    steeper: str

    @property
    def remarkable(self) -> bool:
        """Whether the mode looks non-linear."""
        return self._bent_circle or self._bent_peak

    @property
    def _bent_circle(self) -> bool:
        return bool(self.circle_p < RARE and self.distortion > LEAST_DISTORTION)

    @property
    def _bent_peak(self) -> bool:
        return bool(self.flank_p < RARE and abs(self.asymmetry) > LEAST_ASYMMETRY)

    @property
    def statement(self) -> str:
        """The hint in words."""
        said = []
        if self._bent_circle:
            said.append(
                f"Nyquist circle distorted by {100 * self.distortion:.1f} % (p = {self.circle_p:.1g})"
            )
        if self._bent_peak:
            said.append(f"steep {self.steeper} flank (p = {self.flank_p:.1g})")
        return "; ".join(said)


def mode_hints(frfs: FrfSet, pole: Pole, others: Sequence[Pole]) -> ModeHints | None:
    """Look at the strongest FRFs of a mode; None where its peak is too broad to be seen apart from others.

    Parameters
    ----------
    frfs : FrfSet
    pole : the mode.
    others : all other modes; a close doublet would look like a bent peak without them.
    """
    if pole[1] > BROAD and any(_overlap(pole, other) for other in others):
        return None
    receptance = frfs.receptance
    at_peak = np.abs(receptance[:, np.argmin(np.abs(frfs.frequency_hz - pole[0]))])
    rows = np.argsort(-np.nan_to_num(at_peak))[:STRONGEST]
    circles, flanks = [], []
    for row in rows:
        try:
            circles.append(circle_distortion(frfs.frequency_hz, receptance[row], *pole, neighbours=others))
            flanks.append(flank_asymmetry(frfs.frequency_hz, receptance[row], *pole, neighbours=others))
        except IdentificationError:
            continue  # too few lines around the mode
    upper = sum(flank.steeper == "upper" for flank in flanks)
    return ModeHints(
        circle_p=combined_probability([circle.p for circle in circles]),
        distortion=max((circle.distortion for circle in circles), default=0.0),
        flank_p=combined_probability([flank.p for flank in flanks]),
        asymmetry=float(np.median([flank.asymmetry for flank in flanks])) if flanks else 0.0,
        steeper="upper" if 2 * upper >= len(flanks) else "lower",
    )


def _overlap(one: Pole, other: Pole) -> bool:
    return abs(one[0] - other[0]) < OVERLAP * max(one[0] * one[1], other[0] * other[1])

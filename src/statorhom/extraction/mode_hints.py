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

STRONGEST = 12  # FRFs of a mode that are looked at: the others add noise, not evidence
RARE = 1e-3  # probability below which a hint is worth a remark: a test has dozens of modes and two hints each

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
    steeper : str
        The flank that is steeper in most FRFs: "upper" or "lower".
    """

    circle_p: float
    distortion: float
    flank_p: float
    steeper: str

    @property
    def remarkable(self) -> bool:
        """Whether the mode looks non-linear."""
        return bool(self.circle_p < RARE or self.flank_p < RARE)

    @property
    def statement(self) -> str:
        """The hint in words."""
        said = []
        if self.circle_p < RARE:
            said.append(
                f"Nyquist circle distorted by {100 * self.distortion:.1f} % (p = {self.circle_p:.1g})"
            )
        if self.flank_p < RARE:
            said.append(f"steep {self.steeper} flank (p = {self.flank_p:.1g})")
        return "; ".join(said)


def mode_hints(frfs: FrfSet, pole: Pole, others: Sequence[Pole]) -> ModeHints:
    """Look at the strongest FRFs of a mode.

    Parameters
    ----------
    frfs : FrfSet
    pole : the mode.
    others : all other modes; a close doublet would look like a bent peak without them.
    """
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
        steeper="upper" if 2 * upper >= len(flanks) else "lower",
    )

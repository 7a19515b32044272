"""Modes broader than all around them: they may stand for several, and no noise tells how far these lie apart.

Where loss factors hardly differ from mode to mode, as in a bare stack, a pole that is broader covers modes that the
references do not tell apart, or is what a fit needed in addition. Its frequency lies somewhere among theirs. Where loss
factors differ anyhow, as in a wound stator, a broad mode is nothing unusual.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.extraction import ExtractedMode
from statorhom.recordings.estimation.pulses import noise_sd

FloatArray = npt.NDArray[np.float64]

AROUND, LEAST = 10, 6  # modes on both sides that tell what is usual, and how few of them do
NEAR = 1.5  # times its frequency: a mode with few others nearer than this stands alone under its peak
USUAL = 3.0  # standard deviations of ln η
# of what a mode is too broad by: of 29 such modes of known recordings 24 are off by less, none by more than all of it
OFF = 0.5
# times the usual loss factor, and standard deviation over bandwidth, of what is no one mode
BROAD, UNSURE = 1.3, 0.04
TOLD = 0.1  # too broad by this part of the loss factor, a mode is remarked on


def with_doubt(modes: Sequence[ExtractedMode]) -> tuple[tuple[ExtractedMode, ...], tuple[str, ...]]:
    """The modes, standard deviations of too broad ones with what they may stand for, and what is to be said.

    Parameters
    ----------
    modes : of one test, in any order.
    """
    found, said = [], []
    for mode, usual in zip(modes, _most_usual(modes), strict=True):
        excess = max(0.0, mode.loss_factor - float(usual))
        found.append(_doubted(mode, excess) if excess > 0 else mode)
        if excess > TOLD * mode.loss_factor:
            said.append(
                f"the mode at {mode.frequency_hz:.2f} Hz is {mode.loss_factor / usual:.2g} times as broad as modes "
                "around it: it may stand for several; more points or another reference would tell"
            )
    return tuple(found), tuple(said)


def _doubted(mode: ExtractedMode, excess: float) -> ExtractedMode:
    """With the doubt of a loss factor that is too large by so much."""
    alone = mode.loss_factor - excess
    nothing = mode.loss_factor > BROAD * alone and mode.frequency_sd_hz > UNSURE * mode.bandwidth_hz
    off = mode.frequency_hz * (mode.loss_factor if nothing else OFF * excess)
    return replace(
        mode,
        frequency_sd_hz=float(np.hypot(mode.frequency_sd_hz, off)),
        loss_factor_sd=float(np.hypot(mode.loss_factor_sd, excess)),
    )


def _most_usual(modes: Sequence[ExtractedMode]) -> FloatArray:
    """(modes,) the largest loss factor that is nothing unusual among those around each; ∞ where too few tell."""
    place = np.log([mode.frequency_hz for mode in modes])
    loss = np.array([mode.loss_factor for mode in modes])
    found = np.full(len(modes), np.inf)
    for i in range(len(modes)):
        away = np.abs(place - place[i])
        near = np.argsort(away, kind="stable")[1 : 1 + AROUND]
        own = loss[near[(loss[near] > 0) & (away[near] < np.log(NEAR))]]
        if len(own) >= LEAST:
            logs = np.log(own)
            middle = float(np.median(logs))
            # by the median of what they differ by: a few broad ones do not count, as pulses do not in a record
            found[i] = np.exp(middle + USUAL * noise_sd(logs))
    return found

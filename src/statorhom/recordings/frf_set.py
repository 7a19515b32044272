"""Frequency response functions on one frequency axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.recordings.dof import Dof


@dataclass(frozen=True)
class FrfSet:
    """Accelerances of pairs of points.

    Attributes
    ----------
    frequency_hz : array, shape (lines,)
        Ascending, evenly spaced or not.
    responses, references : tuple of Dof, one per FRF
        Where the acceleration was measured and where the force acted.
    accelerance : complex array, shape (FRFs, lines)
        Acceleration over force, (m/s²)/N.
    coherence : array, shape (FRFs, lines), or None
        Ordinary coherence; NaN for FRFs without one.
    relative_sd : array, shape (FRFs, lines), or None
        Standard deviation of an FRF's complex value over its magnitude, where repeats or coherence tell it.
    window_decay_per_s : float
        Decay rate that exponential windows added to every free vibration (1/s); a pole's true decay rate is
        the measured one less this. 0 where none was used or its effect is already removed.
    source : str
        File it came from, for messages.
    """

    frequency_hz: np.ndarray
    responses: tuple[Dof, ...]
    references: tuple[Dof, ...]
    accelerance: np.ndarray
    coherence: np.ndarray | None = None
    relative_sd: np.ndarray | None = None
    window_decay_per_s: float = 0.0
    source: str = ""

    def __post_init__(self) -> None:
        shape = (len(self.responses), len(self.frequency_hz))
        if len(self.references) != shape[0] or self.accelerance.shape != shape:
            raise ValueError("an FRF set needs one response, one reference and one row per FRF")
        for array in (self.frequency_hz, self.accelerance, self.coherence, self.relative_sd):
            if array is not None:
                array.setflags(write=False)

    @property
    def receptance(self) -> np.ndarray:
        """Displacement over force (m/N), shape (FRFs, lines); NaN at 0 Hz."""
        receptance = np.full(self.accelerance.shape, np.nan, dtype=complex)
        moving = self.frequency_hz > 0
        receptance[:, moving] = -self.accelerance[:, moving] / (2 * np.pi * self.frequency_hz[moving]) ** 2
        return receptance

    def __len__(self) -> int:
        return len(self.responses)

"""A hammer hit: the force and the accelerations that it caused, as time records."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.recordings.dof import Dof


@dataclass(frozen=True)
class Hit:
    """Time records of one hit.

    Attributes
    ----------
    number : int
        Of the hit, as the file counts it.
    sample_rate_hz : float
        Samples per second, of all channels.
    force_n : array, shape (samples,)
        Hammer force (N).
    acceleration_m_s2 : array, shape (channels, samples)
        Accelerations (m/s²).
    reference : Dof
        Where the hammer hit.
    responses : tuple of Dof, one per channel
        Where the accelerometers sat.
    source : str
        File it came from, for messages.
    """

    number: int
    sample_rate_hz: float
    force_n: np.ndarray
    acceleration_m_s2: np.ndarray
    reference: Dof
    responses: tuple[Dof, ...]
    source: str = ""

    def __post_init__(self) -> None:
        if self.acceleration_m_s2.shape != (len(self.responses), len(self.force_n)):
            raise ValueError("a hit needs one row of accelerations per response, as long as the force")
        self.force_n.setflags(write=False)
        self.acceleration_m_s2.setflags(write=False)

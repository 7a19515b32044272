"""What a study says about recordings that do not say it themselves: points, direction, sample rate, scales."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.recordings.dof import Dof, Vector
from statorhom.recordings.named_direction import direction_vector
from statorhom.study.modal_tests import ModalTestKeys

_RESPONSE_NODE, _HAMMER_NODE = 1, 2
_MM = 1e-3


@dataclass(frozen=True)
class Placement:
    """Where sensor and hammer were, and how samples are to be read.

    Attributes
    ----------
    hammer_mm, response_mm : (x, y, z) or None
        Points of the hammer and of the accelerometer.
    direction : str or None
        Of both: x, y, z, r or theta, with a sign.
    sample_rate_hz : float or None
    force_full_scale_n, acceleration_full_scale_m_s2 : float or None
        What the largest sample of a WAV file stands for.
    """

    hammer_mm: Vector | None = None
    response_mm: Vector | None = None
    direction: str | None = None
    sample_rate_hz: float | None = None
    force_full_scale_n: float | None = None
    acceleration_full_scale_m_s2: float | None = None

    @classmethod
    def of_test(cls, test: ModalTestKeys) -> Placement:
        """The placement that the keys of a study's test describe."""
        return cls(
            test.hammer_mm,
            test.response_mm,
            test.direction,
            test.sample_rate_hz,
            test.force_full_scale_n,
            test.acceleration_full_scale_m_s2,
        )

    def hammer(self) -> Dof:
        """Where and in which direction the force acted."""
        return self._dof(_HAMMER_NODE, self.hammer_mm)

    def response(self, node: int = _RESPONSE_NODE) -> Dof:
        """Where and in which direction the acceleration was measured."""
        return self._dof(node, self.response_mm)

    def _dof(self, node: int, point_mm: Vector | None) -> Dof:
        position = None
        if point_mm is not None:
            x, y, z = point_mm
            position = (x * _MM, y * _MM, z * _MM)
        direction = direction_vector(self.direction, position) if self.direction is not None else None
        return Dof(node, position, direction)

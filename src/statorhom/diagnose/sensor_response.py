"""Where a sensor's mass moves the poles to when it sits on the back of the core.

In the first order a pole falls by half the mass times the square of its mode's motion there. A sensor of half a per
cent of the stator does more: it couples the mode with all others that move at its place. So the stator is solved with
two masses at every height, and what lies between and a little beyond follows from these.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.diagnose.broken_response import Response, responses
from statorhom.diagnose.stage_model import StageModel
from statorhom.model.broken.attachments import lump
from statorhom.model.convergence import ModeKey

SAMPLES = (0.002, 0.006)  # of the stator's mass


@dataclass(frozen=True, eq=False)
class SensorResponse:
    """Relative shifts m·(slope + m·curvature) of the named modes' frequencies by a mass m.

    Parameters
    ----------
    heights : (p,) of the sensor (m).
    slope, curvature : mode → (p,) (1/kg, 1/kg²).
    """

    heights: np.ndarray
    slope: Mapping[ModeKey, np.ndarray]
    curvature: Mapping[ModeKey, np.ndarray]

    def shift(self, z: np.ndarray, key: ModeKey, sensor_kg: float) -> np.ndarray:
        """Shifts (places,) of a mode that it knows, by a sensor at heights z (m)."""
        moved = sensor_kg * (self.slope[key] + sensor_kg * self.curvature[key])
        return np.interp(z, self.heights, moved)


def sensor_response(stage: StageModel, heights: Sequence[float]) -> SensorResponse:
    """Of a stage at its reference, by solutions with a mass at each of the heights (m), which ascend; kept.

    Raises
    ------
    SolverError
        If the stator with the mass cannot be solved.
    """
    place = tuple(heights)
    if place not in stage.sensor_responses:
        stage.sensor_responses[place] = _solved(stage, place)
    found: SensorResponse = stage.sensor_responses[place]
    return found


def _solved(stage: StageModel, heights: tuple[float, ...]) -> SensorResponse:
    whole = sum(volume * stage.reference[region].density for region, volume in stage.model.volumes.items())
    masses = [part * whole for part in SAMPLES]
    mesh = stage.model.mesh
    # a quarter of a pitch from a tooth, where what differs from tooth to slot has its mean
    angle = np.pi / (2 * mesh.slots)
    found = [[_lower(responses(stage, [lump(mesh, angle, z, m)])) for z in heights] for m in masses]
    known = set.intersection(*(set(one) for row in found for one in row))
    slope, curvature = {}, {}
    for key in known:
        first, second = (
            np.array([one[key] for one in row]) / m for row, m in zip(found, masses, strict=True)
        )
        curvature[key] = (second - first) / (masses[1] - masses[0])
        slope[key] = first - masses[0] * curvature[key]
    return SensorResponse(np.array(heights), slope, curvature)


def _lower(found: Mapping[ModeKey, Response]) -> dict[ModeKey, float]:
    """Relative shifts of the lines whose antinode the mass sits on."""
    return {
        key: float(np.expm1(one.shift) + 0.5 * np.log1p(-0.5 * abs(one.split))) for key, one in found.items()
    }

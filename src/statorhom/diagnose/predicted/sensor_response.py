"""Where a sensor's mass moves the poles to when it sits on the back of the core.

In the first order a pole falls by half the mass times the square of its mode's motion there. A sensor of half a per
cent of the stator does more: it couples the mode with all others that move at its place. So the stator is solved with
two masses at every height, and what lies between and a little beyond follows from these.

The mass dents the surface under its foot, too, which adds to the fall of high modes. The dent under a single point
grows without end as a mesh gets finer; without any, the mass couples nothing but modes. The truth lies between the two.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from statorhom.diagnose.bases.trained_basis import TrainedBasis
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.stages.broken_response import Response, responses
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.broken.attachments import lump
from statorhom.model.broken.statics import statics
from statorhom.model.convergence import ModeKey

SAMPLES = (0.002, 0.006)  # of the stator's mass
OWN = 0.5  # share of a named mode in the mode that is taken for it
MOST_DOUBT = 1.0

Falls = Mapping[ModeKey, np.ndarray]


@dataclass(frozen=True, eq=False)
class SensorResponse:
    """Relative shifts m·(slope + m·curvature) of the named modes' frequencies by a mass m.

    Parameters
    ----------
    heights : (p,) of the sensor (m).
    slope, curvature : mode → (p,) (1/kg, 1/kg²), halfway between a mass that dents the surface and one that does not.
    dent : mode → (p,) by which the shifts lie on both sides of that, over m² (1/kg²).
    """

    heights: np.ndarray
    slope: Falls
    curvature: Falls
    dent: Falls

    def shift(self, z: np.ndarray, key: ModeKey, sensor_kg: float) -> np.ndarray:
        """Shifts (places,) of a mode that it knows, by a sensor at heights z (m)."""
        moved = sensor_kg * (self.slope[key] + sensor_kg * self.curvature[key])
        return np.interp(z, self.heights, moved)

    def doubt(self, z: np.ndarray, key: ModeKey, shift: np.ndarray) -> float:
        """Part of a mode's measured shifts from plane to plane, at heights z (m), that is as uncertain as the dent."""
        slope, dent = (np.interp(z, self.heights, one[key]) for one in (self.slope, self.dent))
        size = float(np.ptp(slope))
        if size == 0.0:
            return MOST_DOUBT
        mass = float(np.ptp(shift)) / size
        return min(mass * float(np.ptp(dent)) / size, MOST_DOUBT)


def shifted_response(stage: StageModel, test: MeasuredTest) -> SensorResponse | None:
    """At the heights of a test; None where it does not tell how poles move from plane to plane."""
    if not test.shifts:
        return None
    return sensor_response(stage, np.unique(np.concatenate([s.z_m for s in test.shifts])).tolist())


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
    dented = _fitted([[_on_a_point(stage, z, m) for z in heights] for m in masses], masses)
    smooth = _fitted([[_by_modes(stage, z, m) for z in heights] for m in masses], masses)
    known = [key for key in smooth if key in dented]
    slope = {key: smooth[key][0] for key in known}
    # a dent follows from the second order on
    second = {key: dented[key][1] + (dented[key][0] - smooth[key][0]) / masses[1] for key in known}
    curvature = {key: 0.5 * (second[key] + smooth[key][1]) for key in known}
    dent = {key: 0.5 * (second[key] - smooth[key][1]) for key in known}
    return SensorResponse(np.array(heights), slope, curvature, dent)


def _fitted(
    found: Sequence[Sequence[Mapping[ModeKey, float]]], masses: Sequence[float]
) -> dict[ModeKey, tuple[np.ndarray, np.ndarray]]:
    """Slope and curvature of the modes that every mass at every height leaves, from their shifts by both masses."""
    fits = {}
    for key in set.intersection(*(set(one) for row in found for one in row)):
        first, second = (
            np.array([one[key] for one in row]) / m for row, m in zip(found, masses, strict=True)
        )
        curvature = (second - first) / (masses[1] - masses[0])
        fits[key] = first - masses[0] * curvature, curvature
    return fits


def _angle(slots: int) -> float:
    """A quarter of a pitch from a tooth, where what differs from tooth to slot has its mean."""
    return float(np.pi / (2 * slots))


def _on_a_point(stage: StageModel, z: float, mass_kg: float) -> dict[ModeKey, float]:
    """Relative shifts of the lines whose antinode a mass on a single point sits on."""
    mesh = stage.model.mesh
    return {
        key: _lower(one)
        for key, one in responses(stage, [lump(mesh, _angle(mesh.slots), z, mass_kg)]).items()
    }


def _lower(one: Response) -> float:
    return float(np.expm1(one.shift) + 0.5 * np.log1p(-0.5 * abs(one.split)))


def _by_modes(stage: StageModel, z: float, mass_kg: float) -> dict[ModeKey, float]:
    """The same of a mass that couples modes and nothing else; without the modes that it mixes up."""
    trained: TrainedBasis = stage.trained(())
    mesh, values = trained.basis.mesh, trained.basis.values
    motion = statics(trained.basis, [lump(mesh, _angle(mesh.slots), z, 1.0)]).answers.rows
    added = np.eye(len(values)) + mass_kg * motion.T @ motion
    eigenvalues, x = eigh(np.diag(values), added)
    shares = added @ x
    found = {}
    for key, place in trained.columns.items():
        # radially, for that is what the sensor measures
        seen = motion[0, place.numbers]
        part = (seen @ shares[place.numbers]) ** 2
        most = int(np.argmax(part))
        if part[most] > OWN * float(seen @ seen):
            found[key] = float(np.sqrt(eigenvalues[most] / place.eigenvalue) - 1.0)
    return found

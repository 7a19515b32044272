"""What a roving sensor's mass did to the modes of a test: the mass, and the frequencies without it.

To first order δf/f = −mφ²/2 with the mass-normalised amplitude φ at the sensor, which follows from the residues
φ_k φ_h: the wave that the shape forms around the circumference, evaluated at the hammer's place, is φ_h².
The mass moves axially as well, which a radial accelerometer does not see: that motion follows from the slope of
the shape along the axis. Tangentially it moves only the other half of a doublet that it turns.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.extraction.extraction import ExtractedMode
from statorhom.modes.axial_motion import AxialLever, axial_lever, sheets_slide
from statorhom.modes.pole_shift import PoleShiftTrend, pole_shift_trend
from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]

SURE = 1e-3  # probability of chance below which a mass is reported
_SEEN = 0.2  # part of its largest amplitude that a mode must have at a point
_FEWEST_POINTS = 6
_CI90 = 3.29  # standard deviations that a 90 % interval spans


@dataclass(frozen=True)
class SensorTrend:
    """Shifts of a test's poles over the places of the sensor.

    Attributes
    ----------
    modes : tuple of int
        Numbers of the modes that the trend rests on.
    shifts : PoleShiftTrend
        Set-ups are the points of the shapes.
    relative_sd : array, shape (points, modes)
        Standard deviation of the relative shifts.
    amplitude_squared : array, shape (points, modes)
        Squared mass-normalised amplitude with which the sensor moves (1/kg).
    bare_hz, bare_sd_hz : arrays, shape (modes,)
        Frequencies extrapolated to a sensor without mass; the deviation holds that of the mass, of the axial
        motion that was not measured, and of the loaded frequency. Infinite: not determined.
    partners : mapping
        Number of a doublet's other half → that of the half which the trend rests on, and their frequencies' ratio.
    """

    modes: tuple[int, ...]
    shifts: PoleShiftTrend
    relative_sd: FloatArray
    amplitude_squared: FloatArray
    bare_hz: FloatArray
    bare_sd_hz: FloatArray
    partners: Mapping[int, tuple[int, float]] = field(default_factory=dict)

    @property
    def significant(self) -> bool:
        """Whether a mass explains the shifts beyond chance."""
        return self.shifts.joint.p_mass < SURE and self.shifts.joint.ci90_kg[0] > 0

    @property
    def bare(self) -> dict[int, tuple[float, float]]:
        """Number of a mode → its frequency without the sensor and the standard deviation (Hz), where determined."""
        rows = zip(self.modes, self.bare_hz.tolist(), self.bare_sd_hz.tolist(), strict=True)
        found = {number: (frequency, sd) for number, frequency, sd in rows if math.isfinite(sd)}
        halves = {
            partner: (ratio * found[number][0], ratio * found[number][1])
            for partner, (number, ratio) in self.partners.items()
            if number in found
        }
        return dict(sorted({**found, **halves}.items()))

    @property
    def statement(self) -> str:
        """The trend in one line."""
        joint = self.shifts.joint
        low, high = (1000 * one for one in joint.ci90_kg)
        modes = ", ".join(
            f"{1 + number}: {frequency:.2f} ± {sd:.2g} Hz" for number, (frequency, sd) in self.bare.items()
        )
        return (
            f"the poles move from point to point as a sensor of {1000 * joint.mass_kg:.3g} g "
            f"({low:.3g} … {high:.3g} g) moves them; without it modes lie at {modes}"
        )


def sensor_trend(
    modes: Sequence[ExtractedMode], names: Mapping[int, tuple[int, int]], points: Sequence[Dof], hammer: Dof
) -> SensorTrend | None:
    """Trend of the modes that move from point to point; None where fewer than one is known by name.

    Parameters
    ----------
    modes : sequence of ExtractedMode
    names : number of a mode → (r, n)
    points : of the shapes, where the sensor was.
    hammer : where the force was.
    """
    chosen = [
        m
        for m, mode in enumerate(modes)
        if mode.shift is not None and len(mode.shift) == len(points) and names.get(m, (0, 0))[0] > 0
    ]
    slides = sheets_slide({name: modes[m].frequency_hz for m, name in names.items()})
    found = {m: _wave(modes[m], names[m], points, hammer, slides) for m in chosen}
    waves = {m: wave for m, wave in found.items() if wave is not None}
    if not waves:
        return None
    poles = [_frequencies(modes[m]) for m in waves]
    frequency, sd = (np.stack(column, axis=1) for column in zip(*poles, strict=True))
    amplitude = np.stack([wave.amplitude for wave in waves.values()], axis=1)
    try:
        shifts = pole_shift_trend(frequency, sd, amplitude)
    except IdentificationError:
        return None
    square = np.sum(amplitude**2, axis=2)
    low, high = shifts.joint.ci90_kg
    of_mass = square.mean(axis=0) * (high - low) / _CI90 / 2
    # infinite where nothing is known of the axial motion, which no mass at all makes up for
    spread = np.array([wave.square_sd for wave in waves.values()])
    of_axial = np.where(shifts.joint.mass_kg > 0, spread, 0.0) * shifts.joint.mass_kg / 2
    of_pole = np.array([modes[m].frequency_sd_hz / modes[m].frequency_hz for m in waves])
    bare_sd = shifts.bare_hz * np.sqrt(of_mass**2 + of_axial**2 + of_pole**2)
    return SensorTrend(tuple(waves), shifts, sd / frequency, square, shifts.bare_hz, bare_sd)


def _frequencies(mode: ExtractedMode) -> tuple[FloatArray, FloatArray]:
    """Frequency at every point and its standard deviation; NaN where the mode hardly moves."""
    assert mode.shift is not None
    size = np.abs(mode.shape)
    frequency = np.where(size > _SEEN * size.max(), mode.frequency_hz * (1 + mode.shift[:, 0].real), np.nan)
    # of a single resonance with unknown residue A: sd(s)/|s| = 2η sd(A)/|A|, s = ω², real part
    loss = mode.observed.imag / mode.observed.real
    sd = mode.frequency_hz * loss / np.sqrt(2) * mode.shape_sd / np.maximum(size, np.finfo(float).tiny)
    return frequency, sd


@dataclass(frozen=True)
class _Wave:
    """Mass-normalised motion of the sensor (1/√kg), shape (points, 4): radial and axial, each as cos rθ and sin rθ.

    `square_sd` is the standard deviation of its mean square, from the axial part.
    """

    amplitude: FloatArray
    square_sd: float


def _wave(
    mode: ExtractedMode,
    name: tuple[int, int],
    points: Sequence[Dof],
    hammer: Dof,
    slides: bool | None,
) -> _Wave | None:
    """Motion of the sensor at every point; None where the points do not tell it.

    A sensor turns a doublet until its antinode lies at the sensor, so the motions of both shapes count.
    """
    order, axial = name
    places = [point.position for point in points]
    if hammer.position is None or hammer.angle is None or None in places or len(points) < _FEWEST_POINTS:
        return None
    x, y, z = np.array([place for place in places if place is not None]).T
    theta = np.arctan2(y, x)
    middle, span = float(z.mean()), max(float(np.ptp(z)), np.finfo(float).tiny)
    degree = min(axial + 2, len(np.unique(z.round(6))) - 1)
    along = np.vander((z - middle) / span, degree + 1)
    columns = np.concatenate(
        [along * np.cos(order * theta)[:, None], along * np.sin(order * theta)[:, None]], axis=1
    )
    size = float(np.abs(mode.participation[0]))
    solution = np.linalg.lstsq(columns, mode.shape.real * size, rcond=None)[0].reshape(2, -1)
    at_hammer = np.vander([(hammer.position[2] - middle) / span], degree + 1)[0] @ solution.T
    square = abs(float(at_hammer @ [np.cos(order * hammer.angle), np.sin(order * hammer.angle)]))
    if square <= 0.0:
        return None
    slope = along[:, 1:] * np.arange(degree, 0, -1) / span
    lever = axial_lever(order, axial, float(np.hypot(x, y).mean()), slides)
    radial = np.linalg.norm(along @ solution.T, axis=1) / np.sqrt(square)
    inclined = np.linalg.norm(slope @ solution[:, :-1].T, axis=1) / np.sqrt(square)
    return _Wave(_turned(radial, inclined * lever.length_m, order * theta), _square_sd(inclined, lever))


def _turned(radial: FloatArray, axial: FloatArray, phase: FloatArray) -> FloatArray:
    columns = [part * turn for part in (radial, axial) for turn in (np.cos(phase), np.sin(phase))]
    return np.stack(columns, axis=1)


def _square_sd(inclined: FloatArray, lever: AxialLever) -> float:
    return float(np.mean(inclined**2)) * 2 * lever.length_m * lever.sd_m

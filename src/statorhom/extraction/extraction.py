"""What modal extraction found: modes with their uncertainty, and the FRFs that they add up to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.roving.load import RovingLoad
from statorhom.extraction.stabilization import Stabilization
from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]


@dataclass(frozen=True)
class ExtractedMode:
    """A mode of A_kj/(ω_r²(1 + iη_r) − ω²) with A_kj = shape_k · participation_j.

    Attributes
    ----------
    frequency_hz, frequency_sd_hz : float
        Undamped natural frequency ω_r/2π.
    loss_factor, loss_factor_sd : float
        Structural loss factor η, without the damping that windows added.
    shape : complex array, shape (points,)
        Turned to be as real as it can be, its largest component of magnitude 1.
    shape_sd : array, shape (points,)
        Standard deviation of the complex values.
    participation, participation_sd : arrays, shape (references,)
        Residue of each reference where the shape is 1 (1/kg), and the standard deviation of its complex value.
    modal_constant_per_kg, modal_constant_sd_per_kg : complex or None, float or None
        Residue at the driving point; None where none was measured.
    phase_collinearity : float
        1 for a shape that is real but for a common phase.
    misfit : float
        Root mean square residual around the mode over the noise.
    stability : float
        Share of the model orders that show the mode, 0 … 1.
    observed : complex
        The pole ω_r²(1 + iη_r) as it lies in the data ((rad/s)²), windows' damping included.
    shift : complex array, shape (points or 1, references or 1), or None
        Relative shift δ of ω_r from set-up to set-up, pole (1 + δ)² ω_r²(1 + iη), with median 0, where the data
        ask for it: a roving sensor's mass or settling supports do this. None where all FRFs share the pole.
    """

    frequency_hz: float
    frequency_sd_hz: float
    loss_factor: float
    loss_factor_sd: float
    shape: ComplexArray
    shape_sd: FloatArray
    participation: ComplexArray
    participation_sd: FloatArray
    modal_constant_per_kg: complex | None
    modal_constant_sd_per_kg: float | None
    phase_collinearity: float
    misfit: float
    stability: float
    observed: complex
    shift: ComplexArray | None = None

    def __post_init__(self) -> None:
        for array in (self.shape, self.shape_sd, self.participation, self.participation_sd):
            array.setflags(write=False)

    @property
    def damping_ratio(self) -> float:
        """ζ = η/2."""
        return 0.5 * self.loss_factor

    @property
    def bandwidth_hz(self) -> float:
        """Half-power bandwidth η f_r as it shows in the data."""
        return self.frequency_hz * self.observed.imag / self.observed.real

    @property
    def shape_to_noise(self) -> float:
        """Root mean square of the shape over its standard deviation, over the points with data."""
        known = np.isfinite(self.shape_sd) & (self.shape_sd > 0)
        if not known.any():
            return 0.0
        return float(np.sqrt(np.mean(np.abs(self.shape[known] / self.shape_sd[known]) ** 2)))

    def receptance(self, frequency_hz: npt.ArrayLike) -> ComplexArray:
        """The mode's part of the receptances (m/N), shape (points, references, lines)."""
        squared = (2 * np.pi * np.asarray(frequency_hz, dtype=float)) ** 2
        shift = np.zeros((1, 1)) if self.shift is None else self.shift
        curve = 1.0 / (self.observed * (1 + shift[..., None]) ** 2 - squared)
        part: ComplexArray = self.shape[:, None, None] * self.participation[None, :, None] * curve
        return part


@dataclass(frozen=True, eq=False)
class Loaded:
    """What a heavy roving sensor did to a recording.

    Attributes
    ----------
    load : RovingLoad
    shifts : array, shape (modes of the load, planes)
        Relative shifts of their frequencies, with the sensor in each plane.
    free : Extraction
        Of the FRFs as they were without the sensor.
    mode_of : tuple of int or None
        Mode of the load that every listed mode is; None for modes that the sensor does not move.
    """

    load: RovingLoad
    shifts: FloatArray
    free: Extraction
    mode_of: tuple[int | None, ...]


@dataclass(frozen=True)
class Extraction:
    """Modes of one test.

    Attributes
    ----------
    modes : tuple of ExtractedMode
        In ascending frequency, inside the band.
    outside : tuple of ExtractedMode
        Poles beyond the band or too uncertain to be called modes; they only help to add up the FRFs.
    points, references : tuple of Dof
        Of shapes and participations.
    hammer_roved : bool
        Whether the points are places of the force (reciprocity) instead of the accelerometer.
    cells : int array, shape (FRFs, 2)
        Point and reference of every FRF that was read, set after set.
    band_hz : (low, high)
    mass_line, stiffness_line : complex arrays, shape (points, references)
        Low residual −1/M (1/kg) over ω², and high residual 1/K (m/N), of equation [7].
    noise_ratio : float
        Median over all lines of noise over magnitude.
    stabilization : Stabilization
    remarks : tuple of str
        What the user should know.
    loaded : Loaded or None
        Where a roving sensor's mass explains how the poles move: then frequencies are those under the sensor, at the
        median of its places, and shapes and residual terms those of the structure without it.
    """

    modes: tuple[ExtractedMode, ...]
    outside: tuple[ExtractedMode, ...]
    points: tuple[Dof, ...]
    references: tuple[Dof, ...]
    hammer_roved: bool
    cells: npt.NDArray[np.int_]
    band_hz: tuple[float, float]
    mass_line: ComplexArray
    stiffness_line: ComplexArray
    noise_ratio: float
    stabilization: Stabilization
    remarks: tuple[str, ...]
    loaded: Loaded | None = None

    def regenerate(self, frequency_hz: npt.ArrayLike) -> ComplexArray:
        """Receptances (m/N) of all FRFs in the order in which they were read, shape (FRFs, lines)."""
        frequency = np.asarray(frequency_hz, dtype=float)
        if self.loaded is not None:
            weighed = self.loaded.load.denominator((2 * np.pi * frequency) ** 2)
            return self.loaded.free.regenerate(frequency) / weighed[self.cells[:, 0]]
        grid = residual_lines(self.mass_line, self.stiffness_line, frequency)
        for mode in self.modes + self.outside:
            grid += mode.receptance(frequency)
        return grid[self.cells[:, 0], self.cells[:, 1]]


def residual_lines(
    mass_line: ComplexArray, stiffness_line: ComplexArray, frequency_hz: FloatArray
) -> ComplexArray:
    """Residual terms of equation [7] over a frequency axis, shape (points, references, lines)."""
    squared = (2 * np.pi * frequency_hz) ** 2
    lines: ComplexArray = mass_line[..., None] / squared + stiffness_line[..., None]
    return lines

"""What one test measured, as the diagnosis sees it: modes, doublets with their angles, pole shifts along the axis."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from statorhom.study.modal_table import MeasuredMode

SHIFT_OWN, SHIFT_PART = 5e-5, 0.08  # of pole shifts from plane to plane: tangential motion, scatter


@dataclass(frozen=True)
class MeasuredSplit:
    """Two modes of one doublet.

    Parameters
    ----------
    lower, upper : labels of the modes.
    relative : complex split b_r over the mean λ (`statorhom.modes.doublets.complex_split`).
    sd : standard deviation of its real and of its imaginary part.
    """

    lower: str
    upper: str
    relative: complex
    sd: float


@dataclass(frozen=True, eq=False)
class PlaneShifts:
    """Relative shifts of a mode's pole from plane to plane, averaged around the circumference.

    Parameters
    ----------
    label : of the mode.
    z_m : (p,) planes.
    shift, sd : (p,) against the mean over all planes.
    mean : of the planes against the mode's own frequency as it was extracted.
    """

    label: str
    z_m: np.ndarray
    shift: np.ndarray
    sd: np.ndarray
    mean: float


@dataclass(frozen=True, eq=False)
class Sideband:
    """Other orders in a mode's shape, relative to its own (`statorhom.modes.shape_features`).

    Parameters
    ----------
    label : of the mode.
    order, angle_rad : of the mode itself.
    cosine, sine : (2, orders) even and odd along the axis.
    sd : (2, orders).
    z_m : (p,) planes of the points.
    """

    label: str
    order: int
    angle_rad: float
    cosine: np.ndarray
    sine: np.ndarray
    sd: np.ndarray
    z_m: np.ndarray


@dataclass(frozen=True, eq=False)
class MeasuredShapes:
    """Radial motion of all modes, made real.

    Parameters
    ----------
    labels : of the modes.
    z_m, angles_rad : (p,), (a,) of the points.
    radial : (modes, p, a); NaN where not measured.
    """

    labels: tuple[str, ...]
    z_m: np.ndarray
    angles_rad: np.ndarray
    radial: np.ndarray


@dataclass(frozen=True, eq=False)
class MeasuredPoints:
    """Motion of all modes at points of a plate, a beam or a wing, made real.

    Parameters
    ----------
    positions, directions : (p, 3) in the body's axes (m).
    motion, sd : (modes, p) and standard deviations.
    shift, shift_sd : (modes, p) of the modes' poles, relative, where one sensor roved; None elsewhere.
    """

    positions: np.ndarray
    directions: np.ndarray
    motion: np.ndarray
    sd: np.ndarray
    shift: np.ndarray | None = None
    shift_sd: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class MeasuredTest:
    """One test.

    Parameters
    ----------
    stage : number of the stage.
    name, support : of the test.
    modes : all modes, by frequency.
    recorded : whether shapes were seen, so that names and angles are the program's own.
    splits, shifts, sidebands, shapes : what the shapes told.
    points : the same of a body without an axis.
    """

    stage: int
    name: str
    support: str
    modes: tuple[MeasuredMode, ...]
    recorded: bool = False
    splits: tuple[MeasuredSplit, ...] = ()
    shifts: tuple[PlaneShifts, ...] = ()
    sidebands: tuple[Sideband, ...] = ()
    shapes: MeasuredShapes | None = None
    points: MeasuredPoints | None = None

    def named(self, names: Mapping[tuple[str, str], tuple[int, int]]) -> tuple[MeasuredMode, ...]:
        """The modes with some names corrected: (test, label) → (r, n)."""
        return tuple(
            replace(mode, order=names[self.name, mode.label][0], axial=names[self.name, mode.label][1])
            if (self.name, mode.label) in names
            else mode
            for mode in self.modes
        )

    def on_core(self, length_m: float) -> MeasuredTest:
        """The same with points beyond the ends of a core of this length moved to its ends.

        The drawing may be wrong: that points were measured where it has no core must not keep anybody from finding out.
        """

        def within(z_m: np.ndarray) -> np.ndarray:
            return np.clip(z_m, 0.0, length_m)

        shapes = self.shapes
        return replace(
            self,
            shifts=tuple(replace(s, z_m=within(s.z_m)) for s in self.shifts),
            sidebands=tuple(replace(s, z_m=within(s.z_m)) for s in self.sidebands),
            shapes=None if shapes is None else replace(shapes, z_m=within(shapes.z_m)),
        )

"""The name (r, n) of a mode shape, and its kind where it has no significant radial motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.model.radial_profile import node_planes, seen_planes
from statorhom.modes.order_spectrum import OrderSpectrum, order_spectrum

SIGNIFICANT_RADIAL_SHARE = 0.02
"""Below this share of radial motion a mode is named by its kind (about 14 % of the amplitude)."""

_NOISE_FACTOR = 3.0
_LEAST_NOISE_ORDERS = 4  # a median of fewer orders may well be real motion


@dataclass(frozen=True)
class ModeName:
    """Name of a mode.

    Attributes
    ----------
    order : int or None
        Circumferential order r; None where the mode is not radial or the points cannot tell.
    axial : int or None
        Axial node planes n of that order; None where the planes cannot tell.
    kind : str
        "radial", "torsion", "axial" or "winding".
    share : float
        The order's part of the radial mean square; for other kinds the part of all motion that is not radial.
    visibility : float
        Part of the mode's motion that is radial motion of the outer surface, 0 … 1.
    order_alias : int or None
        The lowest other order that looks the same at the angles of the points.
    axial_limit : int or None
        More node planes than this would look like fewer at the planes of the points.
    """

    order: int | None
    axial: int | None
    kind: str
    share: float
    visibility: float = 1.0
    order_alias: int | None = None
    axial_limit: int | None = None


def name_shape(
    radial: npt.ArrayLike,
    angles_rad: npt.ArrayLike,
    z_m: npt.ArrayLike,
    *,
    tangential: npt.ArrayLike | None = None,
    axial_motion: npt.ArrayLike | None = None,
    winding_share: float = 0.0,
) -> ModeName:
    """Name a measured or simulated shape by the motion of its outer surface.

    Parameters
    ----------
    radial : array_like, shape (planes, angles) or (angles,)
        Radial motion, complex or real; NaN where it is missing.
    angles_rad : array_like, shape (angles,)
        Angles of the points (rad).
    z_m : array_like, shape (planes,)
        Axial positions of the planes (m), in any order.
    tangential, axial_motion : array_like, shape of `radial`, optional
        The other components, in the same unit, where they are known.
    winding_share : float
        Share of the kinetic energy that is the winding's (simulated modes).

    Raises
    ------
    IdentificationError
        When the arrays do not fit, fewer than three angles remain, or nothing moves.
    """
    kind, visibility = motion_kind(radial, tangential, axial_motion, winding_share)
    if kind != "radial":
        return ModeName(None, None, kind, 1.0 - visibility, visibility)
    return _radial_name(order_spectrum(radial, angles_rad), np.atleast_1d(z_m), visibility)


def motion_kind(
    radial: npt.ArrayLike,
    tangential: npt.ArrayLike | None,
    axial_motion: npt.ArrayLike | None,
    winding_share: float = 0.0,
) -> tuple[str, float]:
    """Kind of a shape ("radial", "torsion", "axial" or "winding"), and the radial part of its mean square.

    Raises
    ------
    IdentificationError
        When nothing moves.
    """
    parts = _mean_squares([radial, tangential, axial_motion])
    visibility = float(parts[0] / parts.sum()) * (1.0 - winding_share)
    return ("radial" if visibility >= SIGNIFICANT_RADIAL_SHARE else _kind(parts, winding_share)), visibility


def _mean_squares(components: Sequence[npt.ArrayLike | None]) -> npt.NDArray[np.float64]:
    """Mean squares of the components (0 where there is none) in units of the largest motion's square."""
    values = [np.asarray(() if part is None else part, dtype=complex) for part in components]
    finite = [np.abs(part[np.isfinite(part)]) for part in values]
    largest = max(float(part.max(initial=0.0)) for part in finite)
    if largest == 0.0:
        raise IdentificationError("the mode shape has no motion: it cannot be named")
    return np.array([np.mean((part / largest) ** 2) if part.size else 0.0 for part in finite])


def _kind(parts: npt.NDArray[np.float64], winding_share: float) -> str:
    if winding_share > 0.5:
        return "winding"
    return "torsion" if parts[1] >= parts[2] else "axial"


def _radial_name(spectrum: OrderSpectrum, z_m: npt.NDArray[np.float64], visibility: float) -> ModeName:
    order = spectrum.dominant_order
    share = spectrum.share(order)
    if spectrum.unexplained_share > share or spectrum.lookalikes:
        # the points do not tell the order: any name would be a guess
        return ModeName(None, None, "radial", share, visibility)
    amplitudes = spectrum.signed_amplitudes(order)
    if z_m.shape != amplitudes.shape:
        raise IdentificationError(
            f"a mode shape with {amplitudes.size} planes needs as many axial positions, got {z_m.size}"
        )
    used = np.isfinite(amplitudes)
    return ModeName(
        order,
        measured_node_planes(amplitudes[used], z_m[used], noise=order_noise(spectrum, order)),
        "radial",
        share,
        visibility,
        order_alias=next(iter(spectrum.aliases(order)), None),
        axial_limit=int(np.unique(z_m[used]).size) - 1,
    )


def measured_node_planes(amplitudes: npt.ArrayLike, z_m: npt.ArrayLike, *, noise: float = 0.0) -> int | None:
    """Sign changes of an order's amplitude along the axis.

    Planes below a tenth of the largest amplitude, or below three times the noise, lie near a node and
    carry no sign. A plane between the two limits that would change the count leaves it open; so do two or more
    planes near nodes between planes of one sign, for a smooth shape that comes down so far has mostly gone through.

    Parameters
    ----------
    amplitudes, z_m : array_like, shape (planes,)
        Signed amplitudes and the axial positions (m) of their planes, in any order.
    noise : float
        Standard deviation of an amplitude, in its unit.

    Returns
    -------
    int or None
        None where the node planes cannot be told: fewer than two planes carry a sign, or faint ones matter.
    """
    along = np.asarray(amplitudes, dtype=float)[np.argsort(z_m, kind="stable"), None]
    least = _NOISE_FACTOR * noise
    if seen_planes(along, least).sum() < 2:
        return None
    count = int(node_planes(along, least)[0])
    if _gone_through(along[:, 0], least):
        return None
    faint = along[np.abs(along[:, 0]) > least, 0]
    return count if noise == 0.0 or count == np.count_nonzero(np.diff(np.sign(faint))) else None


def _gone_through(along: npt.NDArray[np.float64], least: float) -> bool:
    """Whether two or more neighbouring planes of (planes,) amplitudes lie near nodes between planes of one sign."""
    places = np.flatnonzero(seen_planes(along[:, None], least)[:, 0])
    return any(second - first > 2 and along[first] * along[second] > 0 for first, second in pairwise(places))


def order_noise(spectrum: OrderSpectrum, order: int) -> float:
    """Amplitude that noise alone gives an order: the median one, which few real orders do not move."""
    motion = np.hypot(np.abs(spectrum.cosine), np.abs(spectrum.sine))
    scale = float(np.nanmax(motion, initial=0.0)) or 1.0
    others = np.delete(np.nanmean((motion / scale) ** 2, axis=0), order)
    return scale * float(np.sqrt(np.median(others))) if others.size >= _LEAST_NOISE_ORDERS else 0.0

"""Stiffness that differs around the stator or along it: strips, arcs, waves and gradients, element by element.

An element that is covered in part counts by its covered share, so that results are smooth in every angle and size;
where within an element a feature lies is not resolved, but for the depth of strips (`layers.py`).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.model.broken.cells import Sectors, cells
from statorhom.model.broken.change import PieceChange
from statorhom.model.broken.layers import Layers
from statorhom.model.broken.pieces import Pieces, elements_in, mass_pieces, stiffness_pieces
from statorhom.study.regions import core_region


def strip(core: Layers, angle: float, *, width: float, depth: float, ratio: float) -> PieceChange:
    """An axial strip of the back of the core whose stiffness differs; a layer counts by its covered share.

    Along the circumference, where bending loads one part of an element after the other, compliances are averaged:
    as if all parts were loaded side by side, a soft strip would lose a quarter of its effect between two elements.

    Parameters
    ----------
    core : layers of the core's elements.
    angle, width : of the strip's middle, and how wide it is (rad).
    depth : how deep it reaches below the core's outer radius (m).
    ratio : modulus within the strip over that of the core.
    """
    inside = core.place.share_of_arc(angle - width / 2, angle + width / 2)
    change = 1.0 / (1.0 + (1.0 / ratio - 1.0) * inside) - 1.0
    deep = core.place.share_of_depth(core.outer - depth, core.outer)
    return PieceChange(core.pieces, None, change * deep[:, None])


def wave(
    mesh: HalfPitchMesh, yoke: Pieces, angle: float, *, harmonic: int, amplitude: float, inner: float
) -> PieceChange:
    """Stiffness of the back of the core times 1 + ε cos n(θ - α), by its mean over every element's angle.

    Parameters
    ----------
    yoke : stiffness of the core's elements (`region_stiffness`).
    angle : α, a maximum of the stiffness (rad).
    harmonic, amplitude : n and ε.
    inner : radius at which the yoke begins (m).
    """
    place = cells(mesh, elements_in(mesh, (core_region(mesh.regions),)))
    low, high = np.moveaxis(place.angles, -1, 0)
    mean = (np.sin(harmonic * (high - angle)) - np.sin(harmonic * (low - angle))) / (harmonic * (high - low))
    weights = amplitude * mean * place.share_of_depth(inner, mesh.outer_radius)[:, None]
    return PieceChange(yoke, None, weights)


def arc(pieces: Pieces, place: Sectors, start: float, end: float, ratio: float) -> PieceChange:
    """Pieces whose stiffness is scaled between two angles (rad); one counts by its covered share."""
    return PieceChange(pieces, None, (ratio - 1.0) * place.share_of_arc(start, end))


def gradient(parts: Layers, along: Callable[[np.ndarray], np.ndarray]) -> PieceChange:
    """A stiffness that varies along the axis.

    Parameters
    ----------
    parts : of the elements, by height (`radial_layers`): what a weight of one adds.
    along : weight at heights z (m).
    """
    weights = along(parts.place.z.mean(axis=1))
    return PieceChange(parts.pieces, None, np.repeat(weights[:, None], 2 * parts.place.slots, axis=1))


def region_stiffness(mesh: HalfPitchMesh, materials: Materials, regions: tuple[str, ...]) -> Pieces:
    """Stiffness of all elements of some regions, as their materials are."""
    return stiffness_pieces(mesh, {r: hooke_coefficients(materials[r].hooke) for r in regions})


def region_mass(mesh: HalfPitchMesh, materials: Materials, regions: tuple[str, ...]) -> Pieces:
    """Mass of all elements of some regions, as their materials are."""
    return mass_pieces(mesh, {r: materials[r].density for r in regions})

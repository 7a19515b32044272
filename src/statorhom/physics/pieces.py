"""Stiffness of a region's elements, assembled once for all places and strengths of an effect."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Material, hooke_coefficients
from statorhom.model.broken.layers import Layers, radial_layers
from statorhom.model.broken.pieces import Pieces, stiffness_pieces
from statorhom.model.kept import Kept
from statorhom.study.regions import core_region

ALL = (True,) * 9
MOST = 12  # sets of pieces that are kept
LAYERS = 4  # an element, where the depth of a feature counts
_LATEST = Kept(MOST)
_Parts = TypeVar("_Parts", Pieces, Layers)


def region_pieces(
    mesh: HalfPitchMesh, region: str, material: Material, entries: tuple[bool, ...] = ALL
) -> Pieces:
    """Pieces of a region's elements.

    Parameters
    ----------
    mesh : of the half pitch.
    region, material : whose stiffness.
    entries : which of the nine Hooke entries (`statorhom.model.assembly.HOOKE_ENTRIES`) count.
    """
    return hooke_pieces(mesh, region, np.where(entries, hooke_coefficients(material.hooke), 0.0))


def hooke_pieces(mesh: HalfPitchMesh, region: str, coefficients: np.ndarray) -> Pieces:
    """Pieces of a region's elements of which the nine Hooke entries are given, whether of a material or of a change."""
    key = (id(mesh), region, *coefficients.tolist())
    return _kept(mesh, key, lambda: stiffness_pieces(mesh, {region: coefficients}))


def yoke_layers(mesh: HalfPitchMesh, material: Material, inner: float) -> Layers:
    """Layers of the core's elements that reach beyond a radius (m)."""
    coefficients = hooke_coefficients(material.hooke)
    key = (id(mesh), inner, *coefficients.tolist())
    return _kept(
        mesh, key, lambda: radial_layers(mesh, core_region(mesh.regions), coefficients, LAYERS, inner)
    )


def _kept(mesh: HalfPitchMesh, key: tuple[object, ...], make: Callable[[], _Parts]) -> _Parts:
    # the mesh is kept with its pieces, so that its id stays its own
    _, parts = _LATEST.once(key, lambda: (mesh, make()))
    return parts

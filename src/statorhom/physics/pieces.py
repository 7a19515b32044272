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

MOST = 12  # sets of pieces that are kept
LAYERS = 4  # an element, where the depth of a feature counts
_LATEST = Kept(MOST)
_Parts = TypeVar("_Parts", Pieces, Layers)


def region_pieces(mesh: HalfPitchMesh, region: str, material: Material) -> Pieces:
    """Pieces of a region's elements.

    Parameters
    ----------
    mesh : of the half pitch.
    region, material : whose stiffness.
    """
    coefficients = hooke_coefficients(material.hooke)
    key = (id(mesh), region, *coefficients.tolist())
    return _kept(mesh, key, lambda: stiffness_pieces(mesh, {region: coefficients}))


def pieces_by_height(mesh: HalfPitchMesh, region: str, coefficients: np.ndarray) -> Layers:
    """The same of nine Hooke entries or of their change, Gauss points of every height apart.

    For what varies along the axis.
    """
    key = (id(mesh), "by height", region, *coefficients.tolist())
    return _kept(mesh, key, lambda: radial_layers(mesh, region, coefficients, 1, by_height=True))


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

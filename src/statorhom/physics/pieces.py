"""Stiffness of a region's elements, assembled once for all places and strengths of an effect."""

from __future__ import annotations

from collections import OrderedDict

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Material, hooke_coefficients
from statorhom.model.broken.pieces import Pieces, stiffness_pieces

ALL = (True,) * 9
MOST = 12  # sets of pieces that are kept
_KEPT: OrderedDict[tuple[int, str, tuple[float, ...]], tuple[HalfPitchMesh, Pieces]] = OrderedDict()


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
    used = tuple(np.where(entries, hooke_coefficients(material.hooke), 0.0).tolist())
    key = (id(mesh), region, used)
    if key not in _KEPT:
        while len(_KEPT) >= MOST:
            _KEPT.popitem(last=False)
        # the mesh is kept with its pieces, so that its id stays its own
        _KEPT[key] = (mesh, stiffness_pieces(mesh, {region: np.array(used)}))
    return _KEPT[key][1]

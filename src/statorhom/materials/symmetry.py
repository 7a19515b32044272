"""The symmetries a region's material can have, by the names used in study files."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType

from statorhom.errors import MaterialError
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.study.regions import COUPON_CONSTANTS

Material = Isotropic | TransverselyIsotropic | Orthotropic

SYMMETRIES: Mapping[str, type[Isotropic] | type[TransverselyIsotropic] | type[Orthotropic]] = (
    MappingProxyType(
        {material.symmetry: material for material in (Isotropic, TransverselyIsotropic, Orthotropic)}
    )
)


def constant_names(symmetry: str, *, numbered: bool = False) -> tuple[str, ...]:
    """Return the names of a symmetry's engineering constants, in the order of its constructor.

    Where all three axes differ, a coupon's are `numbered` 1, 2, 3 instead of r, θ, z.

    Raises
    ------
    MaterialError
        There is no such symmetry; the message suggests the nearest one.
    """
    if symmetry not in SYMMETRIES:
        near = difflib.get_close_matches(symmetry, SYMMETRIES, n=1)
        hint = f"did you mean {near[0]!r}?" if near else f"use one of {', '.join(SYMMETRIES)}"
        raise MaterialError(f"unknown symmetry {symmetry!r}: {hint}")
    if numbered:
        return COUPON_CONSTANTS[symmetry]  # type: ignore[index]
    return tuple(field.name for field in fields(SYMMETRIES[symmetry]))

"""Physical conditions on engineering constants, named where they are violated."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from statorhom.errors import MaterialError


def check_finite(symmetry: str, constants: Mapping[str, float]) -> None:
    """Refuse constants that are no numbers.

    Raises
    ------
    MaterialError
        Names the first constant that is not finite.
    """
    for name, value in constants.items():
        if not math.isfinite(value):
            raise MaterialError(f"{symmetry} material: {name} must be a finite number, is {value}")


def check_positive(symmetry: str, constants: Mapping[str, float]) -> None:
    """Refuse moduli (the constants in Pa) that are zero or negative.

    Raises
    ------
    MaterialError
        Names the first modulus that is not positive.
    """
    for name, value in constants.items():
        if name.endswith("_pa") and value <= 0.0:
            raise MaterialError(f"{symmetry} material: {name} must be positive, is {value:.6g}")


def check_conditions(symmetry: str, conditions: Iterable[tuple[bool, str]]) -> None:
    """Refuse constants that break one of the conditions of positive strain energy.

    Parameters
    ----------
    symmetry : str
        What the message calls the material.
    conditions : iterable of (holds, statement)
        The statement says what must hold, with the numbers.

    Raises
    ------
    MaterialError
        States the first condition that does not hold.
    """
    for holds, statement in conditions:
        if not holds:
            raise MaterialError(f"{symmetry} material: {statement}")

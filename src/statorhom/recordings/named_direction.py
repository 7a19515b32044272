"""Directions by their names: x, y, z, r, theta, with a sign where they are reversed."""

from __future__ import annotations

import math

import numpy as np

from statorhom.recordings.dof import Dof, Vector

DIRECTIONS = ("x", "y", "z", "r", "theta")
_ALIGNED = 1e-9


def direction_vector(name: str, position: Vector | None) -> Vector | None:
    """The unit vector of a named direction at a point; None where r or theta have none there.

    Parameters
    ----------
    name : str
        One of `DIRECTIONS`, possibly with + or - before it.
    position : (x, y, z) or None
        The point.

    Raises
    ------
    ValueError
        Where it is no such name.
    """
    sign = -1.0 if name.startswith("-") else 1.0
    plain = name.lstrip("+-")
    if plain not in DIRECTIONS or len(name) - len(plain) > 1:
        raise ValueError(name)
    if plain in ("x", "y", "z"):
        vector = np.eye(3)[DIRECTIONS.index(plain)]
    elif position is None or not math.hypot(*position[:2]):
        return None
    else:
        x, y = np.array(position[:2]) / math.hypot(*position[:2])
        vector = np.array([x, y, 0.0] if plain == "r" else [-y, x, 0.0])
    x, y, z = sign * vector
    return (float(x), float(y), float(z))


def direction_name(dof: Dof) -> str | None:
    """The name of a direction, "" where it is unknown; None where it has no name."""
    if dof.direction is None:
        return ""
    for name in DIRECTIONS:
        vector = direction_vector(name, dof.position)
        if vector is not None:
            cosine = float(np.dot(vector, dof.direction))
            if abs(cosine) > 1 - _ALIGNED:
                return name if cosine > 0 else f"-{name}"
    return None

"""Names of the shapes of plates, beams and wings: bending, torsion or in the plane, and nodal lines.

A shape is first told apart from a motion of the rigid body; then the strongest product f(span) · g(chord) in its
out-of-plane motion is found. The sign changes of f and g are the nodal lines; where g has none the body bends, with
one it twists, with more the chord itself bends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.phase import real_shape
from statorhom.modes.plan_form.frame import PlanForm, plan_form
from statorhom.modes.plan_form.waves import field_waves

FloatArray = npt.NDArray[np.float64]
Kind = Literal["bending", "torsion", "chordwise bending", "in-plane bending", "axial", "rigid body"]
Symmetry = Literal["symmetric", "antisymmetric"]

_RIGID = 0.995  # of the motion that a rigid body explains
_EXPLAINED = 0.8  # of the motion that must be understood before it is named
_LEADS = 0.5  # of the motion's power that the named part must have
_SYMMETRIC = 0.8  # of the power: structures are never quite symmetric
_ORDINALS = {1: "st", 2: "nd", 3: "rd"}


@dataclass(frozen=True)
class PlanFormName:
    """What a shape is called.

    Attributes
    ----------
    kind : str or None
        "bending", "torsion", "chordwise bending" (the chord itself bends), "in-plane bending" (along the chord),
        "axial" (along the span), "rigid body"; None where the points do not tell it.
    span_nodes, chord_nodes : int or None
        Nodal lines that cross the span, and that run along it: (i, j) of a free plate. Between simply supported edges
        the numbers of half waves are one more. None for rigid bodies and unnamed shapes.
    symmetry : "symmetric", "antisymmetric" or None
        About mid-span; None for shapes that are neither.
    out_of_plane : float
        Part of the mean square motion along the normal, 0 … 1.
    share : float
        Part of the motion's power that the named kind has, 0 … 1.
    """

    kind: Kind | None
    span_nodes: int | None
    chord_nodes: int | None
    symmetry: Symmetry | None
    out_of_plane: float
    share: float

    @property
    def statement(self) -> str:
        """The name in words."""
        if self.kind is None:
            return "a shape that the points do not tell"
        if self.span_nodes is None:
            return self.kind
        words = f"{self.kind} ({self.span_nodes}, {self.chord_nodes})"
        return words if self.symmetry is None else f"{self.symmetry} {words}"


def name_plan_form(
    points: npt.ArrayLike, motion: npt.ArrayLike, axes: npt.ArrayLike | None = None
) -> PlanFormName:
    """Name a shape from the motion of points on a plate, a beam or a wing.

    Parameters
    ----------
    points : array_like, shape (points, 3)
        Positions, in any unit.
    motion : array_like, shape (points, 3)
        Real or complex displacements, 0 in directions that were not measured; points with NaN are left out.
    axes : array_like, shape (3, 3), optional
        See `plan_form`.

    Raises
    ------
    IdentificationError
        When the arrays do not fit, fewer than four points are there, or nothing moves.
    """
    positions, moved = np.asarray(points, dtype=float), np.asarray(motion, dtype=complex)
    if positions.shape != moved.shape or positions.ndim != 2:
        raise IdentificationError(
            f"points {positions.shape} and their motion {moved.shape} must be (points, 3) both"
        )
    finite = np.isfinite(moved).all(axis=1)
    if not np.any(np.abs(moved[finite]) > 0):
        raise IdentificationError("a shape that does not move has no name")
    positions = positions[finite]
    form = plan_form(positions, axes)
    real = real_shape(moved[finite])
    in_frame = real @ np.linalg.inv(form.axes)
    powers = np.mean(in_frame**2, axis=0)
    out = float(powers[2] / powers.sum())
    if _rigid_share(positions, real) > _RIGID:
        return PlanFormName("rigid body", None, None, None, out, 1.0)
    direction = 2 if out >= _LEADS else int(np.argmax(powers[:2]))
    return _name(form, in_frame[:, direction], direction, float(powers[direction] / powers.sum()), out)


def _name(form: PlanForm, values: FloatArray, direction: int, part: float, out: float) -> PlanFormName:
    waves = field_waves(form, values)
    share = part * waves.explained * waves.share
    nodes, lines = waves.along.nodes, waves.across.nodes
    if waves.explained < _EXPLAINED or share < _LEADS or not waves.resolved:
        return PlanFormName(None, None, None, None, out, share)
    kinds: tuple[Kind, ...] = ("axial", "in-plane bending", "bending")
    kind = kinds[direction]
    if direction == 2 and lines:
        kind = "torsion" if lines == 1 else "chordwise bending"
    even = waves.along.even_share
    symmetry: Symmetry | None = None
    if max(even, 1 - even) > _SYMMETRIC:
        symmetry = "symmetric" if even > 0.5 else "antisymmetric"
    return PlanFormName(kind, nodes, lines, symmetry, out, share)


def _rigid_share(positions: FloatArray, motion: FloatArray) -> float:
    """Part of the motion, 0 … 1, that three translations and three rotations explain.

    Directions in which nothing moves were perhaps not measured and say nothing.
    """
    measured = np.any(motion != 0.0, axis=0)
    centred = positions - positions.mean(axis=0)
    centred /= np.abs(centred).max()
    turned = [np.cross(axis, centred) for axis in np.eye(3)]
    columns = [*(np.broadcast_to(axis, centred.shape) for axis in np.eye(3)), *turned]
    matrix = np.stack([column[:, measured].ravel() for column in columns], axis=1)
    target = motion[:, measured].ravel()
    rest = target - matrix @ np.linalg.lstsq(matrix, target, rcond=1e-9)[0]
    return 1 - float(rest @ rest) / float(target @ target)


def ordinal_labels(names: Sequence[PlanFormName | None]) -> tuple[str, ...]:
    """ "1st bending", "2nd bending", "1st torsion" …: modes of a kind counted in the order given, that of frequency."""
    seen: dict[str, int] = {}
    labels = []
    for name in names:
        if name is None or name.kind is None:
            labels.append("")
            continue
        seen[name.kind] = number = seen.get(name.kind, 0) + 1
        ending = "th" if number % 100 in (11, 12, 13) else _ORDINALS.get(number % 10, "th")
        labels.append(f"{number}{ending} {name.kind}")
    return tuple(labels)

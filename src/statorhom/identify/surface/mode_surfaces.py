"""Response surfaces of the modes' frequencies, one per mode name."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.surface.cube import Cube
from statorhom.identify.surface.experiments import Solved
from statorhom.model.convergence import ModeKey
from statorhom.model.stator_mode import StatorMode


class Surface(Protocol):
    """Several responses over the cube."""

    @property
    def description(self) -> str:
        """What it is, for the report."""
        ...

    def __call__(self, points: Array) -> Array:
        """Return the responses (n, m) at points (n, d)."""
        ...


FitSurface = Callable[[Array, Array], Surface]


@dataclass(frozen=True)
class ModeSurfaces:
    """Frequencies of the modes that exist all over the design.

    Parameters
    ----------
    cube : of the constants.
    keys : names of the modes.
    examples : a mode of each name, for all but its frequency.
    surface : ln f of the modes (Hz).
    """

    cube: Cube
    keys: tuple[ModeKey, ...]
    examples: tuple[StatorMode, ...]
    surface: Surface

    @property
    def description(self) -> str:
        """What was fitted."""
        return self.surface.description

    def frequencies(self, points: Array) -> Array:
        """Hz, (n, m) at points (n, d) of the cube."""
        return np.asarray(np.exp(self.surface(np.atleast_2d(points))))

    def modes(self, point: Array) -> tuple[StatorMode, ...]:
        """Modes at a point of the cube, sorted by frequency."""
        found = [
            mode._replace(frequency_hz=float(f))
            for mode, f in zip(self.examples, self.frequencies(point)[0], strict=True)
        ]
        return tuple(sorted(found, key=lambda mode: mode.frequency_hz))

    def largest_errors(self, points: Array, solved: Sequence[Solved | None]) -> dict[ModeKey, float]:
        """Largest relative prediction error of every mode at solved points."""
        places = [i for i, found in enumerate(solved) if found is not None]
        predicted = self.frequencies(np.asarray(points)[places])
        errors: dict[ModeKey, float] = {}
        for column, key in enumerate(self.keys):
            misses = [
                abs(predicted[row, column] / found[key].frequency_hz - 1.0)
                for row, i in enumerate(places)
                if (found := solved[i]) is not None and key in found
            ]
            errors[key] = max(misses, default=np.inf)
        return errors


def fit_surfaces(cube: Cube, points: Array, solved: Sequence[Solved | None], fit: FitSurface) -> ModeSurfaces:
    """Fit the surfaces to a solved design.

    Parameters
    ----------
    cube : of the constants.
    points, solved : the design; points without a material are left out.
    fit : `fit_polynomial` or the like, for responses side by side.

    Raises
    ------
    IdentificationError
        If no mode exists at all points, or there are too few of them.
    """
    used = [(point, found) for point, found in zip(points, solved, strict=True) if found is not None]
    if not used:
        raise IdentificationError(
            "response surface: no material exists at any point of the design; change the ranges of the constants"
        )
    tables = [found for _, found in used]
    keys = tuple(key for key in tables[0] if all(key in table for table in tables))
    if not keys:
        raise IdentificationError(
            "response surface: no mode keeps its name over the ranges of the constants; narrow them (identify.prior)"
        )
    frequencies = np.array([[table[key].frequency_hz for key in keys] for table in tables])
    chosen = np.array([point for point, _ in used])
    middle = tables[int(np.argmin(np.linalg.norm(chosen, axis=1)))]
    return ModeSurfaces(cube, keys, tuple(middle[key] for key in keys), fit(chosen, np.log(frequencies)))

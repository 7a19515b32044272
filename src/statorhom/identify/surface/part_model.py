"""The full model of a stage, for designs of experiments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.free_modes import FreeProblem, problem_at
from statorhom.model.stator_mode import StatorMode

MORE = 4  # modes of a problem beyond twice those at the typical material
UNSEEN = 8  # modes of a problem beyond those measured in all: rigid bodies, and what a test may have missed


@dataclass(frozen=True)
class PartTask:
    """The part at one material.

    Parameters
    ----------
    problem : its matrices.
    highest_hz, orders, most : see `FreeProblem.solve`.
    """

    problem: FreeProblem
    highest_hz: float
    orders: tuple[int, ...]
    most: int

    def modes(self) -> Sequence[StatorMode]:
        """Named modes of the problems, sorted by frequency."""
        return self.problem.solve(self.highest_hz, self.orders, self.most).modes


@dataclass(frozen=True)
class PartModel:
    """Makes tasks whose modes are the same ones at all materials, as far as their order does not change.

    Parameters
    ----------
    model : of the fitting mesh.
    typical : material at which the band is the given one.
    highest_hz : of the band.
    orders : numbers of the problems.
    most : lowest modes of each problem.
    """

    model: AffineModel[PartMesh]
    typical: Materials
    highest_hz: float
    orders: tuple[int, ...]
    most: int

    def __call__(self, materials: Materials) -> PartTask:
        """Return the task at a material; a stiffer one has its modes higher up."""
        band = self.highest_hz * np.sqrt(max(1.0, self._stiffer(materials)))
        return PartTask(problem_at(self.model, materials), float(band), self.orders, self.most)

    def _stiffer(self, materials: Materials) -> float:
        """Largest ratio of strain energies of a region, here over typically."""
        return max(
            float(np.linalg.eigvals(m.hooke.matrix @ self.typical[region].hooke.compliance).real.max())
            for region, m in materials.items()
        )


def part_model(
    model: AffineModel[PartMesh],
    typical: Materials,
    highest_hz: float,
    orders: Sequence[int],
    measured: int | None = None,
) -> PartModel:
    """Model whose modes cover the band at the typical material and all that moves into it elsewhere.

    Parameters
    ----------
    model, typical, highest_hz, orders : see `PartModel`.
    measured : number of measured modes, where no problem need have many more; None where it may.
    """
    solution = problem_at(model, typical).solve(highest_hz, orders)
    counts = [shape.shape[1] for shape in solution.shapes]
    most = 2 * max(counts, default=1) + MORE
    if measured is not None:
        most = min(most, measured + UNSEEN)
    return PartModel(model, typical, highest_hz, tuple(orders), most)

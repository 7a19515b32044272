"""The full model solved at the points of a design, nothing twice."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from statorhom.errors import MaterialError
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.processes.announce import Progress
from statorhom.identify.processes.workers import Tick, Workers
from statorhom.identify.stages.stage_materials import StageMaterials
from statorhom.identify.surface.cube import Cube
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.stator_mode import StatorMode

Solved = dict[ModeKey, StatorMode]
PER_WORKER = 4  # tasks that wait for a process: each holds the matrices of a whole model


class FullTask(Protocol):
    """The full model at one material; picklable."""

    def modes(self) -> Sequence[StatorMode]:
        """Return its named modes, sorted by frequency."""
        ...


FullModel = Callable[[Materials], FullTask]


@dataclass(frozen=True)
class Experiments:
    """Solves and remembers.

    Parameters
    ----------
    cube : of the constants.
    materials : how constants become materials.
    model : the full model.
    workers : processes.
    progress : called with the number of solves so far.
    """

    cube: Cube
    materials: StageMaterials
    model: FullModel
    workers: Workers
    progress: Progress | None = None
    _known: dict[bytes, Solved | None] = field(default_factory=dict, init=False, repr=False)

    @property
    def solves(self) -> int:
        """Full solves so far."""
        return sum(found is not None for found in self._known.values())

    def at(self, points: Array) -> list[Solved | None]:
        """Modes by name at every point (n, d) of the cube; None where no material has these constants."""
        marks = [_mark(point) for point in points]
        new = [(m, p) for m, p in dict(zip(marks, points, strict=True)).items() if m not in self._known]
        possible = [
            (mark, found) for mark, point in new if (found := self._material(mark, point)) is not None
        ]
        share = PER_WORKER * self.workers.jobs
        for first in range(0, len(possible), share):
            part = possible[first : first + share]
            tasks = [self.model(materials) for _, materials in part]
            for (mark, _), modes in zip(part, self.workers.map(_solve, tasks), strict=True):
                self._known[mark] = mode_keys(modes)
            if self.progress is not None:
                self.progress(self.solves)
        return [self._known[mark] for mark in marks]

    def _material(self, mark: bytes, point: Array) -> Materials | None:
        try:
            return self.materials.of(self.cube.values(point))
        except MaterialError:
            self._known[mark] = None
            return None


def _mark(point: Array) -> bytes:
    return (np.asarray(point, dtype=float) + 0.0).tobytes()  # −0 is 0


def _solve(task: FullTask, tick: Tick) -> Sequence[StatorMode]:
    modes = task.modes()
    tick()
    return modes

"""Meshes of a stage: the one to fit with and the finer ones that tell its error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from statorhom.geometry.block import BlockGeometry
from statorhom.geometry.tested_object import ObjectStep
from statorhom.geometry.wing import WingGeometry
from statorhom.identify.processes.workers import Tick, Workers
from statorhom.mesh.block import block_mesh
from statorhom.mesh.density import MeshDensity
from statorhom.mesh.extrude import mesh_step
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.mesh.wing import wing_mesh
from statorhom.model.affine import AffineModel, Materials, assemble
from statorhom.model.convergence import ModeConvergence, converge
from statorhom.model.free_modes import FreeModes, FreeProblem, problem_at

SolveTask = tuple[FreeProblem, float, tuple[int, ...], int | None]


@dataclass(frozen=True)
class Band:
    """How a harmonic takes part in a convergence study.

    Parameters
    ----------
    highest_hz : upper end of the band.
    meshes : on the coarsest how many meshes.
    most : lowest modes that are enough, None for all of the band.
    """

    highest_hz: float
    meshes: int
    most: int | None


@dataclass(frozen=True)
class MeshSeries:
    """A stage's meshes, coarsest first.

    Parameters
    ----------
    step : its geometry.
    density : of the coarsest mesh of a stator; blocks and wings have their own.
    refinements : factors of the number of cells, ascending from 1.
    """

    step: ObjectStep
    density: MeshDensity
    refinements: tuple[float, ...] = (1.0, 1.5, 2.0)

    @cached_property
    def models(self) -> tuple[AffineModel[PartMesh], ...]:
        """Assembled models of all meshes."""
        return tuple(assemble(self._mesh(factor)) for factor in self.refinements)

    def _mesh(self, factor: float) -> PartMesh:
        if isinstance(self.step, BlockGeometry):
            return block_mesh(self.step, factor)
        if isinstance(self.step, WingGeometry):
            return wing_mesh(self.step, factor)
        return mesh_step(self.step, self.density.refined(factor))

    @property
    def coarsest(self) -> AffineModel[PartMesh]:
        """The model to fit with."""
        return self.models[0]

    def solution(
        self, materials: Materials, highest_hz: float, orders: Sequence[int], workers: Workers
    ) -> FreeModes:
        """Modes of the coarsest mesh with their shapes."""
        task = (problem_at(self.coarsest, materials), highest_hz, tuple(orders), None)
        [found] = workers.map(_solve_whole, [task])
        return found

    def study(
        self, materials: Materials, bands: Mapping[int, Band], workers: Workers
    ) -> tuple[ModeConvergence, ...]:
        """Solve the meshes at the same materials and extrapolate every common mode.

        Parameters
        ----------
        materials : of every region.
        bands : harmonic → how far up and on how many meshes.
        workers : processes; the largest problems begin first.
        """
        problems = [problem_at(model, materials) for model in self.models]
        # harmonics share their factorizations: those with the same band are solved together
        levels, work = [], []
        for level in reversed(range(len(self.models))):
            groups: dict[tuple[float, int | None], list[int]] = {}
            for order, band in bands.items():
                if level < band.meshes:
                    groups.setdefault((band.highest_hz, band.most), []).append(order)
            for (highest_hz, most), orders in groups.items():
                levels.append(level)
                work.append((problems[level], highest_hz, tuple(orders), most))
        found = {
            (level, order): modes
            for level, solved in zip(levels, workers.map(_solve, work), strict=True)
            for order, modes in solved.items()
        }
        converged: list[ModeConvergence] = []
        for order, band in bands.items():
            count = min(band.meshes, len(self.models))
            sizes = [1 / f for f in self.refinements[:count]]
            dofs = [model.mesh.full_dof for model in self.models[:count]]
            converged += converge(sizes, dofs, [found[level, order] for level in range(count)])
        return tuple(converged)


def _solve_whole(task: SolveTask, tick: Tick) -> FreeModes:
    problem, highest_hz, orders, most = task
    solution = problem.solve(highest_hz, orders, most)
    tick()
    return solution


def _solve(task: SolveTask, tick: Tick) -> dict[int, FreeModes]:
    solution = _solve_whole(task, tick)
    # shapes stay in the process: frequencies and names are all that extrapolation needs
    order = [harmonic.order for harmonic in solution.harmonics]
    return {
        wanted: FreeModes(tuple(m for m in solution.modes if order[m.problem] == wanted), (), (), ())
        for wanted in task[2]
    }

"""Numerical settings of a run: what is not the engineer's belief but the program's care."""

from __future__ import annotations

from dataclasses import dataclass, replace

from statorhom.mesh.density import MeshDensity, graded

# Within 0.8 % of the converged (2, 0) frequency at half the degrees of freedom of the usual graded mesh; refined by
# 1.5 and 2 it extrapolates to within 0.1 %. Along the teeth of an empty slot it takes four cells, for with two slender
# teeth do not bend: their modes would lie 5 % too high, and those of the yoke nearby would move the surface too much.
FITTING_MESH = replace(graded(tooth=1, radial=2, yoke=2), bare={"radial": 4})


@dataclass(frozen=True)
class Settings:
    """Settings of a run.

    Parameters
    ----------
    seed : of the search; equal seeds give equal results.
    jobs : processes.
    density : mesh that the constants are fitted on.
    refinements : meshes of the convergence study, as factors of the number of cells.
    shared_bases : whether reduced bases shall serve other machines of the same geometry too. They are larger then,
        for what earlier steps have told of this machine does not confine them.
    """

    seed: int = 1
    jobs: int = 1
    density: MeshDensity = FITTING_MESH
    refinements: tuple[float, ...] = (1.0, 1.5, 2.0)
    shared_bases: bool = False

    def digest_parts(self) -> dict[str, object]:
        """What of it decides the results."""
        d = self.density
        return {
            "seed": self.seed,
            "cells": [dict(d.cells), dict(d.bare)],
            "mesh": [d.grading, d.end_grading, d.widest, d.longest, d.factor],
            "refinements": list(self.refinements),
            "shared_bases": self.shared_bases,
        }

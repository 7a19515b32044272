"""Time a stator's answers to unit loads on its surface: shared by all harmonics, and solved problem by problem.

The impregnated 36-slot stator of the paper on the mesh of the diagnosis. Both ways give flexibility and inertia of the
loaded coordinates of every harmonic problem; they take turns in one run, and their results are compared.

    python benchmarks/unit_loads.py
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

import numpy as np
from broken_symmetry import GEOMETRY, HIGHEST_HZ, materials
from threadpoolctl import threadpool_limits

from statorhom.geometry import stator_geometry
from statorhom.mesh import graded, mesh_step
from statorhom.model.affine import assemble
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.sector import Sector
from statorhom.study.geometry_file import read_geometry

REPEATS = 3

Answers = list[tuple[np.ndarray, np.ndarray]]


def sectors() -> Sequence[Sector]:
    """Problems that know nothing of loads yet."""
    step = stator_geometry(read_geometry(GEOMETRY), GEOMETRY).step(("stack", "wound", "impregnated"))
    basis = symmetric_basis(assemble(mesh_step(step, graded())), materials(), HIGHEST_HZ)
    return [problem.sector for problem in basis.problems]


def shared(found: Sequence[Sector]) -> Answers:
    """Flexibility and inertia by what all harmonics share."""
    return [(s.answers.flexibility, s.answers.inertia) for s in found]


def one_by_one(found: Sequence[Sector]) -> Answers:
    """The same by a solution of every problem."""
    answers = []
    for sector in found:
        loads = np.zeros((sector.space.size, len(sector.loaded)))
        loads[sector.loaded, np.arange(len(sector.loaded))] = 1.0
        responses = sector.solve(loads)
        answers.append((responses[sector.loaded], responses.T @ (sector.M @ responses)))
    return answers


def timed(way: Callable[[Sequence[Sector]], Answers]) -> tuple[float, Answers]:
    """Seconds of a way, and what it gives; factors are there before, answers are not."""
    found = sectors()
    for sector in found:
        sector.problem.factors  # noqa: B018 - both ways need them
    begun = time.perf_counter()
    answers = way(found)
    return time.perf_counter() - begun, answers


def main() -> None:
    with threadpool_limits(limits=1, user_api="blas"):
        pairs = [(timed(one_by_one), timed(shared)) for _ in range(REPEATS)]
    (_, exact), (_, answers) = pairs[0]
    error = max(
        float(np.abs(a - b).max() / np.abs(b).max())
        for own, known in zip(answers, exact, strict=True)
        for a, b in zip(own, known, strict=True)
    )
    ratios = sorted(slow / fast for (slow, _), (fast, _) in pairs)
    seconds = [round(min(s for s, _ in way), 2) for way in zip(*pairs, strict=True)]
    print(f"one by one {seconds[0]} s, shared {seconds[1]} s; ratio {ratios[len(ratios) // 2]:.1f} (median)")
    print(f"largest difference {error:.1e} of the largest entry")


if __name__ == "__main__":
    main()

"""The reduced model that stands in for a stage's mesh, built by all processes or taken from the store.

A fit needs two of them. The search walks through all that the prior allows, decades of stiffness for a winding, and
needs to know no more than where the valleys are: a basis certified to a hundredth where that is cheap to have.
What it finds is polished in a second basis, made for the materials around the optima and certified there to where
nothing of it remains in the result. A fleet's machines share one basis over the whole prior.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from statorhom.identify.processes.announce import Progress
from statorhom.identify.processes.workers import Tick, Workers
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.basis_store import BasisStore, basis_key
from statorhom.model.common_snapshots import Snapshots, common_snapshots
from statorhom.model.material_span import MaterialPoint
from statorhom.model.reduced import MaterialBox, ReducedHarmonic, material_box, reduce_harmonic
from statorhom.model.reduced_stator import ReducedStator, reduced_stator
from statorhom.model.space import Space

BAND = 1.1  # the basis is exact up to here, as a part of the highest measured frequency
STEP, SHARED_STEP = 1.05, 1.2  # bands are rounded up to powers of it, those of a fleet's machines more
LOOK = 1.5  # modes are computed and paired up to here


@dataclass(frozen=True)
class BasisPlan:
    """How fine a stage's bases are.

    Parameters
    ----------
    training : materials among which they pick their snapshots, a power of two; of a local basis around each optimum.
    cells : into which the materials are divided at most; more make an evaluation faster and the bases dearer.
    common : of a cell's materials that all harmonics are solved at together; 0 for bodies that have no harmonics.
    tolerance : certified relative frequency error to stay below.
    folded : see `material_span`.
    room_radius : of the rooms into which cells are divided again; infinite for none. What they save in an evaluation
        is worth their making where there are very many.
    """

    training: int
    cells: int
    common: int
    tolerance: float
    folded: bool = False
    room_radius: float = np.inf


# at the result: a bound, mostly far above the error; and the mesh factors compare the basis with the full model there
TOLERANCE = 1e-3
SEARCH = BasisPlan(64, 4, 6, 1e-2)
# plates and wings have few problems and large ones: what counts are full solves, and a single cell needs the fewest
SEARCH_OF_BLOCKS = BasisPlan(64, 1, 0, 1e-2, folded=True)
LOCAL = BasisPlan(16, 4, 5, TOLERANCE)
LOCAL_OF_BLOCKS = BasisPlan(16, 1, 0, TOLERANCE, folded=True)
SHARED = BasisPlan(512, 12, 6, 3e-4, room_radius=0.35)

SnapshotTask = tuple[Any, Any, Sequence[MaterialPoint], Sequence[str], float, int]
BasisTask = tuple[
    AffineModel[PartMesh], Space, MaterialBox, float, float, BasisStore | None, str, tuple[Snapshots, ...]
]


def reduce_stage(
    model: AffineModel[PartMesh],
    training: Sequence[Materials],
    typical: Materials,
    spaces: Sequence[Space],
    highest_hz: float,
    workers: Workers,
    plan: BasisPlan = SEARCH,
    progress: Progress | None = None,
    store: BasisStore | None = None,
    step: float = STEP,
) -> ReducedStator:
    """Reduced bases of the given harmonic problems, one task each.

    Parameters
    ----------
    model : of the mesh.
    training : materials that cover the box, its middle first.
    typical : evaluations are fastest at its densities.
    spaces : harmonic problems.
    highest_hz : highest measured frequency.
    workers : processes.
    plan : how fine.
    progress : counts the problems that are done.
    store : where bases are kept between runs; None to build them anew.
    step : the band is rounded up to a power of it.
    """
    box = material_box(
        training, model.mesh.regions, most=plan.cells, room_radius=plan.room_radius, folded=plan.folded
    )
    band = rounded_up(BAND * highest_hz, step)
    keys = [basis_key(model.mesh, space, box, band, plan.tolerance) for space in spaces]
    kept = {} if store is None else _kept(store, keys, spaces, box, band)
    # another process may want the same bases at the same time: in different orders, each finds what the other has built
    missing = np.random.default_rng().permutation([i for i in range(len(spaces)) if i not in kept]).tolist()
    # of all problems in any case: digits must not depend on what is kept already
    known = _common_snapshots(model, spaces, box, band, plan.common if missing else 0, workers)
    tasks = [
        (model, spaces[i], box, band, plan.tolerance, store, keys[i], tuple(cell[i] for cell in known))
        for i in missing
    ]
    if progress is not None and kept:
        progress(len(kept))
    built = workers.map(_reduce, tasks, progress=None if progress is None else _after(len(kept), progress))
    found = kept | dict(zip(missing, built, strict=True))
    problems = [found[i] for i in range(len(spaces))]
    return reduced_stator(model, box, problems, LOOK * highest_hz, typical)


def _kept(
    store: BasisStore, keys: Sequence[str], spaces: Sequence[Space], box: MaterialBox, highest_hz: float
) -> dict[int, ReducedHarmonic]:
    """Number → reduced harmonic of all that a store has."""
    read = [store.read(key, space, box, highest_hz) for key, space in zip(keys, spaces, strict=True)]
    return {i: found for i, found in enumerate(read) if found is not None}


def _after(count: int, progress: Progress) -> Progress:
    return lambda done: progress(count + done)


def _common_snapshots(
    model: AffineModel[PartMesh],
    spaces: Sequence[Space],
    box: MaterialBox,
    highest_hz: float,
    count: int,
    workers: Workers,
) -> list[tuple[Snapshots, ...]]:
    """Per cell and problem the modes at a few materials; nothing where a plan wants none."""
    if count == 0:
        return []
    tasks = [(model, spaces, cell, box.span.regions, highest_hz, count) for cell in box.training]
    return workers.map(_snapshots, tasks)


def _snapshots(task: SnapshotTask, _tick: Tick) -> tuple[Snapshots, ...]:
    return common_snapshots(*task)


def rounded_up(value: float, step: float) -> float:
    """To a power of `step`: machines of one kind share a basis."""
    return float(step ** np.ceil(np.log(value) / np.log(step)))


def _reduce(task: BasisTask, tick: Tick) -> ReducedHarmonic:
    model, space, box, highest_hz, tolerance, store, key, known = task
    reduced = None if store is None else store.read(key, space, box, highest_hz)
    if reduced is None:
        reduced = reduce_harmonic(model, space, box, highest_hz, tolerance, known=known)
        if store is not None:
            store.write(key, reduced)
    tick()
    return reduced

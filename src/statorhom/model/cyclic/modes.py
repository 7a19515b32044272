"""All modes of the symmetric stator's harmonics in a band; each problem's number of modes is known before it is solved.

A problem without any mode in the band costs its count alone; where the iteration has found fewer than were counted it
goes on. So no mode is missed, and none is looked for in vain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import repeat

import numpy as np

from statorhom.errors import SolverError
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.cyclic.condensed import Eliminated, condensed, counted, eliminated, modes_under
from statorhom.model.cyclic.half_pitch import HalfPitch, columns, phases
from statorhom.model.cyclic.lanczos import largest
from statorhom.model.eigen import SHIFT
from statorhom.model.harmonic import Harmonic
from statorhom.model.threads import Mapper, mapper

BATCH = 12  # problems that take their steps together: more would leave nothing for a second thread
STEP = 1e-4  # how far the counting moves up where the factorization at the band's end is not to be trusted
TRIALS = 5
LOWER = 0.5  # of λ: by how much the band's end goes down while a few of its modes are enough

Pairs = tuple[np.ndarray, np.ndarray]


def modes_of(
    pitches: Sequence[HalfPitch],
    spaces: Sequence[Harmonic],
    highest_hz: float,
    most: int | None = None,
    jobs: int = 1,
) -> list[Pairs]:
    """All eigenpairs of harmonic problems up to a frequency, rigid-body modes included.

    Parameters
    ----------
    pitches : K and M of every part of the mesh; K semidefinite, M definite.
    spaces : the problems.
    highest_hz : upper end of the band.
    most : lowest modes of each problem that are enough; None for all of the band.
    jobs : threads; solves and products leave the interpreter to the others. The result does not depend on it.

    Returns
    -------
    Per problem λ (k,) in rad²/s², ascending, and (m, k) coordinates y of unit mass yᵀ M y.

    Raises
    ------
    SolverError
        If a matrix cannot be factorized or the iteration does not converge.
    """
    top = (2 * np.pi * highest_hz) ** 2
    groups = []
    for pitch in pitches:
        mine = tuple(i for i, space in enumerate(spaces) if space.axial == pitch.part.axial)
        if mine:
            groups.append(_Group(pitch, mine, tuple(spaces[i] for i in mine)))
    # the limit holds for all threads: entered by each, one would lift another's
    with one_blas_thread(), mapper(jobs) as run:
        starts = _levels(run, groups, -SHIFT * top)
        top, ends = _band(run, groups, starts, top, most)
        batches = [
            batch for entry in zip(groups, starts, ends, strict=True) for batch in _batches(*entry, top, most)
        ]
        pairs = dict(pair for found in run(_Batch.solve, batches) for pair in found)
    nothing = [(np.empty(0), np.empty((space.size, 0))) for space in spaces]
    return [pairs.get(i, empty) for i, empty in enumerate(nothing)]


@dataclass(frozen=True, eq=False)
class _Group:
    """The problems of one part, and their numbers among all."""

    pitch: HalfPitch
    numbers: tuple[int, ...]
    spaces: tuple[Harmonic, ...]


@dataclass(frozen=True, eq=False)
class _Level:
    """Both families of a part's coordinates eliminated at a value of λ."""

    value: float
    real: Eliminated
    imaginary: Eliminated


@dataclass(frozen=True, eq=False)
class _End:
    """The band's end, and how many modes each problem of a part has below."""

    value: float
    counts: np.ndarray


def _levels(run: Mapper, groups: Sequence[_Group], value: float) -> list[_Level]:
    halves = [(group.pitch, family) for group in groups for family in (group.pitch.a, group.pitch.b)]
    done = list(run(lambda half: eliminated(half[0], half[1], value), halves))
    return [_Level(value, real, imaginary) for real, imaginary in zip(done[::2], done[1::2], strict=True)]


def _band(
    run: Mapper, groups: Sequence[_Group], starts: Sequence[_Level], top: float, most: int | None
) -> tuple[float, list[_End]]:
    """Upper end of the band (λ), lowered as long as every problem holds the modes that are enough."""
    ends = _counted(run, groups, starts, top)
    while most is not None and min(end.counts.min() for end in ends) > 2 * most:
        lower = _counted(run, groups, starts, LOWER * top)
        if min(end.counts.min() for end in lower) < most:
            break
        top, ends = LOWER * top, lower
    return top, ends


def _counted(run: Mapper, groups: Sequence[_Group], starts: Sequence[_Level], top: float) -> list[_End]:
    """Number of modes up to the band's end, or a little above where it cannot be told there."""
    halves = [
        (group.pitch, family, known.order)
        for group, start in zip(groups, starts, strict=True)
        for family, known in ((group.pitch.a, start.real), (group.pitch.b, start.imaginary))
    ]
    for trial in range(TRIALS):
        value = top * (1 + trial * STEP)
        done = list(run(counted, *zip(*halves, strict=True), repeat(value)))
        if all(one.negative is not None for one in done):
            counts = run(
                lambda entry: modes_under(phases(entry[0].pitch, entry[0].spaces), *entry[1:]),
                list(zip(groups, done[::2], done[1::2], strict=True)),
            )
            return [_End(value, count) for count in counts]
    raise SolverError("the modes of the band cannot be counted; check the materials")


@dataclass(frozen=True, eq=False)
class _Batch:
    """Problems that are solved together."""

    group: _Group
    chosen: np.ndarray
    start: _Level
    end: _End
    top: float
    most: int | None

    def solve(self) -> list[tuple[int, Pairs]]:
        """The pairs of every problem, with its number."""
        pitch, spaces = self.group.pitch, tuple(self.group.spaces[i] for i in self.chosen)
        problems = phases(pitch, spaces)
        shifted = condensed(pitch, problems, self.start.real, self.start.imaginary)
        # a fixed start: the same study gives the same digits
        begin = np.random.default_rng(0).standard_normal((sum(pitch.sizes), 1)) * problems.present
        shift = self.start.value
        solved = largest(shifted, begin, self.end.counts[self.chosen], 1 / (self.end.value - shift))
        pairs = []
        for i, space, (theta, vectors) in zip(self.chosen, spaces, solved, strict=True):
            values = shift + 1 / theta
            kept = np.flatnonzero(values <= self.top)[: self.most]
            pairs.append(
                (self.group.numbers[i], (values[kept], vectors[np.ix_(columns(pitch, space), kept)]))
            )
        return pairs


def _batches(group: _Group, start: _Level, end: _End, top: float, most: int | None) -> list[_Batch]:
    """The problems of a part that have modes; those with about as many stand together."""
    order = np.argsort(-end.counts, kind="stable")
    order = order[end.counts[order] > 0]
    cuts = range(BATCH, len(order), BATCH)
    return [_Batch(group, chosen, start, end, top, most) for chosen in np.split(order, cuts) if len(chosen)]

"""The symmetric stator's modes of all harmonics, as the basis in which its broken symmetry is solved.

Beside the modes a problem may hold further vectors (`statorhom.model.broken.enrich`); together they are Ritz vectors
of the symmetric stator.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.broken.grams import GramCache
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.problem_basis import ProblemBasis, solved_problems
from statorhom.model.broken.sector import Sector, surface_dofs
from statorhom.model.broken.surface_answers import SurfaceAnswers, surface_answers
from statorhom.model.broken.waves import Waves
from statorhom.model.cyclic.half_pitch import half_pitch
from statorhom.model.cyclic.problem import CyclicProblem, Shifted
from statorhom.model.cyclic.unit_loads import UnitLoads
from statorhom.model.eigen import SHIFT
from statorhom.model.harmonic import all_orders, spaces_of
from statorhom.model.kept import Kept
from statorhom.model.pitch_parts import pitch_parts

PLACES = 8  # of attachments, and sets of them, whose motions and responses are kept
MARGIN = 2.0  # modes reach this much higher than the band
OF_VECTORS = (
    "waves",
    "probes",
    "surface",
    "places",
    "values",
    "probed",
)  # what a basis knows of its vectors alone


@dataclass(frozen=True, eq=False)
class SymmetricBasis:
    """All problems of a symmetric stator.

    Parameters
    ----------
    mesh : of the half pitch.
    problems : of all harmonics.
    highest_hz : upper end of the band.
    cut_hz : all modes of the symmetric stator up to here are in the basis.
    shift : σ (rad²/s²).
    softest : pieces that may be softened, and the least weight (e,) of each.
    added : (coordinates,) what is added to the eigenvalues, K + M Φ diag(added) Φᵀ M; None for nothing.
    """

    mesh: HalfPitchMesh
    problems: tuple[ProblemBasis, ...]
    highest_hz: float
    cut_hz: float
    shift: float
    softest: tuple[tuple[Pieces, np.ndarray], ...] = ()
    added: np.ndarray | None = None
    grams: GramCache = field(default_factory=GramCache, repr=False, compare=False)
    motions: Kept = field(default_factory=partial(Kept, PLACES), init=False, repr=False, compare=False)
    statics: Kept = field(default_factory=partial(Kept, PLACES), init=False, repr=False, compare=False)

    @cached_property
    def waves(self) -> Waves:
        """Columns of the basis."""
        return self._waves([p.vectors for p in self.problems])

    @cached_property
    def probes(self) -> Waves:
        """Columns of the probes."""
        return self._waves([p.probes for p in self.problems])

    @cached_property
    def surface(self) -> SurfaceAnswers:
        """How all problems answer loads on the outer surface."""
        return surface_answers(self.problems, self.mesh.slots)

    @cached_property
    def values(self) -> np.ndarray:
        """Ritz values of all coordinates of the basis."""
        columns = np.concatenate([p.values for p in self.problems])
        return np.concatenate([columns[self.waves.cosine], columns[self.waves.sine]])

    @cached_property
    def probed(self) -> tuple[np.ndarray, np.ndarray]:
        """ζᵀKW and ζᵀMW between all coordinates of the probes and of the basis."""
        found = []
        for images in ([p.elastic for p in self.problems], [p.inertial for p in self.problems]):
            blocks = [p.probes.T @ image for p, image in zip(self.problems, images, strict=True)]
            columns = sp.block_diag(blocks, format="csr").toarray()
            cosine = columns[np.ix_(self.probes.cosine, self.waves.cosine)]
            sine = columns[np.ix_(self.probes.sine, self.waves.sine)]
            found.append(np.asarray(sp.block_diag([cosine, sine], format="csr").toarray()))
        return found[0], found[1]

    @cached_property
    def places(self) -> tuple[dict[bool, slice], ...]:
        """Per problem: family → where its columns stand among the coordinates."""
        start = {False: 0, True: len(self.waves.cosine)}
        found = []
        for problem in self.problems:
            place = {}
            for sine in problem.sector.families:
                place[sine] = slice(start[sine], start[sine] + len(problem.values))
                start[sine] = place[sine].stop
            found.append(place)
        return tuple(found)

    def with_values(self, factors: Mapping[int, float]) -> SymmetricBasis:
        """With the eigenvalues of some coordinates' modes multiplied by factors, as if K were that of a finer mesh."""
        added = np.zeros(len(self.values))
        for number, factor in factors.items():
            added[number] = (factor - 1.0) * self.values[number]
        found = replace(self, added=added)
        # the same vectors: their waves, and what was projected on them, serve both
        found.__dict__.update({name: self.__dict__[name] for name in OF_VECTORS if name in self.__dict__})
        return found

    def truncated(self, cut_hz: float) -> SymmetricBasis:
        """Only the vectors up to a frequency: for signatures, or for a coarser solution."""
        top = (2 * np.pi * cut_hz) ** 2
        problems = []
        for p in self.problems:
            count = int(np.count_nonzero(p.values <= top))
            problems.append(p.lowest(count))
        return replace(self, problems=tuple(problems), cut_hz=min(cut_hz, self.cut_hz), grams=GramCache())

    def _waves(self, vectors: list[np.ndarray]) -> Waves:
        counts = [v.shape[1] for v in vectors]
        numbers = np.split(np.arange(sum(counts)), np.cumsum(counts)[:-1])
        chosen = {
            sine: np.concatenate(
                [np.empty(0, int)]
                + [n for n, p in zip(numbers, self.problems, strict=True) if sine in p.sector.families]
            )
            for sine in (False, True)
        }
        shapes = [p.sector.space.expand(v) for p, v in zip(self.problems, vectors, strict=True)]
        order = np.repeat([p.sector.space.order for p in self.problems], counts)
        return Waves(np.hstack(shapes), order, chosen[False], chosen[True], self.mesh.slots)


def symmetric_basis(
    model: AffineModel,
    materials: Materials,
    highest_hz: float,
    *,
    margin: float = MARGIN,
    contact: sp.csr_array | None = None,
    certified: bool = True,
    jobs: int = 1,
) -> SymmetricBasis:
    """Modes of the symmetric stator in a band.

    Parameters
    ----------
    model : of the half pitch.
    materials : of every region of the model.
    highest_hz : upper end of the band in which the broken symmetry is to be solved.
    margin : the modes reach up to `margin` times `highest_hz`.
    contact : further stiffness of the half pitch (N/m), the same in all copies.
    certified : False leaves out what tells the errors of a solution; it cannot be enriched then.
    jobs : threads.

    Raises
    ------
    SolverError
        If a harmonic's problem cannot be solved.
    """
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    if contact is not None:
        K = sp.csr_array(K + contact)
    shift = SHIFT * (2 * np.pi * highest_hz) ** 2
    parts = pitch_parts(model.mesh)
    shifted = {part.axial: Shifted(half_pitch(part, K, M), shift) for part in parts}
    spaces = [s for order in all_orders(model.mesh.slots) for s in spaces_of(parts, order)]
    surface = surface_dofs(model.mesh)
    unit = {axial: UnitLoads(one, surface) for axial, one in shifted.items()}
    sectors = [Sector(CyclicProblem(s, shifted[s.axial]), unit[s.axial]) for s in spaces]
    problems = solved_problems(sectors, margin * highest_hz, certified=certified, jobs=jobs)
    return SymmetricBasis(model.mesh, problems, highest_hz, margin * highest_hz, shift)

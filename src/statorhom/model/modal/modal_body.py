"""A body with mirror planes in a basis of its modes at some materials; what is attached to it couples the parities."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp
from scipy.linalg import block_diag, eigh

from statorhom.errors import SolverError
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES
from statorhom.model.back_ends.sturdy import sturdy
from statorhom.model.convergence import ModeKey
from statorhom.model.eigen import Solve, lowest_modes, modes_below
from statorhom.model.modal.surface_motion import SurfaceMotion
from statorhom.model.problems import orders_of, spaces_of

FloatArray = npt.NDArray[np.float64]

WIDE = 2.5  # how far the reference's modes reach beyond the band: lumps and springs bend what lies in it
EXPECTED = 72  # modes that are asked for first
MOST = 120  # modes of the reference: local shapes of what is attached stand for the others
LEAST = 15  # of one combination of parities
STEPS = 2  # of the modes towards those of other materials
NEAR = 1.3  # and those of other materials, and where nothing is attached yet
INDEPENDENT = 1e-5  # relative length below which a vector adds nothing to the basis
RIGID = 1e-3  # of the band's end: rigid bodies' frequencies are rounding


@dataclass(frozen=True, eq=False)
class ModalBody:
    """Stiffness and mass of a body in a basis, linear in Hooke entries and densities.

    Parameters
    ----------
    mesh : of the part that the body is copied from.
    shapes : (3 n, k) the basis on the part; of unit mass in the whole body at the reference.
    parities : (k,) of every vector.
    stiffness : region → (9, k, k) per unit Hooke entry; (1, k, k) of one whose material is always the reference's.
    mass : region → (3, k, k) per unit density, of the motion along x, y, z.
    reference : (k, m) modes at the reference, rigid bodies first.
    reference_hz : (m,) their frequencies, 0 of rigid bodies.
    highest_hz : end of the band.
    """

    mesh: MirrorMesh
    shapes: FloatArray
    parities: npt.NDArray[np.int_]
    stiffness: Mapping[str, FloatArray]
    mass: Mapping[str, FloatArray]
    reference: FloatArray
    reference_hz: FloatArray
    highest_hz: float
    _motion: dict[bytes, FloatArray] = field(default_factory=dict, repr=False)

    @property
    def size(self) -> int:
        """k."""
        return len(self.parities)

    @property
    def rigid(self) -> int:
        """How many of the reference's modes are rigid bodies."""
        return int(np.count_nonzero(self.reference_hz == 0.0))

    @cached_property
    def keys(self) -> tuple[ModeKey | None, ...]:
        """Parity and rank of every mode of the reference; None of rigid bodies."""
        ranks: dict[int, int] = {}
        found: list[ModeKey | None] = []
        for parity, hz in zip(self._of_reference.tolist(), self.reference_hz.tolist(), strict=True):
            if hz == 0.0:
                found.append(None)
                continue
            ranks[parity] = ranks.get(parity, -1) + 1
            found.append((parity, 0, ranks[parity]))
        return tuple(found)

    @property
    def counts(self) -> dict[int, int]:
        """Parity → how many modes of the reference have it."""
        return dict(
            zip(*(a.tolist() for a in np.unique(self._of_reference, return_counts=True)), strict=True)
        )

    @cached_property
    def _of_reference(self) -> npt.NDArray[np.int_]:
        """Parity of every mode of the reference."""
        return self.parities[np.abs(self.reference).argmax(axis=0)]

    def yields_beside(self, other: ModalBody) -> float:
        """How much more the body yields than another of its mesh, as a mean of their elastic modes."""
        count = min(len(self.reference_hz), len(other.reference_hz))
        own, others = self.reference_hz[self.rigid : count], other.reference_hz[other.rigid : count]
        return float(np.exp(2.0 * np.mean(np.log(others / own))))

    @cached_property
    def surface(self) -> SurfaceMotion:
        """Motion of the basis on the surface."""
        return SurfaceMotion(self.mesh, self.shapes, self.parities)

    def motion(self, places: FloatArray) -> FloatArray:
        """Displacements (p, 3, k) of places (p, 3); kept, for the same ones are asked for again and again."""
        mark = places.tobytes()
        if mark not in self._motion:
            if len(self._motion) > 256:
                self._motion.clear()
            self._motion[mark] = self.surface.at(places)
        return self._motion[mark]

    def matrices(
        self, materials: Materials, scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    ) -> tuple[FloatArray, FloatArray]:
        """K and M (k, k).

        Parameters
        ----------
        materials : of every region, in the axes of the body.
        scale : by which the body is longer along x, y, z than its mesh. With displacements u_i = v_i / s_i every strain
            is ε_ij(u) = ε_ij(v) / (s_i s_j): the longer body is the mesh with other Hooke entries, exactly.
        """
        factors, inertia = hooke_factors(scale), mass_factors(scale)
        K, M = np.zeros((self.size, self.size)), np.zeros((self.size, self.size))
        for region, terms in self.stiffness.items():
            entries = factors * hooke_coefficients(materials[region].hooke) if len(terms) > 1 else np.ones(1)
            K += np.tensordot(entries, terms, axes=1)
        for region, terms in self.mass.items():
            M += np.tensordot(materials[region].density * inertia, terms, axes=1)
        return K, M


def hooke_factors(scale: tuple[float, float, float]) -> FloatArray:
    """What every Hooke entry is multiplied by where the body is longer than its mesh; see `ModalBody.matrices`."""
    x, y, z = scale
    # 11, 22, 33, 23, 13, 12
    strain = (x**2, y**2, z**2, y * z, x * z, x * y)
    return np.array([x * y * z / (strain[i] * strain[j]) for i, j in HOOKE_ENTRIES])


def mass_factors(scale: tuple[float, float, float]) -> FloatArray:
    """The same of the inertia along x, y, z."""
    return np.asarray(np.prod(scale) / np.square(scale))


def lowest_pairs(
    K: FloatArray, M: FloatArray, parities: npt.NDArray[np.int_], count: int
) -> tuple[FloatArray, FloatArray]:
    """The lowest eigenvalues (count,) and vectors (k, count) of unit mass.

    Parameters
    ----------
    K, M : (k, k); more coordinates than `parities` has may follow the basis.
    parities : of the basis: where they do not couple each is a small problem.

    Raises
    ------
    SolverError
        If the mass is not positive.
    """
    try:
        if len(K) > len(parities) or _couples(K, parities):
            values, vectors = eigh(K, M, subset_by_index=(0, min(count, len(K)) - 1))
            return values, vectors
        return _by_parity(K, M, parities, count)
    except np.linalg.LinAlgError:
        raise SolverError("the body's mass is not positive; check lumps and densities") from None


def _by_parity(
    K: FloatArray, M: FloatArray, parities: npt.NDArray[np.int_], count: int
) -> tuple[FloatArray, FloatArray]:
    values, vectors = np.empty(len(K)), np.zeros(K.shape)
    for parity in np.unique(parities):
        own = np.flatnonzero(parities == parity)
        square = np.ix_(own, own)
        values[own], vectors[square] = eigh(K[square], M[square])
    order = np.argsort(values)[:count]
    return values[order], vectors[:, order]


def _couples(matrix: FloatArray, parities: npt.NDArray[np.int_]) -> bool:
    return bool(np.any(matrix[parities[:, None] != parities[None, :]]))


def modal_body(
    model: AffineModel[MirrorMesh],
    snapshots: Sequence[Materials],
    highest_hz: float,
    varied: Collection[str] | None = None,
    counts: Mapping[int, int] | None = None,
    reach: float = WIDE,
) -> ModalBody:
    """A basis of the modes at some materials; the first ones are the reference.

    Parameters
    ----------
    model : of the part.
    snapshots : materials near which the basis shall be good.
    highest_hz : end of the band.
    varied : regions whose stiffness is not always the reference's; None for all.
    counts : parity → modes of the reference; None for all up to `reach`.
    reach : how far the reference's modes reach beyond the band.
    """
    orders = orders_of(model.mesh)
    known = counts or {}
    found = [_parity_basis(model, snapshots, highest_hz, order, known.get(order), reach) for order in orders]
    parities = np.repeat(orders, [vectors.shape[1] for vectors, _, _ in found])
    shapes = np.hstack([vectors for vectors, _, _ in found])
    reference = block_diag(*(own for _, own, _ in found))
    hz = np.concatenate([own_hz for _, _, own_hz in found])
    by_frequency = np.argsort(hz, kind="stable")
    stiffness, mass = _projected(
        model, shapes, parities, snapshots[0], model.stiffness if varied is None else varied
    )
    return ModalBody(
        model.mesh,
        shapes,
        parities,
        stiffness,
        mass,
        reference[:, by_frequency],
        hz[by_frequency],
        highest_hz,
    )


def _parity_basis(
    model: AffineModel[MirrorMesh],
    snapshots: Sequence[Materials],
    highest_hz: float,
    order: int,
    count: int | None,
    reach: float,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Vectors (3 n, k) of unit mass at the reference, the reference's modes (k, m) in them and their frequencies."""
    [space] = spaces_of(model.mesh, order)
    whole_mass = model.mass_matrix(snapshots[0])
    K, M = (space.project(m) for m in (model.stiffness_matrix(snapshots[0]), whole_mass))
    solvers: list[Solve] = []

    def back_end(matrix: sp.csr_array) -> Solve:
        solvers.append(sturdy(matrix))
        return solvers[-1]

    if count is not None:
        values, y = lowest_modes(K, M, count, highest_hz, back_end)
    else:
        asked, most = (max(LEAST, n // model.mesh.copies) for n in (EXPECTED, MOST))
        expected = max(LEAST, round(asked * reach / WIDE))
        values, y = modes_below(K, M, reach * highest_hz, expected, most, back_end=back_end)
    hz = np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi)
    hz[hz < RIGID * highest_hz] = 0.0
    moved = y[:, (hz > 0.0) & (hz < NEAR * highest_hz)]
    basis = space.expand(y) / np.sqrt(space.copies)
    for materials in snapshots[1:]:
        for vectors in _bent(solvers[-1], space.project(model.stiffness_matrix(materials)), M, moved):
            basis = _extended(basis, space.expand(vectors), model.mesh.copies * whole_mass)
    return basis, np.eye(basis.shape[1])[:, : y.shape[1]], hz


def _bent(solve: Solve, K: sp.csr_array, M: sp.csr_array, modes: FloatArray) -> Iterator[FloatArray]:
    """What another stiffness makes of modes, step by step: forces that bend it so bend the reference otherwise.

    Exact to the order of the difference that is the number of steps, and without a factorization for every stiffness.
    """
    for _ in range(STEPS if modes.size else 0):
        modes = solve(K @ modes)
        modes = modes / np.sqrt(np.einsum("ij,ij->j", modes, M @ modes))
        yield modes


def _extended(basis: FloatArray, vectors: FloatArray, M: sp.csr_array) -> FloatArray:
    """The basis with what other vectors add, of unit mass."""
    rest = vectors
    for _ in range(2):
        rest = rest - basis @ (basis.T @ (M @ rest))
    lengths, turn = np.linalg.eigh(rest.T @ (M @ rest))
    kept = lengths > INDEPENDENT**2
    return np.hstack([basis, (rest @ turn[:, kept]) / np.sqrt(lengths[kept])])


def _projected(
    model: AffineModel[MirrorMesh],
    shapes: FloatArray,
    parities: npt.NDArray[np.int_],
    reference: Materials,
    varied: Collection[str],
) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
    """Terms of stiffness and mass of the whole body; different parities do not couple."""
    groups = [np.flatnonzero(parities == parity) for parity in np.unique(parities)]
    copies = model.mesh.copies
    stiffness, mass = {}, {}
    for region in model.stiffness:
        if region in varied:
            parts = (model.stiffness_term(region, q) for q in range(len(HOOKE_ENTRIES)))
        else:
            parts = (K for K in [model.region_stiffness(region, reference[region])])
        stiffness[region] = copies * np.stack([_between(groups, _own_places(K), shapes) for K in parts])
    for region in model.mass:
        # the same along all axes
        M = _own_places(sp.csr_array(model.mass_term(region)[::3, ::3]))
        mass[region] = copies * np.stack([_between(groups, M, shapes[axis::3]) for axis in range(3)])
    return stiffness, mass


def _own_places(matrix: sp.csr_array) -> sp.csr_array:
    """A region's matrix without the places that other regions have in the body's."""
    matrix.eliminate_zeros()
    return matrix


def _between(groups: Sequence[npt.NDArray[np.int_]], matrix: sp.csr_array, shapes: FloatArray) -> FloatArray:
    """A matrix between shapes (k, k), 0 between those of different groups."""
    found = np.zeros((shapes.shape[1], shapes.shape[1]))
    for own in groups:
        vectors = np.ascontiguousarray(shapes[:, own])
        found[np.ix_(own, own)] = vectors.T @ (matrix @ vectors)
    return found

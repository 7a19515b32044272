"""All modes of the free stator in a band from its reduced harmonics, each with its certificate, in milliseconds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.local_basis import LocalBasis, norm_shift
from statorhom.model.material_cells import stiffness_ratio
from statorhom.model.material_span import MaterialPoint, material_point
from statorhom.model.problems import profile_of
from statorhom.model.radial_profile import node_planes
from statorhom.model.reduced import MaterialBox, ReducedHarmonic
from statorhom.model.reduced_batch import BatchPairs, ReducedBatch, certificates, reduced_batches
from statorhom.model.space import MIRROR
from statorhom.model.stator_mode import StatorMode, modes_of_parities, name_modes

UNIT_DENSITY = 1e-12  # relative: densities that count as the typical ones


@dataclass(frozen=True)
class ProblemKinds:
    """What of the harmonic problems their modes' names need.

    Parameters
    ----------
    orders, multiplicities, copies : (problems,) of each.
    mirrored : a body with mirror planes, whose orders are numbers of combinations of parities.
    """

    orders: np.ndarray
    multiplicities: np.ndarray
    copies: np.ndarray
    mirrored: bool

    def __len__(self) -> int:
        return len(self.orders)


@dataclass(frozen=True)
class ReducedStator:
    """Reduced harmonics, arranged for evaluation.

    Parameters
    ----------
    box : materials that it was made for.
    kinds : of the problems.
    batches : per cell and room the problems side by side.
    densities : at which the bases have unit mass.
    volumes : region → volume (m³).
    highest_hz : upper end of the band that is evaluated.
    certified_hz : upper end of the band that the bases were made for.
    error : largest certified relative frequency error at the training materials.
    """

    box: MaterialBox
    kinds: ProblemKinds
    batches: tuple[tuple[tuple[ReducedBatch, ...], ...], ...]
    densities: np.ndarray
    volumes: Mapping[str, float]
    highest_hz: float
    certified_hz: float
    error: float

    def solve(self, materials: Materials) -> ReducedModes:
        """Modes in the band.

        Raises
        ------
        SolverError
            If a material is of another symmetry than those that the bases were made for.
        """
        point = material_point(materials, self.box.span.regions)
        cell, room = self.box.locate(point)
        weights = self.box.span.weights(point)
        unit = bool(np.all(np.abs(point.density / self.densities - 1.0) < UNIT_DENSITY))
        top = (2 * np.pi * self.highest_hz) ** 2
        with one_blas_thread():
            pairs = tuple(
                batch.pairs(weights, point.density, top, unit_mass=unit) for batch in self.batches[cell][room]
            )
        mass = sum(materials[region].density * volume for region, volume in self.volumes.items())
        return ReducedModes(self, point, cell, room, weights, mass, pairs)


@dataclass(frozen=True)
class ReducedModes:
    """Modes of one evaluation.

    Parameters
    ----------
    stator : the reduced stator.
    point, cell, room, weights : materials, their cell, their room there and their weights in the span.
    mass : of the stator (kg).
    pairs : Ritz pairs of every batch.
    """

    stator: ReducedStator
    point: MaterialPoint
    cell: int
    room: int
    weights: np.ndarray
    mass: float
    pairs: tuple[BatchPairs, ...]

    @property
    def batches(self) -> tuple[ReducedBatch, ...]:
        """The problems, in the order of `pairs`."""
        return self.stator.batches[self.cell][self.room]

    @cached_property
    def modes(self) -> tuple[StatorMode, ...]:
        """Named modes sorted by frequency, rigid bodies left out."""
        columns = [self._in_band(batch, pairs) for batch, pairs in zip(self.batches, self.pairs, strict=True)]
        values, amplitudes, problems, places = (
            np.concatenate([part[i] for part in columns], axis=-1) for i in range(4)
        )
        kinds = self.stator.kinds
        of_unit_mass = amplitudes / np.sqrt(kinds.copies[problems])
        orders = kinds.orders[problems].tolist()
        known = {"mass": self.mass, "problem": problems.tolist(), "column": places.tolist()}
        if kinds.mirrored:
            found = modes_of_parities(values, of_unit_mass, parities=orders, **known)
        else:
            multiplicity = kinds.multiplicities[problems].tolist()
            nodes = node_planes(amplitudes)
            found = name_modes(values, of_unit_mass, nodes, order=orders, multiplicity=multiplicity, **known)
        return tuple(sorted(found, key=lambda mode: mode.frequency_hz))

    @staticmethod
    def _in_band(
        batch: ReducedBatch, pairs: BatchPairs
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Eigenvalues (j,), amplitudes (planes, j), problems (j,) and columns (j,) of a batch's modes."""
        row, column = np.nonzero(pairs.values <= pairs.top)
        amplitudes = np.matmul(batch.profiles[row], pairs.vectors[row, :, column, None])[..., 0].T
        return pairs.values[row, column], amplitudes, batch.problems[row], column

    @cached_property
    def certificates(self) -> tuple[np.ndarray, ...]:
        """Per batch the bounds of the relative frequency errors (b, j); see `reduced_batch.certificates`."""
        reference = self.stator.box.training[self.cell][0]
        ratio = stiffness_ratio(self.point, reference)
        shift = norm_shift(self.stator.certified_hz)
        with one_blas_thread():
            squared = [
                batch.squared_residuals(pairs, self.weights, self.point.density, ratio, shift)
                for batch, pairs in zip(self.batches, self.pairs, strict=True)
            ]
        return certificates(self.pairs, squared, shift)

    def certified_error(self, mode: StatorMode) -> float:
        """By how much at most a mode's frequency lies above the full model's, relative."""
        batch, row = self._place(mode)
        return float(self.certificates[batch][row, mode.column])

    @cached_property
    def largest_certified_error(self) -> float:
        """Over all modes of the band, as far as bases were made for it."""
        top = (2 * np.pi * min(self.stator.certified_hz, self.stator.highest_hz)) ** 2
        return max(
            (
                float(bounds[pairs.values <= top].max(initial=0.0))
                for bounds, pairs in zip(self.certificates, self.pairs, strict=True)
            ),
            default=0.0,
        )

    def log_frequency_gradient(self, mode: StatorMode) -> dict[str, tuple[np.ndarray, float]]:
        """Region → derivative of ln f with respect to its nine Hooke entries and its density.

        ∂λ/∂p = qᵀ(∂K/∂p - λ ∂M/∂p)q. The two modes of a doublet share one eigenvalue and lie in one problem as
        a single vector: nothing is ambiguous.
        """
        number, row = self._place(mode)
        batch, pairs = self.batches[number], self.pairs[number]
        q, value = pairs.vectors[row, :, mode.column], pairs.values[row, mode.column]
        shape = (-1, *batch.padding.shape)
        stiffness = batch.stiffness.reshape(shape)[:, row] @ q @ q
        mass = batch.mass.reshape(shape)[:, row] @ q @ q
        hooke = self.stator.box.span.hooke_gradients(0.5 / value * stiffness)
        return {
            region: (hooke[region], -0.5 * float(m))
            for region, m in zip(self.stator.box.span.regions, mass, strict=True)
        }

    def _place(self, mode: StatorMode) -> tuple[int, int]:
        for number, batch in enumerate(self.batches):
            rows = np.flatnonzero(batch.problems == mode.problem)
            if len(rows):
                return number, int(rows[0])
        raise IndexError(mode.problem)


def reduced_stator(
    model: AffineModel[PartMesh],
    box: MaterialBox,
    problems: Sequence[ReducedHarmonic],
    highest_hz: float,
    typical: Materials,
) -> ReducedStator:
    """Arrange reduced harmonics for evaluation up to a frequency, fastest at the densities of `typical`."""
    densities = material_point(typical, box.span.regions).density
    profile = profile_of(model.mesh)
    batches = []
    for cell, rooms in enumerate(box.rooms):
        bases = [p.cells[cell] for p in problems]
        seen = [
            profile.orders(p.harmonic, p.harmonic.expand(b.basis))
            for p, b in zip(problems, bases, strict=True)
        ]
        batches.append(
            tuple(_room_batches(bases, seen, room, densities) for room in range(len(rooms.members)))
        )
    harmonics = [p.harmonic for p in problems]
    kinds = ProblemKinds(
        np.array([h.order for h in harmonics]),
        np.array([h.multiplicity for h in harmonics]),
        np.array([h.copies for h in harmonics]),
        any(h.parity == MIRROR for h in harmonics),
    )
    certified = min((p.highest_hz for p in problems), default=highest_hz)
    error = max((p.error for p in problems), default=0.0)
    return ReducedStator(
        box, kinds, tuple(batches), densities, dict(model.volumes), highest_hz, certified, error
    )


def _room_batches(
    bases: Sequence[LocalBasis], profiles: Sequence[np.ndarray], room: int, densities: np.ndarray
) -> tuple[ReducedBatch, ...]:
    rooms = [basis.rooms[room] for basis in bases]
    return reduced_batches(rooms, [p @ r.turn for p, r in zip(profiles, rooms, strict=True)], densities)

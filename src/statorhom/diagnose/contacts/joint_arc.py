"""A contact that is weaker over an arc: what that does to the modes of the even one.

It couples the harmonics of one axial parity. An arc around θ = 0 is its own mirror image, which keeps cosine and sine
shapes apart. All faces of a half pitch weaken alike.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.linalg import eigh

from statorhom.diagnose.bases.ring_basis import RingBasis, RingModes
from statorhom.diagnose.contacts.arc_slopes import KnownSlope, Slope, mean_slope
from statorhom.diagnose.contacts.joint_contact import WavesContact
from statorhom.errors import SolverError
from statorhom.model.affine import Materials
from statorhom.model.broken.cells import Sectors
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.waves import Waves
from statorhom.model.stator_mode import StatorMode
from statorhom.physics.action import Joint

LEAST = 0.2  # share of a mode of the even contact that a mode of the weakened one must keep to bear its name
REACH = 1.3  # λ of the highest mode that is sought over that of the band's end


@dataclass(frozen=True, eq=False)
class Family:
    """Cosine or sine shapes of a weakened contact.

    Parameters
    ----------
    even : modes of the even one.
    starts : problem → where its coordinates begin.
    values : (m,) λ, up to somewhat above the band.
    coordinates : (n, m) in the even contact's.
    """

    even: RingModes
    starts: dict[int, int]
    values: np.ndarray
    coordinates: np.ndarray

    def of(self, mode: StatorMode) -> int | None:
        """Number of the mode that is most of a mode of the even contact."""
        weight = self.coordinates[self.starts[mode.problem] + mode.column] ** 2
        if len(weight) == 0:
            return None
        best = int(np.argmax(weight))
        return best if weight[best] >= LEAST and self.values[best] > 0 else None

    def slope(self, number: int, materials: Materials) -> Slope:
        """d ln f of a mode by the materials."""
        total = np.zeros(10 * len(materials))
        for problem, start in self.starts.items():
            vectors = self.even.vectors[problem]
            x = vectors @ self.coordinates[start : start + vectors.shape[1], number]
            total += self.even.problems[problem].slope(x, float(self.values[number]), materials)
        return KnownSlope(total)


@dataclass(frozen=True, eq=False)
class JoinedMode:
    """A named mode of a step with a joint.

    Parameters
    ----------
    mode : with the contact the same all around.
    log_f : ln of the frequency (Hz) of the doublet's mean λ.
    split : complex relative split of λ.
    slope : d ln f by the materials.
    """

    mode: StatorMode
    log_f: float
    split: complex
    slope: Slope


@dataclass(frozen=True, eq=False)
class Weakened:
    """All modes of one axial parity: cosine and sine shapes."""

    families: tuple[Family, ...]

    def response(self, members: Sequence[int], materials: Materials) -> tuple[float, complex, Slope]:
        """ln f of the mean λ, relative split, and d ln f by the materials, of a mode of the even contact.

        Parameters
        ----------
        members : the modes that it is most of, family by family.
        """
        parts = list(zip(self.families, members, strict=False))
        values = [float(family.values[i]) for family, i in parts]
        mean = float(np.mean(values))
        split = complex((values[0] - values[1]) / mean) if len(values) == 2 else 0j
        slopes = [
            (value / mean, family.slope(i, materials))
            for value, (family, i) in zip(values, parts, strict=True)
        ]
        return 0.5 * float(np.log(mean)) - float(np.log(2 * np.pi)), split, mean_slope(slopes)

    def members(self, mode: StatorMode) -> list[int | None]:
        """Of each family that a mode of the even contact has a shape in, the number of the mode that is most of it."""
        return [family.of(mode) for family in self.families[: mode.multiplicity]]


@dataclass(frozen=True, eq=False)
class ArcGroup:
    """Problems that an arc couples.

    Parameters
    ----------
    numbers : of the problems.
    cosine, sine : those of them with cosine and with sine shapes.
    contact : between their bases.
    highest_hz : end of the band.
    """

    numbers: tuple[int, ...]
    cosine: tuple[int, ...]
    sine: tuple[int, ...]
    contact: WavesContact
    highest_hz: float
    _last: dict[str, tuple[RingModes, Joint, Weakened]] = field(default_factory=dict, repr=False)

    @property
    def slots(self) -> int:
        """N."""
        return self.contact.waves.slots

    def weakened(self, even: RingModes, joint: Joint) -> Weakened:
        """Modes with a weaker arc around θ = 0; the last ones are kept.

        Raises
        ------
        SolverError
            If the eigenvalues cannot be found.
        """
        known = self._last.get("last")
        if known is None or known[0] is not even or known[1] != joint:
            known = (even, joint, self._solved(even, joint))
            self._last["last"] = known
        return known[2]

    def _solved(self, even: RingModes, joint: Joint) -> Weakened:
        blocks = self.contact.change(joint, arc_change(joint, self.slots))
        top = REACH * (2 * np.pi * self.highest_hz) ** 2
        families = zip((self.cosine, self.sine), blocks, strict=True)
        return Weakened(tuple(_family(even, numbers, block, top) for numbers, block in families))


def arc_change(joint: Joint, slots: int) -> np.ndarray:
    """(2 N,) relative change of every half pitch's contact by an arc of the joint's width around θ = 0.

    At the arc's ends the contact falls geometrically with the share of the half pitch that is covered: in proportion,
    all but a thousandth would hold nearly as well as all of it, and an arc's width would be told in whole walls.
    """
    assert joint.arc is not None
    half = Sectors(np.array([[0.0, np.pi / slots]]), slots)
    share = half.share_of_arc(-0.5 * joint.arc[1], 0.5 * joint.arc[1])[0]
    return np.asarray(joint.ratio**share - 1.0)


def _family(even: RingModes, numbers: tuple[int, ...], change: np.ndarray, top: float) -> Family:
    vectors = [even.vectors[n] for n in numbers]
    K = _between(vectors, change)
    K[np.diag_indices_from(K)] += np.concatenate([even.values[n] for n in numbers])
    try:
        values, x = eigh((K + K.T) / 2, subset_by_value=(-np.inf, top))
    except np.linalg.LinAlgError:
        raise SolverError("a weakened contact has no modes; check its stiffness") from None
    starts, first = {}, 0
    for n in numbers:
        starts[n] = first
        first += len(even.values[n])
    return Family(even, starts, values, x)


def _between(vectors: Sequence[np.ndarray], matrix: np.ndarray) -> np.ndarray:
    """A matrix between the vectors (k, j) of all problems, one after the other: each knows its own rows alone."""
    ends = np.cumsum([len(v) for v in vectors])[:-1]
    rows = np.vstack([v.T @ part for v, part in zip(vectors, np.split(matrix, ends), strict=True)])
    return np.hstack([part @ v for v, part in zip(vectors, np.split(rows, ends, axis=1), strict=True)])


def arc_groups(ring: RingBasis, pieces: tuple[Pieces, Pieces]) -> Iterator[ArcGroup]:
    """The problems of each axial parity, and the contact between them (`WavesContact`).

    Their waves and pieces know the displacements alone that the contact acts on. One group after the other: what it
    keeps takes a gigabyte where bases are large.
    """
    dofs, local = where_they_touch(pieces)
    for axial in dict.fromkeys(p.space.axial for p in ring.problems):
        numbers = [n for n, p in enumerate(ring.problems) if p.space.axial == axial]
        own = [ring.problems[n] for n in numbers]
        order, odd, even = (
            np.concatenate([np.full(p.basis.shape[1], value(p.space)) for p in own])
            for value in (lambda s: s.order, lambda s: s.parity == "odd", lambda s: s.parity == "even")
        )
        waves = Waves(
            np.hstack([p.space.at(dofs).expand(p.basis) for p in own]),
            order,
            np.flatnonzero(~odd),
            np.flatnonzero(~even),
            ring.model.mesh.slots,
        )
        cosine = tuple(n for n in numbers if ring.problems[n].space.parity != "odd")
        sine = tuple(n for n in numbers if ring.problems[n].space.parity != "even")
        contact = WavesContact(waves, local)
        yield ArcGroup(tuple(numbers), cosine, sine, contact, ring.highest_hz)


def where_they_touch(pieces: tuple[Pieces, Pieces]) -> tuple[np.ndarray, tuple[Pieces, Pieces]]:
    """Displacements (d,) that a contact acts on, both ways the same, and its pieces between these alone."""
    dofs, normal = pieces[0].alone()
    return dofs, (normal, replace(normal, matrices=pieces[1].matrices))

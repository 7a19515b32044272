"""The independent eigenvalue problems of a body: by its mesh, harmonics of a stator or parities of a block."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import singledispatch
from typing import cast

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh, PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.mesh.wing import WingMesh
from statorhom.model.back_ends.sturdy import sturdy
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.cyclic.half_pitch import half_pitches
from statorhom.model.cyclic.modes import modes_of
from statorhom.model.eigen import modes_below
from statorhom.model.harmonic import all_orders, harmonic_spaces
from statorhom.model.harmonic import spaces_of as harmonics_of
from statorhom.model.mirror_space import mirror_space
from statorhom.model.normal_motion import normal_motion, upward_motion
from statorhom.model.pitch_parts import pitch_parts
from statorhom.model.radial_profile import radial_profile
from statorhom.model.space import Profile, Space
from statorhom.model.threads import mapper

Eigenpairs = tuple[Space, np.ndarray, np.ndarray]  # a problem, its λ (k,) and coordinates (m, k) of unit mass
# modes of a body that are asked for first, and of one combination of parities
EXPECTED, LEAST = 24, 8


@singledispatch
def spaces_of(mesh: PartMesh, order: int) -> Sequence[Space]:
    """The problems of a number."""
    raise TypeError(f"{type(mesh).__name__} has no problem {order}")


@singledispatch
def orders_of(mesh: PartMesh) -> Sequence[int]:
    """The numbers of all problems."""
    raise TypeError(type(mesh))


@singledispatch
def profile_of(mesh: PartMesh) -> Profile:
    """What accelerometers see."""
    raise TypeError(type(mesh))


@singledispatch
def eigenpairs_of(
    mesh: PartMesh,
    K: sp.csr_array,
    M: sp.csr_array,
    highest_hz: float,
    orders: Iterable[int],
    most: int | None = None,
    jobs: int = 1,
) -> list[Eigenpairs]:
    """All eigenpairs of the problems of some numbers, or the `most` lowest ones of each.

    Parameters
    ----------
    mesh, K, M : of the part that the body is copied from.
    highest_hz : upper end of the band.
    orders : numbers of the problems.
    most : lowest modes of each problem that are enough; None for all of the band.
    jobs : threads.
    """
    raise TypeError(type(mesh))


@spaces_of.register
def _(mesh: HalfPitchMesh, order: int) -> Sequence[Space]:
    return harmonic_spaces(mesh, order)


@orders_of.register
def _(mesh: HalfPitchMesh) -> Sequence[int]:
    return all_orders(mesh.slots)


@profile_of.register
def _(mesh: HalfPitchMesh) -> Profile:
    return cast(Profile, radial_profile(mesh))  # the problems of a half pitch are harmonics


@spaces_of.register
def _(mesh: MirrorMesh, order: int) -> Sequence[Space]:
    return (mirror_space(mesh, order),)


@orders_of.register
def _(mesh: MirrorMesh) -> Sequence[int]:
    return range(mesh.copies)


@profile_of.register
def _(mesh: MirrorMesh) -> Profile:
    return normal_motion(mesh)


@profile_of.register
def _(mesh: WingMesh) -> Profile:
    return upward_motion(mesh)


@eigenpairs_of.register
def _(
    mesh: HalfPitchMesh,
    K: sp.csr_array,
    M: sp.csr_array,
    highest_hz: float,
    orders: Iterable[int],
    most: int | None = None,
    jobs: int = 1,
) -> list[Eigenpairs]:
    parts = pitch_parts(mesh)
    spaces = [space for order in orders for space in harmonics_of(parts, order)]
    pairs = modes_of(half_pitches(parts, K, M), spaces, highest_hz, most, jobs)
    return [(space, *pair) for space, pair in zip(spaces, pairs, strict=True)]


@eigenpairs_of.register
def _(
    mesh: MirrorMesh,
    K: sp.csr_array,
    M: sp.csr_array,
    highest_hz: float,
    orders: Iterable[int],
    most: int | None = None,
    jobs: int = 1,
) -> list[Eigenpairs]:
    def solved(space: Space) -> Eigenpairs:
        K_p, M_p = space.project(K), space.project(M)
        # what supernodes are made for: a block's matrices are larger and fuller than a half pitch's
        return (space, *modes_below(K_p, M_p, highest_hz, expected, most, back_end=sturdy))

    expected = max(LEAST, EXPECTED // mesh.copies)
    if most is not None and most <= 2 * expected:
        expected = most  # beginning anew costs more than some modes too many
    spaces = [space for order in orders for space in spaces_of(mesh, order)]
    # the limit holds for all threads: entered by each, one would lift another's
    with one_blas_thread(), mapper(jobs) as run:
        return list(run(solved, spaces))

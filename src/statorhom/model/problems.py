"""The independent eigenvalue problems of a body: by its mesh, harmonics of a stator or parities of a block."""

from __future__ import annotations

from collections.abc import Sequence
from functools import singledispatch

from statorhom.mesh.hex_mesh import HalfPitchMesh, PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.harmonic import all_orders, harmonic_spaces
from statorhom.model.mirror_space import mirror_space
from statorhom.model.normal_motion import normal_motion
from statorhom.model.radial_profile import radial_profile
from statorhom.model.space import Profile, Space


@singledispatch
def spaces_of(mesh: PartMesh, order: int) -> Sequence[Space]:
    """The problems of a number."""
    raise TypeError(type(mesh))


@singledispatch
def orders_of(mesh: PartMesh) -> Sequence[int]:
    """The numbers of all problems."""
    raise TypeError(type(mesh))


@singledispatch
def profile_of(mesh: PartMesh) -> Profile:
    """What accelerometers see."""
    raise TypeError(type(mesh))


@spaces_of.register
def _(mesh: HalfPitchMesh, order: int) -> Sequence[Space]:
    return harmonic_spaces(mesh, order)


@orders_of.register
def _(mesh: HalfPitchMesh) -> Sequence[int]:
    return all_orders(mesh.slots)


@profile_of.register
def _(mesh: HalfPitchMesh) -> Profile:
    return radial_profile(mesh)


@spaces_of.register
def _(mesh: MirrorMesh, order: int) -> Sequence[Space]:
    return (mirror_space(mesh, order),)


@orders_of.register
def _(mesh: MirrorMesh) -> Sequence[int]:
    return range(mesh.copies)


@profile_of.register
def _(mesh: MirrorMesh) -> Profile:
    return normal_motion(mesh)

"""What kind of motion a combination of parities is: bending, torsion and the like, for a straight block."""

from __future__ import annotations

from statorhom.mesh.mirror_mesh import MirrorMesh

# a beam with planes of symmetry across y and z: (odd at y, odd at z) → what its sections do
_BEAM = {
    (False, False): "axial",
    (True, False): "bending along y",
    (False, True): "bending along z",
    (True, True): "torsion about x",
}
_ACROSS, _THROUGH = 1, 2  # bits of the planes across y and z
PLATE = "plate"


def mirror_kind(mesh: MirrorMesh, parities: int) -> str:
    """Kind of motion of a free plate or beam; empty where too few planes of symmetry tell it.

    An image's normal component is turned round, so that what is odd at the middle plane of a plate moves out of it.

    Parameters
    ----------
    mesh : of a block, its region named after what it is.
    parities : bit i is set where the motion is odd at plane i.
    """
    if len(mesh.mirrors) < 3:
        return ""
    across, through = bool(parities >> _ACROSS & 1), bool(parities >> _THROUGH & 1)
    if mesh.regions[0] == PLATE:
        return "bending" if through else "in plane"
    return _BEAM[across, through]

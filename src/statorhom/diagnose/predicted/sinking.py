"""How far a held line sinks into a stator, which the mesh and the form of a clamp leave open.

Displacements next to a loaded line grow with the logarithm of how near they are: a line has no stiffness of its own,
its width and the mesh's have. What is pressed radially or dragged along the circumference sinks in by the moduli of
the sheets; what is dragged along the axis by the shear modulus between them, which is a fiftieth of theirs in a loose
stack.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.materials.hooke import Hooke
from statorhom.model.affine import hooke_coefficients
from statorhom.model.broken.change import Attachment
from statorhom.model.broken.solve import BrokenModes
from statorhom.study.supports import FaceSupport, SupportKeys

METAL_PA = 2e11  # modulus that a line is pressed into, here and below to within a factor that does not matter
# standard deviation of what is left open, of a force per metre over a modulus: for all modes alike, but for a part
SINKING, UNLIKE = 0.3, 0.3
AXIAL = 2.0  # an isotropic metal's modulus over its shear modulus, nearly


def sinking(keys: SupportKeys, held: np.ndarray, core: Hooke) -> np.ndarray:
    """By how much frequencies fall, relatively, where lines sink in by a standard deviation more; none for faces.

    Parameters
    ----------
    keys : the support, with its stiffness.
    held : (2, modes) share of the springs in a mode's potential energy, across the axis and along it.
    core : Hooke's matrix of what the lines are pressed into, in its cylindrical axes.
    """
    if isinstance(keys, FaceSupport):
        return np.zeros(held.shape[1])
    assert keys.normal_stiffness_n_per_m2 is not None
    stiffness = keys.normal_stiffness_n_per_m2 * np.array([1.0, keys.tangential_ratio])
    return np.asarray(SINKING * 0.5 * (stiffness / _moduli(core)) @ held)


def _moduli(core: Hooke) -> np.ndarray:
    """(2,) of what a line sinks into across the axis and along it (Pa)."""
    tz, rz = hooke_coefficients(core)[6:8]
    return np.array([METAL_PA, min(METAL_PA, AXIAL * np.sqrt(tz * rz))])


def held_shares(modes: BrokenModes, attached: Sequence[Attachment]) -> np.ndarray:
    """(2, modes) share of springs to the ground in the potential energy of every mode, across the axis and along it.

    Parameters
    ----------
    modes : with what is attached.
    attached : the springs first.
    """
    stiffness = attached[0].stiffness
    motion = _motion(modes, attached)
    energy = (motion * (stiffness @ motion)).reshape(len(attached[0].points), 3, -1).sum(axis=0)
    parts = np.array([energy[0] + energy[1], energy[2]])
    return np.asarray(np.clip(parts / modes.eigenvalues, 0.0, 1.0))


def _motion(modes: BrokenModes, attached: Sequence[Attachment]) -> np.ndarray:
    """(m, modes) of the springs' points, for which modes were coupled unless nothing holds some of them."""
    held, coupled = attached[0], modes.coupled.statics
    if len(coupled) == sum(len(a.stiffness) for a in attached):
        return np.asarray((coupled.answers.motion @ modes.coordinates)[: len(held.stiffness)])
    return modes.motion(held.points).reshape(len(held.stiffness), -1)

"""How a stiffness that varies around the core splits each doublet: not all modes of an order alike.

The wave cos 2rθ of the core's stiffness splits the doublets of order r. Where a mode bends the core most the
strain energy stands at the antinodes, where it shears the sheets between them: such modes split the other way round.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.diagnose.bases.ring_basis import RingModes
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.convergence import ModeKey
from statorhom.model.stator_mode import StatorMode
from statorhom.study.regions import core_region


def scatter_weights(
    model: AffineModel, materials: Materials, solved: RingModes, named: Mapping[ModeKey, StatorMode]
) -> dict[ModeKey, float]:
    """Relative split of λ per relative amplitude of the wave 2r, cosine mode minus sine mode; doublets alone.

    First order: z_cc - z_ss over λ. A half pitch's complex shape U, of the phase e^{irθ}, has the mean strain energy
    UᴴKU; the part that turns with e^{2irθ} is Re UᵀKU, which the wave picks out. A wave that is constant over each
    pitch stands for it, larger by the mean of cos 2rθ over one.

    Parameters
    ----------
    model : of the mesh.
    materials : that the modes were solved with.
    solved : the modes.
    named : of them.
    """
    region = core_region(model.mesh.regions)
    core, mass = model.region_stiffness(region, materials[region]), model.mass_matrix(materials)
    slots = model.mesh.slots
    found = {}
    for key, mode in named.items():
        problem = solved.problems[mode.problem]
        if mode.multiplicity != 2 or mode.order != problem.space.order:
            continue
        shape = problem.space.expand(problem.basis @ solved.vectors[mode.problem][:, mode.column])
        energy = (2 * np.pi * mode.frequency_hz) ** 2 * float((shape.conj() @ (mass @ shape)).real)
        turning = float((shape @ (core @ shape)).real)
        found[key] = turning / energy / float(np.sinc(2 * mode.order / slots))
    return found

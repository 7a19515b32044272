"""CalculiX's own cyclic symmetry: one slot pitch, solved for every nodal diameter."""

from __future__ import annotations

import re

import numpy as np
from calculix import element_cards, material_cards

from statorhom.mesh import HalfPitchMesh, HexMesh
from statorhom.model.eigen import frequency_hz

ON_PLANE = 1e-9  # rad


def one_pitch(half: HalfPitchMesh) -> HexMesh:
    """The pitch around tooth 0: the half pitch and its mirror image."""
    full, _, _ = half.full()
    elements = full.elements[: 2 * len(half.elements)]
    used, numbers = np.unique(elements, return_inverse=True)
    region = full.region[: len(elements)]
    return HexMesh(full.nodes[used], numbers.reshape(elements.shape), region, full.regions)


def cyclic_deck(half: HalfPitchMesh, material: str, modes: int) -> str:
    """CalculiX input: lowest natural frequencies of every nodal diameter of the free stack."""
    mesh = one_pitch(half)
    angle = np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0])
    edge = np.pi / half.slots
    lines = element_cards(mesh)
    for name, sign in (("UPPER", 1), ("LOWER", -1)):
        lines.append(f"*NSET, NSET=N{name}")
        lines += [f"{i + 1}," for i in np.flatnonzero(np.abs(angle - sign * edge) < ON_PLANE)]
        lines += [f"*SURFACE, NAME={name}, TYPE=NODE", f"N{name}"]
    lines += material_cards(material)
    lines += ["*TIE, CYCLIC SYMMETRY, NAME=PITCH, POSITION TOLERANCE=1.E-6", "UPPER,LOWER"]
    lines += [f"*CYCLIC SYMMETRY MODEL, N={half.slots}, NGRAPH=1, TIE=PITCH", "0.,0.,0.,0.,0.,1."]
    diameters = f"*SELECT CYCLIC SYMMETRY MODES, NMIN=0, NMAX={half.slots // 2}"
    lines += ["*STEP", "*FREQUENCY", f"{modes}", diameters, "*END STEP", ""]
    return "\n".join(lines)


def read_cyclic_frequencies(dat: str) -> np.ndarray:
    """Natural frequencies (Hz) of all nodal diameters, ascending, doublets twice."""
    rows = re.findall(r"^\s*\d+\s+\d+\s+(\S+E\S+)\s+\S+\s+\S+\s+\S+\s*$", dat, flags=re.MULTILINE)
    return np.sort(frequency_hz(np.array([float(value) for value in rows])))

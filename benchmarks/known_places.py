"""Time an oval yoke beside a lump: at a place that was asked for before, over a new place.

A refit of two effects changes the lump's mass, the yoke's amplitude and angle far more often than the lump's place,
and what the yoke's pieces make of the static responses depends on the place alone.

    python benchmarks/known_places.py
"""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from statorhom.geometry import stator_geometry
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.mesh import HalfPitchMesh, mesh_step, uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.broken.attachments import lump
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.change import Attachment, PieceChange
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.variations import region_stiffness, wave
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import read_geometry

ROOT = Path(__file__).resolve().parents[1]
GEOMETRY = ROOT / "geometries" / "550w-induction-36-slots.toml"
FIGURES = ROOT / "benchmarks" / "figures" / "known_places.json"
STACK = {"E_p_pa": 182e9, "E_z_pa": 100e9, "nu_p": 0.29, "nu_pz": 0.31, "G_rz_pa": 25e9}
HIGHEST_HZ = 8000.0
REPEATS = 7


def placed(mesh: HalfPitchMesh, angle: float) -> Attachment:
    return lump(mesh, angle, 0.8 * mesh.length, 0.1)


def heavier(attachment: Attachment, factor: float) -> Attachment:
    return replace(attachment, mass=factor * attachment.mass)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--figures", type=Path, default=FIGURES)
    options = parser.parse_args()
    mesh = mesh_step(stator_geometry(read_geometry(GEOMETRY), GEOMETRY).step(("stack",)), uniform(1))
    materials = {
        "lamination": Material(SYMMETRIES["transversely_isotropic"](**STACK).hooke(), 7810.5),
    }
    basis = symmetric_basis(assemble(mesh), materials, HIGHEST_HZ, certified=False)
    core = region_stiffness(mesh, materials, ("lamination",))

    def oval(step: int) -> PieceChange:
        return wave(mesh, core, 0.9 + 0.01 * step, harmonic=4, amplitude=0.02, inner=0.05)

    def solved(attachment: Attachment, step: int) -> float:
        begin = time.perf_counter()
        solve_broken(basis, [attachment, oval(step)], None)
        return time.perf_counter() - begin

    with threadpool_limits(limits=1):
        known = placed(mesh, 1.0)
        solved(known, 0)
        pairs = [
            (solved(heavier(known, 1 + 0.01 * k), k), solved(placed(mesh, 1.0 + 0.1 * k), k))
            for k in range(1, REPEATS + 1)
        ]
    same, new = (float(np.median(seconds)) for seconds in zip(*pairs, strict=True))
    found = {"degrees_of_freedom": mesh.full_dof, "known_s": same, "new_s": new, "ratio": same / new}
    print(json.dumps(found, indent=1))
    write_text(options.figures, json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()

"""Time what breaks a stator's symmetry: solved in the symmetric basis, and as one problem of the whole stator.

A lump, two elastic lines and a 90° arc of slots whose winding has come loose from the teeth, each solved by
`statorhom.model.broken` and, on the same mesh, by shift-invert Lanczos with the fastest factorization of the whole
matrix that is installed (CHOLMOD with the extra `general`). Both find all modes of the band; their frequencies are
compared.

    python benchmarks/broken_symmetry.py --refinement 2
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp
from threadpoolctl import threadpool_limits

from statorhom.geometry import stator_geometry
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.mesh import HalfPitchMesh, MeshDensity, mesh_step, uniform
from statorhom.mesh.density import COARSEST
from statorhom.mesh.hex_mesh import MIRRORED
from statorhom.model.affine import Material, Materials, assemble
from statorhom.model.back_ends.choice import best_available
from statorhom.model.broken.attachments import lump, springs
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.cells import cells
from statorhom.model.broken.change import Attachment, Change, PieceChange
from statorhom.model.broken.pieces import elements_in
from statorhom.model.broken.prepare import prepared
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.variations import arc, region_stiffness
from statorhom.model.eigen import frequency_hz, modes_below
from statorhom.model.general.general_model import whole_ring
from statorhom.model.stator_mode import RIGID_HZ
from statorhom.model.supports import support_on
from statorhom.model.surface import SurfacePoints
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import read_geometry
from statorhom.study.supports import LineSupport

ROOT = Path(__file__).resolve().parents[1]
GEOMETRY = ROOT / "geometries" / "550w-induction-36-slots.toml"
FIGURES = ROOT / "benchmarks" / "figures" / "broken_symmetry.json"
FINE = MeshDensity(dict(COARSEST) | {"tooth": 2, "slot": 2, "shoulder": 2, "radial": 4, "yoke": 3, "core": 6})
MIDDLE = MeshDensity(dict(COARSEST) | {"tooth": 2, "slot": 2, "shoulder": 2, "radial": 3, "core": 4})
STACK = {"E_p_pa": 182e9, "E_z_pa": 100e9, "nu_p": 0.29, "nu_pz": 0.31, "G_rz_pa": 25e9}
WINDING = {"E_p_pa": 2.1e9, "E_z_pa": 11e9, "nu_p": 0.33, "nu_pz": 0.08, "G_rz_pa": 0.7e9}
HIGHEST_HZ = 8000.0
REPEATS = 5


def materials() -> Materials:
    """Typical ones."""
    kind = SYMMETRIES["transversely_isotropic"]
    winding = Material(kind(**WINDING).hooke(), 3166.0)
    return {"lamination": Material(kind(**STACK).hooke(), 7810.5), "winding": winding, "overhang": winding}


@dataclass(frozen=True)
class Case:
    """What breaks the symmetry, and at which other angle the diagnosis might ask for it next."""

    name: str
    kinds: tuple[str, ...]
    density: MeshDensity
    changes: Callable[[HalfPitchMesh, float], list[Change]]
    offsets: tuple[float, ...] = (0.0,)  # of a pitch, at which the basis is prepared


def lumped(mesh: HalfPitchMesh, angle: float) -> list[Change]:
    return [lump(mesh, angle, 0.8 * mesh.length, 0.1)]


def lines(mesh: HalfPitchMesh, angle: float) -> list[Change]:
    degrees = np.rad2deg(angle) + np.array([0.0, 44.0])
    keys = {"name": "lines", "kind": "lines", "angles_deg": tuple(degrees), "declared": "elastic"}
    held = support_on(mesh, LineSupport(**keys, normal_stiffness_n_per_m2=1e10, tangential_ratio=0.5))
    return [springs(mesh, held.points)]


class Loose:
    """The winding of all slots within 90°, which keeps a tenth of its stiffness; its pieces are made once."""

    def __init__(self) -> None:
        self.pieces: dict[int, Any] = {}

    def __call__(self, mesh: HalfPitchMesh, angle: float) -> list[Change]:
        if id(mesh) not in self.pieces:
            place = cells(mesh, elements_in(mesh, ("winding",)))
            self.pieces[id(mesh)] = region_stiffness(mesh, materials(), ("winding",)), place
        pieces, place = self.pieces[id(mesh)]
        return [arc(pieces, place, angle, angle + np.pi / 2, 0.1)]


class Whole:
    """The whole stator as one body without symmetry."""

    def __init__(self, half: HalfPitchMesh) -> None:
        self.half = half
        self.model = whole_ring(half)

    def matrices(self, changes: list[Change]) -> tuple[sp.csr_array, sp.csr_array]:
        """K and M."""
        mesh, model = self.model.mesh, self.model
        factors = np.ones(len(mesh.elements))
        for change in changes:
            if isinstance(change, PieceChange):
                factors[mesh.region == mesh.regions.index("winding")] += change.weights.T.ravel()
            if isinstance(change, Attachment):
                rows = sp.csr_array(change.rows) @ self.rows(change.points)
                stiffness, mass = (rows.T @ sp.csr_array(m) @ rows for m in (change.stiffness, change.mass))
                model = model.with_added(stiffness, mass)
        return model.stiffness_matrix(materials(), factors), model.mass_matrix(materials())

    def rows(self, points: SurfacePoints) -> sp.csr_array:
        """Motion (3 p, 3 n) of points by the whole stator's displacements."""
        n = len(self.half.nodes)
        # a node on a plane of symmetry belongs to one of the copies that share it; elements know all of theirs
        table = np.empty((2 * self.half.slots, n), dtype=int)
        count = len(self.half.elements)
        for c in range(2 * self.half.slots):
            mine = self.half.elements if c % 2 == 0 else self.half.elements[:, MIRRORED]
            table[c, mine] = self.model.mesh.elements[c * count : (c + 1) * count]
        local = sp.coo_array(points.matrix)
        copy = 2 * points.pitch + points.mirrored
        node, component = np.divmod(local.col, 3)
        point, row = np.divmod(local.row, 3)
        columns = 3 * table[copy[point], node] + component
        flips = points.mirrored[point] & ((component == 1) != (row == 1))
        return sp.csr_array(
            (np.where(flips, -local.data, local.data), (local.row, columns)),
            shape=(3 * len(points), 3 * len(self.model.mesh.nodes)),
        )


def timed(call: Callable[[], Any]) -> tuple[Any, float]:
    """Result, and wall time (s)."""
    begin = time.perf_counter()
    result = call()
    return result, time.perf_counter() - begin


def run(case: Case) -> dict[str, Any]:
    """One case on one mesh."""
    half = mesh_step(stator_geometry(read_geometry(GEOMETRY), GEOMETRY).step(case.kinds), case.density)
    pitch = 2 * np.pi / half.slots
    basis, setup = timed(lambda: symmetric_basis(assemble(half), materials(), HIGHEST_HZ))
    # at other pitches than those that the basis is prepared at, and at all of its places in the pitch
    angles = [1.0 + pitch * (k + case.offsets[k % len(case.offsets)]) for k in range(7, 7 + REPEATS)]
    # one solution from nothing, for those who want no other
    alone, once = timed(lambda: solve_broken(basis, case.changes(half, angles[0])))
    # its basis has kept what it needed: the preparation for many starts from another
    basis = symmetric_basis(assemble(half), materials(), HIGHEST_HZ)
    trainings = [case.changes(half, 1.0 + offset * pitch) for offset in case.offsets]
    ready, prepare = timed(lambda: prepared(basis, trainings))
    # and once between these places
    between = solve_broken(ready, case.changes(half, 2.345), None)
    runs = [timed(lambda a=a: solve_broken(ready, case.changes(half, a), None)) for a in angles]
    modes = runs[0][0]
    whole = Whole(half)
    (K, M), assembly = timed(lambda: whole.matrices(case.changes(half, angles[0])))
    back_end = best_available()
    found, full = timed(lambda: modes_below(K, M, HIGHEST_HZ, len(modes) + 8, back_end=back_end))
    exact = frequency_hz(found[0])
    exact = exact[exact > RIGID_HZ]
    error = modes.frequencies_hz / exact[: len(modes)] - 1
    error_alone = alone.frequencies_hz / exact[: len(alone)] - 1
    one = float(np.median([seconds for _, seconds in runs]))
    return {
        "case": case.name,
        "degrees_of_freedom": half.full_dof,
        "modes": len(modes),
        "coordinates": len(modes.coordinates),
        "largest_error": float(np.abs(error).max()),
        "largest_estimate": float(max(run.errors.max() for run, _ in runs)),
        "largest_estimate_between": float(between.errors.max()),
        "largest_error_alone": float(np.abs(error_alone).max()),
        "basis_s": setup,
        "one_solution_alone_s": once,
        "preparation_s": prepare,
        "solution_s": one,
        "whole_assembly_s": assembly,
        "whole_solution_s": full,
        "ratio": full / one,
        "ratio_alone_basis_shared": (full + assembly) / once,
        "ratio_alone_basis_included": (full + assembly) / (setup + once),
        "ratio_everything_included": (full + assembly) / (setup + prepare + one),
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--refinement",
        type=int,
        choices=(1, 2),
        default=2,
        help="1: 26 k and 50 k degrees of freedom, 2: 143 k and 146 k",
    )
    parser.add_argument("--figures", type=Path, default=FIGURES)
    options = parser.parse_args()
    loose = Loose()
    stack, wound = (uniform(1), uniform(1)) if options.refinement == 1 else (FINE, MIDDLE)
    cases = [
        Case("lump of 0.1 kg", ("stack",), stack, lumped),
        Case("two elastic lines", ("stack",), stack, lines),
        Case("loose winding over 90°", ("stack", "wound"), wound, loose, (0.0, 0.25, 0.42)),
    ]
    found = []
    with threadpool_limits(limits=1):
        for case in cases:
            found.append(run(case))
            print(json.dumps(found[-1], indent=1), flush=True)
            write_text(options.figures, json.dumps(found, indent=2, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()

"""Compare the cyclic model with CalculiX on one and the same mesh of the whole stack.

CalculiX gets the mesh of all slot pitches and solves it as one problem; statorhom solves one harmonic after
the other on half a pitch. Both must find the same frequencies, doublets twice.

    python benchmarks/calculix.py --material isotropic --figures benchmarks/figures/calculix_stack_26k.json
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.geometry import stator_geometry
from statorhom.materials.hooke import Hooke
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.mesh import HalfPitchMesh, HexMesh, mesh_step, uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.eigen import frequency_hz, modes_below
from statorhom.model.harmonic import all_orders, harmonic_spaces
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import read_geometry

ROOT = Path(__file__).resolve().parents[1]
INSTALL = "ccx is not on the PATH; on Debian run: apt-get install calculix-ccx"
DENSITY = 7810.5
CONSTANTS = {
    "isotropic": {"E_pa": 187e9, "nu": 0.3},
    "transversely_isotropic": {
        "E_p_pa": 182e9,
        "E_z_pa": 100e9,
        "nu_p": 0.29,
        "nu_pz": 0.31,
        "G_rz_pa": 25e9,
    },
}
# CalculiX counts the mid-sides of the upper face before those of the upright edges
CCX_ORDER = np.r_[0:12, 16:20, 12:16]
RIGID_HZ = 1.0


def input_deck(mesh: HexMesh, material: str, modes: int) -> str:
    """CalculiX input of a free body: 20-node hexahedra with full integration, lowest natural frequencies."""
    lines = [*element_cards(mesh), *material_cards(material)]
    lines += ["*STEP", "*FREQUENCY", f"{modes}", "*END STEP", ""]
    return "\n".join(lines)


def element_cards(mesh: HexMesh) -> list[str]:
    """Nodes and elements."""
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i},{x:.12e},{y:.12e},{z:.12e}" for i, (x, y, z) in enumerate(mesh.nodes, 1)]
    lines.append("*ELEMENT, TYPE=C3D20, ELSET=STACK")
    for i, element in enumerate(mesh.elements[:, CCX_ORDER] + 1, 1):
        numbers = [str(n) for n in element]
        lines += [f"{i}," + ",".join(numbers[:10]) + ",", ",".join(numbers[10:])]
    return lines


def material_cards(material: str) -> list[str]:
    """Material and section of the whole body."""
    constants = CONSTANTS[material]
    cards = ["*MATERIAL, NAME=CORE", "*ELASTIC"]
    section = "*SOLID SECTION, ELSET=STACK, MATERIAL=CORE"
    if material == "isotropic":
        cards.append(f"{constants['E_pa']:.12e},{constants['nu']}")
    else:
        cards[-1] += ", TYPE=ORTHO"
        cards += _orthotropic(SYMMETRIES[material](**constants).hooke())
        cards += ["*ORIENTATION, NAME=AXES, SYSTEM=CYLINDRICAL", "0.,0.,0.,0.,0.,1."]
        section += ", ORIENTATION=AXES"
    return [*cards, "*DENSITY", f"{DENSITY}", section]


def _orthotropic(hooke: Hooke) -> list[str]:
    c = hooke.matrix
    # D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313 and, on the next line, D2323
    entries = [c[0, 0], c[0, 1], c[1, 1], c[0, 2], c[1, 2], c[2, 2], c[5, 5], c[4, 4], c[3, 3]]
    numbers = [f"{entry:.12e}" for entry in entries]
    return [",".join(numbers[:8]), numbers[8] + ",293."]


def read_frequencies(dat: str) -> np.ndarray:
    """Natural frequencies (Hz) from the eigenvalues of a .dat file, which carry seven digits."""
    table = dat.split("E I G E N V A L U E   O U T P U T", 1)[1].split("P A R T I C I P A T I O N", 1)[0]
    rows = re.findall(r"^\s*\d+\s+(\S+)\s+(\S+)\s+(\S+)\s+(\S+)\s*$", table, flags=re.MULTILINE)
    return frequency_hz(np.array([float(row[0]) for row in rows]))


def run_ccx(
    program: str, deck: str, threads: int = 1, read: Callable[[str], np.ndarray] = read_frequencies
) -> tuple[np.ndarray, float]:
    """Frequencies and wall time (s) of CalculiX; `read` finds them in the .dat file."""
    names = ("OMP_NUM_THREADS", "CCX_NPROC_EQUATION_SOLVER", "CCX_NPROC_STIFFNESS")
    environment = {**os.environ, **dict.fromkeys(names, str(threads))}
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "stack.inp").write_text(deck, encoding="ascii")
        begin = time.perf_counter()
        command = [program, "-i", "stack"]
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        seconds = time.perf_counter() - begin
        dat = Path(folder) / "stack.dat"
        if done.returncode != 0 or not dat.exists() or "E I G E N" not in dat.read_text():
            sys.exit(f"ccx failed: {done.stdout.strip().splitlines()[-1:] or done.stderr}")
        return read(dat.read_text()), seconds


def ccx_version(program: str) -> str:
    """Version that CalculiX says it is."""
    said = subprocess.run([program, "-v"], capture_output=True, text=True, check=False).stdout
    found = re.search(r"Version\s+(\S+)", said)
    return found.group(1) if found else "unknown"


def cyclic_frequencies(half: HalfPitchMesh, material: str, highest_hz: float) -> np.ndarray:
    """Our frequencies (Hz) of the whole stack, each as often as it occurs."""
    model = assemble(half)
    core = Material(SYMMETRIES[material](**CONSTANTS[material]).hooke(), DENSITY)
    K, M = model.stiffness_matrix({"lamination": core}), model.mass_matrix({"lamination": core})
    return np.sort(np.concatenate(list(_by_harmonic(half, K, M, highest_hz))))


def _by_harmonic(half: HalfPitchMesh, K: Any, M: Any, highest_hz: float) -> Iterator[np.ndarray]:
    for order in all_orders(half.slots):
        for space in harmonic_spaces(half, order):
            values, _ = modes_below(space.project(K), space.project(M), highest_hz, 4)
            yield np.repeat(frequency_hz(values), space.multiplicity)


def print_table(ours: np.ndarray, theirs: np.ndarray, seconds: tuple[float, float]) -> None:
    """One line per mode, then the times."""
    print("mode   statorhom Hz    CalculiX Hz   difference")
    for i, (a, b) in enumerate(zip(ours, theirs, strict=True), 1):
        print(f"{i:4d}  {a:13.4f}  {b:13.4f}   {a / b - 1:+.1e}")
    print(
        f"statorhom {seconds[0]:.2f} s, CalculiX {seconds[1]:.2f} s, "
        f"one thread each: ratio {seconds[1] / seconds[0]:.0f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--geometry", type=Path, default=ROOT / "geometries" / "550w-induction-36-slots.toml")
    parser.add_argument("--material", choices=sorted(CONSTANTS), default="isotropic")
    parser.add_argument("--factor", type=int, default=1, help="refinement of the uniform mesh")
    parser.add_argument("--modes", type=int, default=40, help="rigid-body modes included")
    parser.add_argument("--figures", type=Path, help="write CalculiX's frequencies to this JSON file")
    options = parser.parse_args()
    program = shutil.which("ccx")
    if program is None:
        sys.exit(INSTALL)
    half = mesh_step(
        stator_geometry(read_geometry(options.geometry), options.geometry).step(("stack",)),
        uniform(options.factor),
    )
    theirs, ccx_seconds = run_ccx(program, input_deck(half.full()[0], options.material, options.modes))
    begin = time.perf_counter()
    ours = cyclic_frequencies(half, options.material, 1.0001 * theirs.max())
    seconds = time.perf_counter() - begin, ccx_seconds
    # a doublet may be cut in two by the number of modes that was asked for
    ours, theirs = ours[ours > RIGID_HZ], theirs[theirs > RIGID_HZ]
    print_table(ours[: len(theirs)], theirs, seconds)
    if options.figures is not None:
        write_text(options.figures, _figures(options, half, theirs, ccx_version(program)))


def _figures(options: argparse.Namespace, half: HalfPitchMesh, hz: np.ndarray, version: str) -> str:
    figures = {
        "ccx_version": version,
        "geometry": options.geometry.name,
        "mesh": f"uniform({options.factor})",
        "degrees_of_freedom": half.full_dof,
        "material": options.material,
        "constants": CONSTANTS[options.material],
        "density_kg_per_m3": DENSITY,
        "frequencies_hz": [round(float(f), 5) for f in hz],
    }
    return json.dumps(figures, indent=2) + "\n"


if __name__ == "__main__":
    main()

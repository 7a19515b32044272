"""A flying wing with something hidden: FRFs of a roving accelerometer from a finer mesh, fins on the truth alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from identification_methods import WING, geometry_of, study_text

from statorhom import Study
from statorhom.geometry.wing import Lump, WingGeometry
from statorhom.mesh.wing import WingMesh, wing_mesh
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import problem_at
from statorhom.model.problems import eigenpairs_of, orders_of
from statorhom.recordings.dof import Dof
from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.writer import write_uff
from statorhom.results.diagnosis import Diagnosis
from statorhom.study.wing_file import LUMPS
from synthetic_frfs import frf_set

FINER = 1.75  # of the truth's mesh over the fitting mesh, in cells along chord and span
LINES = np.arange(25.0, 190.0, 0.1)
BEYOND = 1.3  # of the band: modes that the FRFs hold too
LOSS = 0.01
RIGID_HZ = 1.5  # of the wing on its cords
SPAN_POINTS, CHORD_POINTS = (0.03, 0.2, 0.37, 0.54, 0.71, 0.86, 0.97), (0.05, 0.45, 0.95)
UP = (0.0, 0.0, 1.0)
# one each side, where the rear spar meets the rib of the tip: on bare skin they would swing by themselves
FINS = (Lump("fin", 0.060, 0.638, 0.945),)


@dataclass(frozen=True, eq=False)
class Truth:
    """Modes of the whole wing at nodes of its upper skin.

    Parameters
    ----------
    places : (p, 3) the points of the right half and then their images.
    frequencies : (m,) with those of the rigid body, 0.
    motion : (m, p) upwards, of unit modal mass.
    """

    places: np.ndarray
    frequencies: np.ndarray
    motion: np.ndarray


def wing_truth(folder: Path, lumps: Sequence[Lump] = (), highest_hz: float = float(LINES[-1])) -> Truth:
    """The printed wing with lumps, on a fine mesh."""
    wing = replace(geometry_of(WING, folder), lumps=tuple(lumps))
    assert isinstance(wing, WingGeometry)
    mesh = wing_mesh(wing, FINER)
    nodes = sensor_nodes(mesh, wing)
    # the mesh takes a lump's mass from its place, of its region no more than the density's unit
    materials = dict(WING.materials)
    if lumps:
        materials[LUMPS] = Material(materials[WING.region].hooke, 1.0)
    problem = problem_at(assemble(mesh), materials)
    pairs = eigenpairs_of(mesh, problem.K, problem.M, BEYOND * highest_hz, orders_of(mesh))
    squares, rows = [], []
    for space, values, vectors in pairs:
        right = (space.expand(vectors) / np.sqrt(space.copies))[3 * nodes + 2].T
        squares.append(values)
        rows.append(np.hstack([right, mesh.signs(space.order)[0, 2] * right]))
    hz = np.sqrt(np.maximum(np.concatenate(squares), 0.0)) / (2 * np.pi)
    hz[hz < RIGID_HZ] = 0.0
    order = np.argsort(hz)
    places = mesh.nodes[nodes]
    both = np.vstack([places, places * (1.0, -1.0, 1.0)])
    return Truth(both, hz[order], np.vstack(rows)[order])


def sensor_nodes(mesh: WingMesh, wing: WingGeometry) -> np.ndarray:
    """Nodes of the upper skin nearest to a grid over the right half."""
    found = []
    for y in np.array(SPAN_POINTS) * wing.plan.half_span:
        for share in CHORD_POINTS:
            at = np.array([wing.plan.leading_edge(y) + share * wing.plan.chord(y), y])
            away = np.linalg.norm(mesh.nodes[mesh.upper, :2] - at, axis=1)
            found.append(mesh.upper[int(np.argmin(away))])
    return np.unique(found)


def write_wing_test(folder: Path, truth: Truth, noise: float = 5e-3) -> Path:
    """A study of the wing without lumps; its test is a roving accelerometer's, one fixed shaker."""
    points = [Dof(100 + i, tuple(place.tolist()), UP) for i, place in enumerate(truth.places)]  # type: ignore[arg-type]
    # the shaker sits where no early mode has a node line: behind, near the right tip
    shaker = int(np.argmax(truth.places[:, 0] + truth.places[:, 1]))
    poles = [(f if f else RIGID_HZ, LOSS) for f in truth.frequencies.tolist()]
    frfs = frf_set(LINES, points, [shaker], poles, truth.motion, noise=noise, residuals=(0.0, 0.0))
    nodes = tuple(Node(p.node, p.position) for p in points if p.position is not None)
    write_uff(folder / "wing.uff", Recording("wing", frf_sets=(frfs,), nodes=nodes))
    volumes = geometry_of(WING, folder).exact_volumes()
    mass = sum(WING.materials[region].density * volume for region, volume in volumes.items())
    text = study_text(WING, "annealing", mass, "")
    path = folder / "study.toml"
    path.write_text(text.replace('modal_table = "modes.csv"', 'frf = "wing.uff"'), encoding="utf-8")
    return path


def diagnosed_wing(folder: Path, lumps: Sequence[Lump]) -> Diagnosis:
    """What a diagnosis says of the wing whose declared model has no lumps."""
    study = write_wing_test(folder, wing_truth(folder, lumps))
    return Study.load(study).diagnose(folder / "out")

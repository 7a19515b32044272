"""Contacts of finite stiffness in small bases against the full model on the split mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from small_stators import MATERIALS, stator_mesh

from statorhom.diagnose.contacts.joint_basis import JoinedMode, JointBasis, joint_basis
from statorhom.diagnose.contacts.joint_solution import ROUGH, ArcTraining
from statorhom.diagnose.measured.feature import SINGLE
from statorhom.materials.hooke import Hooke
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Material, Materials, assemble, hooke_coefficients
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.cells import Sectors
from statorhom.model.broken.change import PieceChange
from statorhom.model.broken.interface import contact, split
from statorhom.model.broken.solve import solve_broken
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import FreeProblem, problem_at
from statorhom.physics.action import Joint

TOP, SLOTS = 5000.0, 8
WOUND = ("winding", "overhang")
BOND = 1e14
LOOSE = Joint(WOUND, BOND, BOND, (0.0, np.deg2rad(110.0)), 3e-3)


@pytest.fixture(scope="module")
def basis() -> JointBasis:
    mesh = stator_mesh(SLOTS, ("stack", "wound"))
    return joint_basis(mesh, WOUND, MATERIALS, TOP, range(4), may_differ=True)


@pytest.fixture(scope="module")
def trained() -> JointBasis:
    """Beside arcs on either side of 110° and a hundredth of the stiffness."""
    mesh = stator_mesh(SLOTS, ("stack", "wound"))
    arcs = [
        ArcTraining(MATERIALS, Joint(WOUND, BOND, BOND, (0.0, np.deg2rad(110.0) * f), 0.01 / f**2))
        for f in (0.9, 1.1)
    ]
    return joint_basis(mesh, WOUND, MATERIALS, TOP, range(4), may_differ=True, arcs=arcs)


@pytest.fixture(scope="module")
def loose() -> JointBasis:
    """Beside arcs on either side of `LOOSE`, within which the winding moves by itself."""
    mesh = stator_mesh(SLOTS, ("stack", "wound"))
    (_, width), ratio = LOOSE.arc, LOOSE.ratio
    arcs = [
        ArcTraining(MATERIALS, replace(LOOSE, arc=(0.0, width * f), ratio=ratio / f**2)) for f in (0.9, 1.1)
    ]
    return joint_basis(mesh, WOUND, MATERIALS, TOP, range(4), may_differ=True, arcs=arcs)


def full(stiffness: float, materials=MATERIALS):
    half = split(stator_mesh(SLOTS, ("stack", "wound")), WOUND)
    problem: FreeProblem = problem_at(assemble(half), materials)
    joint = contact(half, WOUND, stiffness, stiffness).matrix
    return mode_keys(replace(problem, K=sp.csr_array(problem.K + joint)).solve(TOP, range(4)).modes)


@pytest.mark.parametrize("stiffness", [3e13, 3e11])
def test_even_contacts_between_those_of_the_basis(basis: JointBasis, stiffness: float) -> None:
    found, exact = basis.solve(MATERIALS, Joint(WOUND, stiffness, stiffness)), full(stiffness)
    for key in ((2, 0, 0), (2, 1, 0), (3, 0, 0)):
        assert np.exp(found[key].log_f) == pytest.approx(exact[key].frequency_hz, rel=1e-3)


def test_slopes_by_the_winding_are_those_of_the_full_model(basis: JointBasis) -> None:
    step, stiffness = 0.02, 3e11
    ends = []
    for factor in (1 - step, 1 + step):
        own = Material(Hooke(factor * MATERIALS["winding"].hooke.matrix), MATERIALS["winding"].density)
        ends.append(full(stiffness, {**MATERIALS, "winding": own}))
    found = basis.solve(MATERIALS, Joint(WOUND, stiffness, stiffness))
    hooke = MATERIALS["winding"].hooke.matrix
    entries = [
        hooke[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2), (3, 3), (4, 4), (5, 5))
    ]
    for key in ((2, 0, 0), (3, 0, 0)):
        slope = found[key].slope.vector.reshape(-1, 10)[list(MATERIALS).index("winding"), :9] @ entries
        exact = np.log(ends[1][key].frequency_hz / ends[0][key].frequency_hz) / (2 * step)
        assert slope == pytest.approx(exact, rel=0.03)


def on_the_mesh(
    width: float,
    ratio: float,
    highest_hz: float = 3000.0,
    mesh: HalfPitchMesh | None = None,
    materials: Materials = MATERIALS,
) -> np.ndarray:
    """Frequencies (Hz) of the full model."""
    half = split(mesh or stator_mesh(SLOTS, ("stack", "wound")), WOUND)
    joint = contact(half, WOUND, BOND, BOND)
    full_basis = symmetric_basis(assemble(half), materials, highest_hz, margin=1.5, contact=joint.matrix)
    share = Sectors(np.array([[0.0, np.pi / half.slots]]), half.slots).share_of_arc(-width / 2, width / 2)
    weights = np.repeat(ratio**share - 1, len(joint.pieces), axis=0)
    return solve_broken(full_basis, [PieceChange(joint.pieces, None, weights)]).frequencies_hz


@pytest.mark.parametrize(
    ("name", "arc_deg", "ratio", "part"),
    [("basis", 70.0, 0.1, 0.2), ("trained", 110.0, 0.01, 0.05), ("trained", 116.0, 0.008, 0.05)],
)
def test_a_weak_arc_shifts_and_splits_as_in_the_full_model(
    request: pytest.FixtureRequest, name: str, arc_deg: float, ratio: float, part: float
) -> None:
    """The error is a part of the shift: a fifth of it in the rough basis, a twentieth near trainings."""
    place, width = 0.7, np.deg2rad(arc_deg)
    own: JointBasis = request.getfixturevalue(name)
    found = own.solve(MATERIALS, Joint(WOUND, BOND, BOND, (place, width), ratio))
    even = own.solve(MATERIALS, Joint(WOUND, BOND, BOND))
    exact = on_the_mesh(width, ratio)
    mean, bonded = (np.exp(modes[2, 0, 0].log_f) for modes in (found, even))
    near = exact[np.argsort(np.abs(exact - mean))[:2]]
    assert bonded - mean == pytest.approx(bonded - near.mean(), rel=part)
    # Ritz values are upper bounds
    assert mean >= near.mean() - 0.5
    split_hz = 0.5 * abs(found[2, 0, 0].split) * mean
    assert split_hz == pytest.approx(np.ptp(near), abs=part * (bonded - near.mean()))


def test_beside_another_winding_arcs_that_were_solved_with_it_are_as_in_the_full_model(
    trained: JointBasis,
) -> None:
    """Its modes are no sums of those of a winding of ten times the stiffness: these stand higher by a thirteenth."""
    soft = Material(Hooke(0.1 * MATERIALS["winding"].hooke.matrix), MATERIALS["winding"].density)
    materials = {**MATERIALS, "winding": soft, "overhang": soft}
    arc = Joint(WOUND, BOND, BOND, (0.0, np.deg2rad(110.0)), 0.01)
    arcs = [ArcTraining(m, arc) for m in (MATERIALS, materials)]
    mesh, top = stator_mesh(SLOTS, ("stack", "wound")), 1500.0
    knowing, roughly = (
        joint_basis(mesh, WOUND, MATERIALS, top, range(2, 3), may_differ=True, arcs=own)
        for own in (arcs, [a._replace(rounds=ROUGH) for a in arcs])
    )
    exact = on_the_mesh(arc.arc[1], arc.ratio, top, mesh, materials)[:2].mean()
    missing, found, near = (
        np.exp(own.solve(materials, arc)[2, 0, 0].log_f) for own in (trained, knowing, roughly)
    )
    assert missing > exact + 50.0
    assert found == pytest.approx(exact, abs=0.5)
    # enough to tell arcs apart
    assert found < near < exact + 10.0


def test_one_tooth_of_many_parts_as_in_the_full_model() -> None:
    """That takes all harmonics of the mesh: without the highest ones next to nothing of the shift is left."""
    mesh = stator_mesh(24, ("stack", "wound"), tooth_width_mm=4.5)
    tooth = Joint(WOUND, BOND, BOND, (0.0, np.deg2rad(15.0)), 1e-3)
    own = joint_basis(
        mesh, WOUND, MATERIALS, 3000.0, range(4), may_differ=True, arcs=[ArcTraining(MATERIALS, tooth)]
    )
    even, found = (own.solve(MATERIALS, joint)[2, 0, 0] for joint in (Joint(WOUND, BOND, BOND), tooth))
    bonded, mean = np.exp(even.log_f), np.exp(found.log_f)
    exact = on_the_mesh(tooth.arc[1], tooth.ratio, 2000.0, mesh)[:2]
    assert bonded - mean == pytest.approx(bonded - exact.mean(), rel=0.1)
    assert 0.5 * abs(found.split) * mean == pytest.approx(np.ptp(exact), rel=0.1)


def test_the_place_of_an_arc_turns_the_splits_alone(basis: JointBasis) -> None:
    arcs = [Joint(WOUND, BOND, BOND, (place, 1.2), 0.1) for place in (0.0, 0.9)]
    first, turned = (basis.solve(MATERIALS, arc) for arc in arcs)
    for key, one in first.items():
        assert turned[key].log_f == one.log_f
        assert turned[key].split == pytest.approx(one.split * np.exp(1.8j * key[0]))
    # less stiffness at the arc: its antinode belongs to the lower mode
    assert first[2, 0, 0].split.real < 0


def lines_of(modes: Mapping[ModeKey, JoinedMode]) -> dict[tuple[ModeKey, int], float]:
    """Frequencies (Hz) of single modes and of both lines of doublets."""
    found = {}
    for key, one in modes.items():
        for side in (-1, 1) if one.mode.multiplicity == 2 else (0,):
            found[key, side] = float(np.exp(one.log_f + side * abs(one.split) / 4))
    return found


def test_modes_of_the_arc_alone_are_those_of_the_full_model(loose: JointBasis) -> None:
    lines = lines_of(loose.solve(MATERIALS, LOOSE))
    single = {key: f for (key, _), f in lines.items() if key[2] >= SINGLE and f < 4300.0}
    exact = on_the_mesh(LOOSE.arc[1], LOOSE.ratio, 4500.0)
    assert single
    for key, f in single.items():
        assert np.abs(np.log(exact / f)).min() < 5e-3, key
    # no mode stands there twice
    assert sum(f < 4300.0 for f in lines.values()) <= np.count_nonzero(exact < 4320.0)


def test_an_arc_that_loses_next_to_nothing_has_no_modes_of_its_own(basis: JointBasis) -> None:
    found = basis.solve(MATERIALS, Joint(WOUND, BOND, BOND, (0.0, 1.2), 0.999))
    even = basis.solve(MATERIALS, Joint(WOUND, BOND, BOND))
    assert set(found) == set(even)
    assert all(found[key].log_f == pytest.approx(one.log_f, abs=1e-4) for key, one in even.items())


def test_slopes_of_an_arc_s_own_modes_are_differences(loose: JointBasis) -> None:
    step, here = 1e-3, loose.solve(MATERIALS, LOOSE)
    keys = [key for key in here if key[2] >= SINGLE][:3]
    ends = []
    for factor in (1 - step, 1 + step):
        own = Material(Hooke(factor * MATERIALS["winding"].hooke.matrix), MATERIALS["winding"].density)
        ends.append(loose.solve({**MATERIALS, "winding": own}, LOOSE))
    entries = hooke_coefficients(MATERIALS["winding"].hooke)
    assert keys
    for key in keys:
        slope = here[key].slope.vector.reshape(-1, 10)[list(MATERIALS).index("winding"), :9] @ entries
        found = (ends[1][key].log_f - ends[0][key].log_f) / (2 * step)
        assert slope == pytest.approx(found, rel=1e-3, abs=1e-6)

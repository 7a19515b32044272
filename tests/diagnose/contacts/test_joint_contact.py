"""The contact between waves against the general products of pieces of all copies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.diagnose.contacts.joint_arc import ArcGroup, arc_change
from statorhom.diagnose.contacts.joint_basis import joint_basis
from statorhom.model.broken.grams import GramCache, project
from statorhom.physics.action import Joint

SLOTS = 8
WOUND = ("winding", "overhang")
ARC = Joint(WOUND, 1e14, 3e13, (0.0, np.deg2rad(97.0)), 3e-3)


@pytest.fixture(scope="module")
def groups() -> tuple[ArcGroup, ...]:
    mesh = stator_mesh(SLOTS, ("stack", "wound"))
    return joint_basis(mesh, WOUND, MATERIALS, 4000.0, range(4), may_differ=True).groups


def projected(group: ArcGroup, number: int, share: np.ndarray) -> np.ndarray:
    """All blocks between the coordinates of both families."""
    pieces, waves = group.contact.pieces[number], group.contact.waves
    return project(GramCache(), pieces, np.repeat(share[None], len(pieces), axis=0), waves, waves)


def test_an_arc_couples_cosines_and_sines_as_its_pieces_do(groups: tuple[ArcGroup, ...]) -> None:
    change = arc_change(ARC, SLOTS)
    for group in groups:
        normal, tangential = (projected(group, number, change) for number in range(2))
        whole, count = ARC.normal * normal + ARC.tangential * tangential, len(group.contact.waves.cosine)
        cosine, sine = group.contact.change(ARC, change)
        size = np.abs(whole).max()
        assert cosine == pytest.approx(whole[:count, :count], abs=1e-10 * size)
        assert sine == pytest.approx(whole[count:, count:], abs=1e-10 * size)
        # an arc around θ = 0 keeps them apart
        assert np.abs(whole[:count, count:]).max() < 1e-10 * size


def test_another_contact_is_another_bond(groups: tuple[ArcGroup, ...]) -> None:
    change = arc_change(ARC, SLOTS)
    once, twice = (groups[0].contact.change(replace(ARC, normal=n), change)[0] for n in (1e14, 2e14))
    again = groups[0].contact.change(ARC, change)[0]
    assert again == pytest.approx(once)
    assert np.abs(twice - once).max() > 0.1 * np.abs(once).max()


@pytest.mark.parametrize("number", [0, 1])
def test_half_pitches_one_by_one(groups: tuple[ArcGroup, ...], number: int) -> None:
    rng = np.random.default_rng(3)
    for group in groups:
        waves = group.contact.waves
        count = len(waves.cosine)
        vectors = [rng.standard_normal((size, 3)) for size in (count, len(waves.sine))]
        halves = group.contact.halves(number, vectors)
        for k, half in enumerate(np.eye(2 * SLOTS)):
            whole = projected(group, number, half)
            for own, V, block in zip(
                halves, vectors, (whole[:count, :count], whole[count:, count:]), strict=True
            ):
                expected = V.T @ block @ V
                assert own[k].reshape(3, 3) == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())

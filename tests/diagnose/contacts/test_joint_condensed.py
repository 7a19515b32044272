"""Arcs of lost contact in few vectors against all coordinates of the bases, between the windings that were solved."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.diagnose.contacts.joint_basis import JointBasis, joint_basis
from statorhom.diagnose.fits.few_vectors import MORE
from statorhom.materials.hooke import Hooke
from statorhom.model.affine import Material, Materials, hooke_coefficients
from statorhom.physics.action import Joint

TOP, SLOTS = 4000.0, 8
WOUND = ("winding", "overhang")
ARC = Joint(WOUND, 1e14, 1e14, (0.0, np.deg2rad(110.0)), 3e-3)


def wound(factor: float) -> Materials:
    """A winding so many times as stiff as the usual one."""
    own = MATERIALS["winding"]
    return {**MATERIALS, "winding": Material(Hooke(factor * own.hooke.matrix), own.density)}


def arc(degrees: float, ratio: float, place: float = 0.0) -> Joint:
    return replace(ARC, arc=(place, np.deg2rad(degrees)), ratio=ratio)


@pytest.fixture(scope="module")
def whole() -> JointBasis:
    mesh = stator_mesh(SLOTS, ("stack", "wound"))
    return joint_basis(mesh, WOUND, MATERIALS, TOP, range(4), may_differ=True)


@pytest.fixture(scope="module")
def few(whole: JointBasis) -> JointBasis:
    corners = [(f, d, q) for f in (0.5, 1.0, 2.0) for d in (80.0, 110.0, 140.0) for q in (1e-3, 1e-2)]
    return whole.condensed([(wound(f), arc(d, q)) for f, d, q in corners], 80)


def test_modes_between_the_samples_are_nearly_those_of_all_coordinates(
    whole: JointBasis, few: JointBasis
) -> None:
    place = (wound(1.4), arc(97.0, 4e-3, 0.7))
    exact, found = whole.solve(*place), few.solve(*place)
    assert set(found) == set(exact)
    for key, one in exact.items():
        assert found[key].log_f == pytest.approx(one.log_f, abs=1e-3)
        # Ritz values in fewer vectors are no lower
        assert found[key].log_f >= one.log_f - 1e-9
        assert abs(found[key].split - one.split) < 4e-3


def test_few_vectors_are_fewer_than_the_bases_have(whole: JointBasis, few: JointBasis) -> None:
    for group, own in zip(few.few, whole.groups, strict=True):
        cosine, sine = (f.vectors for f in group.families)
        assert cosine.shape[0] == len(own.contact.waves.cosine) and sine.shape[0] == len(
            own.contact.waves.sine
        )
        assert cosine.shape[1] < cosine.shape[0] and sine.shape[1] < sine.shape[0]


def test_slopes_are_differences(few: JointBasis) -> None:
    step, joint = 1e-3, arc(97.0, 4e-3)
    here = few.solve(wound(1.0), joint)
    low, high = (few.solve(wound(f), joint) for f in (1 - step, 1 + step))
    entries = hooke_coefficients(MATERIALS["winding"].hooke)
    for key, one in here.items():
        slope = one.slope.vector.reshape(-1, 10)[list(MATERIALS).index("winding"), :9] @ entries
        assert slope == pytest.approx((high[key].log_f - low[key].log_f) / (2 * step), rel=0.02, abs=2e-4)


def test_an_arc_s_end_within_a_half_pitch_changes_the_modes(whole: JointBasis) -> None:
    """In proportion, the contact would hold as well as ever until the last thousandth of a half pitch is lost."""
    widths = [95.0, 100.0, 105.0]
    (a, b, c) = (whole.solve(MATERIALS, arc(w, 1e-3))[2, 0, 0].log_f for w in widths)
    assert a > b > c
    assert (a - b) > 0.05 * (a - c)


def test_near_a_point_more_vectors_are_as_good_as_all(whole: JointBasis) -> None:
    """What an optimum is followed in (`statorhom.diagnose.fits.few_vectors.in_few_vectors_near`)."""
    rng = np.random.default_rng(1)
    around = np.exp(0.15 * (2 * rng.random((24, 3)) - 1))
    samples = [(wound(f), arc(97.0 * d, 4e-3 * q)) for f, d, q in around]
    near = whole.condensed(samples, MORE)
    place = (wound(1.1), arc(92.0, 4.4e-3, 0.7))
    exact, found = whole.solve(*place), near.solve(*place)
    assert set(found) == set(exact)
    for key, one in exact.items():
        assert found[key].log_f == pytest.approx(one.log_f, abs=1e-4)
        assert abs(found[key].split - one.split) < 4e-4

"""A wing's plan form, panels, walls and volumes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from example_wings import FLYING_WING, PLAN, box_wing
from statorhom.errors import GeometryError
from statorhom.geometry.wing import SkinLayer
from statorhom.geometry.wing_lattice import NOTHING, wing_lattice

# kg/m³: the flying wing's printed ply densities, Herex and aluminium
DENSITIES = {"skin": 1510.0, "core": 80.0, "glass": 1270.0, "cage": 2700.0}


def test_a_box_without_taper_has_the_volumes_of_plates():
    wing = box_wing(sweep_deg=0.0, tip_chord=0.4, heights=(0.1, 0.1, 0.1, 0.1))
    skin, web = 0.5e-3, wing.web
    span, chord, height = 0.8, 0.4, 0.04 - 2 * skin
    volumes = wing.exact_volumes()
    edges = 2 * skin * height * span
    assert volumes["skin"] == pytest.approx(2 * skin * chord * span + edges, rel=1e-9)
    spars = 2 * web * height * span
    ribs = (
        (web + 2 * web) * (chord - 2 * web - 2 * skin) * height
    )  # half of the middle one each side, and two tips
    assert volumes["web"] == pytest.approx(spars + ribs, rel=1e-9)


def test_the_skin_has_its_thickness_along_the_normal_of_every_panel():
    lattice = wing_lattice(FLYING_WING)
    count = len(FLYING_WING.skin)
    for column in (1, 6, len(lattice.region) - 2):
        cell = lattice.corners[column, 3]
        normal = lattice.axes[column, 3, -1, :, 2]
        for k, layer in enumerate(FLYING_WING.skin):
            top = 2 * count + 1 - k
            thickness = normal @ (cell[top] - cell[top - 1])
            assert thickness == pytest.approx(layer.thickness, rel=0.01)


def test_the_panels_are_plane():
    lattice = wing_lattice(FLYING_WING, 1.5)
    outer = lattice.corners[:, :, -1].reshape(-1, 3)
    x, y, z = outer.T
    p = FLYING_WING.plan
    share = (x - p.leading_edge(y)) / p.chord(y)
    for panel in range(3):
        inside = (share >= p.stations[panel] - 1e-9) & (share <= p.stations[panel + 1] + 1e-9)
        A = np.column_stack([x, y, np.ones_like(x)])[inside]
        fit, *_ = np.linalg.lstsq(A, z[inside], rcond=None)
        assert np.abs(A @ fit - z[inside]).max() < 1e-12
        assert fit[:2] == pytest.approx(p.panel_slopes(panel), abs=1e-12)


def test_materials_axes_are_rotations_with_the_normal_out_of_the_panel():
    lattice = wing_lattice(FLYING_WING)
    axes = lattice.axes.reshape(-1, 3, 3)
    assert axes @ np.swapaxes(axes, 1, 2) == pytest.approx(np.broadcast_to(np.eye(3), axes.shape), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    # cloth at 45 degrees: half way between the span and the chord
    first = lattice.axes[5, 2, -1, :, 0]
    assert abs(first[1]) == pytest.approx(math.sqrt(0.5), abs=0.02)


def test_refining_keeps_the_volumes():
    coarse, fine = wing_lattice(FLYING_WING), wing_lattice(FLYING_WING, 2.0)
    assert fine.region.size > 2 * coarse.region.size
    for region, volume in coarse.volumes().items():
        assert fine.volumes()[region] == pytest.approx(volume, rel=2e-3)


def test_a_wing_of_the_seeds_span_weighs_what_its_plies_do():
    volumes = FLYING_WING.exact_volumes()
    mass = sum(DENSITIES[region] * volume for region, volume in volumes.items())
    assert 2 * PLAN.half_span == pytest.approx(1.9)
    # plan area both sides: four plies of 0.3 mm cloth, 0.07 mm glass and 1.2 mm core
    area = 2 * 1.9 * (PLAN.root_chord + PLAN.tip_chord) / 2
    assert volumes["glass"] == pytest.approx(0.07e-3 * area, rel=0.02)
    assert 1.5 < mass < 4.0


def test_the_payload_stays_free():
    lattice = wing_lattice(FLYING_WING)
    inner = lattice.region[:, :, len(FLYING_WING.skin)]
    cage = FLYING_WING.regions.index("cage")
    columns = np.flatnonzero((inner == cage).any(axis=1))
    rows = np.flatnonzero((inner == cage).any(axis=0))
    hollow = inner[columns[0] + 1 : columns[-1], : rows[-1]]
    assert (hollow == NOTHING).all()
    assert (inner[columns[0] : columns[-1] + 1, rows[-1]] == cage).all()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"plan": replace(PLAN, sweep=math.radians(70))}, "wing.sweep_deg: must lie in -60 … 60"),
        ({"plan": replace(PLAN, stations=(0.0, 0.7, 0.6, 1.0))}, "wing.spars_percent: must rise"),
        ({"plan": replace(PLAN, heights=(0.05, 0.1, 0.1, 0.005))}, "wing.heights_percent: leave no room"),
        ({"ribs": (0.05,)}, "wing.ribs_mm: must rise from the payload cage"),
        (
            {"skin": (SkinLayer("skin", 0.02, 0.0),)},
            "wing.heights_percent: leave no room between two skins of 20 mm",
        ),
    ],
)
def test_impossible_wings_are_refused_in_one_line(change, said):
    with pytest.raises(GeometryError, match=said) as caught:
        replace(FLYING_WING, **change)
    assert "\n" not in str(caught.value)

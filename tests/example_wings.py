"""Wings that several folders of tests share."""

import math

from statorhom.geometry.wing import PlanForm, SkinLayer, WingGeometry

PLAN = PlanForm(0.95, 0.60, 0.30, math.radians(25.0), (0.0, 0.25, 0.65, 1.0), (0.05, 0.12, 0.09, 0.02))
BIAS = math.radians(45.0)
# the flying wing's printed plies of the wing section: two of carbon at ±45°, Herex, carbon, glass
FLYING_WING = WingGeometry(
    plan=PLAN,
    skin=(
        SkinLayer("skin", 0.2e-3, BIAS),
        SkinLayer("core", 1.2e-3, 0.0),
        SkinLayer("skin", 0.1e-3, BIAS),
        SkinLayer("glass", 0.07e-3, 0.0),
    ),
    ribs=(0.45,),
    web=5e-3,
    web_region="core",
    cage=(0.16, 4e-3),
    cage_region="cage",
    source="wing.toml",
)


def box_wing(*, sweep_deg, tip_chord, heights, half_span=0.4, skin=0.5e-3, web=2e-3):
    """A wing of one skin layer and webs, 0.4 m of chord at the middle, without a cage."""
    stations = (0.0, 0.3, 0.7, 1.0)
    plan = PlanForm(half_span, 0.4, tip_chord, math.radians(sweep_deg), stations, heights)
    layer = SkinLayer("skin", skin, 0.0)
    return WingGeometry(plan, (layer,), (), web, "web", None, "", "wing.toml")

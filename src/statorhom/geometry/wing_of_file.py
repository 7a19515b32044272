"""A wing's geometry from its file."""

from __future__ import annotations

import math
from collections.abc import Sequence

from statorhom.geometry.wing import Lump, PlanForm, SkinLayer, WingGeometry
from statorhom.study.wing_file import PlyKeys, WingKeys


def wing_of_file(keys: WingKeys, where: str) -> WingGeometry:
    """Build a wing.

    Parameters
    ----------
    keys : its table.
    where : the file, for messages.

    Raises
    ------
    GeometryError
        If its dimensions contradict each other.
    """
    plan = PlanForm(
        half_span=keys.span_mm / 2e3,
        root_chord=keys.root_chord_mm / 1e3,
        tip_chord=keys.tip_chord_mm / 1e3,
        sweep=math.radians(keys.sweep_deg),
        stations=(0.0, *(part / 100 for part in keys.spars_percent), 1.0),
        heights=tuple(part / 100 for part in keys.heights_percent),
    )
    cage = keys.cage
    return WingGeometry(
        plan=plan,
        skin=_layers(keys.plies),
        ribs=tuple(y / 1e3 for y in keys.ribs_mm),
        web=keys.web_thickness_mm / 1e3,
        web_region=keys.web_material,
        cage=None if cage is None else (cage.width_mm / 1e3, cage.wall_thickness_mm / 1e3),
        cage_region="" if cage is None else cage.material,
        source=where,
        lumps=tuple(
            Lump(lump.name, lump.mass_g / 1e3, lump.x_mm / 1e3, lump.y_mm / 1e3) for lump in keys.lumps
        ),
        densities=keys.density_kg_m3,
    )


def _layers(plies: Sequence[PlyKeys]) -> tuple[SkinLayer, ...]:
    """Plies of one material and angle that lie on each other are one layer."""
    layers: list[SkinLayer] = []
    for ply in plies:
        layer = SkinLayer(ply.material, ply.thickness_mm / 1e3, math.radians(ply.angle_deg))
        before = layers[-1] if layers else None
        if before is not None and (before.region, before.angle) == (layer.region, layer.angle):
            layers[-1] = SkinLayer(layer.region, before.thickness + layer.thickness, layer.angle)
        else:
            layers.append(layer)
    return tuple(layers)

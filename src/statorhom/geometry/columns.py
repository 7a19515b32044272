"""Patches that continue the columns of the back of the core: the frame outside, the end shields inside."""

from __future__ import annotations

import itertools
from dataclasses import replace

from statorhom.geometry.dimensions import StatorDimensions
from statorhom.geometry.section import ORIGIN, Edge, Patch, Section, polar

FRAME, SHIELD = "frame", "shield"
OTHER_END = {"start": "end", "end": "start", None: None}


def extended_section(section: Section, d: StatorDimensions, regions: frozenset[str]) -> Section:
    """The section with the frame's and the end shields' patches where the regions ask for them."""
    if "frame" in regions and d.frame is not None:
        section = _with_columns(section, FRAME, d.frame.outer_radius, outside=True)
    if "machine" in regions and d.shields is not None:
        section = _with_columns(section, SHIELD, d.shields.bore_radius, outside=False)
    return section


def columns_of(section: Section, name: str) -> tuple[Patch, ...]:
    """The patches that `extended_section` added under a name."""
    return tuple(patch for patch in section.patches if patch.name.startswith(f"{name} "))


def _with_columns(section: Section, name: str, radius: float, outside: bool) -> Section:
    """Add one patch per column, between the back of the core and `radius`."""
    points, edges, patches = dict(section.points), list(section.edges), list(section.patches)
    ends = {back: f"{name}.{i}" for i, back in enumerate(section.outer)}
    for back, end in ends.items():
        points[end] = polar(radius, section.angle(back))
        edges.append(Edge(back, end, name))
    for i, (a, b) in enumerate(itertools.pairwise(section.outer)):
        base = section.edge(a, b)
        dense = base.dense_at if base.start == a else OTHER_END[base.dense_at]
        edges.append(Edge(ends[a], ends[b], base.division, ORIGIN, dense))
        corners = (a, ends[a], ends[b], b) if outside else (ends[a], a, b, ends[b])
        patches.append(Patch(f"{name} {i}", corners))
    return replace(section, points=points, edges=tuple(edges), patches=tuple(patches))

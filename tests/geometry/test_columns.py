import math

import pytest

from example_stators import SLOTS, STEPS, stator
from statorhom.geometry.columns import columns_of, extended_section

BOTH = frozenset({"frame", "machine"})


@pytest.mark.parametrize("name", SLOTS)
def test_every_column_of_the_back_goes_on_radially(name):
    geometry = stator(SLOTS[name])
    section = extended_section(geometry.section, geometry.dimensions, BOTH)
    for prefix, radius in (("frame", 0.065), ("shield", 0.020)):
        assert len(columns_of(section, prefix)) == len(section.outer) - 1
        for i, back in enumerate(section.outer):
            assert math.hypot(*section.points[f"{prefix}.{i}"]) == pytest.approx(radius, rel=1e-14)
            assert section.angle(f"{prefix}.{i}") == pytest.approx(section.angle(back), abs=1e-15)


@pytest.mark.parametrize("name", SLOTS)
def test_cells_of_the_columns_are_as_dense_as_those_of_the_back(name):
    section = stator(SLOTS[name]).step(("stack", "framed")).section
    for i, (a, b) in enumerate(zip(section.outer, section.outer[1:], strict=False)):
        base, copy = section.edge(a, b), section.edge(f"frame.{i}", f"frame.{i + 1}")
        dense = {"start": base.start, "end": base.end, None: None}[base.dense_at]
        dense_copy = {"start": copy.start, "end": copy.end, None: None}[copy.dense_at]
        assert base.division == copy.division
        assert (dense is None) == (dense_copy is None)
        assert dense is None or section.angle(dense) == pytest.approx(section.angle(dense_copy), abs=1e-15)


def test_only_the_regions_of_the_step_are_added():
    geometry = stator()
    assert extended_section(geometry.section, geometry.dimensions, frozenset()) is geometry.section
    framed = geometry.step(STEPS["framed"]).section
    assert columns_of(framed, "frame") and not columns_of(framed, "shield")

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from measured_points import cylinder, radial_values
from statorhom.errors import MissingDependencyError
from statorhom.modes.measured_shape import measured_shapes
from statorhom.modes.point_layout import lay_out
from statorhom.report.shape_vtk import file_stem, write_vtk_series


def shape(z_m=(0.01, 0.04, 0.07)):
    dofs = cylinder(2 * np.pi * np.arange(12) / 12, z_m)
    (found,) = measured_shapes(lay_out(dofs), radial_values(dofs, lambda a, z: np.cos(2 * a) + 0j * z))
    return found


@pytest.mark.parametrize(("z_m", "cells"), [((0.01, 0.04, 0.07), 24), ((0.01,), 12)])
def test_a_series_can_be_read_again(tmp_path, z_m, cells):
    pyvista = pytest.importorskip("pyvista", reason="pyvista is not installed (extra vtk)")
    series = write_vtk_series(shape(z_m), tmp_path / "new", "(2, 0) at 1432.1 Hz")
    files = [entry.attrib["file"] for entry in ET.parse(series).iter("DataSet")]
    assert len(files) == 24
    first, half = (pyvista.read(series.parent / files[step]) for step in (0, 12))
    assert (first.n_points, first.n_cells) == (12 * len(z_m), cells)
    radius = np.hypot(*first.points[:, :2].T)
    assert radius.max() == pytest.approx(0.06 * 1.18, rel=1e-3)
    np.testing.assert_allclose(first["radial"], -half["radial"], atol=1e-6)
    np.testing.assert_allclose(radius, 0.06 * (1 + first["radial"]), rtol=1e-5)


def test_without_pyvista_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pyvista", None)
    with pytest.raises(MissingDependencyError, match=r"statorhom\[vtk\]"):
        write_vtk_series(shape(), tmp_path, "x")
    assert list(tmp_path.iterdir()) == []


@given(st.text(st.sampled_from('aZ09 ./\\:*?"<>|-é日\n\0$('), max_size=90))
def test_file_names_are_safe(name):
    stem = file_stem(name)
    assert 0 < len(stem) <= 60
    assert stem.isascii() and not set(stem) & set('/\\:*?"<>| ') and not stem.startswith((".", "-"))

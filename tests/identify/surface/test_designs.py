"""Designs of experiments: how many points, where, and that larger ones keep what was solved."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.errors import IdentificationError, MissingDependencyError
from statorhom.identify.surface import optional as optional_module
from statorhom.identify.surface.design import (
    DESIGNS,
    full_factorial,
    latin_hypercube,
    latin_hypercube_of,
    sparse_grid,
)


def rows(points):
    return {tuple(point) for point in points}


@pytest.mark.parametrize("name", DESIGNS)
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_designs_lie_in_the_cube_and_grow(name, dimension):
    sizes = [DESIGNS[name](dimension, size, 5) for size in range(3)]
    assert all(points.shape[1] == dimension and np.abs(points).max() <= 1.0 for points in sizes)
    assert len(sizes[0]) < len(sizes[1]) < len(sizes[2])
    assert all(len(rows(points)) == len(points) for points in sizes)
    np.testing.assert_array_equal(DESIGNS[name](dimension, 1, 5), sizes[1])


@pytest.mark.parametrize("design", [full_factorial, sparse_grid])
def test_nested_designs_keep_their_points(design):
    assert rows(design(2, 0)) < rows(design(2, 1)) < rows(design(2, 2))


def test_known_numbers_of_points():
    assert [len(full_factorial(2, size)) for size in range(3)] == [9, 25, 81]
    # Smolyak's grid of Clenshaw-Curtis rules in two dimensions: 13, 29, 65, 145 at levels 2 … 5
    assert [len(sparse_grid(2, size)) for size in range(4)] == [13, 29, 65, 145]
    assert [len(latin_hypercube(2, size, first=7)) for size in range(3)] == [7, 14, 28]


@settings(deadline=None, max_examples=20)
@given(st.integers(1, 4), st.integers(2, 80), st.integers(0, 99))
def test_a_latin_hypercube_has_one_point_in_every_layer(dimension, count, seed):
    points = latin_hypercube_of(dimension, count, seed)
    layers = np.floor((points + 1.0) / 2.0 * count).astype(int)
    for coordinate in layers.T:
        assert sorted(coordinate) == list(range(count))


def test_a_design_that_nobody_can_wait_for_is_refused():
    with pytest.raises(IdentificationError, match="full factorial: 6561 points are more than 4096"):
        full_factorial(8, 0)


def test_a_missing_library_is_one_line(monkeypatch):
    def missing(name, *_):
        raise ImportError(name)

    monkeypatch.setattr(optional_module, "import_module", missing)
    with pytest.raises(MissingDependencyError) as caught:
        sparse_grid(2, 0)
    assert str(caught.value) == (
        "a sparse grid needs chaospy, which is not installed: pip install 'statorhom[surface]'"
    )

"""The fit of a sensor's load: its slopes against finite differences, and what keeps it physical."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from roving_sensor import loaded_frfs
from statorhom.extraction.mode_search import ModeSearch
from statorhom.extraction.noise import expected_sd, noise_sd
from statorhom.extraction.point_grid import point_grid
from statorhom.extraction.roving import load_fit
from statorhom.extraction.roving.first_load import first_load
from statorhom.extraction.roving.load import RovingLoad
from statorhom.extraction.roving.load_unknowns import LoadUnknowns
from statorhom.extraction.roving.plane_poles import PlanePoles
from statorhom.extraction.roving.rings import Rings, rings
from statorhom.extraction.stabilization import stabilize
from synthetic_frfs import ring_points, ring_shape

POINTS = ring_points(12, 2)


def placed() -> Rings:
    found = rings(POINTS)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def search() -> ModeSearch:
    grid = point_grid([loaded_frfs(POINTS)])
    sd = expected_sd(grid, noise_sd(grid))
    poles, parts, stabilization = stabilize(grid, sd)
    return ModeSearch(grid, sd, poles, parts, stabilization.lasting_squared)


def a_load() -> RovingLoad:
    poles = (2 * np.pi * np.array([1003.0, 1604.0])) ** 2 * (1 + 0.0042j)
    load = np.array([[0.011, 0.012], [0.007, 0.008]])
    split = np.array([[3e-4, -2e-4], [1e-4, 2e-4]])
    return RovingLoad(poles, np.array([2, 2]), load, 0 * load, split, np.ones(2), placed())


def changed(load: RovingLoad, number: int, size: float) -> RovingLoad:
    """One unknown of both modes', in the order of `LoadUnknowns`."""
    step = np.zeros(12)
    step[number] = size
    return LoadUnknowns((0, 1), load)._changed(load, step)


def test_slopes_are_those_of_the_objective(search: ModeSearch) -> None:
    """The gradient of variable projection is exact, whatever its curvature leaves out (Kaufman 1975)."""
    first = a_load()
    problem = load_fit._problem(search, first, LoadUnknowns((0, 1), first))
    load = replace(first, load=first.load * 1.05)
    normal, slope = load_fit._normal(problem, load_fit._state(problem, load))
    for number in range(12):
        either = [load_fit._state(problem, changed(load, number, s)).objective for s in (1e-6, -1e-6)]
        exact = (either[0] - either[1]) / 4e-6
        assert slope[number] == pytest.approx(exact, rel=2e-2, abs=1e-7 * np.abs(slope).max())
    # the load of one plane changes nothing in the other
    assert normal[0, 1] == normal[0, 7] == normal[6, 7] == 0.0


def test_a_doublet_stays_whole_where_a_split_one_explains_no_more(
    search: ModeSearch, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its loads have standard deviations all the same: slopes over a split need two columns, and were asked of one."""
    whole = replace(a_load(), split=np.zeros((2, 2)))
    minimized = load_fit._minimized

    def hopeless(problem: load_fit._Problem, state: load_fit._State) -> tuple[load_fit._State, np.ndarray]:
        found, normal = minimized(problem, state)
        return replace(found, objective=np.inf), normal

    monkeypatch.setattr(load_fit, "_minimized", hopeless)
    found = load_fit._fit_cluster(search, whole, LoadUnknowns((0, 1), whole))
    np.testing.assert_array_equal(found.split, whole.split)
    np.testing.assert_array_equal(found.load, whole.load)
    assert np.all((found.load_sd > 0) & np.isfinite(found.load_sd))


def test_no_step_takes_a_plane_s_load_away() -> None:
    load = a_load()
    unknowns = LoadUnknowns((0, 1), load)
    step = np.zeros(12)
    step[:3] = [-1.0, 0.004, 0.1]
    step[6] = 0.001
    found = unknowns.moved(load, step)
    assert found.load[0, 0] == pytest.approx(0.1 * load.load[0, 0])
    # the step of the mode is shorter as a whole, that of the other mode is not
    assert found.load[0, 1] - load.load[0, 1] == pytest.approx(0.004 * 0.9 * load.load[0, 0])
    assert found.load[1, 0] - load.load[1, 0] == pytest.approx(0.001)


def test_no_step_carries_a_mode_off() -> None:
    load = a_load()
    step = np.zeros(12)
    step[3] = -1.5
    found = LoadUnknowns((0, 1), load).moved(load, step)
    assert found.poles[0].real == pytest.approx(0.98 * load.poles[0].real)


def test_the_first_guess_leaves_out_what_stays_where_a_doublet_moves() -> None:
    """A doublet falls by 2 and 1 % in its planes; beside it something of order 6 stays."""
    z = np.array([point.position[2] for point in POINTS if point.position is not None])
    grid = placed()
    strong, image = (ring_shape(POINTS, 2, 0.1) * (1 + z / z.max()), 1e-4 * ring_shape(POINTS, 3, 0.2))
    hammer = POINTS[0]
    residues = np.stack([strong * strong[0], image * image[0]], axis=1)[:, None].astype(complex)
    poles = np.array([[0.99, 0.995], [0.98, 0.995]]) * (1 + 0.004j)
    found = PlanePoles(poles, residues, np.ones((2, 2)))
    guess = first_load(found, 1e7, grid, [hammer])
    assert guess is not None
    assert guess.orders.tolist() == [2]
    moving = replace(found, poles=np.array([[0.99, 0.995], [0.98, 0.960]]) * (1 + 0.004j))
    both = first_load(moving, 1e7, grid, [hammer])
    assert both is not None
    assert both.orders.tolist() == [2, 3]

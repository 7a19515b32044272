"""The search by response surface on a ring whose truth is known."""

import numpy as np
import pytest
import synthetic_stage as stage

from statorhom.errors import IdentificationError
from statorhom.identify.bases.training import neighbouring_materials
from statorhom.identify.fits.stage_fit import search_space
from statorhom.identify.processes.workers import Workers
from statorhom.identify.surface.cube import Cube
from statorhom.identify.surface.design import full_factorial
from statorhom.identify.surface.experiments import Experiments
from statorhom.identify.surface.mode_surfaces import fit_surfaces
from statorhom.identify.surface.part_model import part_model
from statorhom.identify.surface.polynomial import fit_polynomial
from statorhom.identify.surface.search import search_surface
from statorhom.study.response_surface import SurfaceKeys

KNOWN = {"lamination": {"E_z_pa": 60e9, "nu_p": 0.29, "nu_pz": 0.31}}
NARROW = {"lamination": {"E_p_pa": {"low": 150e9, "high": 220e9}, "G_rz_pa": {"low": 10e9, "high": 30e9}}}


def experiments(prior=NARROW, fixed=KNOWN):
    space = search_space(stage.space(fixed=fixed, prior=prior))
    typical = stage.LAMINATION.of(space.values(space.start))
    full = part_model(stage.ring(), typical, 1.5 * stage.TOP_HZ, (2, 3))
    return Experiments(Cube(space), stage.LAMINATION, full, Workers())


def searched(lab, modes=None, **keys):
    return search_surface(lab, modes or stage.measured(), SurfaceKeys(**keys), evaluations=1000, seed=1)


def error(search, name):
    found = search.problem.space.values(search.optima[0])[f"lamination.{name}"]
    return abs(found / stage.TRUTH[f"lamination.{name}"] - 1.0)


@pytest.fixture(scope="module")
def laboratory():
    """Remembers what was solved."""
    return experiments()


@pytest.fixture(scope="module")
def polynomial(laboratory):
    return searched(laboratory, surface="polynomial")


def test_the_constants_come_out_of_the_surfaces(polynomial):
    assert polynomial.gate.passed
    assert polynomial.gate.rounds[-1].largest < 0.03
    assert error(polynomial, "E_p_pa") < 0.01
    assert error(polynomial, "G_rz_pa") < 0.01
    assert polynomial.names == tuple((*name, 0) for name in stage.MODES)
    assert polynomial.at_limits == ()


def test_the_objectives_are_the_seed_s(polynomial):
    """Equation (12), in per cent, at the points of the front."""
    f = polynomial.problem.surfaces.frequencies(polynomial.front.points)
    keys = polynomial.problem.surfaces.keys
    for column, (key, mode) in enumerate(zip(polynomial.names, stage.measured(), strict=True)):
        expected = 100 * np.abs(f[:, keys.index(key)] - mode.frequency_hz) / mode.frequency_hz
        np.testing.assert_allclose(polynomial.front.objectives[:, column], expected, rtol=1e-9)


def test_no_point_of_the_front_is_better_in_everything(polynomial):
    F = polynomial.front.objectives
    better = np.all(F[:, None] <= F[None], axis=2) & np.any(F[:, None] < F[None], axis=2)
    assert not better.any()


def test_full_solves_are_counted_and_none_is_done_twice():
    lab = experiments()
    first = full_factorial(2, 0)
    lab.at(first)
    assert lab.solves == 9
    lab.at(full_factorial(2, 1))
    assert lab.solves == 25


def test_the_gate_enlarges_the_design_until_it_predicts(laboratory):
    # a plane through three points misses what bends; larger designs allow higher degrees
    found = searched(laboratory, surface="polynomial", points=4, largest_error_percent=0.3)
    assert [r.points for r in found.gate.rounds][:2] == [4, 8]
    assert found.gate.rounds[0].largest > 0.003 >= found.gate.rounds[-1].largest
    assert found.gate.passed


def test_where_no_more_points_are_allowed_the_gate_says_so(laboratory):
    found = searched(laboratory, surface="polynomial", points=4, largest_error_percent=0.001, most_points=8)
    assert not found.gate.passed
    assert [r.points for r in found.gate.rounds] == [4, 8]


def test_a_gaussian_process_does_as_well(laboratory):
    found = searched(laboratory, surface="gaussian_process", points=12)
    assert found.gate.passed and error(found, "G_rz_pa") < 0.01


def test_an_optimum_beyond_the_range_is_told():
    high = {"lamination": {**NARROW["lamination"], "G_rz_pa": {"low": 20e9, "high": 30e9}}}
    found = searched(experiments(high), surface="polynomial")
    assert found.at_limits == ("lamination.G_rz_pa",)


def test_too_few_points_for_the_degree_are_refused_before_anything_is_solved():
    lab = experiments()
    with pytest.raises(IdentificationError, match="a design of 9 points cannot determine a surface of 10"):
        searched(lab, surface="polynomial", points=9, degree=3)
    assert lab.solves == 0


def test_nothing_to_search_is_an_error():
    given = {"lamination": {**KNOWN["lamination"], "E_p_pa": 186e9, "G_rz_pa": 17e9}}
    with pytest.raises(IdentificationError, match="all constants are fixed"):
        searched(experiments({}, given))


def test_the_surfaces_say_where_a_polish_may_go(polynomial):
    """In the full space too, whose density the surfaces do not feel."""
    space = stage.space(fixed=KNOWN, prior=NARROW)
    problem = polynomial.problem_over(space)
    starts = polynomial.starts(space)
    np.testing.assert_allclose(
        problem.point(starts[0]), polynomial.problem.point(polynomial.optima[0]), atol=1e-9
    )
    around = neighbouring_materials(problem, starts, 8)
    assert len(around) == len(starts) * 9
    found = [m["lamination"].hooke.matrix[5, 5] for m in around]
    assert max(found) / min(found) < 1.2


def test_a_mode_that_is_lost_somewhere_has_no_surface(laboratory):
    lab = laboratory
    points = full_factorial(2, 0)
    solved = lab.at(points)
    spoilt = [None if i == 4 else found for i, found in enumerate(solved)]
    spoilt[0] = {key: mode for key, mode in solved[0].items() if key != (3, 1, 0)}
    surfaces = fit_surfaces(lab.cube, points, spoilt, fit_polynomial)
    assert (3, 1, 0) not in surfaces.keys and (2, 0, 0) in surfaces.keys
    with pytest.raises(IdentificationError, match="no mode keeps its name"):
        fit_surfaces(lab.cube, points, [{} for _ in points], fit_polynomial)
    with pytest.raises(IdentificationError, match="no material exists"):
        fit_surfaces(lab.cube, points, [None for _ in points], fit_polynomial)

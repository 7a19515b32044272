"""Materials that a reduced basis is trained on."""

import numpy as np
import pytest
import synthetic_stage as stage

from statorhom.errors import MaterialError
from statorhom.identify.bases.training import neighbouring_materials, training_materials
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace


def moduli(materials):
    return np.array([1 / m["lamination"].hooke.compliance[0, 0] for m in materials])


def test_the_prior_mean_comes_first_and_the_rest_spreads_like_the_prior():
    space = stage.space()
    found = training_materials(space, stage.LAMINATION, 128)
    centre = stage.LAMINATION.of(space.values(space.start))
    np.testing.assert_allclose(found[0]["lamination"].hooke.matrix, centre["lamination"].hooke.matrix)
    e = moduli(found)
    prior = next(p for p in space.parameters if p.name == "lamination.E_p_pa")
    inside = np.mean((e > prior.low90) & (e < prior.high90))
    assert 0.85 < inside < 0.97
    assert e.min() < prior.low90
    assert e.max() > prior.high90


def test_the_same_materials_every_time():
    one, two = (moduli(training_materials(stage.space(), stage.LAMINATION, 16)) for _ in range(2))
    np.testing.assert_array_equal(one, two)


def test_machines_that_differ_by_their_weights_are_trained_on_the_same():
    def densities(density):
        known = Parameter.constant("lamination.density_kg_m3", density)
        parameters = [known if p.name == known.name else p for p in stage.space().parameters]
        found = training_materials(ParameterSpace(tuple(parameters)), stage.LAMINATION, 8)
        return {m["lamination"].density for m in found}

    (lighter,), (heavier,) = densities(7650.0), densities(7800.0)
    assert lighter == heavier
    # the band of the heavier one has more modes in it
    assert 7800.0 <= heavier <= 1.1 * 7800.0


def test_a_space_without_freedom_has_one_material():
    fixed = ParameterSpace(tuple(Parameter.constant(n, v) for n, v in stage.TRUTH.items()))
    assert len(training_materials(fixed, stage.LAMINATION, 64)) == 1


def test_impossible_materials_are_left_out():
    class Picky:
        calls = 0

        def of(self, values):
            self.calls += 1
            if self.calls % 2 == 0:
                raise MaterialError("no material has these constants")
            return stage.LAMINATION.of(values)

    picky = Picky()
    found = training_materials(stage.space(), picky, 16)
    assert picky.calls == 17
    assert len(found) == 9


def test_around_an_optimum_lies_what_the_modes_leave_open():
    problem = stage.problem()
    x = problem.space.internal(stage.TRUTH)
    found = neighbouring_materials(problem, [x], 32)
    assert len(found) == 33
    e, g = moduli(found), np.array([m["lamination"].hooke.matrix[3, 3] for m in found])
    assert e[0] == pytest.approx(stage.TRUTH["lamination.E_p_pa"])
    prior = moduli(training_materials(stage.space(), stage.LAMINATION, 32))
    assert np.ptp(np.log(e)) < 0.3 * np.ptp(np.log(prior))
    assert g.min() < stage.TRUTH["lamination.G_rz_pa"] < g.max()


def test_around_several_optima_the_best_comes_first():
    problem = stage.problem()
    x = problem.space.internal(stage.TRUTH)
    other = problem.space.internal(stage.TRUTH | {"lamination.E_p_pa": 200e9})
    found = moduli(neighbouring_materials(problem, [other, x], 8))
    assert len(found) == 18
    np.testing.assert_allclose(found[:2], [200e9, stage.TRUTH["lamination.E_p_pa"]])

"""Sensitivities against an independent model, and what they say of the constants."""

import numpy as np
import pytest
import synthetic_stage as stage

from example_stators import stator
from statorhom.identify.residuals.sensitivity import mode_name, sensitivity, unreached_statement
from statorhom.mesh import MeshDensity, mesh_step, uniform
from statorhom.model.affine import assemble
from statorhom.model.harmonic import problems_of
from statorhom.model.reduced import material_box, reduce_harmonic
from statorhom.model.reduced_stator import reduced_stator

PAPER = stage.TRUTH | {
    "lamination.E_p_pa": 182e9,
    "lamination.E_z_pa": 100e9,
    "lamination.nu_p": 0.29,
    "lamination.nu_pz": 0.31,
    "lamination.G_rz_pa": 25e9,
}
# physics.md §4 of the project's specification: E_p, E_z, nu_pz, G_rz, computed with another model
EXPECTED = {
    "(2, 0)": (0.479, 0.019, 0.044, 0.002),
    "(2, 1)": (0.274, 0.008, 0.021, 0.217),
    "(3, 1)": (0.360, 0.011, 0.028, 0.129),
    "(4, 1)": (0.406, 0.014, 0.034, 0.080),
    "(1, 1)": (0.136, 0.002, 0.005, 0.362),
}


def paper_machine(names, top_hz):
    cells = dict(uniform(1).cells) | {"slot": 2, "radial": 3, "core": 3, "yoke": 2}
    model = assemble(mesh_step(stator().step(("stack",)), MeshDensity(cells)))
    materials = stage.LAMINATION.of(PAPER)
    box = material_box([materials], model.mesh.regions)
    problems = [reduce_harmonic(model, h, box, top_hz) for h in problems_of(model.mesh, names)]
    return reduced_stator(model, box, problems, top_hz, materials).solve(materials)


@pytest.fixture(scope="module")
def solution():
    return paper_machine({(1, 1), (2, 0), (2, 1), (3, 1), (4, 1)}, 11000.0)


def test_the_paper_s_machine(solution):
    matrix = sensitivity(solution, stage.LAMINATION, PAPER)
    columns = [matrix.constants.index(f"lamination.{c}") for c in ("E_p_pa", "E_z_pa", "nu_pz", "G_rz_pa")]
    for name, expected in EXPECTED.items():
        found = np.abs(matrix.values[matrix.modes.index(name), columns])
        np.testing.assert_allclose(found, expected, atol=0.012, err_msg=name)


def test_all_moduli_together_and_the_density_are_worth_half(solution):
    matrix = sensitivity(solution, stage.LAMINATION, PAPER)
    moduli = [matrix.constants.index(f"lamination.{c}") for c in ("E_p_pa", "E_z_pa", "G_rz_pa")]
    density = matrix.constants.index("lamination.density_kg_m3")
    np.testing.assert_allclose(matrix.values[:, moduli].sum(axis=1), 0.5, atol=1e-6)
    np.testing.assert_allclose(matrix.values[:, density], -0.5, atol=1e-6)


def test_constants_that_no_mode_reaches_are_named(solution):
    matrix = sensitivity(solution, stage.LAMINATION, PAPER, keys=[(2, 0, 0), (9, 9, 0)])
    assert matrix.modes == ("(2, 0)",)
    out = matrix.out_of_reach()
    assert "lamination.nu_p" in out
    assert "lamination.G_rz_pa" in out
    assert "lamination.E_p_pa" not in out
    # over decades even a small sensitivity is felt
    assert "lamination.G_rz_pa" not in matrix.out_of_reach({"lamination.G_rz_pa": np.log(100.0)})
    assert matrix.strongest("lamination.E_p_pa") == "(2, 0)"
    statement = unreached_statement(out)
    assert "lamination.nu_p or lamination.G_rz_pa" in statement
    assert "E_p" not in statement


def test_without_modes_nothing_is_reached(solution):
    matrix = sensitivity(solution, stage.LAMINATION, PAPER, keys=[])
    assert matrix.values.shape == (0, 6)
    assert set(matrix.out_of_reach()) == set(matrix.constants)
    assert matrix.strongest("lamination.nu_p") is None


def test_names_and_statements():
    assert mode_name((3, 1, 0)) == "(3, 1)"
    assert mode_name((3, 1, 2)) == "(3, 1)''"
    assert unreached_statement(()) == ""
    assert unreached_statement(["winding.density_kg_m3"]) == ""
    assert "depends on winding.nu_p:" in unreached_statement(["winding.nu_p"])

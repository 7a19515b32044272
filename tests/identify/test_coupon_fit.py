"""Coupons from their files to their materials."""

from __future__ import annotations

from pathlib import Path

import pytest

from command import statorhom
from coupon_study import (
    BEAM,
    PLATE,
    SIZE_M,
    TUBE,
    block_frequencies,
    study_text,
    table_text,
    write_hits,
    write_study,
)
from statorhom.api import Study
from statorhom.geometry.block import BlockGeometry
from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.chain import chain
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import stage_setup
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.model.affine import Material
from statorhom.results import Constant, RegionResult
from statorhom.simulate import simulate_study
from statorhom.study.study import load_study

ALUMINIUM = Isotropic(70e9, 0.33)
LAMINATE = Orthotropic(42e9, 12e9, 10e9, 0.27, 0.3, 0.35, 4.6e9, 4.2e9, 3.8e9)
STACK = TransverselyIsotropic(150e9, 40e9, 0.28, 0.25, 12e9)
TABLE = 'modal_table = "free.csv"'
BEAM_M = (0.24, 0.024, 0.016)
ALUMINIUM_KG = 2700.0 * 0.24 * 0.024 * 0.016


def hits_of_a_plate(folder: Path, material: Material) -> str:
    """Files of hammer hits on a plate; what a study says of them."""
    names = write_hits(
        folder,
        BlockGeometry("plate", SIZE_M, "truth"),
        material,
        hammer_m=(0.012, 0.02, 0.004),
        response_m=(0.285, 0.015, 0.004),
        highest_hz=5000.0,
    )
    listed = ", ".join(f'"{name}"' for name in names)
    return (
        f'hits = [{listed}]\nhammer_mm = [12.0, 20.0, 4.0]\nresponse_mm = [285.0, 15.0, 4.0]\ndirection = "z"'
    )


def engineering(region: RegionResult) -> dict[str, Constant]:
    return dict(region.engineering)


def test_labels_of_a_block_are_left_out_and_its_density_is_its_weight(tmp_path: Path) -> None:
    (tmp_path / "free.csv").write_text("frequency_hz,order,axial\n200.0,2,0\n", encoding="utf-8")
    files = load_study(write_study(tmp_path, PLATE, study_text("plate", "orthotropic", 0.4536, TABLE)))
    setup = stage_setup(files, object_geometry(files.drawing, files.geometry_path), 0)
    assert [(mode.order, mode.axial) for mode in setup.fitted] == [(None, None)]
    assert setup.densities["plate"].density_kg_m3 == pytest.approx(1890.0)
    assert setup.materials.constants["plate"][0] == "E_1_pa"


def test_a_tube_keeps_its_labels(tmp_path: Path) -> None:
    (tmp_path / "free.csv").write_text("frequency_hz,order,axial\n900.0,2,0\n", encoding="utf-8")
    files = load_study(write_study(tmp_path, TUBE, study_text("tube", "isotropic", 1.4, TABLE)))
    setup = stage_setup(files, object_geometry(files.drawing, files.geometry_path), 0)
    assert [(mode.order, mode.axial) for mode in setup.fitted] == [(2, 0)]
    assert setup.step is not None and setup.step.regions == ("tube",)


def test_a_beam_is_simulated_and_identified_from_its_table(tmp_path: Path) -> None:
    material = Material(ALUMINIUM.hooke(), 2700.0)
    frequencies = block_frequencies("beam", BEAM_M, material, 7500.0, 1.0)
    (tmp_path / "free.csv").write_text(table_text(frequencies, 1e-4, 1), encoding="utf-8")
    identify = "evaluations = 60\nchains = 1\nprior.beam.E_pa = { low = 4e10, high = 1.2e11 }"
    path = write_study(tmp_path, BEAM, study_text("beam", "isotropic", ALUMINIUM_KG, TABLE, identify))
    _, table = simulate_study(path, None, tmp_path / "simulated")
    assert len(table) >= len(frequencies) and table["order"].isna().all()

    results = chain(load_study(path), tmp_path / "out", Settings(refinements=(1.0,))).run()
    stage = results.stages[0]
    E = stage.regions["beam"].engineering["E_pa"]
    assert E.status == "identified"
    # the one mesh has an error of its own, which the interval holds
    assert E.value == pytest.approx(ALUMINIUM.E_pa, rel=0.03)
    assert stage.regions["beam"].loss_factor is not None
    assert stage.regions["beam"].loss_factor.value == pytest.approx(0.008, rel=0.1)
    assert {m.role for m in stage.modes if m.measured_hz is not None} == {"fitted"}
    kinds = {"bending along y (2, 0)", "bending along z (2, 0)", "torsion about x (1, 1)"}
    assert {m.kind for m in stage.modes} >= kinds
    assert all(m.order is None and m.axial is None for m in stage.modes)
    assert results.geometry["height_mm"] == pytest.approx(16.0)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_all_nine_constants_of_a_plate_from_fifteen_noisy_modes(tmp_path: Path, seed: int) -> None:
    """What the modes determine lies within 3 % of the truth, the rest is said to be the prior's."""
    material = Material(LAMINATE.hooke(), 1890.0)
    frequencies = block_frequencies("plate", SIZE_M, material, 1500.0, 2.5)[:15]
    (tmp_path / "free.csv").write_text(table_text(frequencies, 1e-3, seed), encoding="utf-8")
    path = write_study(
        tmp_path, PLATE, study_text("plate", "orthotropic", 1890.0 * 2.4e-4, TABLE, "evaluations = 400")
    )
    results = Study.load(path).run(tmp_path / "out", seed=seed, jobs=2)
    stage = results.stages[0]
    found = engineering(stage.regions["plate"])
    assert {"E_1_pa", "E_2_pa", "G_12_pa"} <= {n for n, c in found.items() if c.status == "identified"}
    for name, constant in found.items():
        true = getattr(LAMINATE, name.translate(str.maketrans("123", "rtz")))
        if constant.status == "identified":
            assert constant.value == pytest.approx(true, rel=0.03), name
        assert constant.ci90[0] * 0.97 < true < constant.ci90[1] * 1.03, name
    assert all(m.role == "fitted" for m in stage.modes if m.measured_hz is not None)
    assert (tmp_path / "out" / "report.html").exists() and (tmp_path / "out" / "report.pdf").exists()


@pytest.mark.slow
def test_from_raw_hits_to_the_material_in_one_command(tmp_path: Path) -> None:
    material = Material(ALUMINIUM.hooke(), 2700.0)
    test = hits_of_a_plate(tmp_path, material)
    mass = 2700.0 * SIZE_M[0] * SIZE_M[1] * SIZE_M[2]
    path = write_study(tmp_path, PLATE, study_text("plate", "isotropic", mass, test, "evaluations = 400"))
    stage = Study.load(path).run(tmp_path / "out", jobs=2).stages[0]
    found = engineering(stage.regions["plate"])
    assert found["E_pa"].status == "identified"
    assert found["E_pa"].value == pytest.approx(ALUMINIUM.E_pa, rel=0.01)
    assert found["nu"].value == pytest.approx(ALUMINIUM.nu, abs=0.02)
    assert stage.regions["plate"].loss_factor is not None
    assert stage.regions["plate"].loss_factor.value == pytest.approx(0.008, rel=0.1)


@pytest.mark.slow
def test_from_raw_hits_to_an_orthotropic_material_in_one_command(tmp_path: Path) -> None:
    test = hits_of_a_plate(tmp_path, Material(LAMINATE.hooke(), 1890.0))
    text = study_text("plate", "orthotropic", 1890.0 * 2.4e-4, test, "evaluations = 400")
    out = tmp_path / "out"
    done = statorhom("run", write_study(tmp_path, PLATE, text), "--out", out, "--jobs", 2)
    assert done.code == 0, done.stderr
    stage = Study.read(out).stages[0]
    found = engineering(stage.regions["plate"])
    assert {"E_1_pa", "E_2_pa", "G_12_pa"} <= {n for n, c in found.items() if c.status == "identified"}
    for name, constant in found.items():
        true = getattr(LAMINATE, name.translate(str.maketrans("123", "rtz")))
        if constant.status == "identified":
            assert constant.value == pytest.approx(true, rel=0.03), name
        assert constant.ci90[0] * 0.97 < true < constant.ci90[1] * 1.03, name


@pytest.mark.slow
def test_a_stacked_beam_tells_what_its_bending_depends_on(tmp_path: Path) -> None:
    material = Material(STACK.hooke(), 7600.0)
    frequencies = block_frequencies("beam", BEAM_M, material, 12000.0, 1.5)
    (tmp_path / "free.csv").write_text(table_text(frequencies, 1e-3, 1), encoding="utf-8")
    mass = 7600.0 * BEAM_M[0] * BEAM_M[1] * BEAM_M[2]
    text = study_text("beam", "transversely_isotropic", mass, TABLE, "evaluations = 400")
    stage = Study.load(write_study(tmp_path, BEAM, text)).fit(tmp_path / "out", jobs=2).stages[0]
    found = engineering(stage.regions["beam"])
    assert found["E_p_pa"].status == "identified"
    assert found["E_p_pa"].value == pytest.approx(STACK.E_p_pa, rel=0.03)
    for name, constant in found.items():
        if constant.status == "identified":
            assert constant.value == pytest.approx(getattr(STACK, name), rel=0.03), name

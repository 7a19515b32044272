from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from cheap_study import append, coarse, edit, write_study
from statorhom.geometry.stator import stator_geometry
from statorhom.identify.chain import chain
from statorhom.identify.fits.priors import Carried
from statorhom.identify.results.stage_result import mass_only
from statorhom.identify.stages.stage_setup import StageSetup, stage_setup
from statorhom.materials.isotropic import Isotropic
from statorhom.results.schema import StageResult
from statorhom.study.study import load_study


def setup(path: Path, index: int) -> StageSetup:
    files = load_study(path)
    return stage_setup(files, stator_geometry(files.geometry, files.geometry_path), index)


@pytest.fixture(scope="module")
def stack(tmp_path_factory: pytest.TempPathFactory) -> StageResult:
    """A stage with a held-out mode and one that no simulated mode explains."""
    root = tmp_path_factory.mktemp("stack")
    study = write_study(root)
    append(root / "stack.csv", "1500,0.004,2,0\n")
    edit(study, '"stack.csv"', '"stack.csv"\nhold_out = [2, 3]')
    return chain(load_study(study), root / "out", coarse()).run(0).stages[0]


def test_hooke_matrix_is_that_of_the_constants(stack: StageResult) -> None:
    region = stack.regions["lamination"]
    e, nu = (region.engineering[name].value for name in ("E_pa", "nu"))
    np.testing.assert_allclose(region.hooke_pa, Isotropic(e, nu).hooke().matrix, rtol=1e-6, atol=1.0)


def test_values_lie_inside_their_intervals(stack: StageResult) -> None:
    for constant in stack.regions["lamination"].engineering.values():
        assert constant.ci90[0] <= constant.value <= constant.ci90[1]


def test_density_is_mass_over_volume(stack: StageResult) -> None:
    region = stack.regions["lamination"]
    assert region.density_kg_m3 == pytest.approx(2.313 / region.volume_m3)
    assert region.density_sd_kg_m3 == pytest.approx(0.005 / region.volume_m3)


def test_every_measured_mode_has_its_role(stack: StageResult) -> None:
    roles = {mode.measured_hz: mode.role for mode in stack.modes if mode.measured_hz is not None}
    assert roles == {3090.0: "fitted", 4590.0: "held_out", 1500.0: "unmatched"}
    assert any("1500 Hz has no simulated partner" in warning for warning in stack.warnings)


def test_errors_are_simulated_over_measured(stack: StageResult) -> None:
    paired = [mode for mode in stack.modes if mode.error_percent is not None]
    assert len(paired) == 2
    for mode in paired:
        assert mode.simulated_hz is not None and mode.measured_hz is not None
        assert mode.error_percent == pytest.approx(100 * (mode.simulated_hz / mode.measured_hz - 1))
    assert stack.fit is not None
    assert stack.fit.max_percent == pytest.approx(abs(paired[0].error_percent or 0.0))
    assert stack.fit.held_out_rms_percent == pytest.approx(abs(paired[1].error_percent or 0.0))


def test_finer_meshes_are_softer(stack: StageResult) -> None:
    assert stack.convergence
    for series in stack.convergence:
        assert list(series.dof) == sorted(series.dof)
        assert series.extrapolated_hz < series.frequency_hz[-1] < series.frequency_hz[0]


def test_the_fitting_mesh_alone_would_take_less_modulus(stack: StageResult) -> None:
    assert stack.fit is not None
    plain = stack.fit.without_mesh_correction["lamination.E_pa"]
    assert plain < stack.regions["lamination"].engineering["E_pa"].value


def test_what_it_hands_on_comes_back(stack: StageResult) -> None:
    carried = Carried.from_state(stack.carried)
    assert carried.block is not None
    assert "mesh" not in carried.block.names
    assert {p.name for p in carried.parameters} == {
        "lamination.E_pa",
        "lamination.nu",
        "lamination.density_kg_m3",
    }
    assert carried.state() == stack.carried


def test_a_weight_alone(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    result = mass_only(setup(study, 1), 2.313, {})
    assert set(result.regions) == {"frame"}
    assert result.added_mass_kg == pytest.approx(0.252)
    assert result.regions["frame"].engineering == {}
    assert result.modes == () and result.fit is None and result.warnings == ()


def test_a_density_that_no_material_has_is_a_warning(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    edit(study, "2.565", "5.565")
    (warning,) = mass_only(setup(study, 1), 2.313, {}).warnings
    assert "frame" in warning and "kg/m" in warning

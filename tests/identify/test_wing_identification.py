"""A wing like the printed ones (span, plies, E and G; 3 kg): a concealed truth on a finer mesh, found again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from identification_methods import WING, run


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Any]]:
    """Figures of both methods."""
    return {
        method: run(WING, method, Path(tmp_path_factory.mktemp(method)))
        for method in ("response_surface", "annealing")
    }


@pytest.mark.slow
@pytest.mark.parametrize("method", ["response_surface", "annealing"])
def test_E_and_G_of_the_cloth_are_found_again(found: dict[str, dict[str, Any]], method: str) -> None:
    figures = found[method]
    assert set(figures["errors"]) == {"E_1_pa", "G_12_pa"}
    assert max(abs(error) for error in figures["errors"].values()) < 3.0
    assert figures["max_percent"] < 2.0
    stage = figures["results"].stages[0]
    cloth = stage.regions["cbx90"].engineering
    assert cloth["E_1_pa"] == cloth["E_2_pa"]
    assert {cloth[name].status for name in ("E_1_pa", "G_12_pa")} == {"identified"}
    assert {mode.role for mode in stage.modes if mode.measured_hz is not None} == {"fitted"}


@pytest.mark.slow
def test_the_reduced_basis_takes_a_tenth_of_the_full_solves(found: dict[str, dict[str, Any]]) -> None:
    surface, annealing = (found[method]["full_solves"] for method in ("response_surface", "annealing"))
    assert annealing <= 0.1 * surface

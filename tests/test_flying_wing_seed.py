"""Every printed figure of the flying wing's ground vibration test that follows from others, recomputed.

The printed figures are those of `shared/seeds/flying-wing-gvt.txt`; where one does not follow from its table, the
test says so.
"""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.model.mesh_study import MeshStudy, mesh_study
from statorhom.model.suspension import Cord, suspend
from statorhom.modes.mac_table import difference
from statorhom.recordings.estimation.sweep_plan import SweepStage, highest_rate_hz_per_s

EXPERIMENT_HZ = [50.3, 111.9, 125.0]
SIMULATION_HZ = [60.4, 97.8, 138.0]
SPAN_M, MASS_KG = 1.9, 3.0
MESH_MM = [8.0, 6.0, 4.0]
MESH_HZ = [[60.4, 97.8, 138.0], [60.3, 97.3, 137.5], [60.1, 97.0, 137.1]]
SECONDS = [55.0, 109.0, 204.0]
PRINTED_HALF = 0.05  # Hz: half of the last printed digit


@pytest.fixture(scope="module")
def study() -> MeshStudy:
    return mesh_study(MESH_MM, MESH_HZ, SECONDS)


def test_differences_of_table_3() -> None:
    percent = 100 * np.abs(difference(SIMULATION_HZ, EXPERIMENT_HZ))
    assert np.round(percent[0], 2) == 20.08
    assert np.round(percent[1:], 1).tolist() == [12.6, 10.4]
    # the abstract's range, from the smallest to the largest
    assert (np.round(percent.min(), 1), np.round(percent.max(), 1)) == (10.4, 20.1)


def test_the_signs_that_the_table_does_not_print() -> None:
    """The text calls the model too stiff throughout ("higher … for selected modes"); the second bending is too soft."""
    assert np.sign(difference(SIMULATION_HZ, EXPERIMENT_HZ)).tolist() == [1.0, -1.0, 1.0]


def test_the_suspension_of_2_hz() -> None:
    """Four cords of 100 N/m and 3 kg: 1.84 Hz, which the text rounds to "about 2 Hz"."""
    corners = [Cord((x, y, 0.0), 100.0) for x in (-0.4, 0.4) for y in (-0.1, 0.1)]
    found = suspend(corners, MASS_KG)
    heave = found.frequency_hz[found.names.index("along z")]
    assert sum(cord.stiffness_n_per_m for cord in corners) == 400.0
    assert heave == pytest.approx(np.sqrt(400.0 / MASS_KG) / (2 * np.pi))
    assert heave == pytest.approx(1.84, abs=0.005) and round(heave) == 2
    # of the heave that can be said: 4 % of the first bending mode. Where the cords hold is not printed
    assert heave / EXPERIMENT_HZ[0] < 0.04


def test_cords_anywhere_within_the_span_are_soft_enough() -> None:
    """Roll about the chord with the mass spread evenly along the span and the cords as far out as they can be."""
    inertia = (MASS_KG * SPAN_M**2 / 12, MASS_KG * 0.3**2 / 12, MASS_KG * SPAN_M**2 / 12)
    tips = [Cord((x, y, 0.0), 100.0) for x in (-0.15, 0.15) for y in (-SPAN_M / 2, SPAN_M / 2)]
    found = suspend(tips, MASS_KG, inertia)
    assert found.frequency_hz[-1] < 3.3
    assert "as good as free" in found.verdict(EXPERIMENT_HZ[0])


def test_the_two_sweeps() -> None:
    low, high = SweepStage(0.0, 40.0, 1.0), SweepStage(40.0, 220.0, 5.0)
    assert (low.duration_s, high.duration_s) == (40.0, 36.0)
    # about 90 excitation cycles of both are two hours of shaking
    assert 94 * (low.duration_s + high.duration_s) / 3600 == pytest.approx(2.0, abs=0.02)
    # ISO 7626-2: 5 Hz/s shows the steady state of the first bending mode from 2.3 % damping on
    damping = np.sqrt(5.0 / highest_rate_hz_per_s(EXPERIMENT_HZ[0], 1.0))
    assert damping == pytest.approx(0.0234, abs=1e-4)


def test_the_spectra() -> None:
    """10 kHz and 0.5 Hz make 10 000 lines; but the frequencies of Table 3 are no multiples of 0.5 Hz."""
    assert 10_000 / 0.5 / 2 == 10_000
    off = [frequency % 0.5 for frequency in EXPERIMENT_HZ]
    # 50.3 and 111.9 Hz lie between the lines: they were fitted, or the lines were closer than printed
    assert np.round(off, 1).tolist() == [0.3, 0.4, 0.0]


def test_the_elements_of_figure_2() -> None:
    assert 37_268 + 205_041 == 242_309


def test_table_4_falls_with_the_mesh(study: MeshStudy) -> None:
    assert study.size.tolist() == MESH_MM
    assert np.all(study.change < 0)
    assert study.frequency_hz[0].tolist() == SIMULATION_HZ
    assert 1.8 < (study.cost_order or 0.0) < 2.0


def test_variations_below_half_a_percent_do_not_follow_from_table_4(study: MeshStudy) -> None:
    """From 8 to 4 mm the modes fall by 0.50, 0.82 and 0.65 %; "approximately 0.5 %" holds from mesh to mesh only."""
    total = 100 * np.abs(study.total_change)
    assert np.round(total, 2).tolist() == [0.5, 0.82, 0.65]
    assert 100 * np.abs(study.change).max() == pytest.approx(0.51, abs=0.005)


def test_the_extrapolated_error_that_table_4_does_not_print(study: MeshStudy) -> None:
    """The 8 mm mesh of the comparison is 1.0 % too stiff: small beside differences of 10 … 20 %."""
    error = 100 * study.error[0]
    np.testing.assert_allclose(error, 1.0, atol=0.05)
    assert np.all(study.extrapolated_hz < MESH_HZ[-1])
    assert np.all(error < 100 * np.abs(difference(SIMULATION_HZ, EXPERIMENT_HZ)) / 4)
    # digits printed to 0.1 Hz bound what the table can tell of the limit
    assert np.all(study.sd_hz > PRINTED_HALF)

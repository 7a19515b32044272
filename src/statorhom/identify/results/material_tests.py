"""Identified constants against mechanical tests of samples, and the frequencies that the tests' values would give."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from statorhom.identify.comparison.mode_results import shared_shift, simulated_modes
from statorhom.identify.fits.stage_run import StageRun
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.residuals.sensitivity import mode_name
from statorhom.identify.residuals.stage_problem import corrected, pair_modes
from statorhom.modes.mac_table import difference
from statorhom.results.schema import MaterialTest, RegionResult, TestedFrequency
from statorhom.study.material_tests import MaterialTestKeys


def difference_percent(found: ArrayLike, reference: ArrayLike) -> Array:
    """|found − reference| / reference in per cent: the seeds' equations (11) and (13)."""
    return 100.0 * np.abs(difference(found, reference))


def material_test_results(
    tests: Sequence[MaterialTestKeys], regions: Mapping[str, RegionResult]
) -> tuple[MaterialTest, ...]:
    """Every test beside the identified constant, in the order of the study."""
    found = []
    for test in tests:
        constant = regions[test.region].engineering[test.constant]
        found.append(
            MaterialTest(
                name=test.name,
                region=test.region,
                constant=test.constant,
                value=test.value,
                low=test.low,
                high=test.high,
                identified=constant,
                difference_percent=float(difference_percent(constant.value, test.value)),
            )
        )
    return tuple(found)


def tested_frequencies(run: StageRun) -> tuple[TestedFrequency, ...]:
    """Fitted modes as measured, as identified, and as the mean values of the tests would have them."""
    if run.at_tests is None:
        return ()
    simulated = simulated_modes(run)
    tested = corrected(run.at_tests.modes, run.error, shared_shift(run))
    by_key = {mode.key: mode.frequency_hz for mode in tested if mode.key is not None}
    rows = []
    for pair in pair_modes(run.setup.fitted, simulated).pairs:
        measured, partner = run.setup.fitted[pair.measured], simulated[pair.simulated]
        if partner.key is None or partner.key not in by_key:
            continue
        f = by_key[partner.key]
        rows.append(
            TestedFrequency(
                mode=mode_name(partner.key),
                measured_hz=measured.frequency_hz,
                identified_hz=partner.frequency_hz,
                tests_hz=f,
                identified_percent=float(difference_percent(partner.frequency_hz, measured.frequency_hz)),
                tests_percent=float(difference_percent(f, measured.frequency_hz)),
            )
        )
    return tuple(sorted(rows, key=lambda row: row.measured_hz))

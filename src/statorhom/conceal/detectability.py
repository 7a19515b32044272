"""How much an effect leaves behind that no refit of the declared model's constants explains.

Frequencies only, so that it is the least that a diagnosis has: r = ln(f true / f declared) of all free tests, of the
modes that a table lists or FRFs show, whitened by the noise of the frequencies and the mesh's uncertainty, which both
modes of a name share, after a refit of the declared constants of all stages (physics.md §7.4, repeated until nothing
more is absorbed). The projected signal-to-noise is the norm of what is left. Supported tests add their plain errors,
a heavy accelerometer the differences of the poles.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from statorhom.conceal.absorbed import FREQUENCY_SD, MESH_SD, Misfit, absorbed
from statorhom.conceal.declared_residual import Residual, declared_test
from statorhom.conceal.measure_case import Measured, pressed
from statorhom.conceal.sensors import PLANES
from statorhom.conceal.truth import Case
from statorhom.mesh import MeshDensity
from statorhom.model.broken.solve import solve_broken
from statorhom.study.supports import LineSupport

AROUND = 24  # angles at which a plane's poles are averaged


def detectability(case: Case, tests: Sequence[Measured], density: MeshDensity | None) -> dict[str, Any]:
    """What each test leaves behind, and all of them together as `projected_snr`.

    Parameters
    ----------
    case, tests : the truth and its measurements.
    density : of the true stator's mesh; None: what is usual of the step.
    """
    declared = [d for measured in tests if (d := declared_test(case, measured, density)) is not None]
    found, total = _left(absorbed(declared))
    for measured in tests:
        test = case.stages[measured.stage].tests[measured.test]
        entry = {}
        if test.elastic is not None:
            entry = _supported(measured, test.elastic.lines)
        elif test.sensor_mass_kg:
            entry = _loaded(measured, test.sensor_mass_kg)
        if entry:
            found[test.name] = {**found.get(test.name, {}), **entry}
            total = float(np.hypot(total, entry["projected_snr"]))
    return {**found, "projected_snr": total}


def _left(misfit: Misfit | None) -> tuple[dict[str, Any], float]:
    """What the refit of all constants leaves in every test, and its norm in standard deviations."""
    if misfit is None:
        return {}, 0.0
    left, found, first = misfit.left, {}, 0
    for residual in misfit.residuals:
        part = left[first : first + len(residual.values)]
        found[residual.test] = _entry(residual, part)
        first += len(part)
    return found, misfit.left_sd


def _entry(residual: Residual, left: np.ndarray) -> dict[str, Any]:
    worst = int(np.abs(left).argmax())
    return {
        "worst_percent": 100 * float(np.abs(left[worst])),
        "worst_mode": list(residual.keys[residual.owner[worst]][:2]),
        "rms_percent": 100 * float(np.sqrt(np.mean(left**2))),
        "modes_compared": len(left),
    }


def _supported(measured: Measured, lines: LineSupport) -> dict[str, Any]:
    """Error of rigid lines against the elastic truth, mode by mode in the order of frequency."""
    ground = measured.ritz.ground
    rigid = solve_broken(ground.basis, [pressed(ground, lines)], None).frequencies_hz
    true = np.array([mode.frequency_hz for mode in measured.modes])
    count = min(len(rigid), len(true))
    error = np.log(rigid[:count] / true[:count])
    worst = int(np.abs(error).argmax())
    return {
        "worst_percent": 100 * float(np.abs(error[worst])),
        "worst_mode": float(true[worst]),
        "definition": "rigid lines against the elastic truth with the true material",
        "projected_snr": float(np.linalg.norm(error / np.hypot(FREQUENCY_SD, MESH_SD))),
    }


def _loaded(measured: Measured, sensor_kg: float) -> dict[str, Any]:
    """First-order shifts of the poles by plane; their mean is absorbed by the modulus."""
    ritz = measured.ritz
    seen = [i for i, mode in enumerate(measured.modes) if mode.is_visible]
    length = ritz.ground.mesh.length
    angles = np.tile(2 * np.pi * np.arange(AROUND) / AROUND, len(PLANES))
    motion = ritz.motion(angles, np.repeat(np.array(PLANES) * length, AROUND))[..., ritz.in_band[seen]]
    shift = -0.5 * sensor_kg * np.sum(motion**2, axis=1).reshape(len(PLANES), AROUND, -1)
    planes = shift.mean(axis=1)
    deviation = planes - planes.mean(axis=0)
    return {
        "worst_percent": 100 * float(np.ptp(planes, axis=0).max()),
        "definition": "largest difference of a pole between sensor planes, first order",
        "projected_snr": float(np.linalg.norm(deviation / FREQUENCY_SD)),
    }

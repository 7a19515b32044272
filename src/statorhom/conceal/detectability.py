"""How much an effect leaves behind that no refit of the declared model's constants explains.

Frequencies only, so that it is the least that a diagnosis has: r = ln(f true / f declared) of all free tests, of the
modes that a table lists or FRFs show, whitened by the noise of the frequencies and the mesh's uncertainty, which both
modes of a name share, and projected onto what no combination of the declared constants of all stages can do (physics.md
§7.4). The projected signal-to-noise is the norm of what is left. Supported tests add their plain errors, a heavy
accelerometer the differences of the poles.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from statorhom.conceal.declared_stage import Key, declared_stage
from statorhom.conceal.listed import ListedMode
from statorhom.conceal.measure_case import Measured, pressed
from statorhom.conceal.sensors import PLANES
from statorhom.conceal.tables import relabelled
from statorhom.conceal.truth import Case
from statorhom.errors import StatorhomError
from statorhom.mesh import MeshDensity
from statorhom.model.broken.solve import solve_broken
from statorhom.study.supports import LineSupport

FREQUENCY_SD, MESH_SD = (
    3e-4,
    2e-3,
)  # relative: of a measured frequency; of a name's mesh error, after extrapolation
CONSTANT_SD = 0.5  # of a constant's logarithm, before any measurement
AROUND = 24  # angles at which a plane's poles are averaged
WIDEST_SPLIT = 1.08  # two modes of a name that are farther apart are no doublet
REACH = 1.3  # declared modes are sought this much higher than the true ones


@dataclass(frozen=True, eq=False)
class Residual:
    """One free test: ln(f true/f declared), the number of each one's name, and slopes by constant."""

    test: str
    keys: tuple[Key, ...]
    values: np.ndarray
    owner: np.ndarray
    slopes: dict[str, np.ndarray]


def detectability(case: Case, tests: Sequence[Measured], density: MeshDensity | None) -> dict[str, Any]:
    """What each test leaves behind, and all of them together as `projected_snr`.

    Parameters
    ----------
    case, tests : the truth and its measurements.
    density : of the true stator's mesh; None: what is usual of the step.
    """
    residuals = [r for measured in tests if (r := _residual(case, measured, density)) is not None]
    found, total = _projected(residuals)
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


def _residual(case: Case, measured: Measured, density: MeshDensity | None) -> Residual | None:
    test = case.stages[measured.stage].tests[measured.test]
    seen = measured.listed if test.is_table else tuple(m for m in measured.modes if m.is_visible)
    if test.relabelled is not None:
        seen = relabelled(seen, test.relabelled)[0]
    pairs = _by_name(seen)
    if test.declared is not None or not pairs:
        return None
    try:
        declared = declared_stage(case, measured.stage, density)
    except StatorhomError:
        return None  # typed data that no stator can have are seen without any test
    orders = sorted({key[0] for key in pairs})
    modes = declared.modes(orders, REACH * measured.ritz.ground.highest_hz)
    partner = _partners(pairs, {key: mode.frequency_hz for key, mode in modes.named.items()})
    if not partner:
        return None
    keys = tuple(partner.values())
    base = np.array([modes.named[partner[key]].frequency_hz for key in partner for _ in pairs[key]])
    true = np.array([f for key in partner for f in pairs[key]])
    owner = np.array([i for i, key in enumerate(partner) for _ in pairs[key]])
    slopes = {name: column[owner] for name, column in modes.slopes(keys).items()}
    return Residual(test.name, keys, np.log(true / base), owner, slopes)


def _by_name(modes: Sequence[ListedMode]) -> dict[Key, list[float]]:
    """Frequencies by name: one or two of a doublet, then the next one of the same name."""
    found: dict[Key, list[float]] = {}
    counts: dict[tuple[int, int], int] = defaultdict(int)
    for mode in sorted(modes, key=lambda m: m.frequency_hz):
        if mode.order is None or mode.axial is None:
            continue
        name = (mode.order, mode.axial)
        last = found.get((*name, counts[name] - 1))
        if last is not None and len(last) == 1 and mode.frequency_hz < WIDEST_SPLIT * last[0]:
            last.append(mode.frequency_hz)
        else:
            found[*name, counts[name]] = [mode.frequency_hz]
            counts[name] += 1
    return found


def _partners(pairs: Mapping[Key, list[float]], declared: Mapping[Key, float]) -> dict[Key, Key]:
    """The declared mode of the same name that is nearest in frequency; each is taken once."""
    found: dict[Key, Key] = {}
    for key, frequencies in pairs.items():
        free = [other for other in declared if other[:2] == key[:2] and other not in found.values()]
        if free:
            found[key] = min(free, key=lambda other: abs(np.log(declared[other] / frequencies[0])))
    return found


def _projected(residuals: Sequence[Residual]) -> tuple[dict[str, Any], float]:
    """What one refit of all constants leaves in every test, and its norm in standard deviations."""
    if not residuals:
        return {}, 0.0
    values = np.concatenate([r.values for r in residuals])
    names = sorted({name for r in residuals for name in r.slopes})
    slopes = np.vstack(
        [np.column_stack([r.slopes.get(n, np.zeros(len(r.values))) for n in names]) for r in residuals]
    )
    owner = np.concatenate([1000 * i + r.owner for i, r in enumerate(residuals)])
    covariance = FREQUENCY_SD**2 * np.eye(len(values)) + MESH_SD**2 * (owner[:, None] == owner)
    weights = np.linalg.inv(covariance)
    normal = slopes.T @ weights @ slopes + np.eye(len(names)) / CONSTANT_SD**2
    left = values - slopes @ np.linalg.solve(normal, slopes.T @ weights @ values)
    found, first = {}, 0
    for residual in residuals:
        part = left[first : first + len(residual.values)]
        found[residual.test] = _entry(residual, part)
        first += len(part)
    return found, float(np.sqrt(max(left @ weights @ left, 0.0)))


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

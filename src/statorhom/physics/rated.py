"""Modes of a stator whose moduli follow the frequency: where f of the moduli at f is f itself."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import TypeVar

import numpy as np

from statorhom.materials.hooke import Hooke
from statorhom.model.affine import Material, Materials
from statorhom.model.stator_mode import StatorMode

_Name = TypeVar("_Name", bound=Hashable)
ITERATIONS = 4  # each leaves about a tenth of the error: frequencies follow moduli slowly
Laws = Mapping[str, Callable[[float], float]]  # region → factor of its stiffness at a frequency (Hz)


def at_rate(materials: Materials, laws: Laws, rate_hz: float) -> Materials:
    """Materials with the stiffness that they have at a frequency."""
    return {
        r: Material(Hooke(laws[r](rate_hz) * m.hooke.matrix), m.density) if r in laws else m
        for r, m in materials.items()
    }


def self_consistent(
    log_rates: np.ndarray, tables: Sequence[Mapping[_Name, StatorMode]]
) -> dict[_Name, float]:
    """ln f of the modes that the tables around it have: those of much softer or stiffer moduli may lie beyond the band.

    Parameters
    ----------
    log_rates : (t,) ln of the frequencies (Hz) whose moduli the tables' modes have, ascending.
    tables : t of them.
    """
    found = {}
    for key in dict.fromkeys(key for table in tables for key in table):
        logs = np.array([np.log(t[key].frequency_hz) if key in t else np.nan for t in tables])
        log_f = _crossing(log_rates, logs)
        if log_f is not None:
            found[key] = log_f
    return found


def _crossing(log_rates: np.ndarray, logs: np.ndarray) -> float | None:
    """Where ln f of the modes at a rate is that rate's; None where a table beside it lacks the mode.

    Beyond the first and the last table moduli count as theirs. Between two of them ln f is the polynomial through these
    and the next ones: a modulus that doubles over a decade bends it by more than what frequencies are known to.
    """
    above = log_rates - logs  # rises
    if above[0] > 0 or above[-1] < 0:
        return float(logs[0] if above[0] > 0 else logs[-1])
    between = np.flatnonzero((above[:-1] <= 0) & (above[1:] >= 0))
    if not len(between):
        return None
    i = int(between[0])
    known = [k for k in (i, i + 1, i - 1, i + 2) if 0 <= k < len(logs) and np.isfinite(logs[k])]
    found = float(np.interp(0.0, above[i : i + 2], logs[i : i + 2]))
    for _ in range(ITERATIONS):
        found = _through(log_rates[known], logs[known], found)
    return found


def _through(x: np.ndarray, y: np.ndarray, at: float) -> float:
    """The polynomial through some points (Lagrange)."""
    weights = [np.prod((at - np.delete(x, k)) / (x[k] - np.delete(x, k))) for k in range(len(x))]
    return float(np.dot(weights, y))

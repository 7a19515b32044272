"""Modes of a stator whose moduli follow the frequency: where f of the moduli at f is f itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from statorhom.materials.hooke import Hooke
from statorhom.model.affine import Material, Materials
from statorhom.model.convergence import ModeKey
from statorhom.model.stator_mode import StatorMode

Laws = Mapping[str, Callable[[float], float]]  # region → factor of its stiffness at a frequency (Hz)


def at_rate(materials: Materials, laws: Laws, rate_hz: float) -> Materials:
    """Materials with the stiffness that they have at a frequency."""
    return {
        r: Material(Hooke(laws[r](rate_hz) * m.hooke.matrix), m.density) if r in laws else m
        for r, m in materials.items()
    }


def self_consistent(
    log_rates: np.ndarray, tables: Sequence[Mapping[ModeKey, StatorMode]]
) -> dict[ModeKey, float]:
    """ln f of the modes that the tables around it have: those of much softer or stiffer moduli may lie beyond the band.

    Parameters
    ----------
    log_rates : (t,) ln of the frequencies (Hz) whose moduli the tables' modes have, ascending.
    tables : t of them.
    """
    found = {}
    for key in dict.fromkeys(key for table in tables for key in table):
        logs = np.array([np.log(t[key].frequency_hz) if key in t else np.nan for t in tables])
        log_f = _crossing(log_rates - logs, logs)
        if log_f is not None:
            found[key] = log_f
    return found


def _crossing(above: np.ndarray, logs: np.ndarray) -> float | None:
    """Where `above`, which rises, is zero, ln f of the modes at its rate; None where a table beside it lacks the mode.

    Beyond the first and the last table moduli count as theirs.
    """
    if above[0] > 0 or above[-1] < 0:
        return float(logs[0] if above[0] > 0 else logs[-1])
    for i in np.flatnonzero((above[:-1] <= 0) & (above[1:] >= 0)).tolist():
        return float(np.interp(0.0, above[i : i + 2], logs[i : i + 2]))
    return None

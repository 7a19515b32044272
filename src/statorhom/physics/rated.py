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
    """ln f of the modes that all tables have.

    Parameters
    ----------
    log_rates : (t,) ln of the frequencies (Hz) whose moduli the tables' modes have, ascending.
    tables : t of them.
    """
    found = {}
    for key in tables[0]:
        if all(key in table for table in tables):
            logs = np.log([table[key].frequency_hz for table in tables])
            # rate - f(rate) rises: it crosses zero once
            found[key] = float(np.interp(0.0, log_rates - logs, logs))
    return found

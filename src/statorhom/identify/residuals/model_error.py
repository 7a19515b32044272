"""What the model itself may be wrong by, beside the measurement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from statorhom.model.broken.named_response import Response
from statorhom.model.convergence import ModeConvergence, ModeKey

# Where a table gives no standard deviation: the resolution and repeatability of a hammer test.
DEFAULT_RELATIVE_SD = 2e-3
# What remains after extrapolation is shared by all modes of a stage: real tooth roots and slot corners (fillets,
# burrs, baked varnish) are stiffer or softer than the model's sharp ones, and every mode feels them as strongly as it
# feels the refinement there. So the pattern is the mesh correction's own, and half of it is its standard deviation.
SHARED_FLOOR = 2e-3
SHARED_PART = 0.5
# What is left of each mode by itself: not every mode follows the pattern.
OWN = 5e-4
OWN_PART = 0.2


class _Terms(NamedTuple):
    """What is wrong of one mode: computed once, asked for at every evaluation."""

    factor: float
    borrowed: float
    shared: float


@dataclass(frozen=True)
class ModelError:
    """Mesh factors and uncertainties of simulated modes.

    Parameters
    ----------
    factors : mode → extrapolated over computed frequency; other modes take the mean of their order, or of all.
    sds : mode → relative standard deviation of the extrapolation.
    corrections : mode → relative change from the fitting mesh to the extrapolation.
    effects : mode → what effects that the study declares do to it.
    """

    factors: Mapping[ModeKey, float] = field(default_factory=dict)
    sds: Mapping[ModeKey, float] = field(default_factory=dict)
    corrections: Mapping[ModeKey, float] = field(default_factory=dict)
    effects: Mapping[ModeKey, Response] = field(default_factory=dict)
    _known: dict[ModeKey, _Terms] = field(default_factory=dict, init=False, repr=False, compare=False)

    @classmethod
    def of_factors(cls, factors: Mapping[ModeKey, float]) -> ModelError:
        """Of mesh factors alone: all that they correct is the mesh's."""
        return cls(factors=factors, corrections={key: factor - 1.0 for key, factor in factors.items()})

    def factor(self, key: ModeKey) -> float:
        """Mesh factor of a mode."""
        return self._terms(key).factor

    def borrowed(self, key: ModeKey) -> float:
        """Relative standard deviation of a mesh factor that others stand in for; 0 of a mode with its own."""
        return self._terms(key).borrowed

    def effect(self, key: ModeKey) -> float:
        """Factor of the declared effects on the middle of a mode's lines."""
        shifts = {k: response.shift for k, response in self.effects.items()}
        return float(np.exp(_nearest(shifts, key, 0.0)))

    def shared(self, key: ModeKey) -> float:
        """Relative standard deviation that the modes of a stage share; they are all wrong in the same direction."""
        return self._terms(key).shared

    def _terms(self, key: ModeKey) -> _Terms:
        if key not in self._known:
            others = [] if key in self.factors else _alike(self.factors, key)
            self._known[key] = _Terms(
                _nearest(self.factors, key, 1.0),
                float(np.std(others or [0.0])),
                float(np.hypot(SHARED_FLOOR, SHARED_PART * _nearest(self.corrections, key, 0.0))),
            )
        return self._known[key]

    def own(self, key: ModeKey) -> float:
        """Relative standard deviation that a mode does not share with others."""
        correction = OWN_PART * _nearest(self.corrections, key, 0.0)
        return float(np.hypot(max(OWN, self.sds.get(key, OWN)), correction))


def model_error(convergence: Sequence[ModeConvergence], reduced: Mapping[ModeKey, float]) -> ModelError:
    """Factors and uncertainties of a convergence study.

    Parameters
    ----------
    convergence : on the full models.
    reduced : frequencies of the reduced model at the same materials: the factors take its error along.
    """
    found = [c for c in convergence if c.key in reduced]
    return ModelError(
        factors={c.key: c.extrapolated_hz / reduced[c.key] for c in found},
        sds={c.key: c.sd for c in found},
        corrections={c.key: c.factor - 1.0 for c in found},
    )


def _nearest(table: Mapping[ModeKey, float], key: ModeKey, default: float) -> float:
    """Entry of a mode; of one that was not computed, the mean of its order's or of all."""
    if key in table:
        return table[key]
    same = _alike(table, key)
    return sum(same) / len(same) if same else default


def _alike(table: Mapping[ModeKey, float], key: ModeKey) -> list[float]:
    """Entries of a mode's order, or of all."""
    return [value for k, value in table.items() if k[0] == key[0]] or list(table.values())

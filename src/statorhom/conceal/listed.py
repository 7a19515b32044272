"""The modes of a test as truth.json and modal tables list them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.conceal.ritz import RitzModes
from statorhom.modes.supported_names import name_supported

VISIBLE = 0.1  # of a uniform ring's radial motion: what an accelerometer shows clearly
PURE = (
    0.6  # of the radial motion that one order must have before anybody gives a mode of a free test its name
)
BODIES = 0.5  # of the lowest elliptic frequency: below lies a body on its springs, which no table lists
HEAVY_DAMPING = 0.12  # loss factor above which nobody finds a mode in the FRFs


@dataclass(frozen=True)
class ListedMode:
    """One true mode; names as in `statorhom.modes.supported_names.SupportedMode`."""

    frequency_hz: float
    loss_factor: float
    order: int | None
    axial: int | None
    kind: str
    is_visible: bool


def listed_modes(ritz: RitzModes, *, is_free: bool = True) -> tuple[ListedMode, ...]:
    """All elastic modes of the band; of a test that should be free, its motion on its springs is none to be seen."""
    lowest = BODIES * ritz.ground.elliptic_hz if is_free else 0.0
    named = name_supported(ritz.band_shapes, ritz.ground.model, ritz.ground.materials)
    losses = ritz.loss_factors[ritz.in_band]
    return tuple(
        ListedMode(
            mode.frequency_hz,
            float(loss),
            mode.order,
            mode.axial,
            mode.kind,
            bool(
                mode.kind == "radial"
                and mode.visibility > VISIBLE
                and loss < HEAVY_DAMPING
                and (mode.share > PURE or not is_free)
                and mode.frequency_hz > lowest
            ),
        )
        for mode, loss in zip(named, losses, strict=True)
    )


def resolved(modes: tuple[ListedMode, ...]) -> tuple[ListedMode, ...]:
    """Visible modes; a doublet closer than half a bandwidth counts as one mode."""
    found: list[ListedMode] = []
    for mode in sorted((m for m in modes if m.is_visible), key=lambda m: m.frequency_hz):
        twin = next((i for i, m in enumerate(found) if _unresolved(m, mode)), None)
        if twin is None:
            found.append(mode)
        else:
            other = found[twin]
            middle = float(np.sqrt(other.frequency_hz * mode.frequency_hz))
            found[twin] = ListedMode(
                middle, mode.loss_factor, mode.order, mode.axial, mode.kind, is_visible=True
            )
    return tuple(found)


def _unresolved(one: ListedMode, other: ListedMode) -> bool:
    same = (one.order, one.axial) == (other.order, other.axial)
    bandwidth = one.loss_factor * one.frequency_hz
    return same and other.frequency_hz - one.frequency_hz < 0.5 * bandwidth

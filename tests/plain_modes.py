"""Modes as bare as pairing sees them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Measured:
    frequency_hz: float
    order: int | None = None
    axial: int | None = None


@dataclass(frozen=True)
class Simulated:
    frequency_hz: float
    order: int | None
    axial: int | None
    kind: str = "radial"
    visibility: float = 1.0
    multiplicity: int = 2

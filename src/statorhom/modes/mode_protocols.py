"""What the pairing needs to know of a measured and of a simulated mode."""

from __future__ import annotations

from typing import Protocol


class LabelledMode(Protocol):
    """A measured mode; labels that are None are unknown."""

    @property
    def frequency_hz(self) -> float: ...
    @property
    def order(self) -> int | None: ...
    @property
    def axial(self) -> int | None: ...


class SimulatedMode(Protocol):
    """A simulated mode; a doublet is one mode of multiplicity 2.

    `visibility` (0 … 1) says how strongly a radial accelerometer sees the mode, `kind` is "radial",
    "torsion", "axial" or "winding", and only radial modes have an order.
    """

    @property
    def frequency_hz(self) -> float: ...
    @property
    def order(self) -> int | None: ...
    @property
    def axial(self) -> int | None: ...
    @property
    def kind(self) -> str: ...
    @property
    def visibility(self) -> float: ...
    @property
    def multiplicity(self) -> int: ...

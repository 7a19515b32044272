"""Plain rings of one geometry whose masses and moduli scatter; each is identified in a second or less.

The frequencies of an isotropic body scale with √(E/ρ) exactly, so that the ratio of two machines' moduli is known
whatever the mesh.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import cheap_study

STAGE = cheap_study.STUDY.split('[[stages]]\nname = "framed"')[0]
MASS_KG, MODES = 2.313, ((3090.0, 2, 0), (4590.0, 2, 1))


def modulus_ratios(count: int) -> np.ndarray:
    """True moduli over the typical one (count,)."""
    return 1.0 + 0.03 * np.random.default_rng(5).standard_normal(count)


def write_fleet(folder: Path, count: int) -> list[Path]:
    """Write the studies, a folder each, with one geometry file; return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "ring.toml").write_text(cheap_study.GEOMETRY, encoding="utf-8")
    masses = 1.0 + 0.01 * np.random.default_rng(6).standard_normal(count)
    return [
        write_machine(folder / f"{i:03}", f"ring-{i:03}", ratio, mass)
        for i, (ratio, mass) in enumerate(zip(modulus_ratios(count), masses, strict=True))
    ]


def write_machine(folder: Path, name: str, modulus_ratio: float, mass_ratio: float) -> Path:
    """Write one study beside the fleet's geometry and return its path."""
    folder.mkdir()
    text = STAGE.replace('name = "ring"', f'name = "{name}"', 1).replace('"ring.toml"', '"../ring.toml"')
    text = text.replace(f"mass_kg = {MASS_KG}", f"mass_kg = {float(MASS_KG * mass_ratio)!r}")
    scale = np.sqrt(modulus_ratio / mass_ratio)
    rows = "".join(f"{f * scale:.6f},0.004,{r},{n}\n" for f, r, n in MODES)
    (folder / "stack.csv").write_text(f"frequency_hz,loss_factor,order,axial\n{rows}", encoding="utf-8")
    (folder / "study.toml").write_text(text, encoding="utf-8")
    return folder / "study.toml"


class Inline:
    """An executor in this process that notes what it did."""

    def __init__(self) -> None:
        self.did: list[Any] = []

    def run(self, function: Callable[[Any], Any], tasks: Sequence[Any]) -> Generator[tuple[int, Any]]:
        for i, task in enumerate(tasks):
            self.did.append(task)
            yield i, function(task)

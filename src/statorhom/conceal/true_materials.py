"""True materials, drawn from what is plausible of a region at a step."""

from __future__ import annotations

import numpy as np

from statorhom.conceal.truth import TrueMaterial
from statorhom.errors import MaterialError
from statorhom.materials.symmetry import SYMMETRIES, constant_names
from statorhom.materials.typical import prior_range

Range = tuple[float, float]
# well-made stators: narrower than what `statorhom.materials.typical_ranges` expects before any measurement
_LAMINATION = {
    "E": (165.0, 205.0),
    "E_z": (50.0, 130.0),
    "G_rz": (20.0, 45.0),
    "nu": (0.27, 0.30),
    "nu_pz": (0.24, 0.28),
}
_WOUND = {"E": (0.3, 2.0), "E_z": (2.0, 8.0), "G_rz": (0.12, 0.6), "nu": (0.28, 0.35), "nu_pz": (0.03, 0.06)}
_IMPREGNATED = {
    "E": (1.5, 5.0),
    "E_z": (8.0, 25.0),
    "G_rz": (0.5, 1.8),
    "nu": (0.28, 0.35),
    "nu_pz": (0.03, 0.06),
}
_METAL = {
    "E": (68.0, 74.0),
    "E_z": (66.0, 74.0),
    "G_rz": (25.0, 28.0),
    "nu": (0.32, 0.34),
    "nu_pz": (0.32, 0.34),
}
_RANGES: dict[str, dict[str, Range]] = {
    "stack": _LAMINATION,
    "wound": _WOUND,
    "impregnated": _IMPREGNATED,
    "framed": _METAL,
    "machine": _METAL,
}
_LOSSES: dict[str, Range] = {
    "stack": (0.003, 0.010),
    "wound": (0.04, 0.12),
    "impregnated": (0.015, 0.05),
    "framed": (0.001, 0.004),
    "machine": (0.004, 0.010),
}
# of what a step adds (kg/m³); resin adds to the copper
_DENSITIES: dict[str, Range] = {
    "stack": (7600.0, 7780.0),
    "wound": (2700.0, 3500.0),
    "impregnated": (100.0, 350.0),
    "framed": (2660.0, 2740.0),
    "machine": (2660.0, 2740.0),
}
ATTEMPTS = 100


def drawn_density(kind: str, rng: np.random.Generator) -> float:
    """Density of what a step adds (kg/m³)."""
    return float(rng.uniform(*_DENSITIES[kind]))


def drawn_material(
    kind: str, region: str, symmetry: str, density: float, rng: np.random.Generator, *, wide: bool
) -> TrueMaterial:
    """A region's material after a step.

    Parameters
    ----------
    kind : the step that made the region what it is.
    region, symmetry : as in study files.
    density : kg/m³.
    rng : source of the numbers.
    wide : from all of the typical range, far from where a fit starts, instead of a well-made stator's.

    Raises
    ------
    MaterialError
        If no draw is a possible material.
    """
    loss = float(rng.uniform(*_LOSSES[kind]))
    for _ in range(ATTEMPTS):
        constants = {
            name: _drawn(kind, region, symmetry, name, rng, wide) for name in constant_names(symmetry)
        }
        try:
            SYMMETRIES[symmetry](**constants)
        except MaterialError:
            continue
        return TrueMaterial(symmetry, constants, density, loss)
    raise MaterialError(
        f"no material of the {region} could be drawn; its typical ranges contradict each other"
    )


def _drawn(kind: str, region: str, symmetry: str, name: str, rng: np.random.Generator, wide: bool) -> float:
    if wide:
        prior = prior_range(region, kind, symmetry, name)
        low, high = prior.low90, prior.high90
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))
    low, high = _typical(_RANGES[kind], name)
    unit = 1e9 if name.endswith("_pa") else 1.0
    return unit * float(rng.uniform(low, high))


def _typical(ranges: dict[str, Range], name: str) -> Range:
    role = name.removesuffix("_pa")
    if role in ranges:
        return ranges[role]
    if role.startswith("nu"):
        return ranges["nu_pz" if role.endswith("z") else "nu"]
    if role == "G_rt":
        low, high = ranges["E"]
        return low / 2.6, high / 2.6
    return ranges["G_rz" if role.startswith("G") else "E"]

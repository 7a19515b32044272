"""The axial contact pressure, and with it G_rz and E_z, differs between the two ends of the stack."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import AxialSlope
from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding

HEIGHTS = 5  # along the core, between which the material is interpolated


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (Drawn("G_rz_end_ratio", 0.85, 0.12, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    own = place.true_stage.materials["lamination"]
    ratio = values["G_rz_end_ratio"]
    slope = (ratio - 1) / (ratio + 1)

    def scaled(factor: float) -> dict[str, float]:
        return {
            name: factor * own.constants[name]
            for name in ("G_rz_pa", "G_tz_pa", "E_z_pa")
            if name in own.constants
        }

    # moduli are linear along z, Hooke's matrices are not
    along = np.linspace(-1.0, 1.0, HEIGHTS)
    materials = tuple(own.with_constants(**scaled(1 + s * slope)).material for s in along.tolist())
    parameters = {
        "G_rz_end_ratio": ratio,
        "note": "G_rz and E_z at z = L over those at z = 0, linear in between, the mean unchanged",
    }
    finding = Finding("stack_pressure_gradient", place.true_stage.keys.name, parameters)
    return place.case.with_broken(place.stage, AxialSlope(materials)).with_finding(finding)


def _fits(place: Place) -> bool:
    first = next(i for i, s in enumerate(place.case.stages) if s.tests)
    return place.stage == first and "G_rz_pa" in place.true_stage.materials["lamination"].constants


EFFECT = HiddenEffect("stack_pressure_gradient", _parameters, _apply, _fits)

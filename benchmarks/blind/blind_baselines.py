"""What simpler methods would have answered to the same cases, and how well they predict modes that they did not see.

- refit of E alone: Young's moduli are fitted, all else stays as typed or typical; it never names anything;
- refit of all constants: the declared model, regularised by its priors, with nothing left out; it never names anything;
- error map alone: where the declared model is inadequate, the region with the largest part of the constitutive-relation
  error stands for the effect that is most usual there; without shapes there is no map and no answer;
- BIC without projection: the effect with the largest 2 ln L - k ln n at constants that stay where the refit of all of
  them put them, named where that is positive.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

CHANCE = 0.01  # of a misfit, below which the declared model counts as inadequate
ALONE, ALL, MAP, BIC = (
    "refit of E alone",
    "refit of all constants",
    "error map alone",
    "BIC without projection",
)
METHODS = ("diagnose", ALONE, ALL, MAP, BIC)
# region of the map → effect that the list conceals there most often
USUAL: Mapping[str, str] = {
    "lamination": "attached_mass",
    "winding": "end_winding_stiffness",
    "overhang": "end_winding_stiffness",
    "frame": "press_fit_contact",
}


def simpler_answers(details: Mapping[str, Any]) -> dict[str, str]:
    """Method → effect that it names, empty for none.

    Parameters
    ----------
    details : contents of diagnosis-details.json.
    """
    simpler = details.get("simpler") or {}
    listed = simpler.get("by_criterion") or ()
    by_criterion = listed[0]["effect"] if listed and listed[0]["gain"] > 0 else ""
    return {ALONE: "", ALL: "", MAP: _by_map(details), BIC: by_criterion}


def _by_map(details: Mapping[str, Any]) -> str:
    if details["nothing_adequacy"] >= CHANCE or not details.get("maps"):
        return ""
    total: dict[str, float] = {}
    for one in details["maps"]:
        for region, part in one["regions"].items():
            total[region] = total.get(region, 0.0) + float(np.sum(part)) * one["error"]
    return USUAL.get(max(total, key=lambda region: total[region]), "") if total else ""


def held_out_ratios(details: Mapping[str, Any], said: Mapping[str, Any]) -> dict[str, float]:
    """Method → error on modes that its fit did not see, over that of the refit of all constants."""
    found = {ALL: 1.0}
    simpler = details.get("simpler") or {}
    alone, whole = (simpler.get(f"{name}_held_out_percent") for name in ("modulus_alone", "all_constants"))
    if alone is not None and whole:
        found[ALONE] = alone / whole
    unseen = said["fit"].get("held_out")
    if said["verdict"] == "named" and unseen is not None and unseen["before_rms_percent"]:
        found["diagnose"] = unseen["after_rms_percent"] / unseen["before_rms_percent"]
    return found


def comparison(rows: Sequence[Mapping[str, Any]], detectable: float) -> dict[str, dict[str, tuple[int, int]]]:
    """Method → how many of how many: right effects among detectable single ones, false names on nothing and outside.

    A case that failed counts as wrong, and as no false name.
    """
    single = [r for r in rows if r["group"] == "single" and r["snr"] >= detectable]
    found = {}
    for method in METHODS:
        right = [bool(r.get("answers")) and r["answers"][method] == r["effect"] for r in single]
        shares = {"effect right": (sum(right), len(right))}
        for group in ("nothing", "outside"):
            own = [bool(r["answers"][method]) for r in rows if r["group"] == group and r.get("answers")]
            shares[f"named on {group}"] = (sum(own), len(own))
        found[method] = shares
    return found


def median_ratios(rows: Sequence[Mapping[str, Any]], detectable: float) -> dict[str, float]:
    """Method → median over detectable single effects of `held_out_ratios`; NaN where there is none."""
    single = [
        r["held_out"] for r in rows if r["group"] == "single" and r["snr"] >= detectable and "held_out" in r
    ]
    found = {}
    for method in METHODS:
        values = [r[method] for r in single if method in r]
        found[method] = float(np.median(values)) if values else float("nan")
    return found

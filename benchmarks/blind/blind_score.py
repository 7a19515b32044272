"""What a diagnosis is worth: its answer against the sealed truth, one row per case."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from blind_baselines import held_out_ratios, simpler_answers
from blind_cases import BlindCase
from blind_work import Work
from scipy.stats import beta, binom

from statorhom.physics.library import part_of

# the parameter that says how much, and whether its error is one of the logarithm of a ratio to 1
MAGNITUDES: Mapping[str, str] = {
    "attached_mass": "mass_kg",
    "local_stiffness": "stiffness_ratio",
    "ovality": "relative_amplitude",
    "interlaminar_shear": "G_rz_pa",
    "stack_pressure_gradient": "G_rz_end_ratio",
    "support_compliance": "normal_stiffness_n_per_m2",
    "suspension_stiffness": "stiffness_n_per_m",
    "end_winding_stiffness": "stiffness_ratio",
    "interface_debond": "arc_deg",
    "loose_winding_mass": "participating_fraction",
    "viscoelastic_winding": "modulus_slope_per_decade",
    "press_fit_contact": "contact_stiffness_n_per_m3",
    "temperature_shift": "temperature_k",
    "wrong_input": "value",
    "sensor_mass": "mass_kg",
}
DETECTABLE = 4.0  # projected signal-to-noise from which on an answer is expected


def scored(work: Work, case: BlindCase) -> dict[str, Any] | None:
    """One row; None where the case was not diagnosed."""
    truth_path, run_path = work.truth(case), work.run(case) / "run.json"
    if not truth_path.exists() or not run_path.exists():
        return None
    truth = json.loads(truth_path.read_text(encoding="utf-8"))
    run = json.loads(run_path.read_text(encoding="utf-8"))
    diagnosis_path = work.run(case) / "diagnosis.json"
    said = json.loads(diagnosis_path.read_text(encoding="utf-8")) if diagnosis_path.exists() else None
    row: dict[str, Any] = {
        "case": case.name,
        "group": case.group,
        "data": "table" if case.tables else "FRF",
        "template": case.template,
        "machine": case.machine,
        "truth": "+".join(case.effects),
        "right_verdict": truth["verdict"],
        "snr": truth["detectability"]["projected_snr"],
        "seconds": run["seconds"],
        "fault": run["message"],
        "commit": run.get("commit", ""),
    }
    if said is None:
        return row | {"verdict": "failed"}
    details = json.loads((work.run(case) / "diagnosis-details.json").read_text(encoding="utf-8"))
    row |= compared(truth, said, details.get("part", ()))
    row["effect"] = "+".join(e["effect"] for e in truth["effects"])
    row["held_out"] = held_out_ratios(details, said)
    return row | {"answers": {"diagnose": row["named"], **simpler_answers(details)}}


def compared(truth: Mapping[str, Any], said: Mapping[str, Any], part: Sequence[str] = ()) -> dict[str, Any]:
    """The answer against the truth; `part` is what an ambiguous one is sure of (`Details.part`).

    The class of an effect is the part of the machine or of the measurement that it concerns.
    """
    true, named = truth["effects"], said["effects"] if said["verdict"] == "named" else []
    names = [e["effect"] for e in true]
    found = [e["effect"] for e in named]
    offered = found or [a["effect"] for a in said.get("alternatives", [])[:1]]
    named_right = sorted(map(part_of, found)) == sorted(map(part_of, names))
    row: dict[str, Any] = {
        "verdict": said["verdict"],
        "named": "+".join(found),
        "best": "+".join(offered),
        "effect_right": sorted(found) == sorted(names),
        "class_named": named_right,
        "class_right": named_right or (bool(part) and sorted(part) == sorted({part_of(n) for n in names})),
        "part": " and ".join(part),
        "verdict_right": said["verdict"] == truth["verdict"]
        and (not found or sorted(found) == sorted(names)),
    }
    pairs = [(t, s) for t in true for s in named if t["effect"] == s["effect"]]
    if pairs:
        row["angle_error_deg"] = _first(angle_error_deg(t, s) for t, s in pairs)
        row["magnitude_error"] = _first(magnitude_error(t, s) for t, s in pairs)
        row["covered"] = _first(covered(t, s) for t, s in pairs)
    held_out = said["fit"].get("held_out")
    if held_out is not None and held_out["before_rms_percent"]:
        row["held_out_ratio"] = held_out["after_rms_percent"] / held_out["before_rms_percent"]
    return row


def angle_error_deg(true: Mapping[str, Any], said: Mapping[str, Any]) -> float | None:
    """Smallest distance of the true angle from the stated one and its equivalents; None where there is no angle."""
    where, place = true.get("location"), said.get("location")
    if not where or not place or where.get("angle_deg") is None or place.get("angle_deg") is None:
        return None
    stated = [place["angle_deg"], *place.get("angle_ambiguity_deg", ())]
    harmonic = true["parameters"].get("harmonic")
    period = 360.0 / harmonic if harmonic else 360.0
    off = [(a - where["angle_deg"] + period / 2) % period - period / 2 for a in stated]
    return float(np.abs(off).min())


def magnitude_error(true: Mapping[str, Any], said: Mapping[str, Any]) -> float | None:
    """Relative error of the effect's magnitude; None where it has none."""
    values = _magnitudes(true, said)
    return None if values is None else abs(values[1] / values[0] - 1)


def covered(true: Mapping[str, Any], said: Mapping[str, Any]) -> bool | None:
    """Whether the 90 % interval of the magnitude holds the truth; None where there is none."""
    key = MAGNITUDES.get(true["effect"])
    stated = said["parameters"].get(key)
    if key is None or not isinstance(stated, dict) or not stated.get("ci90") or key not in true["parameters"]:
        return None
    low, high = stated["ci90"]
    return bool(low <= true["parameters"][key] <= high)


def _magnitudes(true: Mapping[str, Any], said: Mapping[str, Any]) -> tuple[float, float] | None:
    key = MAGNITUDES.get(true["effect"])
    if key is None or key not in true["parameters"] or key not in said["parameters"]:
        return None
    if true["effect"] == "wrong_input" and true["parameters"]["input"] != _word(
        said["parameters"].get("input")
    ):
        return None
    stated = said["parameters"][key]
    return float(true["parameters"][key]), float(stated["value"] if isinstance(stated, dict) else stated)


def _word(stated: Any) -> Any:
    return stated["value"] if isinstance(stated, dict) else stated


def _first(values: Any) -> Any:
    return next((value for value in values if value is not None), None)


def proportions(rows: Sequence[Mapping[str, Any]]) -> dict[str, tuple[int, int]]:
    """The benchmark's shares: how many of how many. A case without an answer is a wrong one, and no false name."""
    single = [r for r in rows if r["group"] == "single" and r["snr"] >= DETECTABLE]
    named = [r for r in single if r.get("effect_right")]
    return {
        "effect right, snr >= 4": _count(single, "effect_right"),
        "class right, snr >= 4": _count(single, "class_right"),
        "class right by name, snr >= 4": _count(single, "class_named"),
        "right effect leads, snr >= 4, whatever the verdict": _leads_rightly(single),
        "doubles: both right": _count([r for r in rows if r["group"] == "double"], "effect_right"),
        "ambiguous: right verdict": _count([r for r in rows if r["group"] == "ambiguous"], "verdict_right"),
        "named on nothing missing": _false_names(rows, "nothing"),
        "named outside the library": _false_names(rows, "outside"),
        "90 % intervals cover": _count([r for r in named if r.get("covered") is not None], "covered"),
        "no answer": (sum(r.get("verdict") == "failed" for r in rows), len(rows)),
    }


def medians(rows: Sequence[Mapping[str, Any]]) -> dict[str, list[float]]:
    """The values behind the benchmark's medians: of rightly named single effects, and of all times."""
    single = [r for r in rows if r["group"] == "single" and r["snr"] >= DETECTABLE]
    named = [r for r in single if r.get("effect_right")]
    return {
        "median angle error (deg)": _values(named, "angle_error_deg"),
        "median magnitude error": _values(named, "magnitude_error"),
        "median held-out error, after over before": _values(named, "held_out_ratio"),
        "median seconds, tables": _values([r for r in rows if r["data"] == "table"], "seconds"),
        "median seconds, FRFs": _values([r for r in rows if r["data"] == "FRF"], "seconds"),
    }


def summary(rows: Sequence[Mapping[str, Any]]) -> dict[str, float]:
    """The benchmark's figures; NaN where nothing was measured."""
    shares = {name: k / n if n else float("nan") for name, (k, n) in proportions(rows).items()}
    return shares | {
        name: float(np.median(values)) if values else float("nan") for name, values in medians(rows).items()
    }


def interval(right: int, count: int) -> tuple[float, float]:
    """95 % interval of a share (Clopper and Pearson 1934)."""
    low = beta.ppf(0.025, right, count - right + 1) if right else 0.0
    high = beta.ppf(0.975, right + 1, count - right) if right < count else 1.0
    return float(low), float(high)


def median_interval(values: Sequence[float]) -> tuple[float, float]:
    """95 % interval of a median, between two of the sorted values."""
    first = int(binom.ppf(0.025, len(values), 0.5))
    ordered = np.sort(np.asarray(values, dtype=float))
    return float(ordered[max(first - 1, 0)]), float(ordered[min(len(values) - first, len(values) - 1)])


def _values(rows: Sequence[Mapping[str, Any]], key: str) -> list[float]:
    return [float(r[key]) for r in rows if r.get(key) is not None]


def _count(rows: Sequence[Mapping[str, Any]], key: str) -> tuple[int, int]:
    return sum(bool(r.get(key)) for r in rows), len(rows)


def _leads_rightly(rows: Sequence[Mapping[str, Any]]) -> tuple[int, int]:
    """Named, or the first alternative of what was not named."""
    return sum(r.get("best", "") == r.get("effect") for r in rows), len(rows)


def _false_names(rows: Sequence[Mapping[str, Any]], group: str) -> tuple[int, int]:
    own = [r for r in rows if r["group"] == group]
    return sum(r.get("verdict") == "named" for r in own), len(own)

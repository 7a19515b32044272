"""What simpler methods would have answered, from the numbers behind the same diagnosis.

- refit of all constants: the declared model, regularised by its priors, with nothing left out: it never names anything;
- largest gain of the projected scan: named where it is unlikely under noise (p < 0.01), with no refit and no rule;
- largest evidence: the best refitted effect wherever it beats "nothing", with no rule about held-out modes or adequacy.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

CHANCE = 0.01
METHODS = ("diagnose", "refit of all constants", "largest gain", "largest evidence")


def simpler_answers(details: Mapping[str, Any]) -> dict[str, str]:
    """Method → effect that it names, empty for none.

    Parameters
    ----------
    details : contents of diagnosis-details.json.
    """
    scan, evidence = details["scan"], details["evidence"]
    by_gain = scan[0]["effect"] if scan and details["p_value"] < CHANCE else ""
    # labels begin with the effect's name
    by_evidence = evidence[0][0].split(" (")[0] if evidence and details["over_nothing"] > 0 else ""
    return {"refit of all constants": "", "largest gain": by_gain, "largest evidence": by_evidence}


def comparison(rows: Sequence[Mapping[str, Any]], detectable: float) -> dict[str, dict[str, float]]:
    """Method → share of right effects among detectable single ones, and of false names on nothing and outside."""
    single = [r for r in rows if r["group"] == "single" and r["snr"] >= detectable and "answers" in r]
    found = {}
    for method in METHODS:
        false = {
            group: [bool(r["answers"][method]) for r in rows if r["group"] == group and "answers" in r]
            for group in ("nothing", "outside")
        }
        right = [r["answers"][method] == r["effect"] for r in single]
        found[method] = {
            "effect right": _mean(right),
            "named on nothing": _mean(false["nothing"]),
            "named outside": _mean(false["outside"]),
        }
    return found


def _mean(values: Sequence[bool]) -> float:
    return float(np.mean(values)) if values else float("nan")

"""Which test the declared model meets worst, and what of it, in words."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.feature import Feature
from statorhom.results.diagnosis import Mismatch

REMARKABLE = 3.0  # standard deviations
TOGETHER = 1.2  # root mean square, in standard deviations: from which on modes are off though none of them is by much
MOST_MODES = 8


def mismatch(base: Refit, part: Sequence[str] = ()) -> Mismatch | None:
    """The test that the declared model meets worst, and its modes; `part` is what any cause would concern."""
    features = [f for f in base.hypothesis.features(base.z) if f.test]
    tests = {t.name: s.name for s in base.hypothesis.study.stages for t in s.tests}
    if not features:
        return None
    cost: dict[str, float] = {}
    for f in features:
        cost[f.test] = cost.get(f.test, 0.0) + f.residual**2
    worst = max(cost, key=lambda t: cost[t])
    odd = sorted(
        (f for f in features if f.test == worst and abs(f.residual) > REMARKABLE),
        key=lambda f: -abs(f.residual),
    )
    modes = tuple(dict.fromkeys(f.mode for f in odd if f.mode is not None))[:MOST_MODES]
    said = _statement(worst, odd) or _weighed(base) or _unremarkable(worst, features)
    said += f"; whatever is missing, it concerns {' and '.join(part)}" if part else ""
    return Mismatch(stage=tests[worst], test=worst, modes=modes, statement=said)


def _weighed(base: Refit) -> str:
    """Of weights: modes may be met by constants of an impossible density, for of a wrong length they make up."""
    odd = [
        f for f in base.hypothesis.features(base.z) if f.kind == "density" and abs(f.residual) > REMARKABLE
    ]
    if not odd:
        return ""
    f = max(odd, key=lambda f: abs(f.residual))
    return (
        f"the declared model meets every measured mode, but weights and volumes give {f.measured:.0f} kg/m³ "
        f"where {f.predicted:.0f} is usual ({abs(f.residual):.0f} standard deviations)"
    )


def _unremarkable(test: str, features: Sequence[Feature]) -> str:
    """Of a test of which no mode is remarkably off: all together may be."""
    # doublets that show one line have a split of nothing each
    off, lean = (_together(test, kind, features) for kind in ("frequency", "lean"))
    if off > TOGETHER:
        return f"{test}: no mode is far off, but all together are, frequencies by {off:.1f} standard deviations (rms)"
    if lean > TOGETHER:
        return f"{test}: every frequency is met, but shapes lean to one end by {lean:.1f} standard deviations (rms)"
    return "the declared model meets every measured mode within its uncertainty"


def _together(test: str, kind: str, features: Sequence[Feature]) -> float:
    """What a test leaves of one kind, root mean square."""
    own = [f.residual for f in features if f.test == test and f.kind == kind]
    return float(np.sqrt(np.mean(np.square(own)))) if own else 0.0


def _statement(test: str, odd: Sequence[Feature]) -> str:
    """Of what is remarkably off; empty where nothing is."""
    frequencies = [f for f in odd if f.kind == "frequency"]
    lost = sum(f.lost for f in frequencies)
    parts = _frequencies([f for f in frequencies if not f.lost])
    parts += _of_modes(odd, ("split",), "doublet is", "doublets are", "split otherwise than predicted")
    if any(f.kind == "shift" for f in odd):
        parts.append("poles move from measuring plane to measuring plane")
    parts += _of_modes(odd, ("lean",), "shape leans", "shapes lean", "to one end otherwise than predicted")
    parts += _of_modes(odd, ("shape",), "shape is not that", "shapes are not those", "of the declared body")
    parts += _of_modes(
        odd,
        ("level", "level_loss"),
        "mode changes",
        "modes change",
        "with the force otherwise than predicted",
    )
    if lost:
        parts.append(f"{_counted(lost, 'mode has', 'modes have')} no partner")
    return f"{test}: {'; '.join(parts)}" if parts else ""


def _frequencies(off: Sequence[Feature]) -> list[str]:
    """How many are off, and the worst one."""
    if not off:
        return []
    f, number = off[0], _counted(len(off), "frequency is", "frequencies are")
    error = 100 * (np.exp(f.predicted - f.measured) - 1)
    return [f"{number} off, {_words(f)} by {error:+.2f} % ({abs(f.residual):.0f} standard deviations)"]


def _of_modes(odd: Sequence[Feature], kinds: Collection[str], one: str, several: str, how: str) -> list[str]:
    """How many modes are off in something else."""
    modes = {f.key for f in odd if f.kind in kinds and not f.lost}
    return [f"{_counted(len(modes), one, several)} {how}"] if modes else []


def _counted(number: int, one: str, several: str) -> str:
    return f"{number} {one if number == 1 else several}"


def _words(f: Feature) -> str:
    mode = f.mode or ()
    return f"mode {mode[0]}" if len(mode) == 1 else f"({', '.join(str(number) for number in mode)})"

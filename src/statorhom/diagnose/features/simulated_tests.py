"""Tests as they would be measured again if the declared model missed nothing: lines where it has them, and noise."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredSplit, MeasuredTest

LINES = ("frequency", "split")  # features that say where lines lie


@dataclass(frozen=True)
class _Doublet:
    """What is drawn of one named mode of a test.

    Parameters
    ----------
    rows : labels of its lines.
    shift : of their mean ln f.
    split : relative, complex where its angle was measured; None of a single line.
    """

    rows: tuple[str, ...]
    shift: float
    split: complex | None

    def moved(self, label: str, log_f: float, mean: float) -> float:
        """New ln f of one of its lines; `mean` is that of the outer two as they were measured."""
        if self.split is None or label not in (self.rows[0], self.rows[-1]):
            return log_f + self.shift
        side = -1.0 if label == self.rows[0] else 1.0
        # lines of a relative split of λ lie a quarter of it to either side
        return mean + self.shift + side * abs(self.split) / 4


def simulated(
    test: MeasuredTest, partners: Sequence[object], features: Sequence[Feature], noise: Callable[[], float]
) -> MeasuredTest:
    """The same test as a repetition might show it.

    Parameters
    ----------
    test : as it was measured.
    partners : of its modes; what has none is left out, for the model would not make it.
    features : of all tests, at the constants that the repetition is made with.
    noise : gives the next deviation, in standard deviations of a feature.
    """
    drawn = _drawn([f for f in features if f.test == test.name], noise)
    logs = {m.label: float(np.log(m.frequency_hz)) for m in test.modes}
    modes = []
    for mode, partner in zip(test.modes, partners, strict=True):
        if partner is None:
            continue
        one = drawn.get(mode.label)
        if one is not None:
            mean = (logs[one.rows[0]] + logs[one.rows[-1]]) / 2
            log_f = one.moved(mode.label, logs[mode.label], mean)
            mode = replace(mode, frequency_hz=float(np.exp(log_f)))
        modes.append(mode)
    modes.sort(key=lambda mode: mode.frequency_hz)
    return replace(test, modes=tuple(modes), splits=tuple(_with_angle(split, drawn) for split in test.splits))


def is_line(feature: Feature) -> bool:
    """Whether a repetition of its test shows it by where the lines lie."""
    return feature.kind in LINES and bool(feature.rows)


def _drawn(features: Sequence[Feature], noise: Callable[[], float]) -> dict[str, _Doublet]:
    """By label of every line."""
    groups: dict[tuple[str, ...], list[Feature]] = {}
    for feature in features:
        if is_line(feature) and not feature.lost:
            groups.setdefault(feature.rows, []).append(feature)
    found: dict[str, _Doublet] = {}
    for rows, own in groups.items():
        shift = next((_again(f, noise) - f.measured for f in own if f.kind == "frequency"), 0.0)
        parts = [_again(f, noise) for f in own if f.kind == "split" and f.silence is None]
        one = _Doublet(rows, shift, complex(*parts) if parts else None)
        found |= dict.fromkeys(rows, one)
    return found


def _again(feature: Feature, noise: Callable[[], float]) -> float:
    return feature.predicted + feature.sd * noise()


def _with_angle(split: MeasuredSplit, drawn: Mapping[str, _Doublet]) -> MeasuredSplit:
    one = drawn.get(split.lower)
    if one is None or one.split is None or split.upper not in one.rows:
        return split
    return replace(split, relative=one.split)

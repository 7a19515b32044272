"""What the declared model misses of one free test: ln(f true/f declared), mode by mode, and slopes by constant.

With the true constants the declared model stands on the true stator's kind of mesh. What other constants change is
computed on a rougher one, whose error is about the same with all of them: the ratio of two of its frequencies has
hardly any.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from statorhom.conceal.declared_stage import DeclaredModes, DeclaredStage, Key, declared_stage
from statorhom.conceal.listed import ListedMode
from statorhom.conceal.measure_case import Measured
from statorhom.conceal.tables import relabelled
from statorhom.conceal.truth import Case
from statorhom.errors import StatorhomError
from statorhom.mesh import MeshDensity, graded

ROUGH_MESH = graded(tooth=1, slot=1, radial=2, yoke=2)
WIDEST_SPLIT = 1.08  # two lines that are farther apart are no doublet
LONE = 10.0  # what a line without a mode costs: more than any pair of them
REACH = 1.3  # declared modes are sought this much higher than the true ones

Name = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Residual:
    """One free test.

    Parameters
    ----------
    test : its name.
    keys : names of the declared modes.
    values, owner : ln(f true/f declared) of every line, and the number of its mode in `keys`.
    slopes : constant → ∂ ln f declared/∂ ln p of every line.
    spreads : constant → standard deviation of its logarithm before any measurement.
    """

    test: str
    keys: tuple[Key, ...]
    values: np.ndarray
    owner: np.ndarray
    slopes: dict[str, np.ndarray]
    spreads: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class DeclaredTest:
    """A free test and the stage as it is declared.

    Parameters
    ----------
    name : of the test.
    modes : with the true constants as far as the declared symmetry has them.
    rough : the stage on the rougher mesh.
    true_hz : (r, n) → true frequencies of that name, of modes for which the declared model has a partner.
    highest_hz : declared modes are sought up to here.
    """

    name: str
    modes: DeclaredModes
    rough: DeclaredStage
    true_hz: Mapping[Name, Sequence[float]]
    highest_hz: float

    def residual(self, changes: Mapping[str, float]) -> Residual | None:
        """With the constants' logarithms changed; None where a mode has no partner or no material is like that."""
        if not changes:
            return self._of(self.modes, self.modes.frequencies_hz)
        try:
            moved = self.rough.changed(changes).modes(self.orders, self.highest_hz)
        except StatorhomError:
            return None
        begin, now = self._rough_begin.frequencies_hz, moved.frequencies_hz
        frequencies_hz = {
            key: hz * now[key] / begin[key]
            for key, hz in self.modes.frequencies_hz.items()
            if key in now and key in begin
        }
        return self._of(moved, frequencies_hz)

    @cached_property
    def _rough_begin(self) -> DeclaredModes:
        """With the true constants on the rougher mesh."""
        return self.rough.modes(self.orders, self.highest_hz)

    @property
    def orders(self) -> list[int]:
        """Harmonics of its lines."""
        return sorted({name[0] for name in self.true_hz})

    def _of(self, modes: DeclaredModes, frequencies_hz: Mapping[Key, float]) -> Residual | None:
        partners = _partners(self.true_hz, frequencies_hz)
        if len(partners) < sum(map(len, self.true_hz.values())):
            return None
        keys = tuple(dict.fromkeys(key for _, key in partners))
        declared = [frequencies_hz[key] for _, key in partners]
        owner = np.array([keys.index(key) for _, key in partners])
        slopes = {name: column[owner] for name, column in modes.slopes(keys).items()}
        values = np.log(np.array([f for f, _ in partners]) / declared)
        return Residual(self.name, keys, values, owner, slopes, modes.stage.spreads)


def declared_test(case: Case, measured: Measured, density: MeshDensity | None) -> DeclaredTest | None:
    """A free test of which anything was measured and that the declared model can be compared with."""
    test = case.stages[measured.stage].tests[measured.test]
    seen = measured.listed if test.is_table else tuple(m for m in measured.modes if m.is_visible)
    if test.relabelled is not None:
        seen = relabelled(seen, test.relabelled)[0]
    true_hz = _by_name(seen)
    if test.declared is not None or not true_hz:
        return None
    highest_hz = REACH * measured.ritz.ground.highest_hz
    try:
        stage = declared_stage(case, measured.stage, density)
        modes = stage.modes(sorted({name[0] for name in true_hz}), highest_hz)
        rough = declared_stage(case, measured.stage, ROUGH_MESH)
    except StatorhomError:
        return None  # typed data that no stator can have are seen without any test
    met: dict[Name, list[float]] = defaultdict(list)
    for frequency_hz, key in _partners(true_hz, modes.frequencies_hz):
        met[key[:2]].append(frequency_hz)
    return DeclaredTest(test.name, modes, rough, met, highest_hz) if met else None


def _by_name(modes: Sequence[ListedMode]) -> dict[Name, list[float]]:
    found: dict[Name, list[float]] = defaultdict(list)
    for mode in sorted(modes, key=lambda m: m.frequency_hz):
        if mode.order is not None and mode.axial is not None:
            found[mode.order, mode.axial].append(mode.frequency_hz)
    return found


def _partners(
    true_hz: Mapping[Name, Sequence[float]], declared_hz: Mapping[Key, float]
) -> list[tuple[float, Key]]:
    """True frequencies and the declared modes of their names that, in the same order, are nearest to all of them."""
    found: list[tuple[float, Key]] = []
    for name, frequencies in true_hz.items():
        keys = sorted((key for key in declared_hz if key[:2] == name), key=declared_hz.__getitem__)
        own = tuple(declared_hz[key] for key in keys)
        found += [
            (frequencies[i], keys[j])
            for i, j in enumerate(_aligned(tuple(frequencies), own, name[0] > 0))
            if j is not None
        ]
    return found


def _aligned(lines: tuple[float, ...], modes: tuple[float, ...], doublets: bool) -> tuple[int | None, ...]:
    """For every line a mode, in the same order: two close lines may be one doublet, a line without any costs much."""

    @cache
    def best(i: int, j: int) -> tuple[float, tuple[int | None, ...]]:
        if i == len(lines):
            return 0.0, ()
        if j == len(modes):
            return LONE * (len(lines) - i), (None,) * (len(lines) - i)
        ways = [best(i, j + 1), _after(best(i + 1, j), LONE, (None,))]
        for count in (1, 2) if doublets else (1,):
            own = lines[i : i + count]
            if len(own) == count and own[-1] < WIDEST_SPLIT * own[0]:
                cost = sum(np.log(line / modes[j]) ** 2 for line in own)
                ways.append(_after(best(i + count, j + 1), cost, (j,) * count))
        return min(ways, key=lambda way: way[0])

    return best(0, 0)[1]


def _after(
    rest: tuple[float, tuple[int | None, ...]], cost: float, own: tuple[int | None, ...]
) -> tuple[float, tuple[int | None, ...]]:
    return cost + rest[0], own + rest[1]

"""The least-squares problem of one fabrication step: measured against simulated frequencies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from statorhom.errors import MaterialError
from statorhom.identify.inference.problem import Problem
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.residuals.doublet_lines import line_shifts
from statorhom.identify.residuals.model_error import DEFAULT_RELATIVE_SD, ModelError
from statorhom.identify.stages.stage_materials import StageMaterials
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.reduced_stator import ReducedModes, ReducedStator
from statorhom.model.stator_mode import StatorMode
from statorhom.modes.pairing import Pairing, pair
from statorhom.study.modal_table import MeasuredMode

MESH = "mesh"  # the coordinate that shifts all modes together by the shared model error
PAIRING_SD = 0.03  # of ln f: how far simulated and measured modes may lie apart and still be thought the same
GATE, LABELLED_GATE = 4.0, 12.0  # in units of PAIRING_SD
SEEN = 0.05  # visibility from which on a mode is no unlikely partner
EXPECTED = 0.2  # visibility from which on a test would rather find a mode
# A test finds a strongly visible mode with this probability, one of visibility `HALF_FOUND` with half of it.
FOUND, HALF_FOUND = 0.8, 0.1


def chance_to_find(visibility: float) -> float:
    """Chance that a test finds a mode of this visibility."""
    return FOUND * visibility / (visibility + HALF_FOUND)


class NamedByMode:
    """Something that is known by the names of the simulated mode that it holds."""

    mode: StatorMode

    @property
    def order(self) -> int | None:
        return self.mode.order

    @property
    def axial(self) -> int | None:
        return self.mode.axial

    @property
    def kind(self) -> str:
        return self.mode.kind

    @property
    def multiplicity(self) -> int:
        return self.mode.multiplicity


@dataclass(frozen=True)
class CorrectedMode(NamedByMode):
    """A simulated mode at its mesh-corrected frequency, as the pairing wants it."""

    mode: StatorMode
    key: ModeKey | None
    frequency_hz: float
    visibility: float


def seen(mode: StatorMode) -> float:
    """Visibility as the pairing counts it, 1 from `SEEN` on."""
    return min(1.0, mode.visibility / SEEN)


def corrected(modes: Sequence[StatorMode], error: ModelError, shift: float = 0.0) -> list[CorrectedMode]:
    """Modes with mesh factor, declared effects and the shared shift (in its standard deviations) applied."""
    keys = {id(mode): key for key, mode in mode_keys(modes).items()}
    found = []
    for mode in modes:
        key = keys.get(id(mode))
        factor = 1.0
        if key is not None:
            factor = error.factor(key) * error.effect(key) * (1.0 + shift * error.shared(key))
        found.append(CorrectedMode(mode, key, mode.frequency_hz * factor, seen(mode)))
    return found


def doublet_lines(
    measured: Sequence[MeasuredMode],
    keys: Sequence[ModeKey | None],
    partners: Mapping[ModeKey, CorrectedMode],
    error: ModelError,
) -> list[float]:
    """How far (in ln f) the measured modes' lines lie off the middle of their doublets, by declared effects."""
    if not error.effects:
        return [0.0] * len(measured)
    middle = {key: mode.frequency_hz for key, mode in partners.items()}
    return line_shifts([mode.frequency_hz for mode in measured], keys, error.effects, middle)


def pair_modes(
    measured: Sequence[MeasuredMode], simulated: Sequence[CorrectedMode], with_doubt: bool = False
) -> Pairing:
    """Pair with the tolerances of this module."""
    return pair(
        measured, simulated, PAIRING_SD, gate=GATE, labelled_gate=LABELLED_GATE, with_doubt=with_doubt
    )


def pair_by_rank(
    measured: Sequence[MeasuredMode], simulated: Sequence[CorrectedMode]
) -> tuple[ModeKey | None, ...]:
    """Key of the simulated mode of the same rank, by frequency and among the visible ones, within every test."""
    visible = sorted((m for m in simulated if m.mode.visibility >= EXPECTED), key=lambda m: m.frequency_hz)
    keys: list[ModeKey | None] = [None] * len(measured)
    # rows are counted anew in every test
    starts = [i for i in range(len(measured)) if i == 0 or measured[i].row <= measured[i - 1].row]
    for first, last in pairwise([*starts, len(measured)]):
        order = sorted(range(first, last), key=lambda i: measured[i].frequency_hz)
        for i, mode in zip(order, visible, strict=False):
            keys[i] = mode.key
    return tuple(keys)


@dataclass(frozen=True, eq=False)
class StageProblem(Problem):
    """Residuals of a stage's fitted modes.

    Parameters
    ----------
    space : constants, densities and the shared model error.
    materials : how constants become materials.
    solver : the reduced model.
    measured : fitted modes.
    error : mesh factors and uncertainties.
    discrepancy : relative standard deviation of what the model leaves unexplained, of every mode.
    held : pairing that is kept (measured number → mode key), None to pair anew at every point.
    by_rank : pair the k-th mode of every test with the k-th visible one instead: far from the optimum, where simulated
        modes of any frequency abound, the nearest one says nothing.
    """

    space: ParameterSpace
    materials: StageMaterials
    solver: ReducedStator
    measured: tuple[MeasuredMode, ...]
    error: ModelError
    discrepancy: float = 0.0
    held: tuple[ModeKey | None, ...] | None = None
    by_rank: bool = False
    _last: dict[bytes, ReducedModes] = field(default_factory=dict, init=False, repr=False)

    def simulated(self, x: Array) -> list[CorrectedMode]:
        """Corrected modes at a point.

        Raises
        ------
        MaterialError
            If no material has these constants.
        """
        return self._corrected(self.solve(x), x)

    def solve(self, x: Array) -> ReducedModes:
        """Modes of the reduced model at a point, uncorrected; the last point's are kept for its derivatives."""
        mark = np.asarray(x, float).tobytes()
        if mark not in self._last:
            self._last.clear()
            self._last[mark] = self.solver.solve(self.stage_materials(x))
        return self._last[mark]

    def _corrected(self, solution: ReducedModes, x: Array) -> list[CorrectedMode]:
        return corrected(solution.modes, self.error, self.space.values(x).get(MESH, 0.0))

    def stage_materials(self, x: Array) -> Materials:
        """Materials at a point."""
        return self.materials.of(self.space.values(x))

    def __getstate__(self) -> dict[str, object]:
        return {**self.__dict__, "_last": {}}  # workers start with an empty memory

    def pairing(self, simulated: Sequence[CorrectedMode]) -> tuple[ModeKey | None, ...]:
        """Key of the simulated partner of every measured mode."""
        if self.by_rank:
            return pair_by_rank(self.measured, simulated)
        found = pair_modes(self.measured, simulated)
        keys: list[ModeKey | None] = [None] * len(self.measured)
        for p in found.pairs:
            keys[p.measured] = simulated[p.simulated].key
        return tuple(keys)

    def relative_sd(self, mode: MeasuredMode, key: ModeKey | None) -> float:
        """Standard deviation of ln f of measured minus simulated mode, the shared part left out."""
        sd = mode.frequency_sd_hz
        measured = DEFAULT_RELATIVE_SD if sd is None else sd / mode.frequency_hz
        own = self.error.own(key) if key is not None else 0.0
        return float(np.sqrt(measured**2 + own**2 + self.discrepancy**2))

    def data_residuals(self, x: Array) -> Array:
        """One residual per fitted mode and one for all that is unlikely about who was found and who was not.

        An unpaired measured mode costs as much as the farthest that would be paired.
        """
        try:
            simulated = self.simulated(x)
        except MaterialError:
            return np.full(len(self.measured) + 1, np.nan)
        keys = self.pairing(simulated) if self.held is None else self.held
        partners = {mode.key: mode for mode in simulated if mode.key is not None}
        lines = doublet_lines(self.measured, keys, partners, self.error)
        distances = [
            self._residual(m, k, partners, line)
            for m, k, line in zip(self.measured, keys, lines, strict=True)
        ]
        if self.by_rank:
            return np.array([*distances, 0.0])
        unlikely = self._missed(simulated, keys) + self._hidden(keys, partners)
        return np.array([*distances, np.sqrt(unlikely)])

    def _residual(
        self,
        measured: MeasuredMode,
        key: ModeKey | None,
        partners: dict[ModeKey, CorrectedMode],
        line: float,
    ) -> float:
        sd = self.relative_sd(measured, key)
        if key is None or key not in partners:
            return (GATE if measured.order is None else LABELLED_GATE) * PAIRING_SD / sd
        return float(np.log(partners[key].frequency_hz / measured.frequency_hz) + line) / sd

    def data_jacobian(self, x: Array) -> Array:
        """Analytic derivative of the residuals with the pairing held, (modes + 1, d)."""
        held = self.smooth_at(x).held
        assert held is not None
        solution = self.solve(x)
        partners = {mode.key: mode for mode in self._corrected(solution, x) if mode.key is not None}
        values = self.space.values(x)
        slopes = self.materials.hooke_slopes(values)
        # what a test finds changes slowly or in steps: the last row stays zero
        rows = np.zeros((len(self.measured) + 1, len(self.space.names)))
        for i, (measured, key) in enumerate(zip(self.measured, held, strict=True)):
            if key is None or key not in partners:
                continue
            gradient = self._log_frequency_row(solution, partners[key], values, slopes)
            rows[i] = gradient / self.relative_sd(measured, key)
        return rows @ self.space.physical_jacobian(x)

    def _log_frequency_row(
        self,
        solution: ReducedModes,
        partner: CorrectedMode,
        values: dict[str, float],
        slopes: dict[str, dict[str, np.ndarray]],
    ) -> np.ndarray:
        """d ln f of one corrected mode with respect to all constants."""
        gradient = solution.log_frequency_gradient(partner.mode)
        row = dict.fromkeys(self.space.names, 0.0) | self.materials.log_frequency_slopes(gradient, slopes)
        if MESH in row and partner.key is not None:
            sd = self.error.shared(partner.key)
            row[MESH] = sd / (1.0 + values[MESH] * sd)
        return np.array(list(row.values()))

    def _missed(self, simulated: Sequence[CorrectedMode], keys: Sequence[ModeKey | None]) -> float:
        """−2 ln of the chance that the test found none of the visible modes that it did not find."""
        top = max(mode.frequency_hz for mode in self.measured)
        chances = [
            1.0 - chance_to_find(mode.mode.visibility)
            for mode in simulated
            if mode.frequency_hz < top and mode.key is not None and mode.key not in keys
        ]
        return float(-2.0 * np.sum(np.log(chances)))

    def _hidden(self, keys: Sequence[ModeKey | None], partners: dict[ModeKey, CorrectedMode]) -> float:
        """Cost of partners that hardly move the surface, as the pairing counts it."""
        costs = [
            -2.0 * np.log(partners[key].visibility) * (PAIRING_SD / self.relative_sd(measured, key)) ** 2
            for measured, key in zip(self.measured, keys, strict=True)
            if key is not None and key in partners
        ]
        return float(np.sum(costs))

    def smooth_at(self, x: Array) -> StageProblem:
        """The problem with the pairing held as it is at `x`."""
        return self if self.held is not None else replace(self, held=self.pairing(self.simulated(x)))

    def coarse(self) -> StageProblem:
        """The same problem with the tolerance of the pairing: its valleys are wide enough to be found."""
        return replace(self, discrepancy=PAIRING_SD)

"""Finds as many modes as the data carry: fit, remove, add, window by window, until nothing changes.

The number of modes follows from the Bayesian information criterion (Schwarz 1978): a mode must raise the
likelihood by more than the price of its unknowns, a pole and one residue per point, with a misfit beyond the
noise counted as noise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.clusters import cluster_lines, clusters, nearest, tiles
from statorhom.extraction.doubtful_modes import drop_doubtful
from statorhom.extraction.modal_model import Modes, Window, steady_modes
from statorhom.extraction.mode_count import grow, grown_to_noise, prune
from statorhom.extraction.moving_modes import most_move, moving_set_ups, refitted, with_moving_modes
from statorhom.extraction.noise import LEAST_MODEL_ERROR
from statorhom.extraction.point_grid import PointGrid
from statorhom.extraction.set_up_shifts import SetUps
from statorhom.extraction.window_fit import WindowFit, fit_window

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_SWEEPS = 3
_BINS_PER_BANDWIDTH = 8
_ENOUGH_BINS = 250
_QUIET = 1.001  # of the least error of a model
_REACH = 0.3  # of a window's width
_SEEN = 0.1  # bandwidths
_SETTLED = 0.01  # bandwidths that a pole may still move


@dataclass(frozen=True)
class FittedWindow:
    """A cluster of modes with its data and fit; `own` are its modes' places among all modes."""

    lines: slice
    window: Window
    fit: WindowFit
    neighbours: Modes
    own: tuple[int, ...]

    @property
    def fitted(self) -> tuple[Window, WindowFit, Modes]:
        """Data, fit and neighbours: what tells whether poles move."""
        return self.window, self.fit, self.neighbours


class ModeSearch:
    """State of a search over one grid: data, noise and the modes so far."""

    def __init__(
        self,
        grid: PointGrid,
        sd: FloatArray,
        poles: ComplexArray,
        parts: ComplexArray,
        stable: ComplexArray,
        steady: bool = False,
    ) -> None:
        self.steady = steady  # known not to move
        self.unit = float(grid.omega[-1] ** 2)
        self.grid, self.sd = grid, sd
        self.stable = stable / self.unit
        self.variance = np.where(grid.measured, sd**2.0, np.inf)
        self.set_ups: SetUps | None = None
        self.first: list[FittedWindow] | None = None
        self.moved: list[bool] = []  # by every window, while poles may move
        self.visited: list[tuple[slice, ComplexArray]] = []
        self.modes = steady_modes(poles / self.unit, parts.reshape(len(poles), len(grid.references)))

    @property
    def omega(self) -> FloatArray:
        """Angular frequencies of the lines over the root of `unit`."""
        lines: FloatArray = self.grid.omega / np.sqrt(self.unit)
        return lines

    def first_look(self) -> list[FittedWindow]:
        """The windows of the first modes, and whether poles move."""
        self.first = self._windows()
        if not self.steady:
            self.set_ups = moving_set_ups([one.fitted for one in self.first])
        return self.first

    def run(self, hopeless: Callable[[Sequence[FittedWindow]], bool] | None = None) -> list[FittedWindow]:
        """Sweep until the modes settle; the windows of the clusters with their last fits.

        Parameters
        ----------
        hopeless : whether what the first sweep has found is not worth another one.
        """
        if self.first is None:
            self.first_look()
        for number in range(_SWEEPS):
            before = self.modes
            self._sweep()
            if _settled(before, self.modes):
                break
            if number == 0 and hopeless is not None and hopeless(found := self._windows()):
                return [self._checked(one) for one in found]
        return [self._checked(one) for one in self._windows()]

    def _windows(self) -> list[FittedWindow]:
        return [self._fitted(own) for own in clusters(self.modes.poles)]

    def window(self, lines: slice) -> Window:
        """Data of some lines, in bins."""
        squared = self.grid.omega[lines] ** 2 / self.unit
        size = self._bin(squared)
        count = len(squared) // size * size
        shape = (*self.grid.receptance.shape[:2], -1, size)
        values = self.grid.receptance[..., lines][..., :count].reshape(shape).mean(axis=-1)
        variance = self.variance[..., lines][..., :count].reshape(shape).mean(axis=-1) / size
        return Window(squared[:count], values, 1.0 / variance, self.unit, quiet=self._quiet(lines))

    def _quiet(self, lines: slice) -> bool:
        """Whether most of the data are less noisy than a linear model is exact."""
        variance = self.variance[..., lines]
        least = (_QUIET * LEAST_MODEL_ERROR) ** 2 * np.abs(self.grid.receptance[..., lines]) ** 2
        return bool(np.median((variance <= least)[np.isfinite(variance)]) > 0.5)

    def _bin(self, squared: FloatArray) -> int:
        """Lines of a bin: a small part of the narrowest bandwidth inside, and no more than a long window needs."""
        poles = self.modes.poles[(self.modes.poles.real > squared[0]) & (self.modes.poles.real < squared[-1])]
        spacing = (np.sqrt(squared[-1]) - np.sqrt(squared[0])) / (len(squared) - 1)
        narrowest = float(np.min(poles.imag / np.sqrt(poles.real), initial=np.inf)) / spacing
        return int(max(1, min(narrowest / _BINS_PER_BANDWIDTH, len(squared) / _ENOUGH_BINS)))

    def _neighbours(self, own: list[int], lines: slice) -> Modes:
        beside = nearest(self.modes.poles, own, lines, self.omega)
        return self.modes.of(beside)

    def _fitted(self, own: list[int]) -> FittedWindow:
        lines = cluster_lines(self.modes.poles[own], self.omega)
        window, neighbours = self.window(lines), self._neighbours(own, lines)
        fit = refitted(window, self.modes.of(own), neighbours, self.set_ups)
        return FittedWindow(lines, window, fit, neighbours, tuple(own))

    def _checked(self, one: FittedWindow) -> FittedWindow:
        """Without the modes that the last sweep has turned into corrections of others."""
        kept = prune(one.window, drop_doubtful(one.window, one.fit, one.neighbours), one.neighbours)
        return replace(one, fit=kept)

    def _sweep(self) -> None:
        omega = self.omega
        groups = clusters(self.modes.poles)
        windows = [cluster_lines(self.modes.poles[own], omega) for own in groups]
        for own, lines in zip(groups, windows, strict=True):
            self._improve(own, lines)
        keep = ~np.isnan(self.modes.poles)
        self.modes = self.modes.of(keep)
        groups = clusters(self.modes.poles)
        for lines in tiles([cluster_lines(self.modes.poles[own], omega) for own in groups], len(omega)):
            self._improve([], lines)

    def _reach(self, lines: slice) -> tuple[float, float]:
        """How far beyond a window modes are looked for: beyond the ends of the data they are residual terms."""
        return (_REACH * (lines.start == 0), _REACH * (lines.stop == len(self.grid.omega)))

    def _visited(self, lines: slice, modes: Modes, neighbours: Modes, tolerance: float) -> bool:
        """Whether this window was searched before among the same poles, but for a part of their bandwidths."""
        poles = np.sort_complex(np.concatenate([modes.poles, neighbours.poles]))
        slack = 0.05 * (lines.stop - lines.start)
        return any(
            abs(lines.start - seen.start) <= slack
            and abs(lines.stop - seen.stop) <= slack
            and len(known) == len(poles)
            and bool(np.all(np.abs(known - poles) < tolerance * poles.imag))
            for seen, known in self.visited
        )

    def _improve(self, own: list[int], lines: slice) -> None:
        """Fit one window, drop modes that are not worth their price and add those that are."""
        neighbours = self._neighbours(own, lines)
        if self._visited(lines, self.modes.of(own), neighbours, _SETTLED):
            return
        window = self.window(lines)
        fit = refitted(window, self.modes.of(own), neighbours, self.set_ups)
        fit = drop_doubtful(window, fit, neighbours)
        if not self._visited(lines, fit.modes, neighbours, _SEEN):
            fit = self._with_moving(window, fit, neighbours)
            where = neighbours, self.stable, self._reach(lines)
            fit = grow(window, grown_to_noise(window, fit, *where), *where)
            fit = prune(window, fit, neighbours)
        self.visited.append((lines, np.sort_complex(np.concatenate([fit.modes.poles, neighbours.poles]))))
        # poles that are gone are marked, so that the places of the others stay; the sweep's end removes them
        poles = self.modes.poles.copy()
        poles[own] = np.nan
        self.modes = replace(self.modes, poles=poles).joined(fit.modes)

    def _with_moving(self, window: Window, fit: WindowFit, neighbours: Modes) -> WindowFit:
        if self.set_ups is None or not len(fit.modes):
            return fit
        found = with_moving_modes(window, fit, neighbours, self.set_ups, self.stable)
        self.moved.append(bool(found.modes.moving.any()))
        if not most_move(self.moved):
            self._hold_still()
            return fit_window(window, self._steady(found.modes), neighbours)
        return found

    def _hold_still(self) -> None:
        """Take the poles for those of a test that stays as it is, after all."""
        self.set_ups = None
        self.visited.clear()
        self.modes = self._steady(self.modes)

    @staticmethod
    def _steady(modes: Modes) -> Modes:
        return steady_modes(modes.poles, modes.parts)


def _settled(before: Modes, after: Modes) -> bool:
    if len(before) != len(after) or not len(after):
        return len(before) == len(after)
    a, b = np.sort_complex(before.poles), np.sort_complex(after.poles)
    return bool(np.all(np.abs(a - b) < _SETTLED * b.imag))

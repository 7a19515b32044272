"""How much of a misfit a refit of the declared constants absorbs: damped steps until nothing more is gained.

A strong effect moves constants so far that one linear projection leaves many times what a refit does.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from statorhom.conceal.declared_residual import DeclaredTest, Residual

# relative: of a measured frequency; of a name's mesh error, after extrapolation
FREQUENCY_SD, MESH_SD = 3e-4, 2e-3
ROUNDS = 40
SMALL = 0.01  # a step of a constant's logarithm that changes modes as the slopes say
LARGEST = 0.5  # step of a constant's logarithm
# of the curvature that is added to itself (Levenberg 1944, Marquardt 1963): at first, and after steps that gain or not
DAMPING, LESS, MORE = 1e-3, 0.2, 6.0
STIFFEST = 10.0  # damping at which no step gains
# rounds after which a valley is given up that is so many times as far off as another one's end
PATIENCE, FAR_OFF = 8, 30.0
WEAKER = (-0.5, -1.0, -1.5)  # changes of the winding's moduli from which the steps begin again
SEEN = 3.0  # standard deviations
GAIN = 0.01  # of the misfit; what gains less is the end


@dataclass(frozen=True, eq=False)
class Misfit:
    """All tests at some constants.

    Parameters
    ----------
    residuals : of every test.
    names : of the constants.
    changes : of their logarithms from the true ones.
    """

    residuals: tuple[Residual, ...]
    names: tuple[str, ...]
    changes: np.ndarray

    @cached_property
    def values(self) -> np.ndarray:
        """All tests' ln(f true/f declared)."""
        return np.concatenate([r.values for r in self.residuals])

    @cached_property
    def slopes(self) -> np.ndarray:
        """Of the declared ln f by the constants' logarithms, by mode and constant."""
        return np.vstack(
            [
                np.column_stack([r.slopes.get(n, np.zeros(len(r.values))) for n in self.names])
                for r in self.residuals
            ]
        )

    @cached_property
    def weights(self) -> np.ndarray:
        """Inverse covariance of the frequencies: noise of its own, a mesh's error of its name."""
        owner = np.concatenate([1000 * i + r.owner for i, r in enumerate(self.residuals)])
        return np.linalg.inv(FREQUENCY_SD**2 * np.eye(len(owner)) + MESH_SD**2 * (owner[:, None] == owner))

    @cached_property
    def spreads(self) -> np.ndarray:
        """Standard deviations of the constants' logarithms before any measurement."""
        return np.array([next(r.spreads[n] for r in self.residuals if n in r.spreads) for n in self.names])

    @cached_property
    def merit(self) -> float:
        """χ² with what is known of the constants."""
        return self._merit(self.values, self.changes)

    def _merit(self, values: np.ndarray, changes: np.ndarray) -> float:
        return float(values @ self.weights @ values + np.sum((changes / self.spreads) ** 2))

    def step(self, damping: float = 0.0) -> np.ndarray:
        """Of the constants' logarithms to the least merit, as the slopes say; a damped one is shorter."""
        J, W, known = self.slopes, self.weights, self.spreads**-2
        curvature = J.T @ W @ J + np.diag(known)
        curvature += damping * np.diag(np.diag(curvature))
        return np.linalg.solve(curvature, J.T @ W @ self.values - known * self.changes)

    @cached_property
    def left(self) -> np.ndarray:
        """What an undamped step leaves of the values."""
        return self.values - self.slopes @ self.step()

    @cached_property
    def left_sd(self) -> float:
        """Norm of rᵀPr (physics.md §7.4): of what is left and of how unusual the constants became, in sd."""
        return float(np.sqrt(self._merit(self.left, self.changes + self.step())))


def absorbed(tests: Sequence[DeclaredTest]) -> Misfit | None:
    """The tests at the constants that come nearest to the truth; None without any test.

    Where the nearest valley leaves something to be seen, others are tried: a winding is known to a decade only.
    """
    begin = [r for test in tests if (r := test.residual({})) is not None]
    tests = [test for test in tests if test.name in {r.test for r in begin}]
    if not begin:
        return None
    names = tuple(sorted({name for r in begin for name in r.slopes}))
    best = _settled(Misfit(tuple(begin), names, np.zeros(len(names))), tests)
    for weaker in WEAKER:
        if best.left_sd < SEEN:
            break
        start = _moved(tests, names, np.array([weaker * _is_winding_modulus(name) for name in names]))
        if start is not None:
            best = min(best, _settled(start, tests, FAR_OFF * best.merit), key=lambda misfit: misfit.merit)
    return best


def _is_winding_modulus(name: str) -> bool:
    source, constant = name.rsplit(".", 1)
    return source.startswith("winding") and constant.endswith("_pa")


def _settled(misfit: Misfit, tests: Sequence[DeclaredTest], far: float = np.inf) -> Misfit:
    damping = DAMPING
    for number in range(ROUNDS):
        if number >= PATIENCE and misfit.merit > far:
            break
        step = misfit.step(damping)
        size = float(np.abs(step).max())
        if size < SMALL or damping > STIFFEST:
            break
        moved = _moved(tests, misfit.names, misfit.changes + min(1.0, LARGEST / size) * step)
        if moved is None or moved.merit >= misfit.merit:
            damping *= MORE
            continue
        gained, misfit, damping = misfit.merit - moved.merit, moved, LESS * damping
        if gained < GAIN * misfit.merit:
            break
    return misfit


def _moved(tests: Sequence[DeclaredTest], names: Sequence[str], changes: np.ndarray) -> Misfit | None:
    by_name: Mapping[str, float] = dict(zip(names, changes, strict=True))
    residuals = []
    for test in tests:
        residual = test.residual(by_name)
        if residual is None:
            return None
        residuals.append(residual)
    return Misfit(tuple(residuals), tuple(names), changes)

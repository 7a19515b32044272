"""What a roving sensor does to the FRFs of a body around an axis, exactly.

A mass m at point p turns the receptance H_pj into H_pj / (1 − ω² m G_p), with the receptance G_p of the point itself in
all directions in which the mass follows its radial motion (Sherman & Morrison 1950). Around a resonance G_p is that of
one doublet of order r: b/m · (cos² r(θ − α)/(s₁ − ω²) + sin² r(θ − α)/(s₂ − ω²)), b the same all around a measuring
plane. What the mass does by tangential motion, which both halves have alike, counts as part of the poles s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.roving.rings import Rings

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int_]

_NEWTON = 30
_SETTLED = 1e-12


@dataclass(frozen=True, eq=False)
class RovingLoad:
    """Modes without the sensor, and how it loads them at every plane.

    Attributes
    ----------
    poles : complex array, shape (modes,)
        ω²(1 + iη) of every doublet without the sensor, the mean of both halves ((rad/s)²).
    orders : int array, shape (modes,)
    load : array, shape (modes, planes)
        b = m φ², with the mass-normalised amplitude φ of the sensor's motion.
    load_sd : array, shape (modes, planes)
    split : array, shape (modes, 2)
        Difference of the halves' ω² over their mean, times cos 2rα and sin 2rα with the lower one's antinode α.
    misfit : array, shape (modes,)
        Mean squared residual over the noise.
    rings : Rings
        Where the sensor was.
    """

    poles: ComplexArray
    orders: IntArray
    load: FloatArray
    load_sd: FloatArray
    split: FloatArray
    misfit: FloatArray
    rings: Rings

    def __len__(self) -> int:
        return len(self.poles)

    def halves(self, mode: int) -> tuple[complex, complex]:
        """Poles of a doublet's halves, the lower one first."""
        half = 0.5 * float(np.hypot(*self.split[mode]))
        pole = complex(self.poles[mode])
        return pole * (1 - half), pole * (1 + half)

    def denominator(self, squared: FloatArray) -> ComplexArray:
        """1 − ω² m G_p of every point, shape (points, lines)."""
        found = np.ones((len(self.rings.plane), len(squared)), dtype=complex)
        for mode in range(len(self)):
            found -= self.part(mode, squared)
        return found

    def part(self, mode: int, squared: FloatArray) -> ComplexArray:
        """One mode's part of ω² m G_p, shape (points, lines)."""
        lower, upper = self.halves(mode)
        load = self.load[mode][self.rings.plane][:, None]
        if lower == upper:
            return np.asarray(load * (squared / (lower - squared)))
        phase = 2 * self.orders[mode] * self.rings.angles_rad - np.arctan2(*self.split[mode][::-1])
        share = 0.5 * (1 + np.cos(phase))[:, None]
        curves = [squared / (pole - squared) for pole in (lower, upper)]
        return np.asarray(load * (share * curves[0] + (1 - share) * curves[1]))

    def relative_shifts(self) -> FloatArray:
        """Fall of every mode's frequency at every plane, its antinode at the sensor, shape (modes, planes)."""
        return np.array([[self._shift(m, z) for z in range(self.load.shape[1])] for m in range(len(self))])

    def _shift(self, mode: int, plane: int) -> float:
        """By Newton's method on (s − x)(1 − x m G), both halves at the mean pole."""
        load, pole = self.load[:, plane], self.poles[mode]
        others = np.delete(np.arange(len(self)), mode)
        x = pole / (1 + load[mode])
        for _ in range(_NEWTON):
            apart = self.poles[others] - x
            rest = 1 - np.sum(load[others] * x / apart)
            slope = -np.sum(load[others] * self.poles[others] / apart**2)
            value = (pole - x) * rest - x * load[mode]
            step = value / (-rest + (pole - x) * slope - load[mode])
            x = x - step
            if abs(step) < _SETTLED * abs(pole):
                break
        return float(np.sqrt(x.real / pole.real) - 1)


def load_of(loaded: ComplexArray, bare: ComplexArray) -> ComplexArray:
    """Loads b that move poles at one plane, for Π (s' − x)/(s − x) is 1 − x Σ b/(s − x) but for its value at 0.

    Parameters
    ----------
    loaded, bare : complex arrays, shape (modes,)
    """
    scale = np.prod(bare / loaded)
    found = np.empty(len(bare), dtype=complex)
    for m, pole in enumerate(bare):
        others = np.delete(bare, m)
        found[m] = -scale * np.prod(np.delete(loaded, m) - pole) / np.prod(others - pole)
        found[m] *= (loaded[m] - pole) / pole
    return found

"""Unknowns of the load of a cluster of doublets: loads of the planes, loss factor, place and split of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.roving.load import RovingLoad

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int_]

_FIRST_SPLIT = 0.03  # of the loss factor
# Standard deviations from the first guess: of a load, of the mean load and of the loss factor (an image has no load);
# of a doublet's place, of the mean load.
_LOAD, _LEAST_LOAD_SD, _PLACE = 1.0, 0.05, 0.2
_SMALLEST_LOAD, _LARGEST_LOAD, _LARGEST_SPLIT = 1e-7, 0.2, 0.02
_LEAST_LOSS = 1e-6
_TO_ZERO = 0.9  # of the way to no load, at most in one step
_LARGEST_MOVE = 0.02  # of a place in one step, of ω²


@dataclass(frozen=True, eq=False)
class LoadUnknowns:
    """Which modes of a load are unknown, and where each unknown stands.

    One mode after the other: its loads by plane, loss factor, relative change of the place and both parts of the split.

    Attributes
    ----------
    own : tuple of int
        The modes.
    first : RovingLoad
        From which their places are counted.
    noise : float
        Misfit that no load explains, at least 1: data that the model misses tell the places less well.
    """

    own: tuple[int, ...]
    first: RovingLoad
    noise: float = 1.0

    @property
    def planes(self) -> int:
        return int(self.first.load.shape[1])

    @property
    def _each(self) -> int:
        return self.planes + 4

    def of_plane(self, plane: int) -> IntArray:
        """Places of the unknowns that one plane's FRFs depend on, in the order of `steps`."""
        return np.array(
            [
                number * self._each + one
                for number in range(len(self.own))
                for one in (plane, *range(self.planes, self._each))
            ]
        )

    def places(self, load: RovingLoad) -> ComplexArray:
        """Where the modes' poles lie, with and without the sensor."""
        return np.concatenate(
            [[load.poles[m], *(load.poles[m] / (1 + load.load[m]))] for m in self.own], dtype=complex
        )

    def halves(self, load: RovingLoad) -> ComplexArray:
        """Poles without the sensor: two of a doublet, one of a mode that has no split."""
        found = [
            pole for m in self.own for pole in (load.halves(m) if load.split[m].any() else load.halves(m)[:1])
        ]
        return np.array(found, dtype=complex)

    def split(self, load: RovingLoad) -> RovingLoad:
        """With a small split of doublets that have none: two equal poles are one column."""
        equal = [m for m in self.own if load.orders[m] > 0 and not load.split[m].any()]
        if not equal:
            return load
        split = load.split.copy()
        for m in equal:
            split[m] = _FIRST_SPLIT * load.poles[m].imag / load.poles[m].real / np.sqrt(2)
        return replace(load, split=split)

    def steps(self, load: RovingLoad, size: float) -> Iterator[RovingLoad]:
        """One unknown changed at a time, but the loads of all planes together."""
        for number in range(len(self.own)):
            begin = number * self._each
            for places in (
                [begin + z for z in range(self.planes)],
                *([begin + self.planes + i] for i in range(4)),
            ):
                step = np.zeros(len(self.own) * self._each)
                step[places] = size
                yield self._changed(load, step)

    def moved(self, load: RovingLoad, step: FloatArray) -> RovingLoad:
        """After a step of all unknowns, inside what a sensor can do."""
        found = self._changed(load, self._shortened(load, step))
        split, poles = found.split.copy(), found.poles.copy()
        rows = list(self.own)
        size = np.linalg.norm(split[rows], axis=1, keepdims=True)
        split[rows] *= np.minimum(1.0, _LARGEST_SPLIT / np.maximum(size, np.finfo(float).tiny))
        poles[rows] = poles[rows].real * (
            1 + 1j * np.maximum(poles[rows].imag / poles[rows].real, _LEAST_LOSS)
        )
        return replace(
            found, load=np.clip(found.load, _SMALLEST_LOAD, _LARGEST_LOAD), split=split, poles=poles
        )

    def _shortened(self, load: RovingLoad, step: FloatArray) -> FloatArray:
        """The same step, that of a mode as a whole shorter where it would take a plane's load or carry the mode off."""
        steps = step.reshape(len(self.own), -1).copy()
        for row, m in zip(steps, self.own, strict=True):
            fall = np.max(-row[: self.planes] / load.load[m], initial=0.0)
            row *= min(1.0, _TO_ZERO / fall) if fall > 0 else 1.0
            place = abs(row[self.planes + 1])
            row *= min(1.0, _LARGEST_MOVE / place) if place > 0 else 1.0
        return np.asarray(steps.ravel())

    def _changed(self, load: RovingLoad, step: FloatArray) -> RovingLoad:
        loads, poles, split = load.load.copy(), load.poles.copy(), load.split.copy()
        for m, own in zip(self.own, step.reshape(len(self.own), -1), strict=True):
            loads[m] += own[: self.planes]
            loss, place = own[self.planes : self.planes + 2]
            poles[m] = poles[m].real * (1 + place) * (1 + 1j * (poles[m].imag / poles[m].real + loss))
            if load.orders[m] > 0:
                split[m] += own[self.planes + 2 :]
        return replace(load, load=loads, poles=poles, split=split)

    def _expected_sd(self) -> FloatArray:
        """Of loads and place against the first guess, shape (modes, planes + 1)."""
        mean = self.first.load[list(self.own)].mean(axis=1)
        poles = self.first.poles[list(self.own)]
        loads = _LOAD * mean + _LEAST_LOAD_SD * poles.imag / poles.real
        columns = [*[loads] * self.planes, _PLACE * mean]
        return np.asarray(np.stack(columns, axis=1) / np.sqrt(self.noise))

    def _expected_places(self) -> IntArray:
        """Where the unknowns of `_expected_sd` stand."""
        of_one = [*range(self.planes), self.planes + 1]
        return np.array([number * self._each + one for number in range(len(self.own)) for one in of_one])

    def kept(self, load: RovingLoad) -> FloatArray:
        """How far loads and places are from the first guess, over what is expected."""
        rows = list(self.own)
        moved = load.poles[rows].real / self.first.poles[rows].real - 1
        apart = np.column_stack([load.load[rows] - self.first.load[rows], moved])
        return np.asarray((apart / self._expected_sd()).ravel())

    def prior(self, load: RovingLoad) -> tuple[FloatArray, FloatArray]:
        """Curvature and slope of what is expected; without a split nothing else tells the places."""
        normal = np.zeros((len(self.own) * self._each,) * 2)
        slope = np.zeros(len(normal))
        at, sd = self._expected_places(), self._expected_sd().ravel()
        normal[at, at] = sd**-2.0
        slope[at] = self.kept(load) / sd
        return normal, slope

    def load_sd(self, normal: FloatArray) -> FloatArray:
        """Standard deviations of the loads against each other, shape (modes, planes): a place changes all alike."""
        places = [number * self._each + self.planes + 1 for number in range(len(self.own))]
        others = np.delete(np.arange(len(normal)), places)
        size = np.sqrt(np.maximum(np.diag(normal)[others], np.finfo(float).tiny))
        covariance = np.linalg.pinv(normal[np.ix_(others, others)] / np.outer(size, size), hermitian=True)
        sd = np.full(len(normal), np.inf)
        sd[others] = np.sqrt(np.maximum(np.diag(covariance), 0.0)) / size
        return np.asarray(sd.reshape(len(self.own), -1)[:, : self.planes])

"""A mesh-convergence study as a table: frequencies over element sizes, with the error that extrapolation shows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import SolverError
from statorhom.model.convergence import extrapolate

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class MeshStudy:
    """Frequencies of the same modes on a series of meshes.

    Attributes
    ----------
    size : array, shape (meshes,)
        Element sizes in one unit, coarsest first.
    frequency_hz : array, shape (meshes, modes)
    seconds : array, shape (meshes,), or None
        Time of each computation.
    extrapolated_hz, sd_hz : arrays, shape (modes,)
        Of infinitely fine meshes (Richardson), and the standard deviation of that.
    """

    size: FloatArray
    frequency_hz: FloatArray
    seconds: FloatArray | None
    extrapolated_hz: FloatArray
    sd_hz: FloatArray

    def __post_init__(self) -> None:
        for array in (self.size, self.frequency_hz, self.extrapolated_hz, self.sd_hz):
            array.setflags(write=False)

    @property
    def error(self) -> FloatArray:
        """Relative error of every frequency against the extrapolated one, shape (meshes, modes)."""
        return np.asarray(self.frequency_hz / self.extrapolated_hz - 1)

    @property
    def change(self) -> FloatArray:
        """Relative change from each mesh to the next finer one, shape (meshes − 1, modes)."""
        return np.asarray(self.frequency_hz[1:] / self.frequency_hz[:-1] - 1)

    @property
    def total_change(self) -> FloatArray:
        """Relative change from the coarsest to the finest mesh, shape (modes,)."""
        return np.asarray(self.frequency_hz[-1] / self.frequency_hz[0] - 1)

    @property
    def cost_order(self) -> float | None:
        """Exponent q of time ∝ size^−q, by least squares; None without times."""
        if self.seconds is None:
            return None
        return -float(np.polyfit(np.log(self.size), np.log(self.seconds), 1)[0])

    def rows(self) -> list[dict[str, float]]:
        """One row per mesh, and a last one of size 0 for the extrapolated frequencies with their deviations."""
        modes = range(1, self.frequency_hz.shape[1] + 1)
        table = []
        for i, size in enumerate(self.size.tolist()):
            row = {"size": size}
            for mode in modes:
                row[f"frequency_{mode}_hz"] = float(self.frequency_hz[i, mode - 1])
                row[f"error_{mode}_percent"] = 100 * float(self.error[i, mode - 1])
            if self.seconds is not None:
                row["seconds"] = float(self.seconds[i])
            table.append(row)
        last = {"size": 0.0}
        for mode in modes:
            last[f"frequency_{mode}_hz"] = float(self.extrapolated_hz[mode - 1])
            last[f"error_{mode}_percent"] = 100 * float(self.sd_hz[mode - 1] / self.extrapolated_hz[mode - 1])
        return [*table, last]


def mesh_study(
    size: npt.ArrayLike, frequency_hz: Sequence[npt.ArrayLike], seconds: npt.ArrayLike | None = None
) -> MeshStudy:
    """Extrapolate a series of meshes.

    Parameters
    ----------
    size : array_like, shape (meshes,)
        Element sizes, in any order and unit; two at least, all different.
    frequency_hz : sequence of array_like, shape (meshes, modes)
        The same modes on every mesh.
    seconds : array_like, shape (meshes,), optional

    Raises
    ------
    SolverError
        When the lists do not fit, or are not of positive numbers.
    """
    sizes = np.asarray(size, dtype=float)
    frequencies = np.asarray(frequency_hz, dtype=float)
    times = None if seconds is None else np.asarray(seconds, dtype=float)
    if sizes.ndim != 1 or len(sizes) < 2 or frequencies.ndim != 2 or len(frequencies) != len(sizes):
        raise SolverError(
            "a mesh study needs two sizes at least and the frequencies of the same modes on each mesh"
        )
    if times is not None and times.shape != sizes.shape:
        raise SolverError(f"{len(sizes)} meshes need {len(sizes)} times, not {times.size}")
    given = [sizes, frequencies] if times is None else [sizes, frequencies, times]
    if not all(np.isfinite(one).all() and np.all(one > 0) for one in given):
        raise SolverError("sizes, frequencies and times of a mesh study must be positive numbers")
    if len(np.unique(sizes)) < len(sizes):
        raise SolverError("two meshes of a study have the same element size: leave one out")
    order = np.argsort(-sizes)
    sizes, frequencies = sizes[order], frequencies[order]
    limits = np.array([extrapolate(sizes, column) for column in frequencies.T])
    return MeshStudy(sizes, frequencies, None if times is None else times[order], limits[:, 0], limits[:, 1])

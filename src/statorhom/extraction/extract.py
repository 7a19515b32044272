"""From FRFs to modes with uncertainty."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from statorhom.extraction.extraction import ExtractedMode, Extraction, residual_lines
from statorhom.extraction.mode_estimates import mode_estimates
from statorhom.extraction.mode_search import FittedWindow, ModeSearch
from statorhom.extraction.moving_modes import few_stay, stay
from statorhom.extraction.noise import expected_sd, noise_sd
from statorhom.extraction.point_grid import PointGrid, point_grid
from statorhom.extraction.roving.find_load import find_load, freed
from statorhom.extraction.roving.load import RovingLoad
from statorhom.extraction.roving.loaded import loaded
from statorhom.extraction.stabilization import LEAST_SHARE, Stabilization, stabilize
from statorhom.extraction.unresolved import without_unresolved
from statorhom.recordings.frf_set import FrfSet

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
# stable poles and participations, and what tells them
Start = tuple[ComplexArray, ComplexArray, Stabilization]

_BROAD = 0.1  # loss factor from which on a mode has no peak of its own among others; then …
_KNOWN = 5e-4  # … its frequency's standard deviation must be less than this part of it
_AT_NOISE = 1.2  # misfit, of the noise …
_CLEAR_SHAPE = 10.0  # … and least shape, of its standard deviation, of a mode that no stable pole shows
_LOCATED = 0.5  # largest standard deviation of a mode's frequency, in half-power bandwidths


def extract(frf_sets: FrfSet | Sequence[FrfSet], band_hz: tuple[float, float] | None = None) -> Extraction:
    """Modes of a test from its FRFs.

    Start values are the stable poles of the poly-reference least-squares complex frequency estimator; every
    cluster of modes is then fitted by maximum likelihood, and modes are removed and added until each is worth
    its unknowns.

    Parameters
    ----------
    frf_sets : FrfSet or sequence of FrfSet
        One test; repeated pairs of points are averaged, and three or more tell the noise.
    band_hz : (low, high), optional
        Lines to use; all by default.

    Raises
    ------
    ExtractionError
        When frequency axes differ, the band holds too few lines or no finite value.
    """
    sets = [frf_sets] if isinstance(frf_sets, FrfSet) else list(frf_sets)
    grid = point_grid(sets, band_hz)
    noise = noise_sd(grid)
    sd = expected_sd(grid, noise)
    decay = float(np.mean([one.window_decay_per_s for one in sets]))
    start = stabilize(grid, sd)
    search, stable = _search(grid, sd, start), start[2]
    first = search.first_look()
    if search.set_ups is not None:
        # what looks from afar like poles that move may be doublets that are barely split, or modes that lie close
        still = _search(grid, sd, start, steady=True)
        windows = still.run(lambda found: few_stay([one.fitted for one in found]))
        if stay([one.fitted for one in windows]):
            return _extraction(still, windows, noise, stable, decay)
        load = find_load(search, first)
        if load is not None:
            return _freed(grid, noise, load, decay)
    return _extraction(search, search.run(), noise, stable, decay)


def _freed(grid: PointGrid, noise: FloatArray, load: RovingLoad, decay: float) -> Extraction:
    """Modes of a recording that is freed of a load."""
    grid, noise, missed = freed(grid, noise, load)
    sd = np.hypot(expected_sd(grid, noise), missed)
    start = stabilize(grid, sd)
    search = _search(grid, sd, start, steady=True)
    return loaded(_extraction(search, search.run(), noise, start[2], decay), load)


def _search(grid: PointGrid, sd: FloatArray, start: Start, steady: bool = False) -> ModeSearch:
    """A search that begins at the stable poles; `steady`: of a recording whose poles are known not to move."""
    poles, parts, stabilization = start
    return ModeSearch(grid, sd, poles, parts, stabilization.lasting_squared, steady)


def _extraction(
    search: ModeSearch,
    fitted: Sequence[FittedWindow],
    noise: FloatArray,
    stable: Stabilization,
    decay: float,
) -> Extraction:
    grid = search.grid
    windows = [without_unresolved(one) for one in fitted]
    found = [mode for one, _ in windows for mode in mode_estimates(one, grid, stable, decay)]
    found.sort(key=lambda mode: mode.frequency_hz)
    band = (float(grid.omega[0] / (2 * np.pi)), float(grid.omega[-1] / (2 * np.pi)))
    listed = [_is_mode(mode, band) for mode in found]
    modes = tuple(mode for mode, inside in zip(found, listed, strict=True) if inside)
    outside = tuple(mode for mode, inside in zip(found, listed, strict=True) if not inside)
    mass_line, stiffness_line = _residual_terms(grid, search.sd, found)
    return Extraction(
        modes,
        outside,
        grid.points,
        grid.references,
        grid.hammer_roved,
        grid.cells,
        band,
        mass_line,
        stiffness_line,
        float(np.median((noise / np.maximum(np.abs(grid.receptance), np.finfo(float).tiny))[grid.measured])),
        stable,
        tuple(
            [
                *_merged_remarks([pole for _, poles in windows for pole in poles], len(grid.references)),
                *_remarks(modes, outside, band),
            ]
        ),
    )


def _is_mode(mode: ExtractedMode, band: tuple[float, float]) -> bool:
    """Whether a pole is listed: inside the band, located, and shown by enough model orders or clear."""
    broad = mode.bandwidth_hz > _BROAD * mode.frequency_hz
    located = mode.frequency_sd_hz < (_KNOWN * mode.frequency_hz if broad else _LOCATED * mode.bandwidth_hz)
    return (
        band[0] <= mode.frequency_hz <= band[1]
        and located
        and (mode.stability >= LEAST_SHARE or _clear(mode))
    )


def _clear(mode: ExtractedMode) -> bool:
    """Whether a mode needs no vote of the start estimator, whose orders go to stronger ones nearby.

    Where noise explains what the modes leave, no ripple of the recording is taken for one.
    """
    return mode.misfit < _AT_NOISE and mode.shape_to_noise > _CLEAR_SHAPE


def _residual_terms(
    grid: PointGrid, sd: FloatArray, modes: Sequence[ExtractedMode]
) -> tuple[ComplexArray, ComplexArray]:
    """Mass line and stiffness line of every pair: weighted least squares on what the modes leave."""
    frequency = grid.omega / (2 * np.pi)
    rest = grid.receptance.copy()
    for mode in modes:
        rest -= mode.receptance(frequency)
    shape = rest.shape[:2]
    one, none = np.ones(shape, dtype=complex), np.zeros(shape, dtype=complex)
    columns = np.stack([residual_lines(one, none, frequency), residual_lines(none, one, frequency)], axis=-1)
    # the misfit of strong modes is part of what the terms must not chase
    weight = np.where(grid.measured, 1.0 / np.hypot(sd, np.abs(rest)), 0.0)[..., None]
    norm = np.maximum(np.linalg.norm(columns * weight, axis=-2, keepdims=True), np.finfo(float).tiny)
    scaled = columns * weight / norm
    gram = scaled.conj().swapaxes(-1, -2) @ scaled
    right = scaled.conj().swapaxes(-1, -2) @ (rest[..., None] * weight)
    solution = (np.linalg.pinv(gram, rcond=1e-12, hermitian=True) @ right)[..., 0] / norm[..., 0, :]
    return solution[..., 0], solution[..., 1]


def _merged_remarks(poles: Sequence[complex], references: int) -> list[str]:
    """What is said of modes that were not told apart."""
    remedy = (
        "cannot be resolved from one reference: hit a second point"
        if references == 1
        else "cannot be resolved"
    )
    return [
        f"near {np.sqrt(pole.real) / (2 * np.pi):.2f} Hz two modes of almost one frequency show, a doublet perhaps, "
        f"which {remedy}; one is listed"
        for pole in poles
    ]


def _remarks(
    modes: tuple[ExtractedMode, ...], outside: tuple[ExtractedMode, ...], band: tuple[float, float]
) -> list[str]:
    remarks = []
    for mode in outside:
        if band[0] <= mode.frequency_hz <= band[1]:
            remarks.append(
                f"near {mode.frequency_hz:.1f} Hz a mode is doubtful: {100 * mode.stability:.0f} % of the model "
                f"orders show it, its frequency is known to {mode.frequency_sd_hz:.2g} Hz; it is not listed"
            )
    for mode in modes:
        if mode.loss_factor <= 0:
            remarks.append(
                f"the mode at {mode.frequency_hz:.1f} Hz is damped less than the exponential window alone would "
                "damp it: check the window's decay"
            )
    return remarks

"""Modes and their standard deviations from the fit of a window."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.extraction.extraction import ExtractedMode
from statorhom.extraction.modal_model import free_parts
from statorhom.extraction.mode_search import FittedWindow
from statorhom.extraction.point_grid import PointGrid
from statorhom.extraction.pole_price import dispersion, misfit
from statorhom.extraction.stabilization import Stabilization
from statorhom.modes.phase import in_phase, phase_collinearity
from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_SAME_PLACE_M = 1e-6
_PARALLEL = 0.999


def mode_estimates(
    fitted: FittedWindow, grid: PointGrid, stabilization: Stabilization, window_decay_per_s: float
) -> list[ExtractedMode]:
    """All modes of a window; standard deviations count misfit beyond the noise as noise."""
    fit = fitted.fit
    count = len(fit.modes)
    excess = dispersion(fitted.window, fit)
    covariance = np.linalg.pinv(fit.hessian, rcond=1e-14, hermitian=True) * excess
    linear = np.einsum("kcc->kc", fit.linear.inverse).real * excess
    moved = np.einsum("kcp,pq,kcq->kc", fit.cross, covariance, fit.cross.conj()).real
    amplitude = fit.linear.unscaled
    amplitude_sd = np.sqrt(linear + np.maximum(moved, 0.0)) / fit.linear.norms
    amplitude_sd[linear <= 0] = np.inf  # points without data in the window
    free = free_parts(fit.modes)
    drive = driving_point(grid.points, grid.references)
    modes = []
    for m in range(count):
        part_sd = np.zeros(len(grid.references))
        for i, (mode, reference) in enumerate(free):
            if mode == m:
                part_sd[reference] = np.sqrt(max(float(covariance[count + i, count + i].real), 0.0))
        pole = complex(fit.modes.poles[m]) * fitted.window.unit
        # real and imaginary part of a circular complex figure share its variance
        pole_sd = np.sqrt(max(float(covariance[m, m].real), 0.0) / 2) * fitted.window.unit
        residue = amplitude[:, m] * fitted.window.unit
        residue_sd = amplitude_sd[:, m] * fitted.window.unit
        modes.append(
            _mode(pole, pole_sd, residue, residue_sd, fit.modes.parts[m], part_sd, drive, window_decay_per_s)
            | {
                "misfit": float(np.sqrt(misfit(fitted.window, fit))),
                "stability": stabilization.share(pole),
                "shift": fit.modes.shift[:, m] if fit.modes.moving[m] else None,
            }
        )
    return [ExtractedMode(**fields) for fields in modes]


def _mode(
    pole: complex,
    pole_sd: float,
    residue: ComplexArray,
    residue_sd: FloatArray,
    part: ComplexArray,
    part_sd: FloatArray,
    drive: tuple[int, int, float] | None,
    window_decay_per_s: float,
) -> dict:
    omega = float(np.sqrt(pole.real))
    turned = in_phase(residue)
    scale = float(np.max(np.abs(residue))) or 1.0
    # what the shape was turned and scaled by goes into the participation: their product stays the residue
    largest = int(np.argmax(np.abs(residue)))
    factor = residue[largest] / turned[largest] * scale if residue[largest] else 1.0
    shape = turned / scale
    constant, constant_sd = None, None
    if drive is not None:
        k, j, sign = drive
        constant = complex(residue[k] * part[j] * sign)
        constant_sd = float(np.hypot(residue_sd[k] * abs(part[j]), abs(residue[k]) * part_sd[j]))
    return {
        "frequency_hz": omega / (2 * np.pi),
        "frequency_sd_hz": pole_sd / (2 * omega) / (2 * np.pi),
        # a window's decay σ adds 2σ/ω to the loss factor
        "loss_factor": pole.imag / pole.real - 2 * window_decay_per_s / omega,
        "loss_factor_sd": pole_sd / pole.real,
        "shape": shape,
        "shape_sd": residue_sd / scale,
        "participation": part * factor,
        "participation_sd": part_sd * abs(factor),
        "modal_constant_per_kg": constant,
        "modal_constant_sd_per_kg": constant_sd,
        "phase_collinearity": phase_collinearity(shape),
        "observed": pole,
    }


def driving_point(points: tuple[Dof, ...], references: tuple[Dof, ...]) -> tuple[int, int, float] | None:
    """Point, reference and sign (−1 where their directions oppose) of the first driving point."""
    for j, reference in enumerate(references):
        for k, point in enumerate(points):
            if not _same_place(point, reference):
                continue
            if point.direction is None or reference.direction is None:
                return k, j, 1.0
            along = float(np.dot(point.direction, reference.direction))
            if abs(along) > _PARALLEL:
                return k, j, float(np.sign(along))
    return None


def _same_place(one: Dof, other: Dof) -> bool:
    if one.position is None or other.position is None:
        return one.node == other.node
    return float(np.linalg.norm(np.subtract(one.position, other.position))) < _SAME_PLACE_M

"""Whether a recording's poles move as a heavy roving sensor moves them, and its load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.mode_search import FittedWindow, ModeSearch
from statorhom.extraction.moving_modes import distinct
from statorhom.extraction.point_grid import PointGrid
from statorhom.extraction.roving.first_load import first_load
from statorhom.extraction.roving.load import RovingLoad
from statorhom.extraction.roving.load_fit import fitted_load
from statorhom.extraction.roving.plane_alignment import aligned
from statorhom.extraction.roving.plane_poles import plane_poles
from statorhom.extraction.roving.plane_starts import BROAD, plane_starts
from statorhom.extraction.roving.rings import Rings, rings
from statorhom.extraction.set_up_shifts import SetUps

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_EXPLAINED = 3.0  # median misfit up to which a load explains a recording
_WELL = 1.5  # misfit around every mode up to which no other load is looked for
_HOPELESS = 30.0  # median misfit of single planes from which on no load explains all of them
_MODEL = 0.003  # part of what the load changes that its model may miss


def find_load(search: ModeSearch, first: Sequence[FittedWindow]) -> RovingLoad | None:
    """The load that explains a recording whose poles move from point to point; None where none does."""
    placed = None if search.grid.hammer_roved else rings(search.grid.points)
    known = all(one.position is not None for one in search.grid.references)
    start = _start(first)
    if search.set_ups is not SetUps.POINTS or placed is None or not known or not len(start):
        return None
    # the first look takes a split doublet for one mode, but so it does with different modes that lie close
    load = _from(search, start, placed)
    if load is not None and load.misfit.max() < _WELL:
        return load
    other = _from(search, plane_starts(search, placed), placed)
    found = [one for one in (load, other) if one is not None]
    # around a mode that one of them lacks it leaves much, of which the median says nothing
    return min(found, key=lambda one: float(np.mean(np.log(one.misfit))), default=None)


def _from(search: ModeSearch, start: ComplexArray, placed: Rings) -> RovingLoad | None:
    """The load that explains a recording, from start poles of its modes as in `plane_poles`."""
    if not start.size:
        return None
    found = aligned(plane_poles(search, start, placed), placed)
    guess = first_load(found, search.unit, placed, search.grid.references)
    if guess is None or np.median(guess.misfit) > _HOPELESS:
        return None
    load = fitted_load(search, guess)
    return load if np.median(load.misfit) < _EXPLAINED else None


def _start(first: Sequence[FittedWindow]) -> ComplexArray:
    """One pole of every mode, in ascending frequency."""
    poles = np.concatenate(
        [np.zeros(0), *(one.fit.modes.poles[distinct(one.fit)] for one in first if len(one.fit.modes))]
    )
    narrow = poles[poles.imag < BROAD * poles.real]
    return np.asarray(narrow[np.argsort(narrow.real)], dtype=complex)


def freed(grid: PointGrid, noise: FloatArray, load: RovingLoad) -> tuple[PointGrid, FloatArray, FloatArray]:
    """The FRFs of the structure without the sensor, their noise, and what the load's model may miss."""
    factor = load.denominator(grid.omega**2)[:, None]
    size = np.abs(factor)
    missed = _MODEL * np.abs(grid.receptance) * np.abs(factor - 1)
    repeats = tuple(one * factor for one in grid.repeats)
    return replace(grid, receptance=grid.receptance * factor, repeats=repeats), noise * size, missed

"""Functions of a universal file that are FRFs, made accelerances in SI, with their coherences."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

import numpy as np

from statorhom.recordings.frf_groups import Frf, same_axis
from statorhom.recordings.uff.function import Function
from statorhom.recordings.uff.function_header import COHERENCE, FRF, FunctionHeader
from statorhom.recordings.uff.nodes import Geometry
from statorhom.recordings.uff.quantities import FREQUENCY, is_per_force, plain, quantity, scale_to_si
from statorhom.recordings.uff.units import Units

_ORDINATE_LINE, _DENOMINATOR_LINE, _ABSCISSA_LINE = 10, 11, 9
# acceleration is iω times velocity and (iω)² times displacement
_DERIVATIVES = {"acceleration": 0, "velocity": 1, "displacement": 2}
_HERTZ = ("", "hz", "hertz", "1/s", "s-1")
_ROTATION = 4

Pair = tuple[int, int, int, int]


def frfs(functions: Sequence[Function], geometry: Geometry, units: Units) -> tuple[list[Frf], list[str]]:
    """The FRFs among functions.

    Parameters
    ----------
    functions : sequence of Function
    geometry : Geometry
    units : Units

    Returns
    -------
    frfs : list of Frf
    remarks : list of str
        What is no accelerance, mobility or receptance of translations, and is left out.

    Raises
    ------
    RecordingError
        Where units, frequencies or directions contradict the rest of the file.
    """
    coherences = defaultdict(list)
    for function in functions:
        if function.header.kind == COHERENCE:
            coherences[_pair(function.header)].append(function)
    noted: Counter[str] = Counter()
    unknown_units: set[str] = set()
    found = []
    for function in functions:
        header = function.header
        if header.kind != FRF:
            continue
        reason = _why_not(header)
        if reason:
            noted[reason] += 1
            continue
        if not header.is_complex:
            noted["are real (kept, without phase)"] += 1
        _check_frequencies(function)
        accelerance = _accelerance(function, units, unknown_units)
        coherence = _coherence(function, coherences[_pair(header)])
        response = geometry.dof(header.response_node, header.response_direction)
        reference = geometry.dof(header.reference_node, header.reference_direction)
        found.append(Frf(response, reference, function.abscissa, accelerance, coherence))
    remarks = [f"{count} FRFs {reason}" for reason, count in noted.items()]
    remarks += [f'unit "{unit}" is taken for that of the file' for unit in sorted(unknown_units)]
    spare = sum(map(len, coherences.values()))
    return found, remarks + ([f"{spare} coherences belong to no FRF and are left out"] if spare else [])


def _pair(header: FunctionHeader) -> Pair:
    return (
        header.response_node,
        header.response_direction,
        header.reference_node,
        header.reference_direction,
    )


def _why_not(header: FunctionHeader) -> str:
    if max(abs(header.response_direction), abs(header.reference_direction)) >= _ROTATION:
        return "are of rotations or moments and are left out"
    if not is_per_force(header.ordinate, header.denominator):
        return "are not per force and are left out"
    if quantity(header.ordinate) not in _DERIVATIVES:
        return "are of no acceleration, velocity or displacement and are left out"
    return ""


def _check_frequencies(function: Function) -> None:
    axis, frequency = function.header.abscissa, function.abscissa
    if axis.quantity not in (0, 1, FREQUENCY) or plain(axis.unit) not in _HERTZ:
        raise function.place.error(
            _ABSCISSA_LINE,
            "the abscissa of an FRF is not a frequency in Hz",
            "export it over frequency in Hz",
        )
    if not np.isfinite(frequency).all() or frequency[0] < 0 or (np.diff(frequency) <= 0).any():
        raise function.place.error(None, "frequencies do not ascend from 0 or above", "export the FRF again")


def _accelerance(function: Function, units: Units, unknown_units: set[str]) -> np.ndarray:
    header = function.header
    motion = quantity(header.ordinate)
    assert motion is not None
    scale, known = scale_to_si(function.place, _ORDINATE_LINE, motion, header.ordinate.unit, units)
    force, force_known = scale_to_si(
        function.place, _DENOMINATOR_LINE, "force", header.denominator.unit, units
    )
    if not known:
        unknown_units.add(header.ordinate.unit)
    if not force_known:
        unknown_units.add(header.denominator.unit)
    order = _DERIVATIVES[motion]
    if order == 0 and scale == force:
        return function.values
    return function.values * (scale / force * (2j * np.pi * function.abscissa) ** order)


def _coherence(function: Function, candidates: list[Function]) -> np.ndarray | None:
    """The first coherence of the pair that no earlier FRF of the same pair has taken."""
    for index, candidate in enumerate(candidates):
        if same_axis(candidate.abscissa, function.abscissa):
            return np.asarray(candidates.pop(index).values.real, dtype=float)
    return None

"""Single FRFs, as files hold them, brought together into sets that share a frequency axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet

# files print frequencies with six digits
_SAME_AXIS = 1e-5


@dataclass(frozen=True)
class Frf:
    """One accelerance on its own frequency axis, ascending and finite.

    Attributes
    ----------
    response, reference : Dof
    frequency_hz : array, shape (lines,)
    accelerance : complex array, shape (lines,)
        (m/s²)/N; single precision where the file has no more.
    coherence : array, shape (lines,), or None
    """

    response: Dof
    reference: Dof
    frequency_hz: np.ndarray
    accelerance: np.ndarray
    coherence: np.ndarray | None = None


def frf_sets(frfs: Sequence[Frf], source: str) -> tuple[tuple[FrfSet, ...], tuple[str, ...]]:
    """Sets of FRFs that share their frequencies, in the order in which the axes occur.

    Lines at which no FRF of a set is a number are left out (many analysers write none at 0 Hz), and so are
    FRFs that still are not numbers somewhere.

    Parameters
    ----------
    frfs : sequence of Frf
    source : str
        File that they come from.

    Returns
    -------
    sets : tuple of FrfSet
    remarks : tuple of str
        What was left out.
    """
    groups: list[list[Frf]] = []
    for frf in frfs:
        for group in groups:
            if same_axis(group[0].frequency_hz, frf.frequency_hz):
                group.append(frf)
                break
        else:
            groups.append([frf])
    remarks: list[str] = []
    if len(groups) > 1:
        remarks.append(f"FRFs have {len(groups)} different frequency axes and are kept in as many sets")
    sets = [_frf_set(group, source, remarks) for group in groups]
    return tuple(frfs_of_axis for frfs_of_axis in sets if frfs_of_axis is not None), tuple(remarks)


def single_frfs(frf_set: FrfSet) -> list[Frf]:
    """The FRFs of a set one by one."""
    return [
        Frf(
            frf_set.responses[row],
            frf_set.references[row],
            frf_set.frequency_hz,
            frf_set.accelerance[row],
            None if frf_set.coherence is None else frf_set.coherence[row],
        )
        for row in range(len(frf_set))
    ]


def same_axis(first: np.ndarray, second: np.ndarray) -> bool:
    """Whether two axes differ by no more than the digits that files print."""
    return len(first) == len(second) and bool(np.allclose(first, second, rtol=_SAME_AXIS, atol=0.0))


def _frf_set(group: list[Frf], source: str, remarks: list[str]) -> FrfSet | None:
    usable = [np.isfinite(frf.accelerance) for frf in group]
    lines = np.any(usable, axis=0)
    if not lines.all() and lines.any():
        remarks.append(f"{np.sum(~lines)} lines at which no FRF is a number are left out")
    kept = []
    for frf, finite in zip(group, usable, strict=True):
        if finite.any() and finite[lines].all():
            kept.append(frf)
        else:
            remarks.append(f"{_pair(frf)} is not a number at {np.sum(~finite)} lines and is left out")
    if not kept:
        return None
    accelerance = np.empty((len(kept), int(lines.sum())), dtype=complex)
    for row, frf in zip(accelerance, kept, strict=True):
        row[:] = frf.accelerance[lines]
    return FrfSet(
        frequency_hz=kept[0].frequency_hz[lines],
        responses=tuple(frf.response for frf in kept),
        references=tuple(frf.reference for frf in kept),
        accelerance=accelerance,
        coherence=_coherence(kept, lines),
        source=source,
    )


def _coherence(frfs: list[Frf], lines: np.ndarray) -> np.ndarray | None:
    if all(frf.coherence is None for frf in frfs):
        return None
    coherence = np.full((len(frfs), int(lines.sum())), np.nan)
    for row, frf in zip(coherence, frfs, strict=True):
        if frf.coherence is not None:
            row[:] = frf.coherence[lines]
    return coherence


def _pair(frf: Frf) -> str:
    return f"FRF of response {frf.response.node} and reference {frf.reference.node}"

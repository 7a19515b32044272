"""Modes followed from where they were paired: what is predicted of them changes continuously with the constants.

A mode's own name changes at a point: its rank when another mode of its family becomes visible, its node planes when
their number is doubtful. Its place in its harmonic problem does not, for modes of one problem avoid to cross. But where
two of them come near each other they exchange their shapes; then the name is what stays. That is the name that it had
where it was paired; what it is known by may be another one, of the reference (`statorhom.diagnose.stages.same_shapes`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import NamedTuple

from statorhom.model.convergence import ModeKey
from statorhom.model.stator_mode import StatorMode


class Followed(NamedTuple):
    """Names of a mode where it was paired.

    Parameters
    ----------
    key : that it is known by.
    family : its own there.
    """

    key: ModeKey
    family: tuple[int, int] | None


Names = Mapping[tuple[int, int], Followed]  # of modes by `StatorMode.place`


def names_of(modes: Mapping[ModeKey, StatorMode]) -> Names:
    """The names that modes have, by their places."""
    return {mode.place: Followed(key, mode.family) for key, mode in modes.items()}


def with_partners(
    names: Mapping[str, Names], held: Mapping[str, Collection[ModeKey | None]]
) -> dict[str, Names]:
    """The names in the harmonic problems that hold a partner of any measured mode; others are followed by themselves.

    Parameters
    ----------
    names, held : test → names and partners, of the tests of one step.
    """
    problems = {p for test, own in names.items() for (p, _), one in own.items() if one.key in held[test]}
    return {
        test: {place: one for place, one in own.items() if place[0] in problems}
        for test, own in names.items()
    }


def named(modes: Iterable[StatorMode], names: Names) -> dict[ModeKey, StatorMode]:
    """Modes by the names that they had where they were paired.

    Parameters
    ----------
    modes : sorted by frequency.
    names : by place.
    """
    here = {mode.place: mode for mode in modes}
    found = {
        one.key: here[place]
        for place, one in names.items()
        if place in here and here[place].family in (one.family, None)
    }
    missing = [(place, one) for place, one in names.items() if one.key not in found]
    if not missing:
        return found
    taken = {mode.place for mode in found.values()}
    free = {place: mode for place, mode in here.items() if place not in taken}
    for place, one in missing:
        same = [p for p, mode in free.items() if p[0] == place[0] and mode.family == one.family]
        nearest = min(same, key=lambda p: abs(p[1] - place[1]), default=place)
        if nearest in free:
            found[one.key] = free.pop(nearest)
    return found

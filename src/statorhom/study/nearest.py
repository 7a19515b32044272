"""The known name that a mistyped one probably meant."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import SequenceMatcher

from statorhom.study.message import quoted

_CONVINCING = 0.6


def hint(name: str, known: Iterable[str]) -> str:
    """A remedy for an unknown name.

    Parameters
    ----------
    name : str
        What the file says.
    known : iterable of str
        What it could have said; at least one name.

    Returns
    -------
    str
        ``did you mean "mass_kg"?``; where nothing resembles the name, the nearest one and all the others.
    """
    names = tuple(known)
    nearest = max(names, key=lambda candidate: similarity(name, candidate))
    if similarity(name, nearest) >= _CONVINCING:
        return f"did you mean {quoted(nearest)}?"
    return f"the nearest known name is {quoted(nearest)} (known: {', '.join(names)})"


def similarity(one: str, other: str) -> float:
    """Likeness of two names between 0 and 1, regardless of case; a name without its unit counts as like."""
    # the head of a long name suffices, and the comparison is quadratic
    short, long = one[:80].lower(), other[:80].lower()
    ratio = SequenceMatcher(None, short, long).ratio()
    without_unit = len(short) > 2 and long.startswith(f"{short}_")
    return max(ratio, 0.9) if without_unit else ratio

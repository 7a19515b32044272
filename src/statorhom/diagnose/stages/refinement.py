"""What a finer mesh and many more local fields add to shifts and splits, near where they were solved on both.

What breaks the symmetry strongly is solved over and over in a small basis of a coarse mesh, which takes milliseconds.
Both leave a deep soft strip too little room to deform: splits come out by a tenth or more too large or too small. One
solution that is exact tells by how much, and that hardly changes from there to the optimum nearby.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from statorhom.model.broken.named_response import Response, Way
from statorhom.model.convergence import ModeKey

NEAR = 0.3  # standard deviations of the priors, up to which what was made for one place serves another
PROPORTIONAL = 0.5  # of a split: up to so much, what is added to it grows with it


@dataclass(frozen=True)
class Addition:
    """To the response of one named mode.

    Parameters
    ----------
    shift : to that of ln f.
    split : that of the coarse mesh where both were solved.
    more : to that split.
    """

    shift: float
    split: complex
    more: complex

    def to(self, response: Response) -> Response:
        """The response of the coarse mesh, nearby, with what is added to it."""
        split = self._split(response.split)
        longer = abs(split) / abs(response.split) if response.split else 1.0
        middle = response.shift
        return replace(
            response,
            shift=middle + self.shift,
            split=split,
            ways=tuple(
                replace(w, shift=w.shift + self.shift, split=self._split(w.split)) for w in response.ways
            ),
            lines=tuple(self._line(line, middle, longer) for line in response.lines),
        )

    def _split(self, split: complex) -> complex:
        """What is small beside a split is a part of it; what is not turns with it, as the cause does."""
        if abs(self.more) <= PROPORTIONAL * abs(self.split):
            return split * (1 + self.more / self.split) if self.split else split
        if not split or not self.split:
            return split + self.more
        turn = split / self.split
        return split + self.more * turn / abs(turn)

    def _line(self, line: Way, middle: float, longer: float) -> Way:
        return replace(line, shift=middle + self.shift + longer * (line.shift - middle))


@dataclass(frozen=True)
class Refinement:
    """Of all named modes of a stage.

    Parameters
    ----------
    labels : of the effects that break its symmetry (`Action.label`); it tells nothing where one of them is missing.
    sizes : of the effects' magnitudes and sizes where it was made, in their priors' standard deviations.
    additions : by key; a mode that either mesh lacks has none.
    """

    labels: frozenset[str]
    sizes: tuple[float, ...]
    additions: Mapping[ModeKey, Addition]

    def holds_at(self, labels: Collection[str], sizes: Sequence[float]) -> bool:
        """Whether it serves these effects as well, for they are nearly the same."""
        same = self.labels == frozenset(labels) and len(self.sizes) == len(sizes)
        return same and all(abs(a - b) < NEAR for a, b in zip(self.sizes, sizes, strict=True))

    def to(self, found: Mapping[ModeKey, Response]) -> dict[ModeKey, Response]:
        """Responses of the coarse mesh with what is added to them."""
        return {k: self.additions[k].to(one) if k in self.additions else one for k, one in found.items()}

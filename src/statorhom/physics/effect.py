"""What every effect in the library says of itself. A new effect is one new file in `statorhom/physics/effects`."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.study.object_file import STATOR, TUBE
from statorhom.study.study import StudyFiles


@dataclass(frozen=True)
class Confusion:
    """Another effect that looks alike, and the measurement that tells the two apart."""

    effect: str
    separated_by: str


@dataclass(frozen=True)
class Words:
    """What a report says of an effect: one sentence, how its magnitude is modelled, and what looks alike."""

    summary: str
    note: str | None = None
    confused_with: tuple[Confusion, ...] = ()


class Effect(ABC):
    """A physical effect that a model may lack.

    Class attributes: `name` (formats.md), `summary` (one sentence for the report), `citation`, `confused_with`, and
    `note`, which says how magnitudes are modelled where that matters; `coupon_words` where plates, beams and wings
    ask for others, and `tube_words` where tubes do; `on_tubes` where a tube has it in all ways that a stator has;
    `part`, what of the machine or of the measurement it concerns, which may be sure where the effect is not (an effect
    without one is a part of its own); `open_by_shape`, what the unknown shape of a local cause leaves open of its
    magnitude, relative.
    """

    name: ClassVar[str]
    part: ClassVar[str | None] = None
    summary: ClassVar[str]
    citation: ClassVar[str]
    confused_with: ClassVar[tuple[Confusion, ...]] = ()
    note: ClassVar[str | None] = None
    coupon_words: ClassVar[Words | None] = None
    tube_words: ClassVar[Words | None] = None
    on_tubes: ClassVar[bool] = False
    open_by_shape: ClassVar[float] = 0.05

    @abstractmethod
    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        """All ways in which the effect may be present in a stator's study; none where it is declared or cannot be."""

    def tube_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        """The same of a study of a tube, whose wall is the core of a ring; none where it needs more of a stator."""
        return self.candidates(files) if self.on_tubes else ()

    def coupon_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:  # noqa: ARG002
        """The same of a study of a plate, a beam or a wing; none where the effect is one of stators alone."""
        return ()

    def coupon_pairs(self, files: StudyFiles) -> tuple[Candidate, ...]:  # noqa: ARG002
        """Two of it on both sides of such a body, as fins are; none where that is no more likely than any two."""
        return ()

    @abstractmethod
    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        """What it changes at values of its parameters (by name, in their units)."""

    def words(self, files: StudyFiles) -> Words:
        """What is said of it in a study."""
        plain = Words(self.summary, self.note, self.confused_with)
        own = {STATOR: None, TUBE: self.tube_words}.get(files.drawing.kind, self.coupon_words)
        return own or plain

    def reported(self, candidate: Candidate, values: Mapping[str, float]) -> dict[str, float | str]:
        """Parameters as diagnosis.json names them: by default all that are no places, and the choices."""
        found: dict[str, float | str] = {p.name: values[p.name] for p in candidate.magnitudes}
        return found | dict(candidate.choice)

"""One way in which an effect may be present: where, in which stage, in which test."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.physics.parameter import EffectParameter


@dataclass(frozen=True)
class Candidate:
    """An effect at a place of the study, with its constants open.

    Parameters
    ----------
    effect : name of the effect.
    stage : first stage that it touches.
    parameters : its constants; discrete choices are candidates of their own.
    region, test : where it is confined to one.
    choice : what else tells it from the effect's other candidates (the input's key, the harmonic, a mode).
    repeats : whether a second one of the same effect may be at another place.
    both_sides : whether it is two of the same size, at the place and at its mirror image about the body's middle.
    """

    effect: str
    stage: str
    parameters: tuple[EffectParameter, ...]
    region: str | None = None
    test: str | None = None
    choice: tuple[tuple[str, str | int], ...] = ()
    repeats: bool = False
    both_sides: bool = False

    @property
    def label(self) -> str:
        """One line that tells it from all others."""
        parts = [self.stage, self.region, self.test, *(f"{k} {v}" for k, v in self.choice)]
        parts += ["both sides"] if self.both_sides else []
        return f"{self.effect} ({', '.join(p for p in parts if p)})"

    @property
    def chosen(self) -> dict[str, str | int]:
        """The discrete choices."""
        return dict(self.choice)

    @property
    def located(self) -> bool:
        """Whether it is somewhere."""
        return any(p.located for p in self.parameters)

    @property
    def magnitudes(self) -> tuple[EffectParameter, ...]:
        """Constants that are no places, and no details that only widen what is known of the others."""
        return tuple(p for p in self.parameters if not p.located and p.usual is None)

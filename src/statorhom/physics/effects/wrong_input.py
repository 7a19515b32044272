"""A number in the study or geometry file contradicts the recordings."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect, Words
from statorhom.physics.parameter import EffectParameter
from statorhom.physics.plan import plan_of
from statorhom.physics.ring import tube_sizes
from statorhom.study.stages import StageKeys
from statorhom.study.study import StudyFiles

# keys of the geometry file by section, and the step from which on they matter
DIMENSIONS = {
    "core": ("outer_diameter_mm", "bore_diameter_mm", "length_mm", "yoke_thickness_mm"),
    "slots": ("tooth_width_mm", "slot_width_mm"),
    "winding": ("overhang_length_mm",),
    "frame": ("outer_diameter_mm", "length_mm"),
}
FIRST_STEP = {"winding": ("wound", "impregnated"), "frame": ("framed",)}
# of dimensions (ISO 2768-1, fine, up to 6 mm; less of thin sheets): what lies within was made, not mistyped
TOLERANCE_MM, TOLERANCE = 0.05, 0.02
SPREAD = 1.3  # a wrong number is off by up to this factor nine times out of ten


class WrongInput(Effect):
    name = "wrong_input"
    part = "the files"
    summary = "a mass or a dimension in the files contradicts the recordings"
    citation = "Mottershead and Friswell (1993), J. Sound Vib. 167, 347"
    confused_with = (
        Confusion("temperature_shift", "weighing and measuring again"),
        Confusion("loose_winding_mass", "weighing again"),
    )

    coupon_words = Words(
        "a mass or a dimension in the files contradicts the recordings",
        None,
        (
            Confusion("wrong_input", "weighing and measuring the body again"),
            Confusion("attached_mass", "shapes: a lump turns them, a wrong weight does not"),
        ),
    )

    tube_words = coupon_words

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        masses = [_mass(stage) for stage in files.study.stages]
        return (*masses, *_dimensions(files))

    def tube_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        stage = files.study.stages[0]
        sizes = [
            _candidate(stage.name, key, typed, (("input", key), ("section", files.drawing.kind)), scaled)
            for key, (typed, scaled) in tube_sizes(files).items()
        ]
        return (_mass(stage), *sizes)

    def coupon_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        stage = files.study.stages[0]
        plan = plan_of(files)
        sizes = {} if plan is None else plan.typed
        kind = files.drawing.kind
        return (
            _mass(stage),
            *(_candidate(stage.name, k, v, (("input", k), ("section", kind))) for k, v in sizes.items()),
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        key = candidate.chosen
        if key["input"] == "mass_kg":
            return Action(masses={candidate.stage: values["value"]})
        return Action(dimensions={f"{key['section']}.{key['input']}": values["value"]})

    def reported(self, candidate: Candidate, values: Mapping[str, float]) -> dict[str, float | str]:
        return {"input": str(candidate.chosen["input"]), "value": values["value"]}


def _dimensions(files: StudyFiles) -> list[Candidate]:
    found = []
    for section, keys in DIMENSIONS.items():
        table = getattr(files.geometry, section)
        kinds = FIRST_STEP.get(section)
        stage = next((s for s in files.study.stages if s.tests and (kinds is None or s.kind in kinds)), None)
        for key in keys if table is not None and stage is not None else ():
            typed = getattr(table, key, None)
            if typed is not None and stage is not None:
                choice = (("input", key), ("section", section))
                found.append(_candidate(stage.name, key, typed, choice))
    return found


def _mass(stage: StageKeys) -> Candidate:
    return _candidate(stage.name, "mass_kg", stage.mass_kg, (("input", "mass_kg"),))


def _candidate(
    stage: str,
    key: str,
    typed: float,
    choice: tuple[tuple[str, str | int], ...],
    scaled: float | None = None,
) -> Candidate:
    """A number that is wrong by factors of its part `scaled`, by default of itself."""
    part = typed if scaled is None else scaled
    factors = (1 / 3, 1 / SPREAD, 0.98, 1.02, SPREAD, 3.0)
    lower, low90, *starts, high90, upper = sorted(typed + (factor - 1.0) * part for factor in factors)
    value = EffectParameter(
        "value",
        low90,
        high90,
        lower,
        upper,
        "log",
        tuple(starts),
        typed,
        negligible=min(TOLERANCE_MM, TOLERANCE * typed) if key.endswith("_mm") else 0.0,
    )
    return Candidate("wrong_input", stage, (value,), choice=choice)


EFFECT = WrongInput()

"""diagnosis.json: what `statorhom diagnose` says, and the numbers behind it for the report."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from statorhom.errors import ResultsError
from statorhom.study.atomic import write_text
from statorhom.study.message import one_line

NAME, DETAILS = "diagnosis.json", "diagnosis-details.json"
Verdict = Literal["none", "named", "ambiguous", "unknown"]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)


class Estimated(_Part):
    """A number with its 90 % interval, or a word."""

    value: float | str
    ci90: tuple[float, float] | None = None


class Location(_Part):
    """Where; None for what is not known or not meant."""

    angle_deg: float | None = None
    angle_sd_deg: float | None = None
    angle_ambiguity_deg: tuple[float, ...] = ()
    z_mm: float | None = None
    z_sd_mm: float | None = None


class PlanLocation(_Part):
    """Where on a plate, a beam or a wing, seen from above; all places that the measurements do not tell apart."""

    x_mm: float
    x_sd_mm: float
    y_mm: float
    y_sd_mm: float
    place_ambiguity_mm: tuple[tuple[float, float], ...] = ()


class EffectResult(_Part):
    """A named effect."""

    effect: str
    stage: str
    region: str | None
    test: str | None
    location: Location | PlanLocation | None
    parameters: dict[str, Estimated | float | str]
    probability: float
    note: str | None = None


class Alternative(_Part):
    """Another explanation."""

    effect: str
    probability: float


class Mismatch(_Part):
    """Where model and measurement differ."""

    stage: str
    test: str
    modes: tuple[tuple[int, ...], ...]
    statement: str


class Errors(_Part):
    """Frequency errors in percent."""

    rms_percent: float
    max_percent: float


class HeldOutErrors(_Part):
    """Errors on modes that the naming did not see."""

    what: str
    before_rms_percent: float
    after_rms_percent: float


class FitErrors(_Part):
    """Before and after the effect is modelled."""

    before: Errors
    after: Errors
    held_out: HeldOutErrors | None


class NextMeasurement(_Part):
    """What would separate the explanations that are left."""

    what: str
    separates: tuple[str, ...]
    expected_log_evidence: float | None = None


class Diagnosis(_Part):
    """The file."""

    schema_version: Literal[1] = Field(default=1, alias="schema")
    study: str
    verdict: Verdict
    effects: tuple[EffectResult, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    mismatch: Mismatch | None = None
    fit: FitErrors
    next_measurement: NextMeasurement | None = None


class FeatureRow(_Part):
    """One measured feature with both predictions."""

    stage: str
    test: str
    mode: tuple[int, ...] | None
    kind: str
    measured: float
    before: float
    after: float
    sd: float


class ScanRow(_Part):
    """A candidate of the scan."""

    effect: str
    label: str
    gain: float


class RuleRow(_Part):
    """A rule of the decision: what was found, what was needed (None: yes), whether it is passed (None: untested)."""

    rule: Literal[
        "chance",
        "nothing",
        "others",
        "discrepancy",
        "held_out",
        "confirmed",
        "adequacy",
        "within",
        "stability",
    ]
    found: float | None
    needed: float | None
    passed: bool | None


class MapRow(_Part):
    """Where one test's shapes contradict the declared model: share of the error by region, angle and height."""

    stage: str
    test: str
    angles_deg: tuple[float, ...]
    z_mm: tuple[float, ...]
    regions: dict[str, tuple[tuple[float, ...], ...]]
    error: float
    modes: tuple[tuple[int, int], ...]


class OppositeRow(_Part):
    """Angles of an effect that splits do not tell apart, and what the shapes' other waves say of them."""

    effect: str
    kept_deg: tuple[float, ...]
    excluded_deg: tuple[float, ...]
    mean_log_ratio: float | None = None
    standard_error: float | None = None


class MachineRow(_Part):
    """What the pictures need of the machine or tube."""

    kind: str = "stator"
    length_mm: float
    outer_diameter_mm: float
    slots: int


class PlanRow(_Part):
    """Outline of a plate, a beam or a wing, seen from above."""

    outline_mm: tuple[tuple[float, float], ...]


class OptionRow(_Part):
    """A measurement that could be made next: hours of work, and the log evidence that it is expected to bring."""

    what: str
    hours: float
    log_evidence: float


class RefittedRow(_Part):
    """A constant of the chain identified without and with what was left out."""

    stage: str
    name: str
    before: float
    before_ci90: tuple[float, float]
    before_status: str
    after: float
    after_ci90: tuple[float, float]
    after_status: str


class AngleRow(_Part):
    """Share of the measured splits that one local cause at an angle explains, 0 … 1."""

    angle_deg: float
    weight: float


class ConstantRow(_Part):
    """A constant before and after."""

    name: str
    before: float
    before_sd: float
    after: float
    after_sd: float


class SimplerRow(_Part):
    """What simpler methods make of the same data (`statorhom.diagnose.evidence.simpler`)."""

    modulus_alone_held_out_percent: float | None
    all_constants_held_out_percent: float | None
    by_criterion: tuple[ScanRow, ...] = ()


class Details(_Part):
    """The numbers behind a diagnosis; `second_confirmed` of two effects, None of others.

    Of an ambiguous answer `possible` tells where and how large each explanation would be that is left (one list of
    effects each), and `part` what of the machine or of the measurement all of them concern, where that is sure.
    `over_discrepancy` is None and `rules` empty in results of versions that did not write them.
    """

    p_value: float
    over_nothing: float
    over_others: float
    adequacy: float
    nothing_adequacy: float
    stability: float
    summary: str | None
    citation: str | None
    confusions: tuple[tuple[str, str], ...]
    features: tuple[FeatureRow, ...]
    scan: tuple[ScanRow, ...]
    constants: tuple[ConstantRow, ...]
    evidence: tuple[tuple[str, float], ...]
    seconds: float
    angles: tuple[AngleRow, ...] = ()
    machine: MachineRow | None = None
    plan: PlanRow | None = None
    maps: tuple[MapRow, ...] = ()
    opposite: tuple[OppositeRow, ...] = ()
    summaries: dict[str, str] = Field(default_factory=dict)
    options: tuple[OptionRow, ...] = ()
    refitted: tuple[RefittedRow, ...] = ()
    refit_note: str | None = None
    simpler: SimplerRow | None = None
    second_confirmed: bool | None = None
    rules: tuple[RuleRow, ...] = ()
    over_discrepancy: float | None = None
    possible: tuple[tuple[EffectResult, ...], ...] = ()
    part: tuple[str, ...] = ()


def write_diagnosis(diagnosis: Diagnosis, details: Details, folder: Path) -> Path:
    """Write both files; the details first, so that a diagnosis never stands without them."""
    write_text(folder / DETAILS, details.model_dump_json(indent=1) + "\n")
    path = folder / NAME
    write_text(path, diagnosis.model_dump_json(indent=1, by_alias=True) + "\n")
    return path


def read_diagnosis(folder: Path) -> tuple[Diagnosis, Details]:
    """Read a folder's diagnosis.

    Raises
    ------
    ResultsError
        If it is missing or damaged.
    """
    path = folder / NAME
    try:
        found = Diagnosis.model_validate_json(path.read_bytes())
        path = folder / DETAILS
        return found, Details.model_validate_json(path.read_bytes())
    except FileNotFoundError:
        raise ResultsError(f"{path}: there is no such file; run `statorhom diagnose STUDY` first") from None
    except OSError as error:
        raise ResultsError(f"{path}: cannot be read ({error.strerror}); check the folder") from None
    except ValidationError as error:
        key = ".".join(str(part) for part in error.errors()[0]["loc"]) or "the file"
        raise ResultsError(one_line(f"{path}: {key} is damaged; delete it and diagnose again")) from None

"""What is true of a machine and its tests, beside what the engineer types into the files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from statorhom.conceal.breaks import Break, Wave
from statorhom.geometry.stator import StatorGeometry
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.model.affine import Material
from statorhom.study.stages import StageKeys
from statorhom.study.supports import LineSupport, SupportKeys


@dataclass(frozen=True)
class TrueMaterial:
    """A region's material.

    Parameters
    ----------
    symmetry, constants : as in study files.
    density : of what moves (kg/m³).
    loss_factor : structural.
    """

    symmetry: str
    constants: Mapping[str, float]
    density: float
    loss_factor: float

    @property
    def material(self) -> Material:
        """As the model takes it."""
        return Material(SYMMETRIES[self.symmetry](**self.constants).hooke(), self.density)

    def with_constants(self, **constants: float) -> TrueMaterial:
        """The material with other constants."""
        return replace(self, constants={**self.constants, **constants})

    def scaled(self, factor: float) -> TrueMaterial:
        """All moduli times a factor."""
        return self.with_constants(
            **{name: value * factor for name, value in self.constants.items() if name.endswith("_pa")}
        )


@dataclass(frozen=True)
class Slip:
    """A contact that slips: a Jenkins element which carries part of every mode's stiffness.

    Parameters
    ----------
    force_n : at which it slips.
    share : of the modal stiffness that goes through the contact.
    """

    force_n: float
    share: float


@dataclass(frozen=True)
class ElasticSupport:
    """Lines that really are springs with losses."""

    lines: LineSupport
    loss_factor: float


@dataclass(frozen=True)
class Absorber:
    """A mass on a radial spring on the surface, with a resonance of its own, over the lowest mode of order 2."""

    angle: float
    z: float
    mass_kg: float
    relative_frequency: float
    loss_factor: float


@dataclass(frozen=True)
class TrueTest:
    """A modal test.

    Parameters
    ----------
    name : of the test.
    declared : the support as the study has it; None for free.
    is_table : a modal table is written, not FRFs.
    breaks : what breaks the symmetry in this test only.
    elastic : what the support really is; None: as declared.
    stiffness_factor : region → factor of its moduli in this test.
    sensor_mass_kg : of the roving accelerometer.
    slip : of a contact, with the force below.
    force_n : amplitude of the force.
    relabelled : seed of the mode that the table names wrongly; None: all names are right.
    only : the one mode (r, n) that the table lists; None: all that are usual.
    """

    name: str
    declared: SupportKeys | None
    is_table: bool
    breaks: tuple[Break, ...] = ()
    elastic: ElasticSupport | None = None
    stiffness_factor: Mapping[str, float] = field(default_factory=dict)
    sensor_mass_kg: float = 0.0
    slip: Slip | None = None
    force_n: float = 1.0
    relabelled: int | None = None
    only: tuple[int, int] | None = None


@dataclass(frozen=True)
class ContactLaw:
    """A joint of zero thickness around regions that hang together; stiffness per area (N/m³)."""

    regions: tuple[str, ...]
    normal: float
    tangential: float


@dataclass(frozen=True)
class TrueStage:
    """A step of fabrication.

    Parameters
    ----------
    keys : of the study.
    kinds : of all steps up to this one.
    materials : of every region of the model.
    scale_kg : what is on the scale.
    scatter : what is never quite alike around a stator.
    tests : that were made.
    breaks : what breaks the symmetry in all tests.
    contact : joint that is not rigid.
    absorbers : on the surface.
    modulus_slope : region → a in E(f) = E(1 kHz)(1 + a log₁₀(f/1 kHz)).
    """

    keys: StageKeys
    kinds: tuple[str, ...]
    materials: Mapping[str, TrueMaterial]
    scale_kg: float
    scatter: tuple[Wave, ...]
    tests: tuple[TrueTest, ...]
    breaks: tuple[Break, ...] = ()
    contact: ContactLaw | None = None
    absorbers: tuple[Absorber, ...] = ()
    modulus_slope: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Finding:
    """An effect as truth.json states it."""

    effect: str
    stage: str
    parameters: Mapping[str, Any]
    test: str | None = None
    angle_deg: float | None = None
    z_mm: float | None = None

    def as_json(self) -> dict[str, Any]:
        """Entry of `effects`."""
        location = {"angle_deg": self.angle_deg, "z_mm": self.z_mm}
        is_placed = self.angle_deg is not None or self.z_mm is not None
        return {
            "effect": self.effect,
            "stage": self.stage,
            "test": self.test,
            "location": location if is_placed else None,
            "parameters": dict(self.parameters),
        }


@dataclass(frozen=True)
class Case:
    """A machine with its tests, and the files that will speak of them.

    Parameters
    ----------
    geometry : the true one.
    stages : the true ones.
    study, geometry_file : contents of the files as they will be typed.
    findings : what was concealed.
    is_explicable : a known effect is behind every finding.
    """

    geometry: StatorGeometry
    stages: tuple[TrueStage, ...]
    study: Mapping[str, Any]
    geometry_file: Mapping[str, Any]
    findings: tuple[Finding, ...] = ()
    is_explicable: bool = True

    @property
    def verdict(self) -> str:
        """What a perfect diagnosis says where the data suffice."""
        if not self.findings:
            return "none"
        return "named" if self.is_explicable else "unknown"

    def with_finding(self, finding: Finding) -> Case:
        """One effect more."""
        return replace(self, findings=(*self.findings, finding))

    def with_study(self, study: Mapping[str, Any]) -> Case:
        """Another content of the study file."""
        return replace(self, study=study)

    def with_stage_keys(self, index: int, **keys: Any) -> Case:
        """Keys of a stage typed otherwise."""
        stages = list(self.study["stages"])
        stages[index] = {**stages[index], **keys}
        return self.with_study({**self.study, "stages": stages})

    def with_stage(self, index: int, **changes: Any) -> Case:
        """The case with a changed stage."""
        stages = list(self.stages)
        stages[index] = replace(stages[index], **changes)
        return replace(self, stages=tuple(stages))

    def with_test(self, stage: int, index: int, **changes: Any) -> Case:
        """The case with a changed test."""
        tests = list(self.stages[stage].tests)
        tests[index] = replace(tests[index], **changes)
        return self.with_stage(stage, tests=tuple(tests))

    def with_broken(self, stage: int, new: Break) -> Case:
        """The case with something that breaks the symmetry in this stage and all later ones."""
        case = self
        for index in range(stage, len(self.stages)):
            case = case.with_stage(index, breaks=(*case.stages[index].breaks, new))
        return case

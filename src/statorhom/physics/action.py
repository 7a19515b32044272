"""What an effect changes: inputs, materials, the stator's parts, its supports, or what is observed of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials
from statorhom.model.broken.change import Change
from statorhom.study.supports import SupportKeys

MaterialRule = Callable[[Materials], Materials]
ChangeRule = Callable[[HalfPitchMesh, Materials], tuple[Change, ...]]
TrainingRule = Callable[[HalfPitchMesh, Materials], tuple[tuple[Change, ...], ...]]


@dataclass(frozen=True)
class Attachment:
    """A lump or springs on the surface of a coupon.

    Parameters
    ----------
    place : x, y, z (m).
    mass_kg : of the lump.
    stiffness : along x, y, z (N/m), to the ground.
    """

    place: tuple[float, float, float]
    mass_kg: float = 0.0
    stiffness: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Patch:
    """A part of a coupon that is stiffer or softer, fading out as exp(-r²/2).

    Parameters
    ----------
    centre : x, y (m).
    radius : r = 1 (m).
    ratio : of the stiffness at the centre over the declared one; the mass is unchanged.
    """

    centre: tuple[float, float]
    radius: float
    ratio: float


@dataclass(frozen=True)
class Joint:
    """A contact of finite stiffness where bonding was assumed.

    Parameters
    ----------
    regions : that get nodes of their own (`statorhom.model.broken.interface.split`).
    normal, tangential : stiffness of the contact (N/m³).
    arc : centre and width (rad) of the part where it is weaker, None for the same all around.
    ratio : stiffness within the arc over that of the rest.
    loss_factor : of the contact.
    """

    regions: tuple[str, ...]
    normal: float
    tangential: float
    arc: tuple[float, float] | None = None
    ratio: float = 1.0
    loss_factor: float = 0.0


@dataclass(frozen=True)
class Friction:
    """A contact that slips, element by element of the modal basis.

    Parameters
    ----------
    law : "jenkins" or "iwan".
    share : Jenkins: part of a mode's stiffness that the sticking contact carries. Iwan: relative fall of the stiffness
        of the softest mode at the highest level.
    slip_force : at which a Jenkins element slips (N); 0 for Iwan.
    exponent : χ of Iwan, dissipation ∝ amplitude^(χ+3); 0 for Jenkins.
    """

    law: Literal["jenkins", "iwan"]
    share: float
    slip_force: float = 0.0
    exponent: float = 0.0


@dataclass(frozen=True)
class Training:
    """Examples of changes whose local fields the symmetric stator's modes do not show.

    Parameters
    ----------
    key : tells it from others.
    examples : from mesh and materials to examples, each of the changes that it makes at once: places within half a slot
        pitch, or strengths.
    """

    key: str
    examples: TrainingRule = field(compare=False)


@dataclass(frozen=True, eq=False)
class Action:
    """What is different from the declared model; what stays empty is as declared.

    Parameters
    ----------
    masses : stage → what the scale would have to say (kg).
    dimensions : "section.key" of the geometry file → true value in the key's unit.
    proportional : whether dimensions act by the slopes of the frequencies alone.
    materials : from the declared materials of a stage to the true ones.
    changes : from mesh and materials to what breaks the symmetry or varies along the axis.
    follows_materials : whether these are made anew wherever constants move the materials: as part of a mode's stiffness
        they depend on them.
    training : what a basis has to hold for these changes beside modes.
    joint : a contact in the place of a bond.
    friction : a contact that slips.
    supports : name of a support → how it really holds.
    support_losses : name of a support → loss factor of its springs.
    names : (test, label of a measured mode) → its true (r, n).
    symmetries : region → material symmetry that a study would have to declare to contain the effect.
    sensor_kg : mass of an accelerometer that roves over the measured points.
    modulus_at : region → factor of its stiffness at a frequency (Hz).
    attachments, patches : on a coupon.
    stages, tests : where it is present; None: everywhere.
    label : of the candidate whose action it is (`Candidate.label`).
    """

    masses: Mapping[str, float] = field(default_factory=dict)
    dimensions: Mapping[str, float] = field(default_factory=dict)
    proportional: bool = False
    materials: MaterialRule | None = None
    changes: ChangeRule | None = None
    follows_materials: bool = False
    training: Training | None = None
    joint: Joint | None = None
    friction: Friction | None = None
    supports: Mapping[str, SupportKeys] = field(default_factory=dict)
    support_losses: Mapping[str, float] = field(default_factory=dict)
    names: Mapping[tuple[str, str], tuple[int, int]] = field(default_factory=dict)
    symmetries: Mapping[str, str] = field(default_factory=dict)
    sensor_kg: float = 0.0
    modulus_at: Mapping[str, Callable[[float], float]] = field(default_factory=dict)
    attachments: tuple[Attachment, ...] = ()
    patches: tuple[Patch, ...] = ()
    stages: frozenset[str] | None = None
    tests: frozenset[str] | None = None
    label: str | None = None

    def touches(self, stage: str, test: str | None = None) -> bool:
        """Whether it is present in a stage, and in a test of it."""
        here = self.stages is None or stage in self.stages
        return here and (test is None or self.tests is None or test in self.tests)

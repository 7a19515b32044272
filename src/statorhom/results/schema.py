"""results.json, schema 1. Keys beyond the file contract are additions; none changes what it says."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

Status = Literal["identified", "prior_dominated", "fixed"]
Role = Literal["fitted", "held_out", "unmatched"]


class _Frozen(BaseModel):
    model_config = ConfigDict(frozen=True, extra="ignore", populate_by_name=True)


class Interval(_Frozen):
    """A figure with its 90 % interval."""

    value: float
    ci90: tuple[float, float]


class Constant(Interval):
    """An elastic constant: `status` says whether the data or the prior gave it.

    `narrowed` is the posterior over the prior standard deviation: 1 where the data said nothing.
    """

    status: Status
    narrowed: float | None = None


class RegionResult(_Frozen):
    """Material of one region after a step; what was not determined is None or absent."""

    volume_m3: float
    density_kg_m3: float | None = None
    density_sd_kg_m3: float | None = None
    symmetry: str | None = None
    hooke_pa: tuple[tuple[float, ...], ...] | None = None
    loss_factor: Interval | None = None
    engineering: dict[str, Constant] = Field(default_factory=dict)


class ModeResult(_Frozen):
    """A measured mode with its simulated partner, or either of them alone.

    `doubt` (0 … 1) is how nearly another pairing would have done; `mesh_percent` is what extrapolation to a
    converged mesh changed in the simulated frequency.
    """

    test: str
    label: str | None = None
    measured_hz: float | None = None
    measured_sd_hz: float | None = None
    model_sd_hz: float | None = None
    simulated_hz: float | None = None
    error_percent: float | None = None
    order: int | None = None
    axial: int | None = None
    kind: str | None = None
    share: float | None = None
    mac: float | None = None
    role: Role
    doubt: float | None = None
    mesh_percent: float | None = None
    measured_loss_factor: float | None = None
    simulated_loss_factor: float | None = None
    shape: int | None = None  # row of the stage's shape file


class Convergence(_Frozen):
    """One mode on a series of refined meshes, and its extrapolation."""

    order: int | None
    axial: int | None
    dof: tuple[int, ...]
    frequency_hz: tuple[float, ...]
    extrapolated_hz: float
    sd_percent: float
    kind: str | None = None  # of motion, where modes have no orders


class Sensitivity(_Frozen):
    """∂ln f / ∂ln p at the optimum: a row per mode, a column per constant."""

    constants: tuple[str, ...]
    modes: tuple[str, ...]
    values: tuple[tuple[float, ...], ...]


class Optimum(_Frozen):
    """A distinct optimum of the fit and its share of the posterior probability."""

    values: dict[str, float]
    cost: float
    probability: float


class SurfaceRound(_Frozen):
    """A design and how well its surfaces predicted points that they were not fitted to."""

    points: int
    largest_error_percent: float


class VerifiedMode(_Frozen):
    """A fitted mode's verified frequency against the measurement's confidence band."""

    number: int
    mode: str
    measured_hz: float
    low_hz: float
    high_hz: float
    verified_hz: float
    inside: bool


class BandSummary(_Frozen):
    """Regression of the measured frequencies on the mode's number, and the verified ones against its band."""

    degree: int
    r_squared: float
    confidence: float
    modes: tuple[VerifiedMode, ...]


class SurfaceSummary(_Frozen):
    """Search by response surface: design, gate, Pareto front, verification."""

    design: str
    surface: str
    rounds: tuple[SurfaceRound, ...]
    check_points: int
    limit_percent: float
    passed: bool
    errors_percent: dict[str, float]  # mode → largest error at the check points, of the last design
    full_solves: int
    objectives: tuple[str, ...]  # modes that the columns of the front are about
    front_percent: tuple[tuple[float, ...], ...]
    at_limits: tuple[str, ...] = ()  # constants that the search left at the end of their range
    band: BandSummary | None = None
    band_remark: str | None = None  # why there is none


class FitSummary(_Frozen):
    """How a stage was fitted."""

    method: str
    evaluations: int
    optima: tuple[Optimum, ...]
    rms_percent: float
    max_percent: float
    held_out_rms_percent: float | None = None
    reduced_basis_error_percent: float | None = None  # certified, over the prior
    reduced_basis_certified_percent: float | None = None  # certified, at the result
    reduced_basis_deviation_percent: float | None = None  # from the full model, at the result
    unexplained_percent: float = 0.0
    shared_shift_percent: dict[str, float] = Field(default_factory=dict)
    without_mesh_correction: dict[str, float] = Field(default_factory=dict)
    surface: SurfaceSummary | None = None


class CarriedParameter(_Frozen):
    """Prior of a constant as a later step needs it; see `identify.parameters.parameter_space.Parameter`."""

    name: str
    median: float
    low90: float
    high90: float
    lower: float
    upper: float
    scale: Literal["log", "linear"]
    fixed: bool


class CarriedState(_Frozen):
    """Joint posterior of a step's constants: what the following step starts from."""

    parameters: tuple[CarriedParameter, ...]
    ties: tuple[tuple[str, ...], ...]
    names: tuple[str, ...]
    mean: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...]


class MaterialTest(_Frozen):
    """A mechanical test of samples beside the identified constant."""

    name: str
    region: str
    constant: str
    value: float
    low: float | None = None
    high: float | None = None
    identified: Constant
    difference_percent: float


class TestedFrequency(_Frozen):
    """A fitted mode as measured, as identified and at the mean values of the material tests."""

    __test__ = False  # the name is the field's; pytest must not collect it

    mode: str
    measured_hz: float
    identified_hz: float
    tests_hz: float
    identified_percent: float
    tests_percent: float


class StageResult(_Frozen):
    """One fabrication step."""

    name: str
    kind: str
    mass_kg: float
    mass_sd_kg: float
    added_mass_kg: float
    regions: dict[str, RegionResult]
    modes: tuple[ModeResult, ...] = ()
    convergence: tuple[Convergence, ...] = ()
    sensitivity: Sensitivity | None = None
    fit: FitSummary | None = None
    assumptions: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    material_tests: tuple[MaterialTest, ...] = ()
    tested_frequencies: tuple[TestedFrequency, ...] = ()
    shapes: str | None = None  # shape file, relative to the results folder
    carried: CarriedState | None = None
    digest: str = ""
    seconds: float = 0.0


class Results(_Frozen):
    """All steps of a study that have been fitted."""

    schema_version: Literal[1] = Field(1, alias="schema")
    study: str
    seed: int
    program: str = ""
    geometry: dict[str, float | int | str] = Field(default_factory=dict)
    stages: tuple[StageResult, ...] = ()

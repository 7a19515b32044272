"""Made-up diagnoses of every verdict; their figures are plausible, not computed."""

from __future__ import annotations

import numpy as np

from statorhom.results.diagnosis import (
    Alternative,
    AngleRow,
    ConstantRow,
    Details,
    Diagnosis,
    EffectResult,
    Errors,
    Estimated,
    FeatureRow,
    FitErrors,
    HeldOutErrors,
    Location,
    MachineRow,
    MapRow,
    Mismatch,
    NextMeasurement,
    OppositeRow,
    OptionRow,
    RefittedRow,
    RuleRow,
    ScanRow,
    Verdict,
)

STRIP = EffectResult(
    effect="local_stiffness",
    stage="stack",
    region="lamination",
    test=None,
    location=Location(angle_deg=95.0, angle_sd_deg=3.0),
    parameters={"stiffness_ratio": Estimated(value=0.7, ci90=(0.6, 0.8))},
    probability=0.4,
)
OVAL = EffectResult(
    effect="ovality",
    stage="stack",
    region="lamination",
    test=None,
    location=Location(angle_deg=40.0, angle_sd_deg=2.0),
    parameters={"harmonic": 2.0, "relative_amplitude": Estimated(value=0.02, ci90=(0.015, 0.025))},
    probability=0.4,
)
LUMP = EffectResult(
    effect="attached_mass",
    stage="stack",
    region="lamination",
    test=None,
    location=Location(
        angle_deg=100.0, angle_sd_deg=2.0, angle_ambiguity_deg=(100.0, 280.0), z_mm=60.0, z_sd_mm=4.0
    ),
    parameters={"mass_kg": Estimated(value=0.057, ci90=(0.053, 0.062))},
    probability=0.97,
    note="a rigid cube on a 12 mm foot",
)


def example_diagnosis(verdict: Verdict, study: str = "example", stage: str = "stack") -> Diagnosis:
    """A diagnosis of a verdict."""
    lump = LUMP.model_copy(update={"stage": stage})
    several = verdict == "ambiguous"
    return Diagnosis(
        schema=1,
        study=study,
        verdict=verdict,
        effects=(lump,) if verdict == "named" else (),
        alternatives=()
        if verdict == "none"
        else (
            Alternative(effect="attached_mass", probability=0.52),
            Alternative(effect="local_stiffness+ovality", probability=0.4),
            Alternative(effect="none", probability=0.004),
        ),
        mismatch=None
        if verdict == "none"
        else Mismatch(
            stage=stage,
            test=f"{stage}-free",
            modes=((2, 0), (3, 1)),
            statement=f"{stage}-free: 2 frequencies are off, (2, 1) by -0.29 % (4 standard deviations)",
        ),
        fit=FitErrors(
            before=Errors(rms_percent=1.2, max_percent=3.0),
            after=Errors(rms_percent=0.1 if verdict == "named" else 1.2, max_percent=0.3),
            held_out=None
            if verdict == "none"
            else HeldOutErrors(what="every third mode", before_rms_percent=1.4, after_rms_percent=0.2),
        ),
        next_measurement=NextMeasurement(
            what="measure the phase between the two end planes",
            separates=("attached_mass", "local_stiffness"),
            expected_log_evidence=6.0,
        )
        if several
        else None,
    )


def example_rules(verdict: Verdict) -> tuple[RuleRow, ...]:
    """What an answer passed."""
    named = verdict == "named"
    return (
        RuleRow(rule="chance", found=2.5e-4, needed=0.01, passed=True),
        RuleRow(rule="nothing", found=368.0, needed=5.0, passed=True),
        RuleRow(rule="others", found=261.0 if named else 0.4, needed=3.0, passed=named),
        RuleRow(rule="discrepancy", found=240.0 if named else -1.0, needed=0.0, passed=named),
        RuleRow(rule="held_out", found=0.94, needed=0.25, passed=True),
        RuleRow(rule="adequacy", found=0.4 if named else 1e-12, needed=0.01, passed=named),
        RuleRow(rule="within", found=None, needed=None, passed=True),
        RuleRow(rule="stability", found=1.0 if named else 0.5, needed=0.8, passed=named),
    )


def example_details(verdict: Verdict, stage: str = "stack", places: bool = True) -> Details:
    """The numbers behind it; `places`: with maps and angles, as from recordings."""
    angles = np.arange(0.0, 360.0, 5.0)
    hill = np.exp(-(((np.arange(24)[:, None] - 6.5) / 2) ** 2)) * np.linspace(0.5, 1.0, 6)
    part = tuple(tuple(float(v) for v in row) for row in hill / hill.sum())
    features = [
        FeatureRow(
            stage=stage,
            test=f"{stage}-free",
            mode=(r, n),
            kind=kind,
            measured=7.2,
            before=7.2 + b,
            after=7.2 + a,
            sd=0.001,
        )
        for r, n, kind, b, a in (
            (2, 0, "frequency", 0.004, 0.0),
            (2, 0, "split", -0.012, 0.0005),
            (2, 0, "split", 0.006, 0.0002),
            (3, 1, "frequency", 0.05, 0.001),
            (-1, 0, "damping", 0.0, 0.0),
        )
    ]
    return Details(
        p_value=2.5e-4 if verdict != "none" else 0.4,
        over_nothing=368.0 if verdict != "none" else -2.0,
        over_others=261.0 if verdict == "named" else 0.4,
        over_discrepancy=240.0 if verdict == "named" else 12.0,
        adequacy=0.4 if verdict != "unknown" else 1e-12,
        nothing_adequacy=1e-150 if verdict != "none" else 0.3,
        stability=1.0 if verdict == "named" else 0.5,
        summary="a lump on the back of the core is not in the model",
        citation="Fox (1990), J. Sound Vib. 142, 227",
        confusions=(("ovality", "several orders r split"),),
        features=tuple(features),
        scan=(ScanRow(effect="attached_mass", label="attached_mass (stack)", gain=12.0),),
        angles=tuple(
            AngleRow(angle_deg=float(a), weight=float(np.cos(np.deg2rad(a - 100.0)) ** 8)) for a in angles
        )
        if places
        else (),
        constants=(
            ConstantRow(name=f"{stage}:mass_kg", before=3.0, before_sd=0.002, after=3.0, after_sd=0.002),
            ConstantRow(
                name=f"{stage}:lamination.E_p_pa", before=1.9e11, before_sd=1e9, after=1.95e11, after_sd=1e9
            ),
        ),
        evidence=(("attached_mass (stack)", 100.0),),
        rules=example_rules(verdict),
        seconds=12.0,
        machine=MachineRow(length_mm=80.5, outer_diameter_mm=120.0, slots=36),
        maps=(
            MapRow(
                stage=stage,
                test=f"{stage}-free",
                angles_deg=tuple(15.0 * i for i in range(25)),
                z_mm=tuple(80.5 * i / 6 for i in range(7)),
                regions={"lamination": part},
                error=1e-3,
                modes=((2, 0), (3, 1)),
            ),
        )
        if places and verdict != "none"
        else (),
        opposite=(
            OppositeRow(effect="attached_mass", kept_deg=(100.0,), excluded_deg=(280.0,), mean_log_ratio=1.2),
        )
        if verdict == "named" and places
        else (),
        summaries={
            "attached_mass": "a lump on the back of the core is not in the model",
            "local_stiffness": "an axial strip is stiffer or softer",
            "ovality": "the yoke's stiffness varies as cos n(θ − α)",
        },
        options=(
            OptionRow(what="the phase between the two end planes", hours=0.5, log_evidence=6.0),
            OptionRow(what="the stator’s temperature", hours=0.2, log_evidence=0.3),
        )
        if verdict == "ambiguous"
        else (),
        possible=((LUMP,), (STRIP, OVAL)) if verdict == "ambiguous" else (),
        part=("the back of the core",) if verdict == "ambiguous" else (),
        refitted=(
            RefittedRow(
                stage=stage,
                name="lamination.E_p_pa",
                before=1.9e11,
                before_ci90=(1.88e11, 1.92e11),
                before_status="identified",
                after=1.95e11,
                after_ci90=(1.9e11, 2.0e11),
                after_status="prior_dominated",
            ),
        )
        if verdict == "named"
        else (),
    )

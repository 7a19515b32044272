"""A made-up results folder with all that a report must cope with; its figures are plausible, not computed."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np

from statorhom.geometry import stator_geometry
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.mesh import HalfPitchMesh, mesh_step, uniform
from statorhom.results import (
    Constant,
    Convergence,
    FitSummary,
    Interval,
    ModeResult,
    Optimum,
    RegionResult,
    Results,
    Sensitivity,
    StageResult,
    write_results,
)
from statorhom.results.full_surface import full_surface
from statorhom.results.shape_file import ModeShape, ShapeFile, write_shape_file
from statorhom.study.geometry_file import read_geometry

GEOMETRY = Path(__file__).resolve().parents[2] / "geometries" / "550w-induction-36-slots.toml"
PLANES_M = np.linspace(0.05, 0.95, 5) * 0.0805
ORDERS = 10


@cache
def example_mesh(kinds: tuple[str, ...]) -> HalfPitchMesh:
    """The coarsest mesh of a fabrication step."""
    return mesh_step(stator_geometry(read_geometry(GEOMETRY), GEOMETRY).step(kinds), uniform(1))


def along(axial: int, z: np.ndarray) -> np.ndarray:
    """A motion with so many node planes along the core."""
    return np.cos(axial * np.pi * z / 0.0805)


def cyclic_shape(mesh: HalfPitchMesh, frequency_hz: float, order: int, axial: int) -> ModeShape:
    """Inextensional bending of a ring: u_r = cos rθ, u_θ = −sin rθ / r."""
    theta = np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0])
    wave = np.exp(1j * order * theta) * along(axial, mesh.nodes[:, 2])
    tangential = 1j / order * wave if order else 0 * wave
    spectrum = np.zeros((len(PLANES_M), ORDERS))
    spectrum[:, order] = along(axial, PLANES_M)
    return ModeShape(
        frequency_hz,
        np.column_stack([wave, tangential, 0 * wave]),
        order,
        "pair" if order else "even",
        order,
        axial,
        "radial",
        0.97,
        spectrum,
    )


def combined_shape(mesh: HalfPitchMesh, frequency_hz: float, parts: dict[int, float]) -> ModeShape:
    """A clamped stator's mode: waves of several orders, the clamp at θ = 180°."""
    nodes = full_surface(mesh).nodes
    theta = np.arctan2(nodes[:, 1], nodes[:, 0])
    radial = sum(a * np.cos(r * theta) for r, a in parts.items())
    tangential = sum(-a * np.sin(r * theta) / max(r, 1) for r, a in parts.items())
    spectrum = np.zeros((len(PLANES_M), ORDERS))
    for r, a in parts.items():
        spectrum[:, r] = a * (1 - 0.1 * r * PLANES_M / 0.08)
    largest = max(parts, key=lambda r: abs(parts[r]))
    return ModeShape(
        frequency_hz,
        np.column_stack([radial, tangential, 0 * theta]),
        None,
        "",
        largest,
        0,
        "radial",
        0.55,
        spectrum,
    )


def stack_shapes() -> ShapeFile:
    """Free modes, then clamped ones."""
    mesh = example_mesh(("stack",))
    free = [
        cyclic_shape(mesh, f, r, n)
        for f, r, n in (
            (1431.6, 2, 0),
            (1768.0, 2, 1),
            (3772.4, 3, 0),
            (4105.0, 3, 1),
            (6139.9, 0, 0),
            (6570.1, 4, 0),
        )
    ]
    clamped = [
        combined_shape(mesh, 391.0, {1: 1.0, 2: 1.2, 3: 0.2}),
        combined_shape(mesh, 1071.0, {2: 1.0, 3: 0.7, 4: -0.3}),
    ]
    return ShapeFile(mesh, PLANES_M, (*free, *clamped))


def wound_shapes() -> ShapeFile:
    """Free modes, the (2, 0) once more as an absorber pair."""
    mesh = example_mesh(("stack", "wound"))
    names = ((1214.0, 2, 0), (1702.0, 2, 1), (1993.0, 2, 0), (3102.0, 3, 0))
    return ShapeFile(mesh, PLANES_M, tuple(cyclic_shape(mesh, f, r, n) for f, r, n in names))


def _constant(value: float, low: float, high: float, status: str) -> Constant:
    return Constant(value=value, ci90=(low, high), status=status)  # type: ignore[arg-type]


def _pair(test: str, label: str, measured: float, simulated: float, role: str, **more: object) -> ModeResult:
    values = {
        "measured_sd_hz": 0.002 * measured,
        "model_sd_hz": 0.003 * simulated,
        "mesh_percent": -0.8,
        "kind": "radial",
        "share": 0.97,
    } | more
    return ModeResult.model_validate(
        {
            "test": test,
            "label": label,
            "measured_hz": measured,
            "simulated_hz": simulated,
            "error_percent": 100 * (simulated / measured - 1),
            "role": role,
            **values,
        }
    )


def _lamination() -> RegionResult:
    material = TransverselyIsotropic(1.915e11, 9.2e10, 0.29, 0.27, 2.51e10)
    return RegionResult(
        volume_m3=3.943e-4,
        density_kg_m3=7810.5,
        density_sd_kg_m3=12.7,
        symmetry="transversely_isotropic",
        hooke_pa=tuple(map(tuple, material.hooke().matrix.tolist())),
        loss_factor=Interval(value=0.0068, ci90=(0.0049, 0.0087)),
        engineering={
            "E_p_pa": _constant(1.915e11, 1.877e11, 1.953e11, "identified"),
            "E_z_pa": _constant(9.2e10, 2.1e10, 1.62e11, "prior_dominated"),
            "nu_p": _constant(0.29, 0.25, 0.33, "prior_dominated"),
            "nu_pz": _constant(0.27, 0.15, 0.36, "prior_dominated"),
            "G_rz_pa": _constant(2.51e10, 2.38e10, 2.66e10, "identified"),
        },
    )


def _winding(value: float, low: float, high: float, density: float, loss: float) -> RegionResult:
    return RegionResult(
        volume_m3=4.2e-4,
        density_kg_m3=density,
        density_sd_kg_m3=16.9,
        symmetry="isotropic",
        hooke_pa=tuple(map(tuple, Isotropic(value, 0.33).hooke().matrix.tolist())),
        loss_factor=Interval(value=loss, ci90=(0.6 * loss, 1.5 * loss)),
        engineering={
            "E_pa": _constant(value, low, high, "identified"),
            "nu": _constant(0.33, 0.33, 0.33, "fixed"),
        },
    )


def _stack_modes() -> tuple[ModeResult, ...]:
    free = "stack-free"
    loss = {"measured_loss_factor": 0.006, "simulated_loss_factor": 0.0068}
    return (
        _pair(free, "1", 1432.0, 1431.6, "fitted", order=2, axial=0, shape=0, mac=0.998, **loss),
        _pair(free, "2", 1766.0, 1768.0, "fitted", order=2, axial=1, shape=1, doubt=0.05),
        _pair(free, "3", 3770.0, 3772.4, "fitted", order=3, axial=0, shape=2),
        _pair(free, "3b", 3778.0, 3772.4, "fitted", order=3, axial=0, shape=2),
        _pair(free, "4", 6148.0, 6139.9, "held_out", order=0, axial=0, shape=4, doubt=0.62),
        _pair(free, "5", 6550.0, 6570.1, "fitted", order=4, axial=0, shape=5),
        ModeResult(test=free, label="6", measured_hz=5120.0, measured_sd_hz=10.0, role="unmatched"),
        ModeResult(
            test=free,
            simulated_hz=4105.0,
            order=3,
            axial=1,
            kind="radial",
            share=0.95,
            role="unmatched",
            shape=3,
        ),
        ModeResult(test=free, simulated_hz=5711.0, kind="torsion", share=0.99, role="unmatched"),
        ModeResult(
            test=free, simulated_hz=9711.0, order=5, axial=0, kind="radial", share=0.99, role="unmatched"
        ),
        _pair("stack-clamped", "1", 384.0, 391.0, "held_out", order=1, axial=0, shape=6, mesh_percent=None),
        _pair("stack-clamped", "2", 1033.0, 1071.0, "held_out", order=2, axial=0, shape=7, mesh_percent=None),
        ModeResult(test="stack-clamped", label="3", measured_hz=3227.0, role="unmatched"),
    )


def _stack() -> StageResult:
    modes = _stack_modes()
    constants = (
        "lamination.E_p_pa",
        "lamination.E_z_pa",
        "lamination.nu_p",
        "lamination.nu_pz",
        "lamination.G_rz_pa",
    )
    return StageResult(
        name="stack",
        kind="stack",
        mass_kg=3.08,
        mass_sd_kg=0.005,
        added_mass_kg=3.08,
        regions={"lamination": _lamination()},
        modes=modes,
        convergence=(
            Convergence(
                order=2,
                axial=0,
                dof=(26568, 71388, 214000),
                frequency_hz=(1467.2, 1441.0, 1434.9),
                extrapolated_hz=1431.6,
                sd_percent=0.11,
            ),
            Convergence(
                order=2,
                axial=1,
                dof=(26568, 71388, 214000),
                frequency_hz=(1799.0, 1776.5, 1771.0),
                extrapolated_hz=1768.0,
                sd_percent=0.12,
            ),
            Convergence(
                order=3,
                axial=0,
                dof=(26568, 71388, 214000),
                frequency_hz=(3885.0, 3805.0, 3784.0),
                extrapolated_hz=3772.4,
                sd_percent=0.19,
            ),
            Convergence(
                order=4,
                axial=0,
                dof=(26568, 71388, 214000),
                frequency_hz=(6842.0, 6655.0, 6599.0),
                extrapolated_hz=6570.1,
                sd_percent=0.31,
            ),
        ),
        sensitivity=Sensitivity(
            constants=constants,
            modes=("(2, 0)", "(2, 1)", "(3, 0)", "(0, 0)", "(4, 0)"),
            values=(
                (0.479, 0.019, 0.001, -0.044, 0.002),
                (0.274, 0.008, 0.003, -0.021, 0.217),
                (0.481, 0.018, 0.001, -0.041, 0.003),
                (0.497, 0.002, 0.004, -0.003, 0.000),
                (0.478, 0.019, 0.002, -0.038, 0.005),
            ),
        ),
        fit=FitSummary(
            method="annealing",
            evaluations=16000,
            optima=(
                Optimum(
                    values=dict(zip(constants, (1.915e11, 9.2e10, 0.29, 0.27, 2.51e10), strict=True)),
                    cost=3.1,
                    probability=0.93,
                ),
                Optimum(
                    values=dict(zip(constants, (1.88e11, 1.3e11, 0.30, 0.21, 2.44e10), strict=True)),
                    cost=5.7,
                    probability=0.07,
                ),
            ),
            rms_percent=0.14,
            max_percent=0.31,
            held_out_rms_percent=0.13,
            reduced_basis_error_percent=0.03,
            reduced_basis_certified_percent=0.02,
            reduced_basis_deviation_percent=0.004,
            without_mesh_correction={"lamination.E_p_pa": 1.873e11},
        ),
        assumptions=(
            "Measured without stated uncertainty: 0.2 % of the frequency was assumed.",
            "The clamp “clamped” is rigid on two axial lines.",
            "Every region is homogeneous.",
        ),
        warnings=("mode 6 at 5120 Hz of test stack-free has no simulated partner within the gate",),
        shapes="shapes/stack.npz",
    )


def _wound() -> StageResult:
    test = "wound-free"
    return StageResult(
        name="wound",
        kind="wound",
        mass_kg=4.36,
        mass_sd_kg=0.005,
        added_mass_kg=1.28,
        regions={"lamination": _lamination(), "winding": _winding(3.46e8, 1.9e8, 5.4e8, 3047.6, 0.18)},
        modes=(
            _pair(
                test,
                "1",
                1255.0,
                1214.0,
                "fitted",
                order=2,
                axial=0,
                shape=0,
                doubt=0.44,
                measured_loss_factor=0.048,
                simulated_loss_factor=0.061,
            ),
            _pair(test, "2", 1731.0, 1702.0, "fitted", order=2, axial=1, shape=1, measured_loss_factor=0.084),
            _pair(
                test, "3", 3071.0, 3102.0, "held_out", order=3, axial=0, shape=3, measured_loss_factor=0.246
            ),
            ModeResult(
                test=test, simulated_hz=1993.0, order=2, axial=0, kind="radial", role="unmatched", shape=2
            ),
            ModeResult(test=test, simulated_hz=1240.0, kind="winding", role="unmatched"),
            ModeResult(test=test, simulated_hz=1251.0, kind="axial", role="unmatched"),
        ),
        assumptions=("Every region is homogeneous.",),
        warnings=("loss factors above 10 % hint at dry friction between the wires",),
        shapes="shapes/wound.npz",
    )


def _impregnated() -> StageResult:
    test = "impregnated-free"
    return StageResult(
        name="impregnated",
        kind="impregnated",
        mass_kg=4.41,
        mass_sd_kg=0.005,
        added_mass_kg=0.05,
        regions={"lamination": _lamination(), "winding": _winding(3.1e9, 2.6e9, 3.8e9, 3166.4, 0.05)},
        modes=(
            _pair(test, "1", 1170.0, 1171.2, "fitted", order=2, axial=0),
            _pair(test, "2", 3502.0, 3476.0, "fitted", order=4, axial=None, measured_sd_hz=None),
        ),
        shapes="shapes/impregnated.npz",
    )


def example_results() -> Results:
    """Four steps: everything, then ever less."""
    framed = StageResult(
        name="framed",
        kind="framed",
        mass_kg=4.9,
        mass_sd_kg=0.005,
        added_mass_kg=0.49,
        regions={
            "lamination": _lamination(),
            "winding": _winding(3.1e9, 2.6e9, 3.8e9, 3166.4, 0.05),
            "frame": RegionResult(volume_m3=2.36e-4, density_kg_m3=2076.0, density_sd_kg_m3=30.0),
        },
        warnings=(
            "region frame: 2076 kg/m³ lies below every usual frame material (2600 … 8000): check the weight",
        ),
    )
    return Results(
        study="van-der-giet-550w, made-up figures",
        seed=1,
        program="statorhom 0.1.0",
        geometry={
            "core.outer_diameter_mm": 120.0,
            "core.bore_diameter_mm": 70.0,
            "core.length_mm": 80.5,
            "core.yoke_thickness_mm": 9.15,
            "slots.count": 36,
            "slots.shape": "parallel_tooth",
        },
        stages=(_stack(), _wound(), _impregnated(), framed),
    )


def write_example(folder: Path) -> Path:
    """A results folder: the impregnated step names a shape file that is not there."""
    write_results(example_results(), folder)
    write_shape_file(folder / "shapes" / "stack.npz", stack_shapes())
    write_shape_file(folder / "shapes" / "wound.npz", wound_shapes())
    return folder

"""What a stage's fit assumed, and what its reader must know first."""

from __future__ import annotations

import math
from collections.abc import Sequence

from statorhom.identify.comparison.mode_results import shared_shift, simulated_modes
from statorhom.identify.fits.stage_run import StageRun
from statorhom.identify.residuals.model_error import DEFAULT_RELATIVE_SD
from statorhom.identify.results.surface_search import surface_warnings
from statorhom.identify.stages.stage_materials import DENSITY
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.results.schema import ModeResult
from statorhom.study.response_surface import SurfaceKeys
from statorhom.study.stages import StageKeys
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE

LIKELY = 0.05  # an optimum of this probability is worth a warning
UNEXPLAINED_PERCENT = 0.5  # of the frequencies: what manufacturing scatter alone does not leave


def assumptions(run: StageRun) -> tuple[str, ...]:
    """Assumptions of a stage, a sentence each."""
    shift = shared_shift(run)
    keys = [m.key for m in simulated_modes(run) if m.key is not None and m.visibility >= 1.0]
    parts = [abs(shift) * run.error.shared(k) for k in keys]
    block = isinstance(run.model.mesh, MirrorMesh)
    axes = "x, y and z" if block else "r, θ and z"
    causes = "" if block else " (tooth roots, slot corners)"
    lines = [
        f"Every region is homogeneous and perfectly bonded to its neighbours; its material's axes are {axes}.",
        "Free tests: no suspension stiffness. Undamped natural frequencies are compared with the measured ones.",
        f"Where a table gives no standard deviation, a frequency counts as known to {100 * DEFAULT_RELATIVE_SD:.1f} %.",
        f"All simulated frequencies share a model error{causes} that grows with what the mesh "
        f"refinement changes; the fit put it at {shift + 0.0:+.2f} of its standard deviations, "
        f"at most {100 * max(parts, default=0.0):.2f} % of a frequency.",
    ]
    if any(m.order is None for m in run.setup.fitted):
        lines.append(
            "Modes without an order in the table were assigned by frequency; doubtful ones are marked."
        )
    if run.effects.names:
        lines.append(f"The free modes contain what the study declares: {', '.join(run.effects.names)}.")
    if "overhang" in run.materials and "overhang" not in run.setup.materials.sources:
        lines.append("The winding's overhangs have the material of the winding in the slots.")
    return tuple(lines)


def warnings(run: StageRun, modes: Sequence[ModeResult]) -> list[str]:
    """Warnings of a stage, a line each."""
    found = []
    unexplained = 100 * run.fit.problem.discrepancy
    if unexplained > UNEXPLAINED_PERCENT:
        found.append(
            f"stage {run.setup.keys.name!r}: the declared model leaves {unexplained:.1f} % of the fitted frequencies "
            f"unexplained; the intervals were widened accordingly, but a physical effect may be missing"
        )
    if run.surface is not None:
        keys = run.setup.keys.identify.response_surface or SurfaceKeys()
        found += surface_warnings(run.surface, keys, run.setup.keys.name)
    found += _rivals(run)
    for m in modes:
        if m.role == "unmatched" and m.measured_hz is not None:
            found.append(
                f"test {m.test!r}: the measured mode at {m.measured_hz:.0f} Hz has no simulated partner"
            )
    local = [n for n, a in zip(run.effects.names, run.effects.actions, strict=True) if a.changes]
    if local and any(t.support != FREE for t in run.setup.tests):
        found.append(
            f"stage {run.setup.keys.name!r}: its supported tests are predicted without {', '.join(local)}; "
            "`statorhom diagnose` compares them with it"
        )
    if not run.basis.holds:
        names = ", ".join(f"({r}, {n})" for r, n in run.basis.broken)
        found.append(
            f"stage {run.setup.keys.name!r}: at the result the reduced model of the search deviates from the full one "
            f"by {100 * run.basis.deviation:.2g} %, more than its certificate allows, in {names}; widen the prior that "
            "the result has left"
        )
    if not run.fit.posterior.best.converged:
        found.append(
            f"stage {run.setup.keys.name!r}: the last descent did not settle; raise identify.evaluations"
        )
    return found


def recording_remarks(files: StudyFiles, stage: StageKeys) -> list[str]:
    """What the recordings of a stage's tests said of themselves: overloads, double hits, doubtful modes."""
    tables = {test.name: files.tables[test.name] for test in stage.tests if test.name in files.tables}
    return [f"test {name!r}: {remark}" for name, table in tables.items() for remark in table.remarks]


def _rivals(run: StageRun) -> list[str]:
    """Other constants that explain the modes about as well."""
    posterior, space = run.fit.posterior, run.fit.problem.space
    best = space.values(posterior.best.x)
    found = []
    for component, weight in list(zip(posterior.components, posterior.weights, strict=True))[1:]:
        if weight < LIKELY:
            continue
        values = space.values(component.optimum.x)
        new = [n for n in values if n.split(".")[0] in run.setup.new and not n.endswith(DENSITY)]
        name = max(new, key=lambda n: abs(math.log(abs(values[n] / best[n]))))
        here, there = _figure(name, best[name]), _figure(name, values[name])
        found.append(
            f"stage {run.setup.keys.name!r}: the modes are met by more than one material: {name} = {there} "
            f"(probability {100 * weight:.0f} %) instead of {here}; label more modes or measure their shapes"
        )
    return found


def _figure(name: str, value: float) -> str:
    """A constant as people write it."""
    return f"{value / 1e9:.3g} GPa" if name.endswith("_pa") else f"{value:.3g}"

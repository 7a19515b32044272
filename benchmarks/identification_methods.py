"""Annealing, threshold accepting and response surfaces on the same objects: error, evaluations, full solves, time.

    python benchmarks/identification_methods.py [--object ring] [--object plate] [--method annealing] …

The truth is a finer mesh with 0.1 % of noise on every frequency. Full solves are eigenproblems of the full model on
the fitting mesh, per problem that the body's symmetry leaves, up to the end of the search. What follows, the polish on
a basis around the optimum and the verification on refined meshes, is the same for all methods. Times are processor
times.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.chain import chain
from statorhom.identify.refinement import MeshSeries
from statorhom.identify.settings import Settings
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.mesh.density import COARSEST, MeshDensity
from statorhom.model import basis_greedy, free_modes
from statorhom.model.affine import Material
from statorhom.model.free_modes import solve_free
from statorhom.model.problems import orders_of, spaces_of
from statorhom.study.object_file import read_object
from statorhom.study.study import load_study

METHODS = ("annealing", "threshold", "response_surface")
NOISE = 1e-3
RING_DENSITY = MeshDensity(COARSEST | {"core": 3, "yoke": 1})


@dataclass(frozen=True)
class TestObject:
    """An object with its truth.

    Parameters
    ----------
    geometry : its geometry file.
    region, kind, symmetry : of the stage.
    material : the true one.
    free : constant → 90 % range in which it is sought; all others are known.
    density : of the material.
    top_hz : modes below are measured.
    """

    geometry: str
    region: str
    kind: str
    symmetry: str
    material: Any
    free: dict[str, tuple[float, float]]
    density: float
    top_hz: float


RING = TestObject(
    geometry="""\
schema = 1
name = "ring"
[core]
outer_diameter_mm = 120.0
bore_diameter_mm = 90.0
length_mm = 80.0
yoke_thickness_mm = 15.0
[slots]
count = 8
shape = "none"
""",
    region="lamination",
    kind="stack",
    symmetry="transversely_isotropic",
    material=TransverselyIsotropic(186e9, 60e9, 0.29, 0.31, 17e9),
    free={"E_p_pa": (120e9, 220e9), "G_rz_pa": (5e9, 45e9)},
    density=7700.0,
    top_hz=9000.0,
)
PLATE = TestObject(
    geometry="""\
schema = 1
kind = "plate"
name = "woven carbon plate"
[plate]
length_mm = 300.0
width_mm = 200.0
thickness_mm = 4.0
""",
    region="plate",
    kind="coupon",
    symmetry="orthotropic",
    material=Orthotropic(47.126e9, 47.126e9, 9e9, 0.04, 0.3, 0.3, 3.927e9, 3e9, 3e9),
    free={"E_1_pa": (25e9, 85e9), "E_2_pa": (25e9, 85e9), "G_12_pa": (1e9, 10e9)},
    density=1510.0,
    top_hz=900.0,
)
OBJECTS = {"ring": RING, "plate": PLATE}
COUPON_NAMES = {"r": "1", "t": "2", "z": "3"}


@dataclass
class Count:
    """Full eigenproblems of the search."""

    solves: int = 0
    counting: bool = True
    cpu_s: float = field(default_factory=time.process_time)

    def stop(self) -> None:
        """The search has ended."""
        if self.counting:
            self.counting, self.cpu_s = False, time.process_time() - self.cpu_s


def constants(thing: TestObject) -> dict[str, float]:
    """True constants by the names that the study uses."""
    found = dict(vars(thing.material))
    if thing.kind == "coupon":
        found = {_numbered(name): value for name, value in found.items()}
    return found


def _numbered(name: str) -> str:
    head, axes, *rest = name.split("_")
    return "_".join([head, "".join(COUPON_NAMES[a] for a in axes), *rest])


def write_case(thing: TestObject, method: str, folder: Path, extra: str = "") -> Path:
    """Study, geometry and table of a concealed truth on a mesh of twice as many cells."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "geometry.toml").write_text(thing.geometry, encoding="utf-8")
    drawing = read_object(folder / "geometry.toml")
    step = object_geometry(drawing, folder / "geometry.toml").step((thing.kind,))
    model = MeshSeries(step, RING_DENSITY, (1.0, 2.0)).models[1]
    material = {thing.region: Material(thing.material.hooke(), thing.density)}
    modes = [m for m in solve_free(model, material, thing.top_hz).modes if m.frequency_hz < thing.top_hz]
    if thing.kind == "stack":
        modes = [m for m in modes if m.visibility > 0.1 and m.order in (2, 3)]
    noise = np.random.default_rng(7).standard_normal(len(modes)) * NOISE
    rows = [
        f"{m.frequency_hz * (1 + e):.5f},{m.frequency_hz * NOISE:.5f}"
        + (f",{m.order},{m.axial}" if thing.kind == "stack" else "")
        for m, e in zip(modes, noise, strict=True)
    ]
    head = "frequency_hz,frequency_sd_hz" + (",order,axial" if thing.kind == "stack" else "")
    (folder / "modes.csv").write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    mass = thing.density * sum(step.exact_volumes().values())
    known = "\n".join(
        f"{name} = {value!r}" for name, value in constants(thing).items() if name not in thing.free
    )
    ranges = "\n".join(
        f"{name} = {{ low = {low!r}, high = {high!r} }}" for name, (low, high) in thing.free.items()
    )
    (folder / "study.toml").write_text(
        f"""\
schema = 1
name = "case"
geometry = "geometry.toml"
[[stages]]
name = "stage"
kind = "{thing.kind}"
mass_kg = {mass!r}
mass_sd_kg = {mass * 1e-4!r}
[stages.model]
{thing.region} = "{thing.symmetry}"
[stages.identify]
method = "{method}"
[stages.identify.fixed.{thing.region}]
{known}
[stages.identify.prior.{thing.region}]
{ranges}
{extra}
[[stages.tests]]
name = "free"
support = "free"
modal_table = "modes.csv"
""",
        encoding="utf-8",
    )
    return folder / "study.toml"


@contextmanager
def counted() -> Iterator[Count]:
    """Count full eigenproblems until the first convergence study begins."""
    count = Count()
    patched = ((basis_greedy, "modes_below", lambda _found: 1), (free_modes, "eigenpairs_of", len))
    before = [getattr(module, name) for module, name, _ in patched]
    study = MeshSeries.study

    def counting(solve: Callable[..., Any], size: Callable[[Any], int]) -> Callable[..., Any]:
        def counted_solve(*args: Any, **kwargs: Any) -> Any:
            found = solve(*args, **kwargs)
            count.solves += size(found) if count.counting else 0
            return found

        return counted_solve

    def stopping(self: MeshSeries, *args: Any, **kwargs: Any) -> Any:
        count.stop()
        return study(self, *args, **kwargs)

    try:
        for (module, name, size), solve in zip(patched, before, strict=True):
            setattr(module, name, counting(solve, size))
        MeshSeries.study = stopping  # type: ignore[method-assign]
        yield count
    finally:
        for (module, name, _), solve in zip(patched, before, strict=True):
            setattr(module, name, solve)
        MeshSeries.study = study  # type: ignore[method-assign]


def run(thing: TestObject, method: str, folder: Path, extra: str = "") -> dict[str, Any]:
    """Identify an object; figures of its row."""
    files = load_study(write_case(thing, method, folder, extra))
    geometry = object_geometry(files.drawing, files.geometry_path)
    settings = Settings(seed=1, density=RING_DENSITY)
    with counted() as count:
        began = time.process_time()
        results = chain(files, folder / "out", settings).run()
        total = time.process_time() - began
    stage = results.stages[0]
    mesh = MeshSeries(geometry.step((thing.kind,)), RING_DENSITY).coarsest.mesh
    orders = [2, 3] if thing.kind == "stack" else list(orders_of(mesh))
    problems = sum(len(spaces_of(mesh, order)) for order in orders)
    truth = constants(thing)
    found = stage.regions[thing.region].engineering
    errors = {name: 100 * (found[name].value / truth[name] - 1) for name in thing.free}
    assert stage.fit is not None
    return {
        "errors": errors,
        "inside": all(found[n].ci90[0] <= truth[n] <= found[n].ci90[1] for n in thing.free),
        "max_percent": stage.fit.max_percent,
        "evaluations": stage.fit.evaluations,
        "full_solves": count.solves / problems,
        "search_s": count.cpu_s,
        "total_s": total,
        "results": results,
    }


def main() -> None:
    """Print a row per object and method."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--object", action="append", choices=OBJECTS)
    parser.add_argument("--method", action="append", choices=METHODS)
    chosen = parser.parse_args()
    print(
        "| object | method | errors of the constants | frequencies | evaluations | full solves | search | all |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for name in chosen.object or OBJECTS:
        for method in chosen.method or METHODS:
            with tempfile.TemporaryDirectory() as folder:
                row = run(OBJECTS[name], method, Path(folder))
            errors = ", ".join(f"{constant} {error:+.2f} %" for constant, error in row["errors"].items())
            print(
                f"| {name} | {method} | {errors}{'' if row['inside'] else ' (outside the interval)'} | "
                f"{row['max_percent']:.2f} % | {row['evaluations']} | {row['full_solves']:.1f} | "
                f"{row['search_s']:.1f} s | {row['total_s']:.1f} s |",
                flush=True,
            )


if __name__ == "__main__":
    main()

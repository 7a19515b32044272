"""Annealing, threshold accepting and response surfaces on the same objects: error, evaluations, full solves, time.

    python benchmarks/identification_methods.py [--object ring] [--object plate] [--object wing] [--method annealing] …

The truth is a mesh of twice as many cells (of the wing, two and a half times) with 0.1 % of noise on every frequency.
Full solves are eigenproblems of the full model on
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
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.chain import chain
from statorhom.identify.residuals.refinement import MeshSeries
from statorhom.identify.stages.settings import Settings
from statorhom.materials.isotropic import Isotropic
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


@dataclass(frozen=True, eq=False)
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
    known : other regions → their material and density, which the study prescribes.
    tied : constants that follow one of `free`.
    search : further lines of [stages.identify].
    refinement : of the truth's mesh over the fitting mesh.
    """

    geometry: str
    region: str
    kind: str
    symmetry: str
    material: Any
    free: dict[str, tuple[float, float]]
    density: float
    top_hz: float
    known: dict[str, tuple[Any, float]] = field(default_factory=dict)
    tied: dict[str, str] = field(default_factory=dict)
    search: str = ""
    refinement: float = 2.0

    @property
    def materials(self) -> dict[str, Material]:
        """True materials of all regions."""
        others = {name: Material(m.hooke(), density) for name, (m, density) in self.known.items()}
        return {self.region: Material(self.material.hooke(), self.density)} | others


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
# span, plies, E and G as printed; the cage's density is what makes 3 kg of it
GEOMETRIES = Path(__file__).resolve().parents[1] / "geometries"
WING = TestObject(
    geometry=(GEOMETRIES / "flying-wing-1900mm.toml").read_text(encoding="utf-8"),
    region="cbx90",
    kind="coupon",
    symmetry="orthotropic",
    material=Orthotropic(47.126e9, 47.126e9, 9e9, 0.04, 0.3, 0.3, 3.927e9, 3e9, 3e9),
    free={"E_1_pa": (25e9, 85e9), "G_12_pa": (1e9, 10e9)},
    density=1510.0,
    top_hz=170.0,
    known={
        "herex": (Isotropic(60e6, 0.3), 80.0),
        "interglass": (Orthotropic(10e9, 10e9, 6e9, 0.15, 0.3, 0.3, 2.8e9, 2e9, 2e9), 1270.0),
        "cage": (Isotropic(70e9, 0.33), 10130.0),
    },
    tied={"E_2_pa": "E_1_pa"},
    refinement=2.5,
)
OBJECTS = {"ring": RING, "plate": PLATE, "wing": WING}
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


def constants(thing: TestObject, material: Any = None) -> dict[str, float]:
    """True constants of a material (default: the one that is sought) by the names that the study uses."""
    found = dict(vars(thing.material if material is None else material))
    if thing.kind == "coupon":
        found = {_numbered(name): value for name, value in found.items()}
    return found


def _numbered(name: str) -> str:
    head, *rest = name.split("_")
    if not rest or not set(rest[0]) <= set(COUPON_NAMES):
        return name  # an isotropic material's
    return "_".join([head, "".join(COUPON_NAMES[a] for a in rest[0]), *rest[1:]])


@cache
def modal_table(thing: TestObject) -> str:
    """Modal table of the concealed truth, on a finer mesh and with noise."""
    with tempfile.TemporaryDirectory() as folder:
        step = geometry_of(thing, Path(folder))
    model = MeshSeries(step, RING_DENSITY, (thing.refinement,)).coarsest
    found = solve_free(model, thing.materials, thing.top_hz).modes
    modes = [m for m in found if m.frequency_hz < thing.top_hz]
    if thing.kind == "stack":
        modes = [m for m in modes if m.visibility > 0.1 and m.order in (2, 3)]
    noise = np.random.default_rng(7).standard_normal(len(modes)) * NOISE
    rows = [
        f"{m.frequency_hz * (1 + e):.5f},{m.frequency_hz * NOISE:.5f}"
        + (f",{m.order},{m.axial}" if thing.kind == "stack" else "")
        for m, e in zip(modes, noise, strict=True)
    ]
    head = "frequency_hz,frequency_sd_hz" + (",order,axial" if thing.kind == "stack" else "")
    return "\n".join([head, *rows]) + "\n"


def geometry_of(thing: TestObject, folder: Path) -> Any:
    """The tested object, from its geometry file in a folder."""
    path = folder / "geometry.toml"
    path.write_text(thing.geometry, encoding="utf-8")
    return object_geometry(read_object(path), path).step((thing.kind,))


def write_case(thing: TestObject, method: str, folder: Path, extra: str = "") -> Path:
    """Study, geometry and table of a concealed truth."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "modes.csv").write_text(modal_table(thing), encoding="utf-8")
    volumes = geometry_of(thing, folder).exact_volumes()
    mass = sum(thing.materials[region].density * volume for region, volume in volumes.items())
    (folder / "study.toml").write_text(study_text(thing, method, mass, extra), encoding="utf-8")
    return folder / "study.toml"


def study_text(thing: TestObject, method: str, mass: float, extra: str) -> str:
    """The study file of a case."""
    own = {n: v for n, v in constants(thing).items() if n not in thing.free and n not in thing.tied}
    fixed = {thing.region: own} | {name: constants(thing, m) for name, (m, _) in thing.known.items()}
    ranges = thing.free | {name: thing.free[leader] for name, leader in thing.tied.items()}
    known = "\n".join(
        f"[stages.identify.fixed.{region}]\n" + "\n".join(f"{n} = {v!r}" for n, v in values.items())
        for region, values in fixed.items()
    )
    priors = "\n".join(f"{n} = {{ low = {low!r}, high = {high!r} }}" for n, (low, high) in ranges.items())
    tied = "".join(f'tied.{thing.region} = [["{led}", "{n}"]]\n' for n, led in thing.tied.items())
    symmetries = {thing.region: thing.symmetry} | {name: m.symmetry for name, (m, _) in thing.known.items()}
    return f"""\
schema = 1
name = "case"
geometry = "geometry.toml"
[[stages]]
name = "stage"
kind = "{thing.kind}"
mass_kg = {mass!r}
mass_sd_kg = {mass * 1e-4!r}
[stages.model{".wing" if thing.known else ""}]
{chr(10).join(f'{name} = "{symmetry}"' for name, symmetry in symmetries.items())}
[stages.identify]
method = "{method}"
{tied}{thing.search}
{known}
[stages.identify.prior.{thing.region}]
{priors}
{extra}
[[stages.tests]]
name = "free"
support = "free"
modal_table = "modes.csv"
"""


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

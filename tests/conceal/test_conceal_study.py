"""A concealed study is a study, holds what was asked for, and is the same every time."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from command import statorhom
from concealed_rings import COARSE, write_ring
from statorhom.conceal.conceal_study import Wish, conceal_study
from statorhom.errors import ResultsError
from statorhom.geometry import stator_geometry
from statorhom.mesh import graded, mesh_step
from statorhom.model.affine import assemble
from statorhom.model.free_modes import solve_free
from statorhom.recordings.read import read_recording
from statorhom.study.geometry_file import read_geometry
from statorhom.study.study import load_study


def concealed(folder: Path, *wishes: Wish, is_table: bool = True, seed: int = 4, density=COARSE):
    template = write_ring(folder / "template", is_table=is_table)
    path, case = conceal_study(template, wishes, folder / "out", seed=seed, density=density)
    return path, case, json.loads((path.parent / "sealed" / "truth.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def clean(tmp_path_factory: pytest.TempPathFactory):
    return concealed(tmp_path_factory.mktemp("clean"), Wish("none"), density=None)


def test_it_loads_and_hides_nothing(clean) -> None:
    path, case, truth = clean
    files = load_study(path)
    assert (truth["verdict"], truth["effects"]) == ("none", [])
    assert len(files.tables["stack-free"].modes) == truth["tables"]["stack-free"]["listed"] >= 3
    assert files.study.stages[0].mass_kg == pytest.approx(case.stages[0].scale_kg, abs=2.5e-3)
    assert truth["detectability"]["projected_snr"] < 3


def test_its_modes_are_those_of_the_diagnosing_model_within_the_meshes_error(clean) -> None:
    _, case, truth = clean
    mesh = mesh_step(case.geometry.step(("stack",)), graded(tooth=1, radial=2, yoke=2))
    materials = {"lamination": case.stages[0].materials["lamination"].material}
    own = solve_free(assemble(mesh), materials, 17e3).modes
    seen = [m for m in truth["modes"] if m["kind"] == "radial" and m["order"] >= 2]
    assert len(seen) >= 8
    for mode in seen:
        same = [m.frequency_hz for m in own if (m.order, m.axial) == (mode["order"], mode["axial"])]
        assert min(abs(f / mode["frequency_hz"] - 1) for f in same) < 0.003


def test_what_was_set_stands_in_the_truth_and_nowhere_else(tmp_path: Path) -> None:
    path, _, truth = concealed(tmp_path, Wish("attached_mass", {"mass_kg": 0.0433, "angle_deg": 61.25}))
    (effect,) = truth["effects"]
    assert truth["verdict"] == "named"
    assert effect["parameters"]["mass_kg"] == 0.0433
    assert effect["location"]["angle_deg"] == 61.25
    outside = [f for f in path.parent.rglob("*") if f.is_file() and f.parent.name != "sealed"]
    assert not any(b"attached" in f.read_bytes() or b"61.25" in f.read_bytes() for f in outside)


def test_a_lump_splits_doublets_by_its_share_of_the_modal_mass(tmp_path: Path) -> None:
    _, _, clean_truth = concealed(tmp_path / "a", Wish("none"))
    given = {"mass_kg": 0.05, "angle_deg": 30.0, "z_mm": 30.0}
    _, case, truth = concealed(tmp_path / "b", Wish("attached_mass", given))

    def doublet(t: dict) -> np.ndarray:
        return np.array([m["frequency_hz"] for m in t["modes"] if (m["order"], m["axial"]) == (2, 0)][:2])

    # thin ring: radial and tangential motion cos 2θ and sin 2θ / 2, so that φ² = 2/M · 4/5 at an antinode
    first_order = 0.5 * 0.05 * 2 / case.stages[0].scale_kg * 4 / 5
    lower, upper = doublet(truth) / doublet(clean_truth).mean()
    assert upper - lower == pytest.approx(first_order * (1 - 1 / 4), rel=0.25)


def test_equal_seeds_give_equal_files(tmp_path: Path) -> None:
    wish = Wish("ovality")
    folders = [
        concealed(tmp_path / name, wish, seed=seed)[0].parent for name, seed in (("a", 5), ("b", 5), ("c", 6))
    ]
    contents = [{f.name: f.read_bytes() for f in folder.rglob("*") if f.is_file()} for folder in folders]
    assert contents[0] == contents[1] != contents[2]


def test_frfs_show_the_true_modes(tmp_path: Path) -> None:
    path, _, truth = concealed(tmp_path, Wish("none"), is_table=False)
    (frfs,) = read_recording([path.parent / "stack-free.uff"]).frf_sets
    level = np.sqrt(np.mean(np.abs(frfs.receptance) ** 2, axis=0))
    visible = [m for m in truth["modes"] if m["kind"] == "radial" and m["order"] >= 2]
    for mode in visible[:4]:
        near = np.abs(frfs.frequency_hz / mode["frequency_hz"] - 1) < 0.02
        top = frfs.frequency_hz[near][np.argmax(level[near])]
        assert top == pytest.approx(mode["frequency_hz"], rel=2e-3)
    assert read_geometry(path.parent / "geometry.toml") == read_geometry(
        tmp_path / "template" / "geometry.toml"
    )
    stator_geometry(read_geometry(path.parent / "geometry.toml"), path)


def test_a_folder_with_files_is_left_alone(tmp_path: Path) -> None:
    template = write_ring(tmp_path)
    with pytest.raises(ResultsError, match="--out"):
        conceal_study(template, [Wish("none")], tmp_path)


def test_the_command_says_where_the_study_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.conceal.ground.STACK_MESH", COARSE)
    template = write_ring(tmp_path / "template")
    options = ["--effect", "attached_mass", "--set", "mass_kg=0.02", "--seed", 3, "--out", tmp_path / "out"]
    done = statorhom("conceal", template, *options)
    assert (done.code, done.stdout.strip()) == (0, f"wrote {tmp_path / 'out' / 'study.toml'}")
    refused = statorhom("conceal", template, "--effect", "atached_mass", "--out", tmp_path / "other")
    assert refused.code == 2
    assert len(refused.stderr.strip().splitlines()) == 1
    assert not (tmp_path / "other").exists()


def test_what_is_seen_at_once_has_a_large_projected_signal(tmp_path: Path) -> None:
    _, _, truth = concealed(tmp_path, Wish("mislabelled_mode"))
    (effect,) = truth["effects"]
    listed = (tmp_path / "out" / "stack-free.csv").read_text(encoding="utf-8").splitlines()
    row = listed[effect["parameters"]["mode"]].split(",")
    assert (int(row[2]), int(row[3])) != (effect["parameters"]["order"], effect["parameters"]["axial"])
    assert truth["detectability"]["projected_snr"] > 10

"""Declared lumps of a plate: its modes shift as those of a whole mesh do, and simulate says so."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from concealed_coupons import CLOTH, Hidden, plate_frequencies
from coupon_study import PLATE, study_text, write_study
from statorhom.geometry.block import BlockGeometry
from statorhom.identify.residuals.body_shifts import body_shifts
from statorhom.mesh.block import block_mesh
from statorhom.model.affine import assemble
from statorhom.model.convergence import mode_keys
from statorhom.model.free_modes import solve_free
from statorhom.physics.action import Action, Attachment
from statorhom.simulate import simulate_study

SIZE, TOP, COARSE = (0.3, 0.2, 0.006), 900.0, 0.5
LUMP_KG = 0.02
LUMP = f"""
[[stages.effects]]
effect = "attached_mass"
mass_kg = {LUMP_KG}
x_mm = 225.0
y_mm = 150.0
"""


def test_modes_shift_as_those_of_a_whole_mesh_with_the_lump() -> None:
    exact, [(x, y)] = plate_frequencies(TOP, [Hidden(0.3, 0.2, mass_kg=LUMP_KG)], size=SIZE, factor=COARSE)
    model = assemble(block_mesh(BlockGeometry("plate", SIZE, "test"), COARSE))
    materials = {"plate": CLOTH}
    plain = mode_keys(solve_free(model, materials, TOP).modes)
    lump = Action(attachments=(Attachment((x, y, SIZE[2]), LUMP_KG),))
    shifts = body_shifts([lump], model, materials, TOP)
    found = sorted(mode.frequency_hz * np.exp(shifts[key].shift) for key, mode in plain.items())
    assert min(shifts[key].shift for key in plain) < -0.01
    np.testing.assert_allclose(found[:4], exact[:4], rtol=1.5e-3)


def plate(folder: Path, effects: str) -> Path:
    (folder / "free.csv").write_text("frequency_hz\n150\n", encoding="utf-8")
    text = study_text("plate", "orthotropic", 0.384, 'modal_table = "free.csv"')
    return write_study(folder, PLATE, text.replace("[[stages.tests]]", effects + "[[stages.tests]]"))


def test_simulated_frequencies_of_a_plate_contain_its_lump(tmp_path: Path) -> None:
    for name, effects in (("bare", ""), ("lumped", LUMP)):
        (tmp_path / name).mkdir()
        simulate_study(plate(tmp_path / name, effects), None, tmp_path / name / "out")
    bare, lumped = (
        pd.read_csv(tmp_path / name / "out" / "modes.csv")["frequency_hz"] for name in ("bare", "lumped")
    )
    assert lumped[0] < 0.99 * bare[0]

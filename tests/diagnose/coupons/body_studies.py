"""A small plate's study with its model near the truth, quick enough for ordinary tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from concealed_coupons import CLOTH, SIZE
from coupon_study import PLATE, study_text, table_text, write_study
from statorhom.diagnose.coupons.body_hypothesis import BodyHypothesis
from statorhom.diagnose.coupons.body_stage import body_stage, with_reference
from statorhom.diagnose.coupons.body_study import BodyStudy
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.stages.constants import study_constants
from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import stage_setup
from statorhom.results.diagnosis import Estimated
from statorhom.study.study import load_study

MASS_KG = float(CLOTH.density * np.prod(SIZE))
PRIOR = """\
[stages.identify.prior.plate]
E_1_pa = { low = 50e9, high = 72e9 }
E_2_pa = { low = 18e9, high = 26e9 }
E_3_pa = { low = 9e9, high = 13e9 }
G_12_pa = { low = 6e9, high = 8e9 }
G_13_pa = { low = 4e9, high = 5e9 }
G_23_pa = { low = 3.6e9, high = 4.4e9 }
"""


def holds(parameter: Estimated | float | str, value: float) -> bool:
    """Whether an effect's parameter has an interval, with a value in it."""
    if not isinstance(parameter, Estimated) or parameter.ci90 is None:
        return False
    low, high = parameter.ci90
    return low < value < high


def write_plate(folder: Path, frequencies: np.ndarray, noise: float = 5e-4, identify: str = "") -> Path:
    """A study of a plate with a modal table."""
    (folder / "free.csv").write_text(table_text(frequencies.tolist(), noise, 0))
    return write_study(
        folder, PLATE, study_text("plate", "orthotropic", MASS_KG, 'modal_table = "free.csv"', identify)
    )


def plate_hypothesis(folder: Path, frequencies: np.ndarray) -> BodyHypothesis:
    """The declared plate at the middle of narrow priors around the truth."""
    files = load_study(write_plate(folder, frequencies, identify=PRIOR))
    setup = stage_setup(files, object_geometry(files.drawing, files.geometry_path), 0)
    constants = study_constants([setup], (), 0.0)
    study = BodyStudy(files, constants)
    materials = study.materials(setup, constants.values(np.zeros(len(constants))))
    test = MeasuredTest(0, "free", "free", files.tables["free"].modes)
    stage = body_stage(setup, [test], [materials], Settings(), frozenset({"plate"}))
    return BodyHypothesis(study.with_stages((with_reference(stage, materials, mesh_known=True),)))

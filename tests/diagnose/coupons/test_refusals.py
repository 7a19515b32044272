"""What of coupons cannot be diagnosed is said in one line."""

from pathlib import Path

import pytest

from coupon_study import TUBE, study_text, write_study
from statorhom import Study
from statorhom.errors import StatorhomError


def test_a_tube_is_refused_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "free.csv").write_text("frequency_hz\n900\n1200\n")
    study = write_study(tmp_path, TUBE, study_text("tube", "isotropic", 1.4, 'modal_table = "free.csv"'))
    with pytest.raises(StatorhomError, match="a tube cannot be diagnosed yet; use fit or run") as error:
        Study.load(study).diagnose(tmp_path / "out")
    assert "\n" not in str(error.value)
    assert not (tmp_path / "out" / "diagnosis.json").exists()

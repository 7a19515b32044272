"""The program finds the constants that a concealed study was made with."""

from __future__ import annotations

from pathlib import Path

import pytest

from cheap_study import coarse
from concealed_rings import write_ring
from statorhom.api import Study
from statorhom.conceal.conceal_study import Wish, conceal_study


@pytest.mark.slow
def test_the_modulus_in_the_plane_comes_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.api.Settings", coarse)
    template = write_ring(tmp_path / "template")
    keys = template.read_text(encoding="utf-8")
    keys += "\n[stages.identify]\nevaluations = 400\nchains = 2\n"
    template.write_text(keys, encoding="utf-8")
    path, case = conceal_study(template, [Wish("none")], tmp_path / "out", seed=4)
    results = Study.load(path).fit(tmp_path / "results", jobs=1)
    found = results.stages[0].regions["lamination"].engineering["E_p_pa"].value
    assert found == pytest.approx(case.stages[0].materials["lamination"].constants["E_p_pa"], rel=0.03)

"""The Python face."""

from __future__ import annotations

from pathlib import Path

import pytest

import statorhom
from cheap_study import coarse, edit, write_study
from statorhom import StatorhomError, Study
from statorhom.errors import GeometryError, InputFileError, ResultsError

ROOT = Path(__file__).resolve().parents[1]


def test_exports_a_study_and_its_errors_only() -> None:
    assert set(statorhom.__all__) == {"Study", "StatorhomError"}


@pytest.mark.parametrize("path", sorted((ROOT / "measurements").glob("*/study*.toml")), ids=lambda p: p.name)
def test_the_measurements_of_this_repository_load(path: Path) -> None:
    study = Study.load(path)
    assert study.stage_names[0] == "stack"
    for stage in ("stack", "wound", "impregnated"):
        assert study.volumes(stage)["lamination"] > 0


def test_what_a_study_tells_before_it_is_fitted(tmp_path: Path) -> None:
    study = Study.load(str(write_study(tmp_path)))
    assert study.name == "ring"
    assert study.stage_names == ("stack", "framed")
    assert study.default_folder == tmp_path / "ring-results"
    assert study.stage_index("framed") == 1
    pi = 3.141592653589793
    assert study.volumes("stack") == pytest.approx({"lamination": pi * (0.06**2 - 0.045**2) * 0.06})
    assert study.volumes("framed")["frame"] == pytest.approx(pi * (0.064**2 - 0.06**2) * 0.06)


def test_faults_have_their_own_errors(tmp_path: Path) -> None:
    study = Study.load(write_study(tmp_path))
    with pytest.raises(InputFileError, match="no stage 'wound'; choose one of stack, framed"):
        study.fit(tmp_path / "out", stage="wound")
    with pytest.raises(ResultsError, match="there is no such file"):
        Study.read(tmp_path / "out")
    with pytest.raises(InputFileError, match="there is no such file"):
        Study.load(tmp_path / "gone.toml")
    edit(tmp_path / "ring.toml", "bore_diameter_mm = 90.0", "bore_diameter_mm = 130.0")
    with pytest.raises(GeometryError, match="bore_diameter_mm"):
        _ = Study.load(tmp_path / "study.toml").geometry
    assert issubclass(GeometryError, StatorhomError)


def test_run_returns_what_it_wrote(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.api.Settings", coarse)
    study = Study.load(write_study(tmp_path))
    announced: list[str] = []

    def announce(what: str, count: int):  # type: ignore[no-untyped-def]
        announced.append(what)
        counts: list[int] = []

        def progress(done: int) -> None:
            assert 0 <= done <= count and (not counts or done >= counts[-1])
            counts.append(done)

        return progress

    results = study.run(announce=announce)
    assert results == Study.read(study.default_folder)
    assert (study.default_folder / "report.html").exists()
    assert (study.default_folder / "report.pdf").exists()
    assert {"reduced bases", "search"} <= set(announced)

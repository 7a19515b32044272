"""A run of all steps: what is done stays, what still holds is not done again, equal seeds give equal results."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from cheap_study import coarse, edit, write_study
from statorhom.errors import ResultsError
from statorhom.identify import chain as chain_module
from statorhom.identify.chain import chain
from statorhom.identify.processes.announce import Progress
from statorhom.identify.stages.settings import Settings
from statorhom.results.files import read_results
from statorhom.results.schema import Results, StageResult
from statorhom.results.shape_file import read_shape_file
from statorhom.study.study import load_study


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study with the results of an uninterrupted run in `out`."""
    root = tmp_path_factory.mktemp("whole")
    fit(write_study(root), root / "out")
    return root


@pytest.fixture
def study(whole: Path, tmp_path: Path) -> Path:
    """A copy of that study with its results, to be spoilt."""
    shutil.copytree(whole, tmp_path / "copy")
    return tmp_path / "copy" / "study.toml"


@pytest.fixture
def fitted(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Names of the stages that are fitted from now on."""
    names: list[str] = []
    run_stage = chain_module.run_stage

    def spy(setup, *rest):  # type: ignore[no-untyped-def]
        names.append(setup.keys.name)
        return run_stage(setup, *rest)

    monkeypatch.setattr(chain_module, "run_stage", spy)
    return names


def fit(study: Path, out: Path, last: int | None = None, settings: Settings | None = None) -> Results:
    return chain(load_study(study), out, settings or coarse()).run(last)


def same(results: Results | StageResult) -> object:
    """What does not depend on the clock, as results.json tells it."""
    stages = results.stages if isinstance(results, Results) else (results,)
    return [stage.model_copy(update={"seconds": 0.0}).model_dump_json() for stage in stages]


def test_every_step_has_materials_modes_and_shapes(whole: Path) -> None:
    results = read_results(whole / "out")
    assert results.study == "ring"
    assert [stage.name for stage in results.stages] == ["stack", "framed"]
    stack, framed = results.stages
    assert set(stack.regions) == {"lamination"}
    assert set(framed.regions) == {"lamination", "frame"}
    assert framed.added_mass_kg == pytest.approx(2.565 - 2.313)
    modulus = stack.regions["lamination"].engineering["E_pa"]
    assert modulus.narrowed is not None and modulus.narrowed < 0.5
    assert stack.regions["lamination"].engineering["nu"].status == "fixed"
    for stage in results.stages:
        assert [(m.order, m.axial, m.role) for m in stage.modes[:2]] == [(2, 0, "fitted"), (2, 1, "fitted")]
        assert stage.shapes is not None
        shapes = read_shape_file(whole / "out" / stage.shapes)
        mode = stage.modes[0]
        assert mode.shape is not None and shapes.modes[mode.shape].order == mode.order


def test_an_earlier_region_keeps_its_material(whole: Path) -> None:
    stack, framed = read_results(whole / "out").stages
    assert framed.regions["lamination"] == stack.regions["lamination"]


def test_modulus_explains_the_lowest_mode(whole: Path) -> None:
    """f² ~ E where everything else is fixed: the fit must put the simulated modes on both sides of the measured."""
    for stage in read_results(whole / "out").stages:
        errors = [mode.error_percent for mode in stage.modes if mode.role == "fitted"]
        assert stage.fit is not None and stage.fit.max_percent == pytest.approx(max(np.abs(errors)))
        assert stage.fit.max_percent < 1.0
        assert min(errors) < 0 < max(errors)


def test_what_is_done_is_not_done_again(study: Path, fitted: list[str]) -> None:
    before = read_results(study.parent / "out")
    results = fit(study, study.parent / "out")
    assert fitted == []
    assert results == before == read_results(study.parent / "out")


def test_an_interrupted_run_continues(whole: Path, tmp_path: Path, fitted: list[str]) -> None:
    study = write_study(tmp_path)
    out = tmp_path / "out"

    def interrupt(_what: str, _count: int) -> Progress:
        if fitted == ["stack", "framed"]:
            raise KeyboardInterrupt
        return lambda _done: None

    with pytest.raises(KeyboardInterrupt):
        chain(load_study(study), out, coarse()).run(announce=interrupt)
    assert [stage.name for stage in read_results(out).stages] == ["stack"]
    assert not list(out.rglob("*.tmp"))
    fitted.clear()
    results = fit(study, out)
    assert fitted == ["framed"]
    assert same(results) == same(read_results(out)) == same(read_results(whole / "out"))


def test_a_changed_table_is_fitted_again_from_its_step_on(study: Path, fitted: list[str]) -> None:
    out = study.parent / "out"
    before = read_results(out)
    edit(study.parent / "framed.csv", "3600", "3610")
    results = fit(study, out)
    assert fitted == ["framed"]
    assert results.stages[0] == before.stages[0]
    old, new = before.stages[1].regions["frame"], results.stages[1].regions["frame"]
    assert new.engineering["E_pa"].value > old.engineering["E_pa"].value
    fitted.clear()
    edit(study.parent / "stack.csv", "3090", "3091")
    fit(study, out)
    assert fitted == ["stack", "framed"]


def test_a_comment_in_a_table_changes_nothing(study: Path, fitted: list[str]) -> None:
    edit(study.parent / "stack.csv", "frequency_hz", "# measured on Monday\nfrequency_hz")
    fit(study, study.parent / "out")
    assert fitted == []


@pytest.mark.parametrize("change", [{"seed": 2}, {"refinements": (1.0, 2.0)}])
def test_other_settings_are_another_run(change: dict[str, object], study: Path, fitted: list[str]) -> None:
    settings = Settings(**{"density": coarse().density, "refinements": coarse().refinements} | change)  # type: ignore[arg-type]
    fit(study, study.parent / "out", 0, settings)
    assert fitted == ["stack"]


def test_one_step_alone_keeps_later_ones_that_still_hold(study: Path, fitted: list[str]) -> None:
    out = study.parent / "out"
    before = read_results(out)
    results = fit(study, out, last=0)
    assert fitted == []
    assert same(results) == same(before.stages[0])
    assert read_results(out) == before


def test_one_step_takes_earlier_ones_from_the_folder(whole: Path, tmp_path: Path, fitted: list[str]) -> None:
    study = write_study(tmp_path)
    fit(study, tmp_path / "out", last=0)
    assert fitted == ["stack"]
    fit(study, tmp_path / "out", last=1)
    assert fitted == ["stack", "framed"]
    assert same(read_results(tmp_path / "out")) == same(read_results(whole / "out"))


def test_lost_shapes_are_made_again(whole: Path, study: Path, fitted: list[str]) -> None:
    out = study.parent / "out"
    lost = read_results(out).stages[0].shapes
    assert lost is not None
    (out / lost).unlink()
    results = fit(study, out)
    assert fitted == ["stack"]
    assert (out / lost).exists()
    assert same(results) == same(read_results(whole / "out"))


def test_two_processes_find_the_same(whole: Path, tmp_path: Path) -> None:
    parallel = Settings(jobs=2, density=coarse().density, refinements=coarse().refinements)
    results = fit(write_study(tmp_path), tmp_path / "out", settings=parallel)
    assert same(results) == same(read_results(whole / "out"))


def test_a_step_without_tests_is_weighed(study: Path, fitted: list[str]) -> None:
    text = study.read_text() + '\n[[stages]]\nname = "done"\nkind = "machine"\nmass_kg = 2.9\n'
    study.write_text(text)
    results = fit(study, study.parent / "out")
    assert fitted == []
    weighed = results.stages[2]
    assert weighed.added_mass_kg == pytest.approx(2.9 - 2.565)
    assert weighed.modes == () and weighed.regions == results.stages[1].regions
    assert len(read_results(study.parent / "out").stages) == 3


def test_results_of_another_study_are_refused(study: Path, fitted: list[str]) -> None:
    edit(study, 'name = "ring"', 'name = "other"')
    with pytest.raises(ResultsError, match="belongs to the study 'ring'"):
        fit(study, study.parent / "out")
    assert fitted == []


def test_a_step_without_tests_is_identified_with_the_next_one(tmp_path: Path, fitted: list[str]) -> None:
    study = write_study(tmp_path)
    text = study.read_text(encoding="utf-8")
    begin, end = text.index("[stages.identify]"), text.index('[[stages]]\nname = "framed"')
    study.write_text(text[:begin] + text[end:], encoding="utf-8")
    stack, framed = fit(study, tmp_path / "out").stages
    assert fitted == ["framed"]
    assert stack.regions["lamination"].engineering == {} and stack.modes == ()
    for region in ("lamination", "frame"):
        low, high = framed.regions[region].engineering["E_pa"].ci90
        assert 1e9 < low < high < 300e9

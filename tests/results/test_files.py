from __future__ import annotations

import json
from pathlib import Path

import pytest

from statorhom.errors import ResultsError
from statorhom.results.files import NAME, check_folder, earlier_stages, read_results, write_results
from statorhom.results.schema import Constant, RegionResult, Results, StageResult

HOOKE = tuple(tuple(float(6 * i + j) for j in range(6)) for i in range(6))
RESULTS = Results(
    schema=1,
    study="ring",
    seed=3,
    stages=(
        StageResult(
            name="stack",
            kind="stack",
            mass_kg=3.08,
            mass_sd_kg=0.002,
            added_mass_kg=3.08,
            regions={
                "lamination": RegionResult(
                    volume_m3=3.943e-4,
                    density_kg_m3=7810.5,
                    symmetry="isotropic",
                    hooke_pa=HOOKE,
                    engineering={"E_pa": Constant(value=1.9e11, ci90=(1.8e11, 2e11), status="identified")},
                )
            },
        ),
    ),
)


def test_comes_back_as_it_was_written(tmp_path: Path) -> None:
    path = write_results(RESULTS, tmp_path / "deep" / "out")
    assert path == tmp_path / "deep" / "out" / NAME
    assert read_results(path.parent) == RESULTS
    assert [file.name for file in path.parent.iterdir()] == [NAME]


def test_keys_are_those_of_the_contract(tmp_path: Path) -> None:
    written = json.loads(write_results(RESULTS, tmp_path).read_text(encoding="utf-8"))
    assert (written["schema"], written["study"], written["seed"]) == (1, "ring", 3)
    region = written["stages"][0]["regions"]["lamination"]
    assert {"volume_m3", "density_kg_m3", "symmetry", "hooke_pa", "loss_factor", "engineering"} <= set(region)
    assert region["hooke_pa"] == [list(row) for row in HOOKE]
    constant = region["engineering"]["E_pa"]
    assert (constant["value"], constant["ci90"], constant["status"]) == (1.9e11, [1.8e11, 2e11], "identified")


def test_keys_of_later_versions_are_let_pass(tmp_path: Path) -> None:
    content = json.loads(RESULTS.model_dump_json(by_alias=True)) | {"later": 1}
    (tmp_path / NAME).write_text(json.dumps(content), encoding="utf-8")
    assert read_results(tmp_path) == RESULTS


@pytest.mark.parametrize(
    ("content", "named"),
    [
        ("", "the file: "),
        ("[]", "the file: "),
        ('{"schema": 1}', "study: "),
        ('{"schema": 9, "study": "s", "seed": 1}', "schema: "),
        ('{"schema": 1, "study": "s", "seed": 1, "stages": [{}]}', "stages.0.name: "),
    ],
)
def test_a_damaged_file_names_its_fault(content: str, named: str, tmp_path: Path) -> None:
    (tmp_path / NAME).write_text(content, encoding="utf-8")
    with pytest.raises(ResultsError) as caught:
        read_results(tmp_path)
    message = str(caught.value)
    assert message.startswith(f"{tmp_path / NAME}: {named}")
    assert message.endswith("; delete the file and run the study again")
    assert message.isprintable()


def test_a_folder_that_cannot_be_written_keeps_what_it_has(tmp_path: Path) -> None:
    write_results(RESULTS, tmp_path)
    before = (tmp_path / NAME).read_bytes()
    with pytest.raises(ResultsError, match="cannot be written"):
        write_results(RESULTS, tmp_path / NAME)
    assert (tmp_path / NAME).read_bytes() == before


def test_earlier_stages_are_those_of_the_same_study(tmp_path: Path) -> None:
    assert earlier_stages(tmp_path, "ring") == ()
    write_results(RESULTS, tmp_path)
    assert earlier_stages(tmp_path, "ring") == RESULTS.stages
    with pytest.raises(ResultsError, match="belongs to the study 'ring', not to 'other'"):
        earlier_stages(tmp_path, "other")


def test_a_folder_is_made_and_a_file_refused(tmp_path: Path) -> None:
    check_folder(tmp_path / "a" / "b")
    assert (tmp_path / "a" / "b").is_dir()
    check_folder(tmp_path / "a" / "b")
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    with pytest.raises(ResultsError, match="is a file; name a folder"):
        check_folder(tmp_path / "file")
    with pytest.raises(ResultsError, match="cannot be made"):
        check_folder(tmp_path / "file" / "out")
    assert (tmp_path / "file").read_text(encoding="utf-8") == "mine"

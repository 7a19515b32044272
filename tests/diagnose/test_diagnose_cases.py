"""Cases with known truth beside the repository, made by a generator that shares nothing with the program."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from statorhom import Study
from statorhom.results.diagnosis import Diagnosis, Estimated

CASES = Path(__file__).resolve().parents[3] / "shared" / "cases"
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not CASES.exists(), reason="the cases do not stand beside the repository"),
]
STUDIES = sorted(CASES.glob("p*/study*.toml"))


def names(path: Path) -> str:
    return f"{path.parent.name}-{path.stem}"


@pytest.mark.parametrize("path", STUDIES, ids=names)
def test_verdict_effect_and_magnitude(path: Path, tmp_path: Path) -> None:
    truth = json.loads((path.parent / "truth.json").read_text())
    found = Study.load(path).diagnose(tmp_path)
    assert found.verdict == truth["verdict"]
    assert [e.effect for e in found.effects] == [e["effect"] for e in truth["effects"]]
    for effect, true in zip(found.effects, truth["effects"], strict=True):
        _check_magnitude(effect.parameters, true["parameters"])
        if true["location"]:
            angles = effect.location.angle_ambiguity_deg if effect.location else ()
            away = [abs((a - true["location"]["angle_deg"] + 180) % 360 - 180) for a in angles]
            assert min(away) < 10.0
    if found.verdict == "named":
        held = found.fit.held_out
        assert held is not None
        assert held.after_rms_percent < 0.5 * held.before_rms_percent


def _check_magnitude(parameters: dict[str, Estimated | float | str], true: dict[str, float | str]) -> None:
    """The first magnitude that both name, within a fifth."""
    name = next(n for n in parameters if n in true and isinstance(true[n], float))
    value = parameters[name]
    number = value.value if isinstance(value, Estimated) else value
    assert float(number) == pytest.approx(float(true[name]), rel=0.2)


def test_twice_the_same_and_never_the_truth(tmp_path: Path) -> None:
    """A copy without its truth is diagnosed the same, to the last digit."""
    origin = CASES / "p2-interlaminar-shear"
    if not origin.exists():
        pytest.skip("the case does not stand beside the repository")
    shutil.copytree(CASES / "geometries", tmp_path / "geometries")
    shutil.copytree(origin, tmp_path / "copy", ignore=shutil.ignore_patterns("truth.json"))
    both = [
        Study.load(folder / "study.toml").diagnose(tmp_path / out)
        for folder, out in ((origin, "a"), (tmp_path / "copy", "b"))
    ]
    assert _numbers(both[0]) == _numbers(both[1])


def _numbers(found: Diagnosis) -> str:
    return found.model_dump_json()

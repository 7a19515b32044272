"""Which valley the declared model is taken from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits import new_step, valleys
from statorhom.diagnose.fits.valleys import ASIDE, SETTLED


def stand(
    monkeypatch: pytest.MonkeyPatch, before: float, aside: float, settled: float, *, convincing: bool = True
) -> tuple[str, list[float]]:
    """Where the declared model ends up, and from where it was followed.

    Parameters
    ----------
    before, aside, settled : objective where it stood, from a constant's upper side, and that in a model of its own.
    """
    constants = (
        SimpleNamespace(log=True, sd=2.0),
        SimpleNamespace(log=True, sd=0.1),
        SimpleNamespace(log=False, sd=2.0),
    )
    study = SimpleNamespace(constants=SimpleNamespace(items=constants))

    @dataclass(frozen=True)
    class Blank:
        study: Any
        held: Any = "pairs"
        shared: tuple[object, ...] = ()

    best = SimpleNamespace(objective=before, z=np.zeros(3), hypothesis=Blank(study), name="before")
    monkeypatch.setattr(new_step, "_is_convincing", lambda _: convincing)
    begun: list[float] = []

    def follow(blank: Blank, start: np.ndarray, worth: float) -> SimpleNamespace:
        assert blank.held is None
        assert worth in (before, aside)
        begun.append(float(start[0]))
        value = aside if start[0] > 0 else before
        return SimpleNamespace(objective=value, z=start, hypothesis=blank, name="aside")

    monkeypatch.setattr(valleys, "refitted", follow)
    own = SimpleNamespace(objective=settled, name="settled")
    monkeypatch.setattr(new_step, "_settled", lambda *_: own)
    found: Any = new_step._on_its_best_side(best, (0, 1, 2))  # type: ignore[arg-type]
    return found.name, begun


def test_a_constant_of_which_little_is_known_is_tried_on_both_sides(monkeypatch: pytest.MonkeyPatch) -> None:
    assert stand(monkeypatch, 43.0, 35.0, 34.0) == ("settled", [-ASIDE, ASIDE])


def test_what_gains_nothing_there_leaves_the_declared_model(monkeypatch: pytest.MonkeyPatch) -> None:
    assert stand(monkeypatch, 43.0, 43.0 - 0.5 * SETTLED, 30.0)[0] == "before"


def test_what_does_not_convince_is_not_helped_to_flee(monkeypatch: pytest.MonkeyPatch) -> None:
    assert stand(monkeypatch, 43.0, 35.0, 34.0, convincing=False) == ("before", [])


def test_what_is_worse_in_a_model_of_its_own_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    assert stand(monkeypatch, 43.0, 35.0, 44.0)[0] == "before"


def valley(
    name: str, wide: float, adequacy: float, own_wide: float, narrower: float | None = None
) -> SimpleNamespace:
    hypothesis = SimpleNamespace(study=name, narrower=wide if narrower is None else narrower)
    return SimpleNamespace(
        objective=wide, adequacy=adequacy, own_wide=own_wide, z=np.array([wide]), hypothesis=hypothesis
    )


@dataclass(frozen=True)
class Stage:
    """A step as high as its tests, and the tests it is fitted to."""

    highest: float
    tests: tuple[Any, ...]

    def with_tests(self, tests: Sequence[Any]) -> Stage:
        return Stage(self.highest, tuple(tests))


def stage(_setup: Any, tests: Sequence[Any], *_: Any) -> Stage:
    return Stage(max((t.highest for t in tests), default=0.0), tuple(tests))


def chosen(
    monkeypatch: pytest.MonkeyPatch,
    *valleys: SimpleNamespace,
    tests: Sequence[Any] = (),
    kept: Any = None,
    known: Sequence[SimpleNamespace] = (),
    drawn: Sequence[Sequence[SimpleNamespace]] = ((), ()),
    fled: Mapping[str, SimpleNamespace] = MappingProxyType({}),
) -> tuple[Any, list[str], int]:
    """The chosen model, what was settled, and how many others are left.

    Parameters
    ----------
    known : valleys in a basis that knows them.
    drawn : of the draws after the first.
    fled : what leads elsewhere when it is settled.
    """
    settled: list[str] = []
    draws = [list(valleys), *drawn]

    def settle(_study: Any, one: SimpleNamespace) -> SimpleNamespace:
        settled.append(one.hypothesis.study)
        return fled.get(one.hypothesis.study, one)

    def study_of(stages: tuple[Any, ...]) -> SimpleNamespace:
        if kept is not None:
            kept(stages)
        return SimpleNamespace(constants=(), stages=(SimpleNamespace(name="stack"),), shared=())

    study = SimpleNamespace(constants=(), stages=(), with_stages=study_of)
    for name, fake in {
        "new_constants": lambda *_: [0],
        "trials_around": lambda _z, _places, seed: seed,
        "_materials": lambda *_: [],
        "stage_model": stage,
        "Hypothesis": lambda study: study,
        "wide_optima": lambda _, seed, **__: list(draws[seed]),
        "with_other_sides": lambda _, wide, *__: wide,
        "in_valleys": lambda hypothesis, *_: SimpleNamespace(objective=hypothesis.narrower),
        "_settled": settle,
        "nothing": lambda found: found,
        "_wide_objective": lambda found: found.own_wide,
        "_on_its_best_side": lambda best, *_: best,
        "_in_a_basis_that_knows": lambda *_: list(known),
    }.items():
        monkeypatch.setattr(new_step, name, fake)
    settings = SimpleNamespace(seed=0, density=None)
    setup: Any = SimpleNamespace(keys=SimpleNamespace(name="stack"))
    found, _, others = new_step.with_step(study, np.zeros(0), setup, tests, settings)  # type: ignore[arg-type]
    return found, settled, len(others)


def test_the_first_that_leaves_nothing_to_explain_is_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = valley("a", 10.0, 0.5, 10.0), valley("b", 11.0, 0.9, 5.0)
    assert chosen(monkeypatch, first, second) == ("a", ["a"], 1)


def test_the_model_reaches_as_high_as_a_clamped_test_and_is_fitted_to_the_free_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Three lines of a clamped table had no partner: the free one lacked its highest mode."""
    free, clamped = (
        SimpleNamespace(support="free", highest=3654.0),
        SimpleNamespace(support="v", highest=5098.0),
    )
    stages: list[Any] = []
    chosen(monkeypatch, valley("a", 10.0, 0.5, 10.0), tests=(free, clamped), kept=stages.extend)
    assert stages == [Stage(5098.0, (free,))]


def test_one_that_fits_beats_a_wider_one_that_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = valley("a", 10.0, 1e-9, 1.0), valley("b", 11.0, 0.9, 5.0)
    assert chosen(monkeypatch, first, second) == ("b", ["a", "b"], 1)


def test_where_none_fits_wide_valleys_tell(monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = valley("a", 10.0, 1e-9, 9.0), valley("b", 11.0, 1e-3, 12.0)
    assert chosen(monkeypatch, first, second) == ("a", ["a", "b"], 1)


def test_what_is_far_behind_is_not_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = valley("a", 10.0, 1e-9, 9.0), valley("b", 60.0, 0.9, 1.0)
    assert chosen(monkeypatch, first, second) == ("a", ["a"], 1)


def test_what_stays_best_as_valleys_narrow_is_followed_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """A table of six wound modes has many valleys nearly as deep while three percent are forgiven."""
    wide = [
        valley("a", 41.9, 0.0, 160.0, 153.0),
        valley("b", 47.2, 0.0, 200.0, 264.0),
        valley("c", 47.8, 0.9, 8.0, 139.0),
        valley("far", 70.0, 0.9, 1.0, 100.0),
    ]
    found, settled, others = chosen(monkeypatch, *wide)
    assert (found, settled) == ("c", ["a", "c"])
    assert others == 2
    # where the widest is the narrowest too, nothing else is paid for
    assert chosen(monkeypatch, valley("a", 41.9, 0.0, 9.0), valley("b", 50.0, 0.9, 8.0))[1] == ["a"]


def test_where_the_first_does_not_fit_other_draws_tell_others(monkeypatch: pytest.MonkeyPatch) -> None:
    """The right winding of a clean chain lay between two hundred points; four of six draws find it."""
    first, right = valley("a", 80.1, 1e-9, 300.0), valley("right", 56.3, 0.9, 9.0)
    assert chosen(monkeypatch, first, drawn=[[], [right]]) == ("right", ["a", "right"], 1)
    assert chosen(monkeypatch, first, drawn=[[right], []])[:2] == ("right", ["a", "right"])
    # where the first fits, nothing more is paid for
    fits = valley("fits", 80.1, 0.9, 9.0)
    assert chosen(monkeypatch, fits, drawn=[[right], []])[:2] == ("fits", ["fits"])


def test_where_none_fits_a_basis_that_knows_the_valleys_tells_others(monkeypatch: pytest.MonkeyPatch) -> None:
    """By FRFs the right winding of a clean chain lacked its highest mode, for the basis was a tenth too stiff there."""
    wide = [valley("a", 44.7, 1e-9, 300.0), valley("b", 47.0, 1e-4, 150.0), valley("right", 103.9, 0.9, 9.0)]
    assert chosen(monkeypatch, *wide)[:2] == ("b", ["a", "b"])
    right, first = valley("right", 13.6, 0.9, 9.0), valley("a", 44.7, 1e-9, 300.0)
    assert chosen(monkeypatch, *wide, known=[right, first])[:2] == ("right", ["a", "right"])
    # what lies where something was settled leads there again
    near, behind = valley("a", 45.0, 1e-9, 300.0), valley("behind", 48.0, 0.9, 9.0)
    assert chosen(monkeypatch, wide[0], known=[near, behind])[:2] == ("behind", ["a", "behind"])
    assert chosen(monkeypatch, valley("fits", 10.0, 0.9, 9.0), known=[right])[:2] == ("fits", ["fits"])


def test_what_only_the_poorer_basis_calls_by_its_name_is_followed_too(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Modes that two counts of node planes share had no partner where the right stack's valley was known."""
    first, right = valley("a", 200.2, 1e-9, 213.0), valley("right", 158.7, 0.01, 160.5)
    named_otherwise = valley("otherwise", 334.9, 1e-9, 340.0)
    found, settled, _ = chosen(monkeypatch, first, drawn=[[right], []], known=[first, named_otherwise])
    assert (found, settled) == ("right", ["a", "right"])


def test_of_valleys_alike_while_they_are_wide_the_narrow_one_tells(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(new_step, "_wide_objective", lambda found: found.own_wide)
    first, second = valley("a", 10.0, 1e-9, 187.5), valley("b", 9.0, 1e-9, 187.3)
    first.objective, second.objective = 553.0, 742.0
    assert new_step._best_in_wide_valleys([first, second]) is first  # type: ignore[list-item]


def test_what_fled_in_a_poor_basis_is_followed_in_a_better_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """The right valley led to 327 of the objective in a basis of six materials, to 89 in a better one."""
    poor, better = valley("poor", 56.3, 0.0, 300.0), valley("better", 56.2, 0.9, 9.0)
    away = valley("away", 326.7, 1e-9, 300.0)
    found = chosen(monkeypatch, poor, known=[better], fled={"poor": away})
    assert found == ("better", ["poor", "better"], 1)


@pytest.mark.parametrize(
    ("before", "after", "moved"),
    [
        ({0: 1000.0, 1: 2000.0}, {0: 1001.0, 1: 1996.0}, 2e-3),
        ({0: 1000.0, 1: 2000.0}, {0: 1001.0}, 1e-3),
        # a narrow band of stiff materials: the first basis has no mode in it
        ({}, {0: 1000.0}, np.inf),
    ],
)
def test_a_basis_without_any_mode_of_the_band_has_not_settled(
    before: dict[int, float], after: dict[int, float], moved: float
) -> None:
    assert new_step._moved(before, after) == pytest.approx(moved, rel=1e-2)


def settled(monkeypatch: pytest.MonkeyPatch, straight: float, gently: float | None) -> tuple[float, int]:
    """What a step ends at whose refit leads to one chance straight and another by degrees, and how many are made."""
    gone = 0

    def optimum(chance: float) -> SimpleNamespace:
        hypothesis = SimpleNamespace(materials=lambda *_: None)
        return SimpleNamespace(objective=1.0 / chance, adequacy=chance, z=chance, hypothesis=hypothesis)

    def by_degrees(*_: Any) -> SimpleNamespace | None:
        nonlocal gone
        gone += 1
        return None if gently is None else optimum(gently)

    step = SimpleNamespace(setup=None, ring=None)
    step.with_error = lambda _: step
    study = SimpleNamespace(stages=(step,))
    study.with_stages = lambda _: study
    for name, fake in {
        "_frequencies": lambda *_: {0: 1000.0},
        "with_reference": lambda *_: step,
        "mesh_error": lambda *_: None,
        "Hypothesis": lambda study: study,
        "refit": lambda _, z: optimum(straight if z is None else z),
        "by_degrees": by_degrees,
        "nothing": lambda found: found,
    }.items():
        monkeypatch.setattr(new_step, name, fake)
    found: Any = optimum(1e-9)
    found.z = None
    return new_step._settled(study, found).adequacy, gone  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("straight", "gently", "chance", "made"),
    [(0.5, 0.9, 0.5, 0), (1e-14, 0.83, 0.83, 1), (1e-3, 1e-9, 1e-3, 1), (1e-3, None, 1e-3, 1)],
)
def test_what_does_not_convince_straight_is_followed_by_degrees_too(
    monkeypatch: pytest.MonkeyPatch, straight: float, gently: float | None, chance: float, made: int
) -> None:
    """A stack's axial stiffness jumped to where (2, 2) had no partner (108 of the objective); by degrees: 17."""
    assert settled(monkeypatch, straight, gently) == (chance, made)

"""Which cheap effects are followed where the declared model is far off."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits import explanations
from statorhom.diagnose.located.scan import Signature
from statorhom.diagnose.searches import refit_starts
from statorhom.diagnose.searches.refit_starts import _as_large, _begun
from statorhom.diagnose.searches.searched_starts import SUPPORTS, _with_few_supports
from statorhom.physics.action import Action, Joint
from statorhom.physics.parameter import EffectParameter, angle, height

BASE: Any = SimpleNamespace(hypothesis=SimpleNamespace(candidates=()), z=None)


def trial(rough: float | None) -> Any:
    found = None if rough is None else SimpleNamespace(objective=rough)
    return 1.0, [SimpleNamespace(rough=found)]


def promising(*roughs: float | None) -> list[float | None]:
    kept = refit_starts._promising(100.0, [trial(r) for r in roughs])
    return [None if one[1][0].rough is None else one[1][0].rough.objective for one in kept]


def test_the_first_few_are_followed_whatever_they_gain() -> None:
    assert promising(99.0, 10.0, 98.0, 97.0, 96.0, None) == [10.0, 96.0, 97.0, 98.0]


def test_others_are_followed_for_a_part_of_the_best_ones_gain() -> None:
    assert promising(10.0, 20.0, 30.0, 40.0, 81.0, 83.0) == [10.0, 20.0, 30.0, 40.0, 81.0]


def test_what_explains_less_than_its_absence_is_sought_all_over_the_prior(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In wide valleys it was in none of its own: a soft end winding was given up for a stranger's suspension."""
    narrow = SimpleNamespace(rough=None)
    monkeypatch.setattr(refit_starts, "narrowed_starts", lambda _: [narrow])
    monkeypatch.setattr(refit_starts, "_through_sizes", lambda _, starts: starts)
    usual, lost = (trial(19.0 + more) for more in (refit_starts.UNUSUAL, 14.0))
    assert refit_starts._in_wide_valleys(BASE, 19.0, usual) == usual
    sought = refit_starts._in_wide_valleys(BASE, 19.0, lost)
    assert sought == (1.0, [narrow, *lost[1]])
    # of it wide valleys say nothing, so that they are no reason to leave it out
    others = [trial(rough) for rough in (18.0, 18.1, 18.2, 18.3, 18.95)]
    assert refit_starts._promising(19.0, [sought, *others]) == [*others[:4], sought]


def test_from_the_constants_of_a_start_every_size_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where one of them leads nowhere the others do."""
    tried: list[list[float]] = []

    def wide(_: Any, points: Any, __: Any) -> list[Any]:
        tried.extend(z.tolist() for z in points)
        return [SimpleNamespace(z=z, objective=float(z[-1])) for z in points]

    monkeypatch.setattr(refit_starts, "scan_starts", lambda *_: [np.array([v]) for v in (3.0, 2.0, 5.0)])
    monkeypatch.setattr(refit_starts, "wide_optima", wide)
    monkeypatch.setattr(refit_starts, "replace", lambda hypothesis, **_: hypothesis)
    monkeypatch.setattr(explanations, "narrowed", lambda rough: rough)
    monkeypatch.setattr(
        explanations, "refitted", lambda _, z: None if z[-1] == 3.0 else SimpleNamespace(objective=z[-1])
    )
    hypothesis: Any = SimpleNamespace(study=None, candidates=[SimpleNamespace(parameters=["share"])])
    start = refit_starts.Start(hypothesis, np.array([0.1, 0.2, 9.0]))
    assert refit_starts.STARTS == 2
    found = refit_starts.best_of_sizes(start)
    assert found is not None and found.objective == 9.0
    assert tried == [[0.1, 0.2, 9.0], [0.1, 0.2, 3.0], [0.1, 0.2, 2.0], [0.1, 0.2, 5.0]]


def test_few_supports_go_with_all_the_constants() -> None:
    points = [np.r_[np.arange(3.0) + i, 10.0 * i, 20.0 * i] for i in range(50)]
    found = _with_few_supports(points, 3)
    assert all(np.array_equal(a[:3], b[:3]) for a, b in zip(found, points, strict=True))
    supports = [tuple(z[3:]) for z in found]
    assert 2 <= len(set(supports)) <= SUPPORTS
    # neighbours share theirs: it is solved once
    assert sum(a != b for a, b in pairwise(supports)) == len(set(supports)) - 1


def signature(effect: Any, start: list[float], strength: float, gain: float) -> Signature:
    return Signature(effect, np.array(start), np.ones(1), strength, gain, np.ones(1))


def test_a_lump_begins_as_heavy_as_the_misfit_asks() -> None:
    mass = EffectParameter("mass_kg", 0.003, 0.05, 1e-4, 0.2, "log", (0.01,), None)
    lump: Any = SimpleNamespace(parameters=(mass, angle(), height(0.08)))
    start = [mass.internal(0.01), 0.3, -0.2]
    # its splits are 8 standard deviations at 10 g, and 40 are missing
    begun = _as_large(signature(lump, start, 8.0, 40.0**2))
    assert mass.value(begun[0]) == pytest.approx(0.05)
    assert begun[1:].tolist() == start[1:]
    # held-down residuals may ask for anything, physical limits hold
    assert mass.value(_as_large(signature(lump, start, 1e-3, 40.0**2))[0]) == pytest.approx(0.08)


def test_a_ratio_goes_away_from_what_it_is_without_the_effect() -> None:
    ratio = EffectParameter("stiffness_ratio", 0.3, 2.5, 0.02, 12.0, "log", (0.6,), 1.0)
    strip: Any = SimpleNamespace(parameters=(ratio, angle()))
    begun = _as_large(signature(strip, [ratio.internal(0.6), 0.0], 10.0, 20.0**2))
    assert ratio.value(begun[0]) == pytest.approx(0.36)


def test_effects_without_a_place_begin_where_the_scan_did() -> None:
    shear = EffectParameter("G_rz_pa", 1e9, 60e9, 0.2e9, 75e9, "log", (10e9,), None)
    sliding: Any = SimpleNamespace(parameters=(shear, shear))
    begun = _as_large(signature(sliding, [0.1, 0.2], 1.0, 100.0))
    assert begun.tolist() == [0.1, 0.2]


@pytest.mark.parametrize(("price", "width_deg"), [("DEAR", 40.0), ("MIDDLING", 200.0)])
def test_an_arc_of_lost_contact_is_not_made_wider(
    monkeypatch: pytest.MonkeyPatch, price: str, width_deg: float
) -> None:
    width = EffectParameter("arc_deg", 20.0, 180.0, 5.0, 330.0, "log", (40.0,), None)
    arc: Any = SimpleNamespace(parameters=(width, angle()))
    monkeypatch.setattr(refit_starts, "start_of", lambda _, __, start: start)
    monkeypatch.setattr(refit_starts, "price", lambda _: getattr(refit_starts, price))
    begun: Any = _begun(BASE, signature(arc, [width.internal(40.0), 0.0], 4.0, 20.0**2))
    assert width.value(begun[0]) == pytest.approx(width_deg)


@pytest.mark.parametrize(
    ("action", "expected"),
    [
        (Action(), refit_starts.CHEAP),
        (Action(joint=Joint(("frame",), 3e12, 2e12)), refit_starts.CHEAP),
        (Action(changes=lambda *_: ()), refit_starts.MIDDLING),
        (Action(joint=Joint(("winding",), 1e14, 1e14, (0.0, 1.0), 1e-3)), refit_starts.DEAR),
    ],
    ids=["even", "contact", "local", "arc"],
)
def test_a_contact_costs_much_where_it_is_lost_over_an_arc(action: Action, expected: int) -> None:
    """Where it is the same all around, it is sought all over the prior like everything that keeps the symmetry."""
    hypothesis: Any = SimpleNamespace(candidates=("effect",), actions=lambda _: (action,))
    assert refit_starts.price((1.0, [refit_starts.Start(hypothesis, np.zeros(1))])) == expected


def test_rivals_of_the_favourite_are_sought_all_over_the_prior(monkeypatch: pytest.MonkeyPatch) -> None:
    """A favourite that explains enough ends the search for others that nobody has looked for."""
    gains = {"soft": 700.0, "loose": 660.0, "loose too": 650.0, "slow": 140.0}

    def start_of(name: str) -> Any:
        own = SimpleNamespace(candidates=(SimpleNamespace(effect=name.split()[0], stage="wound"),))
        return SimpleNamespace(name=name, rough=None, hypothesis=own)

    def candidate(name: str) -> Any:
        return SimpleNamespace(
            gain=gains[name], candidate=SimpleNamespace(label=name, effect=name, stage="wound")
        )

    signatures = [candidate(name) for name in gains]
    scan: Any = SimpleNamespace(of_every_candidate=lambda: signatures)
    start = {name: start_of(name) for name in gains}
    monkeypatch.setattr(refit_starts, "is_poor", lambda _: True)
    monkeypatch.setattr(refit_starts, "shared_by", lambda _: [])
    monkeypatch.setattr(refit_starts, "price", lambda _: refit_starts.CHEAP)
    monkeypatch.setattr(refit_starts, "starts_of", lambda _, __, s: [start[s.candidate.label]])
    monkeypatch.setattr(refit_starts, "searched", lambda s: [f"{s.name} searched"])
    monkeypatch.setattr(refit_starts, "narrowed_starts", lambda s: [f"{s.name} searched, narrowed"])
    monkeypatch.setattr(refit_starts, "_through_sizes", lambda _, starts: starts)
    monkeypatch.setattr(refit_starts, "_without", lambda _: 100.0)
    monkeypatch.setattr(refit_starts, "_promising", lambda _, trials: trials)
    order: Any = list(refit_starts.in_order(BASE, scan, signatures[:2]))
    assert [starts for _, starts in order] == [
        ["soft searched", start["soft"]],
        ["loose searched, narrowed", start["loose"]],
        [start["loose too"]],
        [start["slow"]],
    ]


def test_a_softer_strip_is_no_neighbour_of_a_stiffer_one() -> None:
    """Of a table's splits, which have no sign, both ask for the same; refits followed the stiffer one alone."""
    ratio = EffectParameter("stiffness_ratio", 0.3, 2.5, 0.02, 12.0, "log", (0.6, 1.6), 1.0)
    strip: Any = SimpleNamespace(parameters=(ratio, angle()))
    soft, softer, stiff = (
        signature(strip, [ratio.internal(value), place], 1.0, 100.0)
        for value, place in ((0.6, 0.0), (0.5, 0.7), (1.6, 0.0))
    )
    assert refit_starts._neighbours(soft, softer)
    assert not refit_starts._neighbours(soft, stiff)

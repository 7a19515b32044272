"""What a finer mesh and more local fields add to what breaks the symmetry strongly."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from template_hypothesis import template_hypothesis

from statorhom.diagnose.bases.trained_basis import trained_basis
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import in_its_own_model
from statorhom.diagnose.predicted.prediction import broken_responses
from statorhom.diagnose.stages.refinement import Addition, Refinement
from statorhom.diagnose.stages.stage_model import on_mesh
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.named_response import Response, Way, named_response
from statorhom.model.broken.solve import solve_broken
from statorhom.model.convergence import ModeKey
from statorhom.model.kept import Kept
from statorhom.physics.library import all_candidates

FREE = "frequency_hz,order,axial\n1428,2,0\n1766,2,1\n3770,3,0\n4210,3,1\n"
KEYS: tuple[ModeKey, ...] = ((2, 0, 0), (3, 0, 0), (3, 1, 0))
STRONG = {"stiffness_ratio": 0.18, "depth_mm": 9.0, "width_deg": 14.0, "angle_rad": 0.4}


@pytest.fixture(scope="module")
def strip(tmp_path_factory: pytest.TempPathFactory) -> Hypothesis:
    declared = template_hypothesis(tmp_path_factory.mktemp("study"), {"stack-free.csv": FREE})
    (one,) = (c for c in all_candidates(declared.study.files) if c.effect == "local_stiffness")
    return declared.of_others((one,))


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    """As a diagnosis has it: beside other tests threads wait for each other."""
    with one_blas_thread():
        yield


def at(hypothesis: Hypothesis, **values: float) -> np.ndarray:
    """Coordinates with the effect's parameters; the constants are typical."""
    (candidate,) = hypothesis.candidates
    own = [p.internal(values[p.name]) for p in candidate.parameters]
    return np.r_[np.zeros(hypothesis.constants), own]


def splits(hypothesis: Hypothesis, z: np.ndarray) -> np.ndarray:
    """Predicted sizes, relative."""
    (stage,) = hypothesis.study.stages
    found = broken_responses(stage, hypothesis.actions(z))
    return np.array([abs(found[key].split) for key in KEYS])


def exact_splits(hypothesis: Hypothesis, z: np.ndarray) -> np.ndarray:
    """The same of a solution on the finer mesh whose errors are estimated and small."""
    (stage,) = hypothesis.study.stages
    materials, (action,) = stage.reference, hypothesis.actions(z)
    twin = on_mesh(stage.finely_layered, stage.setup, stage.tests, [materials], stage.density)
    basis = symmetric_basis(twin.model, materials, twin.ring.highest_hz, margin=1.5)
    assert action.changes is not None
    modes = solve_broken(basis, action.changes(twin.model.mesh, materials), tolerance=2e-3)
    columns = trained_basis(modes.basis, twin._named).columns
    found = {key: named_response(modes, columns[key]) for key in KEYS}
    return np.array([abs(one.split) for one in found.values() if one is not None])


def test_a_strong_strip_parts_doublets_as_a_finer_mesh_has_it(strip: Hypothesis) -> None:
    z = at(strip, **STRONG)
    own = in_its_own_model(strip, z)
    (stage,) = own.study.stages
    assert stage.refinement is not None
    rough = own.with_stages((replace(stage, refinement=None, responses=Kept()),))
    exact = exact_splits(strip, z)
    off = [np.abs(splits(h, z) / exact - 1).max() for h in (rough, own)]
    assert off[1] < 0.04 < 0.1 < off[0]
    # nearby, too
    near = at(strip, **STRONG | {"stiffness_ratio": 0.22, "width_deg": 12.5})
    exact = exact_splits(strip, near)
    off = [np.abs(splits(h, near) / exact - 1).max() for h in (rough, own)]
    assert off[1] < 0.4 * off[0]


def test_a_weak_strip_needs_no_finer_mesh_and_no_other_effect_has_it(strip: Hypothesis) -> None:
    own = in_its_own_model(strip, at(strip, **STRONG))
    (stage,) = own.study.stages
    assert (
        in_its_own_model(strip, at(strip, **STRONG | {"stiffness_ratio": 0.9})).study.stages[0].refinement
        is None
    )
    (action,) = own.actions(at(strip, **STRONG))
    bare = replace(stage, refinement=None)
    other = replace(action, label="something else")
    refined, unrefined = (broken_responses(s, [other])[KEYS[0]] for s in (stage, bare))
    assert refined.split == unrefined.split
    assert broken_responses(stage, [action])[KEYS[0]].split != unrefined.split


def test_what_is_small_beside_a_split_is_a_part_of_it() -> None:
    found = Addition(-0.002, 0.02j, 0.002j).to(Response(-0.01, 0.04 + 0j))
    assert found.shift == pytest.approx(-0.012)
    assert found.split == pytest.approx(0.044)


def test_what_is_not_small_turns_as_the_split_does() -> None:
    """A cause that is turned by an angle turns all that it does to a doublet."""
    addition = Addition(0.0, 0.001 + 0j, -0.003 + 0j)
    assert addition.to(Response(0.0, 0.001j)).split == pytest.approx(-0.002j)
    assert Addition(0.0, 0j, 0.003j).to(Response(0.0, 0j)).split == pytest.approx(0.003j)


def test_lines_move_apart_with_their_split_and_other_ways_have_it_too() -> None:
    ways = (Way(0.001, 0.02 + 0j, 0.3),)
    lines = (Way(-0.004, 0j, 1.0), Way(0.006, 0j, 1.0))
    found = Addition(0.01, 0.02 + 0j, 0.002 + 0j).to(Response(0.001, 0.02 + 0j, ways=ways, lines=lines))
    assert [line.shift for line in found.lines] == pytest.approx([0.011 - 0.0055, 0.011 + 0.0055])
    assert found.ways[0].shift == pytest.approx(0.011) and found.ways[0].split == pytest.approx(0.022)


def test_modes_that_either_mesh_lacks_stay_as_they_are() -> None:
    response = Response(-0.01, 0.01 + 0j)
    found = Refinement(frozenset({"strip"}), (), {KEYS[0]: Addition(0.1, 0.01 + 0j, 0j)}).to(
        dict.fromkeys(KEYS, response)
    )
    assert found[KEYS[0]].shift == pytest.approx(0.09) and found[KEYS[1]] is response


def test_nearly_the_same_strip_needs_no_other_solution(strip: Hypothesis) -> None:
    own = in_its_own_model(strip, at(strip, **STRONG))
    (first,) = (stage.refinement for stage in own.study.stages)
    turned = STRONG | {"angle_rad": 2.0, "stiffness_ratio": 0.19}
    assert in_its_own_model(own, at(strip, **turned)).study.stages[0].refinement is first
    other = in_its_own_model(own, at(strip, **STRONG | {"stiffness_ratio": 0.5})).study.stages[0].refinement
    assert other is not first and other is not None

"""What a test's own measuring planes count of a mode's node planes.

Four planes show three node planes at most: a mode with four of them is counted with none or two, and stands in the
table like that. Predicted modes are called by what the same planes show of them. Where nobody says which planes a table
was counted at, one between the ends may be missing, and with it two nodes. A shape that hardly crosses zero, or hardly
does not, may do the other on a finer mesh.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.stages.order_profiles import profiles_at
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey
from statorhom.model.radial_profile import node_planes

FAINT = 0.25  # of the largest amplitude, below which a plane may be taken for one near a node
OPEN = 0.15  # of the largest amplitude: by which the mesh may leave open how far a shape bends
MIXED = 0.003  # relative: modes of one order that lie nearer to each other than this may be mixed in any way


def counted_at_planes(
    stage: StageModel, test: MeasuredTest, modes: Mapping[ModeKey, PredictedMode], materials: Materials
) -> dict[ModeKey, PredictedMode]:
    """The same modes with the counts of node planes that a test may find.

    Parameters
    ----------
    stage, test : whose planes.
    modes : predicted ones.
    materials : with which they were predicted: a mode of mixed motion is counted otherwise at others.
    """
    planes = None if test.shapes is None else tuple(sorted(test.shapes.z_m.tolist()))
    places = {key: None if mode.slope is not None else mode.mode.place for key, mode in modes.items()}
    profiles = profiles_at(stage, planes, materials, places)
    if not profiles:
        return dict(modes)
    along, seen = np.array(list(profiles.values())).T, [modes[key] for key in profiles]
    counts = _anywhere(along, seen) if planes is None else _at_known(along, seen)
    shown = dict(zip(profiles, counts, strict=True))
    return {key: replace(mode, shown=shown.get(key, ())) for key, mode in modes.items()}


def _at_known(along: np.ndarray, modes: Sequence[PredictedMode]) -> list[tuple[int, ...]]:
    """Counts of modes by their profiles (planes, modes), any where another one lies near."""
    own, mixed, every = _possible(along), _mixed(modes), range(len(along))
    return [(*counts, *every) if is_mixed else counts for counts, is_mixed in zip(own, mixed, strict=True)]


def _anywhere(along: np.ndarray, modes: Sequence[PredictedMode]) -> list[tuple[int, ...]]:
    """The same at planes that nobody knows: a mode's own name, and what fewer planes show."""
    counts = zip(modes, _with_fewer_planes(along), strict=True)
    return [own if mode.axial is None else (mode.axial, *own) for mode, own in counts]


def _with_fewer_planes(along: np.ndarray) -> list[tuple[int, ...]]:
    """Counts of profiles (planes, k) without any one plane and that opposite to it; ends are always measured."""
    planes = len(along)
    rest = [[i for i in range(planes) if i not in (k, planes - 1 - k)] for k in range(1, planes // 2)]
    return _each([*(node_planes(along[used]) for used in rest), *_bent(along)])


def _mixed(modes: Sequence[PredictedMode]) -> np.ndarray:
    """Whether another count of node planes of the same order lies so near that what is measured is a sum of both."""
    names, log_f = (
        np.array([(mode.order, mode.axial) for mode in modes]),
        np.array([mode.log_f for mode in modes]),
    )
    same = names[:, None, 0] == names[None, :, 0]
    other = names[:, None, 1] != names[None, :, 1]
    return np.asarray((same & other & (np.abs(log_f[:, None] - log_f) < MIXED)).any(axis=1))


def _possible(along: np.ndarray) -> list[tuple[int, ...]]:
    """Counts of profiles (planes, k) with planes near a node left out, with faint ones left out, and with all."""
    least = FAINT * np.abs(along).max(axis=0)
    every = np.count_nonzero(np.diff(np.sign(along), axis=0), axis=0)
    return _each([node_planes(along), node_planes(along, least), every, *_bent(along)])


def _bent(along: np.ndarray) -> list[np.ndarray]:
    """Counts of profiles (planes, k) that bend a little more and a little less, each in its own symmetry."""
    halves = np.sign(np.arange(len(along)) - (len(along) - 1) / 2)[:, None]
    even = along[:1] * along[-1:] > 0
    more = OPEN * np.abs(along).max(axis=0) * np.where(even, 1.0, halves)
    return [node_planes(along + more), node_planes(along - more)]


def _each(counts: list[np.ndarray]) -> list[tuple[int, ...]]:
    """Of every profile the counts, the likeliest first, each once."""
    return [tuple(dict.fromkeys(own)) for own in zip(*(n.tolist() for n in counts), strict=True)]

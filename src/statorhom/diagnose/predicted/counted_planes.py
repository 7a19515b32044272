"""What a test's own measuring planes count of a mode's node planes.

Four planes show three node planes at most: a mode with four of them is counted with none or two, and stands in the
table like that. Predicted modes are called by what the same planes show of them. Where nobody says which planes a table
was counted at, one between the ends may be missing, and with it two nodes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.stages.order_profiles import reference_profiles
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.convergence import ModeKey
from statorhom.model.radial_profile import node_planes, usual_planes

FAINT = 0.25  # of the largest amplitude, below which a plane may be taken for one near a node
MIXED = 0.003  # relative: modes of one order that lie nearer to each other than this may be mixed in any way


def counted_at_planes(
    stage: StageModel, test: MeasuredTest, modes: Mapping[ModeKey, PredictedMode]
) -> dict[ModeKey, PredictedMode]:
    """The same modes with the counts of node planes that a test may find.

    Parameters
    ----------
    stage, test : whose planes.
    modes : predicted ones.
    """
    counts = (
        _counts_anywhere(stage) if test.shapes is None else _counts(stage, tuple(test.shapes.z_m.tolist()))
    )
    return {key: replace(mode, shown=counts.get(key, ())) for key, mode in modes.items()}


def _counts(stage: StageModel, z_m: tuple[float, ...]) -> Mapping[ModeKey, tuple[int, ...]]:
    """Of every named mode of the reference, the likeliest first."""
    return stage.memory.once(("counted planes", z_m), lambda: _counted(stage, z_m))


def _counted(stage: StageModel, z_m: tuple[float, ...]) -> dict[ModeKey, tuple[int, ...]]:
    profiles = reference_profiles(stage, tuple(sorted(z_m)))
    found = {key: _possible(along[:, None]) for key, along in profiles.items()}
    return {
        key: (*counts, *range(len(z_m))) if _is_mixed(stage, key) else counts for key, counts in found.items()
    }


def _counts_anywhere(stage: StageModel) -> Mapping[ModeKey, tuple[int, ...]]:
    """The same at planes that nobody knows."""
    z_m = tuple(usual_planes(stage.model.mesh.length).tolist())

    def counted() -> dict[ModeKey, tuple[int, ...]]:
        profiles = reference_profiles(stage, z_m)
        return {key: (key[1], *_with_fewer_planes(along)) for key, along in profiles.items()}

    return stage.memory.once(("counted anywhere",), counted)


def _with_fewer_planes(along: np.ndarray) -> tuple[int, ...]:
    """Counts of a profile (planes,) without any one of its planes and that opposite to it; ends are always measured."""
    planes = len(along)
    rest = [[i for i in range(planes) if i not in (k, planes - 1 - k)] for k in range(1, planes // 2)]
    return tuple(dict.fromkeys(int(node_planes(along[used, None])[0]) for used in rest))


def _is_mixed(stage: StageModel, key: ModeKey) -> bool:
    """Whether another count of node planes of the same order lies so near that what is measured is a sum of both."""
    modes = stage.reference_keys
    own = modes[key].frequency_hz
    return any(
        its[0] == key[0] and its[1] != key[1] and abs(np.log(mode.frequency_hz / own)) < MIXED
        for its, mode in modes.items()
    )


def _possible(along: np.ndarray) -> tuple[int, ...]:
    """Counts of a profile (planes, 1) with planes near a node left out, with faint ones left out, and with all."""
    least = FAINT * float(np.abs(along).max())
    counts = (
        node_planes(along)[0],
        node_planes(along, least)[0],
        np.count_nonzero(np.diff(np.sign(along[:, 0]))),
    )
    return tuple(dict.fromkeys(int(n) for n in counts))

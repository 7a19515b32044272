"""Radial motion of the named modes along the axis, at the heights where shapes were measured."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.bases.trained_basis import TrainedBasis
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.broken.named_response import NearestPair
from statorhom.model.broken.solve import BrokenModes
from statorhom.model.convergence import ModeKey
from statorhom.model.radial_profile import radial_profile

FloatArray = npt.NDArray[np.float64]


def reference_profiles(stage: StageModel, heights_m: tuple[float, ...]) -> Mapping[ModeKey, FloatArray]:
    """Profiles (heights,) of the symmetric stator's named modes at the reference, over ascending heights; kept."""
    return stage.memory.once(("profiles", heights_m), lambda: _profiles(stage, heights_m))


def _profiles(stage: StageModel, heights_m: tuple[float, ...]) -> dict[ModeKey, FloatArray]:
    profile = radial_profile(stage.model.mesh, np.array(heights_m))
    solved = stage.solve(stage.reference)
    found = {}
    for key, mode in stage.reference_keys.items():
        problem, vectors = stage.ring.problems[mode.problem], solved.vectors[mode.problem]
        shape = problem.space.expand(problem.basis @ vectors[:, [mode.column]])
        found[key] = profile.orders(problem.space, shape)[:, 0]
    return found


def broken_profile(
    stage: StageModel, trained: TrainedBasis, modes: BrokenModes, key: ModeKey, pair: NearestPair
) -> FloatArray:
    """Profile (heights,) of a named mode of the broken stator, the mean of a doublet's two.

    Parameters
    ----------
    trained : the basis in which the modes were solved.
    pair : which of them are the named one.
    """
    cosine, sine = _amplitudes(stage, trained, key[0])
    # a single mode has one family, whichever it is
    families = (cosine, sine) if len(pair.modes) == 2 else (cosine + sine,)
    turned = modes.participation[:, pair.modes] @ pair.rotation.T
    return np.asarray(np.mean([along @ turned[:, i] for i, along in enumerate(families)], axis=0))


def _amplitudes(stage: StageModel, trained: TrainedBasis, order: int) -> tuple[FloatArray, FloatArray]:
    """Amplitudes (heights, coordinates) of an order by a unit of every coordinate: cosine family, sine family."""
    place = (stage.heights_m, order)
    if place not in trained.amplitudes:
        basis = trained.basis
        profile = radial_profile(stage.model.mesh, np.array(stage.heights_m))
        cosine, sine = (np.zeros((len(stage.heights_m), len(basis.values))) for _ in range(2))
        for problem, families in zip(basis.problems, basis.places, strict=True):
            space = problem.sector.space
            if space.order == order:
                along = profile.orders(space, space.expand(problem.vectors))
                for is_sine, own in families.items():
                    (sine if is_sine else cosine)[:, own] = along
        trained.amplitudes[place] = cosine, sine
    known: tuple[FloatArray, FloatArray] = trained.amplitudes[place]
    return known

"""Radial motion of the named modes along the axis, at the heights where shapes were measured."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.stage_model import StageModel
from statorhom.diagnose.trained_basis import TrainedBasis
from statorhom.model.broken.named_response import nearest_pair
from statorhom.model.broken.solve import BrokenModes
from statorhom.model.convergence import ModeKey
from statorhom.model.radial_profile import radial_profile

FloatArray = npt.NDArray[np.float64]


def reference_profiles(stage: StageModel) -> Mapping[ModeKey, FloatArray]:
    """Profiles (heights,) of the symmetric stator's named modes at the reference; kept."""
    place = ("profiles", stage.heights_m)
    if place not in stage.kept_responses:
        profile = radial_profile(stage.model.mesh, np.array(stage.heights_m))
        solved = stage.solve(stage.reference)
        found = {}
        for key, mode in stage.reference_keys.items():
            problem, vectors = stage.ring.problems[mode.problem], solved.vectors[mode.problem]
            shape = problem.space.expand(problem.basis @ vectors[:, [mode.column]])
            found[key] = profile.orders(problem.space, shape)[:, 0]
        stage.kept_responses[place] = found
    known: Mapping[ModeKey, FloatArray] = stage.kept_responses[place]
    return known


def broken_profiles(
    stage: StageModel, trained: TrainedBasis, modes: BrokenModes
) -> dict[ModeKey, FloatArray]:
    """Profiles (heights,) of the named modes of the broken stator, the mean of a doublet's two.

    Parameters
    ----------
    trained : the basis in which they were solved.
    """
    found = {}
    for key, place in trained.columns.items():
        pair = nearest_pair(modes, place)
        if pair is not None:
            families = _amplitudes(stage, trained, key[0])[: len(place.numbers)]
            turned = modes.participation[:, pair.modes] @ pair.rotation.T
            found[key] = np.mean([along @ turned[:, i] for i, along in enumerate(families)], axis=0)
    return found


def _amplitudes(stage: StageModel, trained: TrainedBasis, order: int) -> tuple[FloatArray, ...]:
    """Amplitudes (heights, coordinates) of an order by a unit of every coordinate: cosine family, sine family."""
    place = (stage.heights_m, order)
    if place not in trained.amplitudes:
        basis = trained.basis
        profile = radial_profile(stage.model.mesh, np.array(stage.heights_m))
        found = [np.zeros((len(stage.heights_m), len(basis.values))) for _ in range(2)]
        for problem, families in zip(basis.problems, basis.places, strict=True):
            space = problem.sector.space
            if space.order == order:
                along = profile.orders(space, space.expand(problem.vectors))
                for sine, own in families.items():
                    found[sine][:, own] = along
        # a single mode has one family, whichever it is
        trained.amplitudes[place] = tuple(found) if order else (found[0] + found[1],)
    known: tuple[FloatArray, ...] = trained.amplitudes[place]
    return known

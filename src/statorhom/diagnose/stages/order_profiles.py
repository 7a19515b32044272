"""Radial motion of the named modes along the axis, at the heights where shapes were measured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.bases.trained_basis import TrainedBasis
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.affine import Materials
from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.named_response import NearestPair
from statorhom.model.broken.solve import BrokenModes
from statorhom.model.convergence import ModeKey
from statorhom.model.radial_profile import RadialProfile, radial_profile

FloatArray = npt.NDArray[np.float64]


def reference_profiles(
    stage: StageModel, heights_m: tuple[float, ...] | None
) -> Mapping[ModeKey, FloatArray]:
    """Profiles (heights,) of the symmetric stator's named modes at the reference; kept.

    Parameters
    ----------
    heights_m : ascending; None for those over the whole core that a basis knows (`RingProblem.profile`).
    """
    return stage.memory.once(("profiles", heights_m), lambda: _profiles(stage, heights_m))


def _profiles(stage: StageModel, heights_m: tuple[float, ...] | None) -> dict[ModeKey, FloatArray]:
    places = {key: mode.place for key, mode in stage.reference_keys.items()}
    return _of_places(stage, heights_m, stage.reference, places)


def profiles_at(
    stage: StageModel,
    heights_m: tuple[float, ...] | None,
    materials: Materials,
    places: Mapping[ModeKey, tuple[int, int] | None],
) -> dict[ModeKey, FloatArray]:
    """The same of modes at other materials.

    Parameters
    ----------
    heights_m : as of `reference_profiles`.
    places : of the modes (`StatorMode.place`); None for one of another basis, which the reference's own stands for.
    """
    found = _of_places(stage, heights_m, materials, {k: place for k, place in places.items() if place})
    other = [key for key in places if key not in found]
    if other:
        known = reference_profiles(stage, heights_m)
        found |= {key: known[key] for key in other if key in known}
    return found


def _of_places(
    stage: StageModel,
    heights_m: tuple[float, ...] | None,
    materials: Materials,
    places: Mapping[ModeKey, tuple[int, int]],
) -> dict[ModeKey, FloatArray]:
    if not places:
        return {}
    solved = stage.solve(materials, frozenset(problem for problem, _ in places.values()))
    along = _of_basis(stage, heights_m)
    return {
        key: along[problem] @ solved.vectors[problem][:, column]
        for key, (problem, column) in places.items()
        if column < solved.vectors[problem].shape[1]
    }


def _of_basis(stage: StageModel, heights_m: tuple[float, ...] | None) -> list[FloatArray]:
    """Amplitudes (heights, k) of the basis's vectors, per problem; kept until the basis grows."""
    problems = stage.ring.problems
    if heights_m is None:
        return [p.profile for p in problems]

    def evaluated() -> list[FloatArray]:
        profile = radial_profile(stage.model.mesh, np.array(heights_m))
        return [profile.orders(p.space, p.space.expand(p.basis)) for p in problems]

    return stage.memory.once(("profiles of the basis", heights_m, stage.ring.sizes), evaluated)


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
        for families, along in _motions(basis, profile, order):
            for is_sine, own in families.items():
                (sine if is_sine else cosine)[:, own] = along
        trained.amplitudes[place] = cosine, sine
    known: tuple[FloatArray, FloatArray] = trained.amplitudes[place]
    return known


def _motions(
    basis: SymmetricBasis, profile: RadialProfile, order: int | None = None
) -> Iterator[tuple[Mapping[bool, slice], FloatArray]]:
    """Where every problem's coordinates stand, by families, and the amplitudes (heights, k) by a unit of each.

    Parameters
    ----------
    order : of the problems that are wanted; all by default.
    """
    for problem, families in zip(basis.problems, basis.places, strict=True):
        space = problem.sector.space
        if order is None or space.order == order:
            yield families, profile.orders(space, space.expand(problem.vectors))


def radial_motion(stage: StageModel, trained: TrainedBasis) -> FloatArray:
    """(coordinates,) mean square radial motion of the surface, of its own order, by a unit of every coordinate."""
    if None not in trained.amplitudes:
        basis, profile = trained.basis, radial_profile(stage.model.mesh)
        squares = np.zeros(len(basis.values))
        for families, along in _motions(basis, profile):
            for own in families.values():
                squares[own] = np.mean(along**2, axis=0)
        trained.amplitudes[None] = squares
    known: FloatArray = trained.amplitudes[None]
    return known

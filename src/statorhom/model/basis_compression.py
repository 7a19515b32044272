"""As few basis vectors as the certificates allow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.model.reduced_space import ReducedSpace, largest_deviation


def compression(
    space: ReducedSpace, weights: Sequence[np.ndarray], ratios: Sequence[float], tolerance: float
) -> np.ndarray:
    """What of a basis the modes of all training materials need, while they stay certified.

    The directions are ordered by their share in the modes' energy (proper orthogonal decomposition), and as many
    are kept as a bisection finds necessary.

    Parameters
    ----------
    space : of the whole basis.
    weights, ratios : of every training material, the reference first.
    tolerance : certified relative frequency error; where the whole basis does not meet it, all is kept.

    Returns
    -------
    turn : (k, fewer) from the kept vectors to the whole basis.
    """
    turn = _by_energy(space, weights)
    modes = [values[values <= space.top] for values, _ in map(space.pairs, weights)]

    def certified(count: int) -> bool:
        fewer = space.turned(turn[:, :count])
        # a mode that is lost has no certificate
        return all(
            largest_deviation(m, fewer.pairs(w)[0]) <= tolerance
            and fewer.certified_error(w, ratio) <= tolerance
            for m, w, ratio in zip(modes, weights, ratios, strict=True)
        )

    enough, few = turn.shape[1], 0
    if not certified(enough):
        return turn
    while enough - few > 1:
        middle = (enough + few) // 2
        enough, few = (middle, few) if certified(middle) else (enough, middle)
    return turn[:, :enough]


def _by_energy(space: ReducedSpace, weights: Sequence[np.ndarray]) -> np.ndarray:
    """Basis of the space (k, k), orthonormal in the reference's energy, the most needed first."""
    found = []
    for values, vectors in map(space.pairs, weights):
        used = int((values <= space.top).sum()) + 1  # the bounds need to know what comes next
        found.append(vectors[:, :used] / np.sqrt(np.maximum(values[:used], 0.0) + space.shift))
    K, M = space.matrices(weights[0])
    root = np.linalg.cholesky(K + space.shift * M).T
    return np.asarray(np.linalg.solve(root, np.linalg.svd(root @ np.hstack(found))[0]))

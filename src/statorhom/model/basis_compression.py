"""As few basis vectors as the certificates allow."""

from __future__ import annotations

import numpy as np

from statorhom.model.reduced_space import ReducedSpace, largest_deviation


def compression(space: ReducedSpace, weights: np.ndarray, ratios: np.ndarray, tolerance: float) -> np.ndarray:
    """What of a basis the modes of all training materials need, while they stay certified.

    The directions are ordered by their share in the modes' energy (proper orthogonal decomposition), and as many
    are kept as a bisection finds necessary.

    Parameters
    ----------
    space : of the whole basis.
    weights, ratios : (n, t) and (n,) of the training materials, the reference first.
    tolerance : certified relative frequency error; where the whole basis does not meet it, all is kept.

    Returns
    -------
    turn : (k, fewer) from the kept vectors, of unit mass, to the whole basis.
    """
    exact, vectors = space.pairs(weights)
    ordered = _by_energy(space, weights[0], exact, vectors)

    def certified(count: int) -> bool:
        fewer = space.turned(_of_unit_mass(space, weights[0], ordered[:, :count]))
        pairs = fewer.pairs(weights)
        # a mode that is lost has no certificate
        kept = largest_deviation(exact, pairs[0], space.top) <= tolerance
        return kept and fewer.certified_errors(weights, ratios, pairs).max() <= tolerance

    enough, few = ordered.shape[1], 0
    if certified(enough):
        while enough - few > 1:
            middle = (enough + few) // 2
            enough, few = (middle, few) if certified(middle) else (enough, middle)
    return _of_unit_mass(space, weights[0], ordered[:, :enough])


def _by_energy(
    space: ReducedSpace, reference: np.ndarray, values: np.ndarray, vectors: np.ndarray
) -> np.ndarray:
    """Basis of the space (k, k), orthonormal in the reference's energy, what Ritz pairs need most first."""
    used = (values <= space.top).sum(axis=1) + 1  # the bounds need to know what comes next
    found = [
        v[:, :j] / np.sqrt(np.maximum(mu[:j], 0.0) + space.shift)
        for mu, v, j in zip(values, vectors, used, strict=True)
    ]
    K, M = space.matrices(reference)
    root = np.linalg.cholesky(K + space.shift * M).T
    return np.asarray(np.linalg.solve(root, np.linalg.svd(root @ np.hstack(found))[0]))


def _of_unit_mass(space: ReducedSpace, reference: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Vectors of the same span that are orthonormal in the reference's mass."""
    mass = turn.T @ space.matrices(reference)[1] @ turn
    return np.asarray(turn @ np.linalg.inv(np.linalg.cholesky(mass)).T)

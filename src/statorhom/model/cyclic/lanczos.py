"""Lanczos' iteration of many symmetric problems in lockstep, with full reorthogonalization (Parlett 1980).

All problems take their steps together, so that one sparse solve and one product serve them all. How many eigenvalues
each has above a bound is known beforehand: it is done when as many have converged. If other eigenvalues have
converged in their place, a multiple one is hidden, and a random vector is added that has a part of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np

from statorhom.errors import SolverError

TOLERANCE = 1e-12  # of the residual over the eigenvalue: the eigenvalue's own error is its square
NEGLIGIBLE = 1e-13  # what is left of a vector whose image lies in the space already
EVERY = 4  # steps between two looks at what has converged
MOST = 400  # more steps than any band of a stator needs


class Problems(Protocol):
    """p symmetric problems (K - σM)⁻¹ M x = θ x, one column each."""

    def take(self, chosen: np.ndarray) -> Self:
        """Some of them."""

    def solve(self, right: np.ndarray) -> np.ndarray:
        """(K - σM)⁻¹ times (n, p)."""

    def mass(self, vectors: np.ndarray) -> np.ndarray:
        """M times (n, p)."""


@dataclass
class _Spaces:
    """Krylov spaces of p problems: V, M V (p, capacity, n) and the projected operator H (p, capacity, capacity)."""

    V: np.ndarray
    MV: np.ndarray
    H: np.ndarray
    held: int = 0  # basis vectors
    done: int = 0  # of them those whose image has been taken

    @classmethod
    def empty(cls, count: int, capacity: int, n: int) -> _Spaces:
        shape = (count, capacity, n)
        return cls(np.empty(shape), np.empty(shape), np.zeros((count, capacity, capacity)))

    def take(self, chosen: np.ndarray) -> _Spaces:
        return _Spaces(self.V[chosen], self.MV[chosen], self.H[chosen], self.held, self.done)

    def add(self, problems: Problems, new: np.ndarray, size: np.ndarray | None = None) -> np.ndarray:
        """Orthonormalize a vector of every problem (p, n) and hold it; returns its length after."""
        self._grow()
        mass = problems.mass(new.T).T
        length = np.sqrt(np.maximum(np.einsum("pn,pn->p", new, mass), 0.0))
        # a vector that lay in the space already would be rounding: it is held as zero
        empty = length <= (0.0 if size is None else NEGLIGIBLE * size)
        scale = np.where(empty, 0.0, 1.0 / np.where(empty, 1.0, length))
        self.V[:, self.held], self.MV[:, self.held] = new * scale[:, None], mass * scale[:, None]
        self.held += 1
        return np.where(empty, 0.0, length)

    def purged(self, new: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Vectors (p, n) without their parts in the space, and these parts (p, held)."""
        V, MV = self.V[:, : self.held], self.MV[:, : self.held]
        parts = np.zeros((len(new), self.held))
        for _ in range(2):  # once leaves rounding
            part = MV @ new[:, :, None]
            new = new - (np.swapaxes(V, 1, 2) @ part)[:, :, 0]
            parts += part[:, :, 0]
        return new, parts

    def _grow(self) -> None:
        count, capacity, n = self.V.shape
        if self.held < capacity:
            return
        larger = _Spaces.empty(count, 2 * capacity, n)
        larger.V[:, :capacity], larger.MV[:, :capacity] = self.V, self.MV
        larger.H[:, :capacity, :capacity] = self.H
        self.V, self.MV, self.H = larger.V, larger.MV, larger.H


def largest(
    problems: Problems, start: np.ndarray, counts: np.ndarray, bound: float
) -> list[tuple[np.ndarray, np.ndarray]]:
    """The eigenvalues θ of (K - σM)⁻¹ M above a bound.

    Parameters
    ----------
    problems : p of them.
    start : (n, p) random vectors.
    counts : (p,) how many eigenvalues each problem has above the bound.
    bound : of θ.

    Returns
    -------
    Per problem θ (k,) descending, and the M-normalised vectors (n, k).

    Raises
    ------
    SolverError
        If they do not converge.
    """
    found: list[tuple[np.ndarray, np.ndarray]] = [(np.empty(0), np.empty((len(start), 0)))] * len(counts)
    active = np.flatnonzero(counts)
    if len(active) == 0:
        return found
    problems, fresh = problems.take(active), start[:, active].T
    most = int(counts.max())
    look = most + 8
    spaces = _Spaces.empty(len(active), look + 3 * EVERY, len(start))
    spaces.add(problems, fresh)
    while spaces.done < MOST + 2 * most:
        _step(spaces, problems)
        if spaces.done < look:
            continue
        look = spaces.done + EVERY
        theta, vectors, hidden, ready = _looked(spaces, counts[active], bound)
        for i in np.flatnonzero(ready):
            k = counts[active[i]]
            shapes = spaces.V[i, : spaces.done].T @ vectors[i, :, :k]
            found[active[i]] = theta[i, :k], shapes
        if ready.any():
            kept = np.flatnonzero(~ready)
            if len(kept) == 0:
                return found
            active, problems, spaces, hidden = (
                active[kept],
                problems.take(kept),
                spaces.take(kept),
                hidden[kept],
            )
        if hidden.any():
            again = np.random.default_rng(spaces.held).standard_normal(start.shape)
            again = np.where(start[:, active] != 0, again[:, active], 0.0).T
            new, parts = spaces.purged(again)
            spaces.add(problems, new, np.linalg.norm(parts, axis=1))
    raise SolverError("the eigenvalue iteration does not converge; refine the mesh or check the materials")


def _step(spaces: _Spaces, problems: Problems) -> None:
    """The image of the next basis vector."""
    j = spaces.done
    image = problems.solve(spaces.MV[:, j].T).T
    new, parts = spaces.purged(image)
    held = spaces.held
    size = np.sqrt(np.einsum("pk,pk->p", parts, parts))
    length = spaces.add(problems, new, size)
    spaces.H[:, :held, j] = parts
    spaces.H[:, held, j] = length
    spaces.done += 1


def _looked(
    spaces: _Spaces, counts: np.ndarray, bound: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Ritz values θ (p, k) descending, their coefficients, and which problems hide a value or are ready."""
    k, held = spaces.done, spaces.held
    projected = spaces.H[:, :k, :k]
    if not np.isfinite(projected).all():
        raise SolverError("the eigenvalue iteration failed; refine the mesh or check the materials")
    theta, vectors = np.linalg.eigh(0.5 * (projected + np.swapaxes(projected, 1, 2)))
    theta, vectors = theta[:, ::-1], vectors[:, :, ::-1]
    residual = np.linalg.norm(spaces.H[:, k:held, :k] @ vectors, axis=1)
    converged = residual <= TOLERANCE * np.abs(theta)
    wanted = np.arange(k) < counts[:, None]
    complete = np.all(converged | ~wanted, axis=1) & (k >= counts)
    # an eigenvalue on the bound may lie on either side of it
    inside = np.all((theta >= bound * (1 - 1e-9)) | ~wanted, axis=1)
    return theta, vectors, complete & ~inside, complete & inside

"""Supports on the whole stator's mesh, written without any use of its symmetry."""

from itertools import pairwise

import numpy as np
import scipy.sparse as sp
from scipy.linalg import null_space

from statorhom.model.eigen import frequency_hz, modes_below
from statorhom.model.element import shape_functions

GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(4)
GAUSS, WEIGHTS = (GAUSS + 1) / 2, WEIGHTS / 2
UPRIGHT = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
MIDDLES = ((8, 13, 16, 12), (9, 14, 17, 13), (10, 15, 18, 14), (11, 12, 19, 15))


def quad8(x, y):
    """Shape functions of the eight-node quadrilateral on [-1, 1]²: four corners, then the mid-sides."""
    return np.array(
        [(1 + a * x) * (1 + b * y) * (a * x + b * y - 1) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        + [(1 - x * x) * (1 - y) / 2, (1 + x) * (1 - y * y) / 2, (1 - x * x) * (1 + y) / 2]
        + [(1 - x) * (1 - y * y) / 2]
    )


class WholeSurface:
    """Outer element faces of a whole stator."""

    def __init__(self, whole, radius):
        self.radius, self.size = radius, 3 * len(whole.nodes)
        self.angle = np.arctan2(whole.nodes[:, 1], whole.nodes[:, 0])
        self.z, self.nodes = whole.nodes[:, 2], whole.nodes
        on = np.abs(np.hypot(*whole.nodes[:, :2].T) - radius) < 1e-9
        self.faces = []
        for corners, middles in zip(UPRIGHT, MIDDLES, strict=True):
            for element in whole.elements[on[whole.elements[:, corners]].all(axis=1)]:
                nodes = element[list(corners) + list(middles)]
                turn = self.offset(self.angle[nodes[1]], self.angle[nodes[0]])
                self.faces.append((nodes, self.angle[nodes[0]], turn))

    @staticmethod
    def offset(angle, start):
        return np.mod(angle - start + np.pi, 2 * np.pi) - np.pi

    def row(self, nodes, start, turn, angle, z):
        """(3, 3 n) displacement (u_r, u_θ, u_z) at a point of a face."""
        bottom, top = self.z[nodes[0]], self.z[nodes[3]]
        x = 2 * self.offset(angle, start) / turn - 1
        values = quad8(x, 2 * (z - bottom) / (top - bottom) - 1)
        away = self.angle[nodes] - angle
        row = np.zeros((3, self.size))
        row[0, 3 * nodes], row[0, 3 * nodes + 1] = values * np.cos(away), -values * np.sin(away)
        row[1, 3 * nodes], row[1, 3 * nodes + 1] = values * np.sin(away), values * np.cos(away)
        row[2, 3 * nodes + 2] = values
        return row

    def at(self, angle, z):
        for nodes, start, turn in self.faces:
            along = self.offset(angle, start) / turn
            low, high = sorted((self.z[nodes[0]], self.z[nodes[3]]))
            if -1e-9 <= along <= 1 + 1e-9 and low - 1e-9 <= z <= high + 1e-9:
                return self.row(nodes, start, turn, angle, z)
        raise ValueError("beside the surface")

    def levels(self):
        return np.unique(np.round(np.concatenate([self.z[nodes] for nodes, *_ in self.faces]), 12))

    def line(self, angle):
        """Conditions of a rigid line."""
        return np.vstack([self.at(angle, z) for z in self.levels()])

    def line_springs(self, angle, normal, tangential):
        total = sp.csr_array((self.size, self.size))
        ends = np.unique(np.round(np.concatenate([self.z[n[:4]] for n, *_ in self.faces]), 12))
        for low, high in pairwise(ends):
            for x, w in zip(GAUSS, WEIGHTS, strict=True):
                row = sp.csr_array(self.at(angle, low + x * (high - low)))
                k = sp.diags_array(np.array([normal, tangential, tangential]) * w * (high - low))
                total = total + row.T @ k @ row
        return total

    def arc(self, start, end):
        """Conditions of a rigid arc: its nodes and its two ends."""
        nodes = np.unique(np.concatenate([n for n, *_ in self.faces]))
        inside = nodes[np.mod(self.angle[nodes] - start + 1e-9, 2 * np.pi) <= end - start + 2e-9]
        identity = np.zeros((3 * len(inside), self.size))
        identity[np.arange(3 * len(inside)), (3 * inside[:, None] + np.arange(3)).ravel()] = 1.0
        return np.vstack([identity, self.line(start), self.line(end)])

    def arc_springs(self, start, end, normal, tangential):
        total = sp.csr_array((self.size, self.size))
        for nodes, first, turn in self.faces:
            # from the arc's start onwards, in the direction of growing angle
            begin = np.mod(min(first, first + turn) - start + 1e-12, 2 * np.pi)
            for shift in (0.0, -2 * np.pi):
                low = max(begin + shift, 0.0)
                high = min(begin + shift + abs(turn), end - start)
                if high - low < 1e-9:
                    continue
                bottom, top = self.z[nodes[0]], self.z[nodes[3]]
                for x, wx in zip(GAUSS, WEIGHTS, strict=True):
                    for y, wy in zip(GAUSS, WEIGHTS, strict=True):
                        angle = start + low + x * (high - low)
                        row = sp.csr_array(self.row(nodes, first, turn, angle, bottom + y * (top - bottom)))
                        area = self.radius * (high - low) * abs(top - bottom) * wx * wy
                        k = sp.diags_array(np.array([normal, tangential, tangential]) * area)
                        total = total + row.T @ k @ row
        return total


def face_nodes(whole, z):
    """Nodes of the core in the plane of an end face."""
    nodes = np.unique(whole.elements_of("lamination"))
    return nodes[np.abs(whole.nodes[nodes, 2] - z) < 1e-9]


def face_springs(whole, z, normal, tangential):
    """Springs on one end face, integrated over every element's face."""
    size = 3 * len(whole.nodes)
    x, y = (axis.ravel() for axis in np.meshgrid(GAUSS, GAUSS))
    weights = np.outer(WEIGHTS, WEIGHTS).ravel()
    rows, columns, blocks = [], [], []
    for local, level in (((0, 1, 2, 3, 8, 9, 10, 11), 0.0), ((4, 5, 6, 7, 16, 17, 18, 19), 1.0)):
        values, gradients = shape_functions(np.column_stack([x, y, np.full(x.size, level)]))
        table = values[:, local], gradients[:, local, :2], weights
        for element in whole.elements_of("lamination"):
            face = element[list(local)]
            if np.abs(whole.nodes[face, 2] - z).max() > 1e-9:
                continue
            dofs = (3 * face[:, None] + np.arange(3)).ravel()
            rows.append(np.repeat(dofs, 24))
            columns.append(np.tile(dofs, 24))
            blocks.append(_face_block(whole.nodes[face], *table, normal, tangential))
    places = (np.concatenate(rows), np.concatenate(columns))
    return sp.csr_array((np.concatenate(blocks).ravel(), places), shape=(size, size))


def _face_block(nodes, values, gradients, weights, normal, tangential):
    angle = np.arctan2(nodes[:, 1], nodes[:, 0])
    block = np.zeros((24, 24))
    for value, gradient, weight in zip(values, gradients, weights, strict=True):
        area = np.linalg.det(nodes[:, :2].T @ gradient) * weight
        motion = np.zeros((3, 24))
        motion[0, 0::3], motion[0, 1::3] = value * np.cos(angle), -value * np.sin(angle)
        motion[1, 0::3], motion[1, 1::3] = value * np.sin(angle), value * np.cos(angle)
        motion[2, 2::3] = value
        block += area * motion.T @ np.diag([tangential, tangential, normal]) @ motion
    return block


def constrained(K, M, conditions, fixed=()):
    """K and M where `conditions` (c, 3 n) vanish and the degrees of freedom `fixed` do not move."""
    size = K.shape[0]
    rows = np.zeros((0, size)) if conditions is None else conditions
    free = np.setdiff1d(np.arange(size), fixed)
    rows = rows[:, free]
    touched = np.flatnonzero(np.abs(rows).max(axis=0, initial=0) > 0)
    rest = np.setdiff1d(np.arange(len(free)), touched)
    space = null_space(rows[:, touched]) if len(touched) else np.zeros((0, 0))
    lower = sp.csr_array(space)
    T = sp.block_diag([sp.eye_array(len(rest)), lower], format="csr")
    T = T[np.argsort(np.concatenate([rest, touched]))]
    whole = sp.csr_array((np.ones(len(free)), (free, np.arange(len(free)))), shape=(size, len(free))) @ T
    return sp.csr_array(whole.T @ K @ whole), sp.csr_array(whole.T @ M @ whole)


def frequencies(K, M, highest_hz, expected):
    """Frequencies of the whole stator up to a limit, free bodies left out."""
    values, _ = modes_below(K, M, highest_hz, expected)
    found = frequency_hz(values)
    return found[found > 1.0]

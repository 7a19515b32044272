"""Names of simulated modes."""

import numpy as np
import pytest

from statorhom.model.stator_mode import RIGID_HZ, VISIBLE, name_modes


def named(frequencies, amplitudes, axial=None, **changes):
    every = {"order": 3, "multiplicity": 2, "problem": 5} | changes
    options = {name: [value] * len(frequencies) for name, value in every.items()}
    options |= {"mass": 4.0, "column": range(len(frequencies))}
    values = (2 * np.pi * np.asarray(frequencies, float)) ** 2
    axial = np.arange(len(frequencies)) if axial is None else axial
    return name_modes(values, np.asarray(amplitudes, float), np.asarray(axial), **options)


def test_a_mode_that_moves_the_surface_takes_the_harmonic_s_order():
    mode = named([1200.0], [[0.3], [0.4]], axial=[1])[0]
    assert (mode.order, mode.axial, mode.kind) == (3, 1, "radial")
    assert mode.frequency_hz == pytest.approx(1200.0)
    assert mode.visibility == pytest.approx(4.0 * (0.09 + 0.16) / 2)
    assert (mode.multiplicity, mode.problem, mode.column) == (2, 5, 0)


def test_visibility_is_cut_at_one():
    assert named([1000.0], [[10.0], [10.0]])[0].visibility == 1.0


def test_a_mode_that_hardly_moves_the_surface_has_no_name():
    below, above = np.sqrt(0.9 * VISIBLE / 4.0), np.sqrt(1.1 * VISIBLE / 4.0)
    hidden, seen = named([1000.0, 1100.0], [[below, above], [below, above]])
    assert (hidden.order, hidden.axial, hidden.kind) == (None, None, "winding")
    assert (seen.order, seen.axial, seen.kind, seen.column) == (3, 1, "radial", 1)


def test_rigid_bodies_are_left_out_even_where_rounding_makes_them_negative():
    amplitudes = np.ones((2, 3))
    values = np.array([-1e-3, (2 * np.pi * 0.9 * RIGID_HZ) ** 2, (2 * np.pi * 1000.0) ** 2])
    found = name_modes(
        values,
        amplitudes,
        np.zeros(3),
        order=[1] * 3,
        multiplicity=[2] * 3,
        mass=1.0,
        problem=[0] * 3,
        column=range(3),
    )
    assert [mode.column for mode in found] == [2]

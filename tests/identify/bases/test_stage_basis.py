"""A stage's reduced model, with and without the store."""

import numpy as np
import synthetic_stage as stage

from statorhom.identify.bases.stage_basis import reduce_stage
from statorhom.identify.bases.training import training_materials
from statorhom.identify.processes.workers import Workers
from statorhom.model import reduced
from statorhom.model.basis_store import BasisStore
from statorhom.model.harmonic import problems_of


def reduced_ring(store=None, highest_hz=4000.0):
    training = training_materials(stage.space(), stage.LAMINATION, 32)
    spaces = problems_of(stage.ring().mesh, {(2, 0)})
    with Workers() as workers:
        return reduce_stage(stage.ring(), training, stage.steel(), spaces, highest_hz, workers, store=store)


def frequencies(stator):
    return [mode.frequency_hz for mode in stator.solve(stage.LAMINATION.of(stage.TRUTH)).modes]


def test_results_are_the_same_with_the_store_and_no_basis_is_built_twice(tmp_path, monkeypatch):
    store = BasisStore(tmp_path)
    alone, first = frequencies(reduced_ring()), frequencies(reduced_ring(store))
    monkeypatch.setattr(reduced, "local_basis", None)  # whoever builds one now fails
    again = frequencies(reduced_ring(store))
    assert len(alone) > 0
    np.testing.assert_array_equal(first, alone)
    np.testing.assert_array_equal(again, alone)


def test_measurements_that_differ_a_little_share_a_basis(tmp_path):
    store = BasisStore(tmp_path)
    reduced_ring(store, 4000.0)
    reduced_ring(store, 4010.0)
    assert len(list(tmp_path.iterdir())) == 1
    reduced_ring(store, 6000.0)
    assert len(list(tmp_path.iterdir())) == 2

"""A harmonic's matrices as weighted sums."""

import numpy as np
import wound_box as stage

from statorhom.model.harmonic_terms import harmonic_terms
from statorhom.model.material_span import material_point


def test_weighted_terms_are_the_projected_matrices():
    terms = harmonic_terms(stage.wound(), stage.space(), stage.box().span)
    materials = stage.winding(np.array([1.0, -0.5, 0.7]), density=3210.0)
    found = terms.matrices(material_point(materials, stage.wound().mesh.regions))
    expected = (stage.wound().stiffness_matrix(materials), stage.wound().mass_matrix(materials))
    for matrix, half in zip(found, expected, strict=True):
        difference = abs(matrix - stage.space().project(half)).max()
        assert difference < 1e-11 * abs(matrix).max()


def test_images_are_the_terms_times_vectors():
    terms = harmonic_terms(stage.wound(), stage.space(), stage.box().span)
    materials = stage.winding(np.array([1.0, -0.5, 0.7]))
    point = material_point(materials, stage.wound().mesh.regions)
    vectors = np.random.default_rng(0).standard_normal((stage.space().size, 2))
    images = terms.images(vectors)
    K, M = terms.matrices(point)
    s = terms.span.size
    np.testing.assert_allclose(
        np.tensordot(terms.span.weights(point), images[:s], axes=1), K @ vectors, rtol=1e-9, atol=1e-3
    )
    np.testing.assert_allclose(np.tensordot(point.density, images[s:], axes=1), M @ vectors, rtol=1e-9)

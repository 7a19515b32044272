"""The finite-element model: affine in the materials, cyclic, reduced; free and supported modes."""

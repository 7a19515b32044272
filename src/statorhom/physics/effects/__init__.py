"""One file per effect; each ends with `EFFECT = …()`, by which `statorhom.physics.library` finds it."""

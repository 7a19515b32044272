"""The library of left-out physics: one file per effect in `effects`, found by `library`.

An effect is a subclass of `effect.Effect`: `candidates` says where in a study it may be (stage, region, test, choice),
with constants (`parameter.EffectParameter`) that carry unit, prior and physical limits; `action` says what it changes
(`action.Action`), for any mesh. A user adds one by writing one file.

`Action.joint` is a contact in the place of a bond, `Action.friction` one that slips (`friction`: harmonic balance of
one mode). stack_pressure_gradient is seen by its second-order shifts only: shapes along z are not features yet.
"""

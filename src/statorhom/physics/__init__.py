"""The library of left-out physics: one file per effect in `effects`, found by `library`.

An effect is a subclass of `effect.Effect`: `candidates` says where in a study it may be (stage, region, test, choice),
with constants (`parameter.EffectParameter`) that carry unit, prior and physical limits; `action` says what it changes
(`action.Action`), for any mesh. A user adds one by writing one file.

Diagnosed: interlaminar_shear, attached_mass, local_stiffness, ovality, support_compliance, suspension_stiffness,
sensor_mass, end_winding_stiffness, loose_winding_mass, viscoelastic_winding, temperature_shift, stack_pressure_gradient
(by second-order shifts only: shapes along z are not features yet), wrong_input, mislabelled_mode. With an action that
the diagnosis does not evaluate yet, and so never named: interface_debond, press_fit_contact (`Action.joint`).
Not written yet: dry_friction.
"""

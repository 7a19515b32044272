"""Diagnosis of plates, beams and wings: the same scan, refits and rules on a body's modal basis."""

from statorhom.diagnose.coupons import body_derivatives as body_derivatives  # registers its jacobian

"""Geometry of the fabrication steps: exact cross-sections, parts and volumes."""

from statorhom.geometry.stator import StatorGeometry, StepGeometry, stator_geometry

__all__ = ["StatorGeometry", "StepGeometry", "stator_geometry"]

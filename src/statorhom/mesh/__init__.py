"""Structured meshes of 20-node hexahedra, one half slot pitch at a time."""

from statorhom.mesh.density import MeshDensity, graded, uniform
from statorhom.mesh.extrude import mesh_step
from statorhom.mesh.hex_mesh import HalfPitchMesh, HexMesh

__all__ = ["HalfPitchMesh", "HexMesh", "MeshDensity", "graded", "mesh_step", "uniform"]

"""A step of a small stator as a diagnosis models it, without any test."""

from __future__ import annotations

from types import SimpleNamespace

from small_stators import MATERIALS, stator_mesh

from statorhom.diagnose.bases.ring_basis import ring_basis
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.identify.residuals.model_error import ModelError
from statorhom.mesh.density import MeshDensity, uniform
from statorhom.model.affine import Materials, assemble


def stage_of(
    kinds: tuple[str, ...],
    highest_hz: float,
    own: Materials | None = None,
    density: MeshDensity | None = None,
) -> StageModel:
    """The last of some steps, up to a frequency; `own` materials instead of the usual ones."""
    model = assemble(stator_mesh(12, kinds, density))
    materials = {region: {**MATERIALS, **(own or {})}[region] for region in model.mesh.regions}
    setup = SimpleNamespace(keys=SimpleNamespace(name=kinds[-1], tests=()), index=len(kinds) - 1)
    ring = ring_basis(model, [materials], highest_hz, range(5))
    return StageModel(setup, (), ring, materials, ModelError(), uniform(1))  # type: ignore[arg-type]

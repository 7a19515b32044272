"""``[[stages]]``: a step of fabrication, its weight, what is believed of its materials, its tests."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, PlainSerializer, model_validator

from statorhom.study.declared_effects import EffectKeys
from statorhom.study.frozen_map import FrozenMap
from statorhom.study.keys import Keys, Name, Number, Positive, WholeNumber
from statorhom.study.material_tests import MaterialTestKeys
from statorhom.study.modal_tests import ModalTestKeys
from statorhom.study.regions import REGIONS, Region, StageKind, Symmetry
from statorhom.study.response_surface import SurfaceKeys

_AS_DICT = PlainSerializer(FrozenMap.plain)

Symmetries = Annotated[Mapping[str, Symmetry], AfterValidator(FrozenMap), _AS_DICT]


class ModelKeys(Keys):
    """``[stages.model]``: symmetries of regions; the overhang is the winding's material by default.

    ``wing`` lists a wing's materials.
    """

    lamination: Symmetry | None = None
    winding: Symmetry | None = None
    overhang: Symmetry | None = None
    frame: Symmetry | None = None
    machine: Symmetry | None = None
    plate: Symmetry | None = None
    beam: Symmetry | None = None
    tube: Symmetry | None = None
    wing: Symmetries = FrozenMap({})

    @property
    def declared(self) -> dict[Region, Symmetry]:
        """The regions that are declared, in the order of fabrication."""
        named = {region: getattr(self, region) for region in REGIONS if getattr(self, region) is not None}
        return named | dict(self.wing)


class PriorRange(Keys):
    """90 % range in which a constant is expected before any measurement."""

    low: Number
    high: Number

    @model_validator(mode="after")
    def _ordered(self) -> PriorRange:
        if not self.low < self.high:
            raise ValueError(
                f"low = {self.low:g} is not below high = {self.high:g}; exchange or correct them"
            )
        return self


Fixed = Annotated[Mapping[str, Mapping[str, Number]], AfterValidator(FrozenMap), _AS_DICT]
Tied = Annotated[Mapping[str, tuple[tuple[str, ...], ...]], AfterValidator(FrozenMap), _AS_DICT]
Priors = Annotated[Mapping[str, Mapping[str, PriorRange]], AfterValidator(FrozenMap), _AS_DICT]


class IdentifyKeys(Keys):
    """``[stages.identify]``: how the constants of this stage are sought.

    ``fixed`` gives constants a value, ``tied`` lists groups of constants that share one value, ``prior``
    replaces typical ranges; all three by region and by the constants' names. ``response_surface`` belongs to the
    method of that name.
    """

    method: Literal["annealing", "threshold", "response_surface"] = "annealing"
    evaluations: Annotated[WholeNumber, Field(ge=1, le=10_000_000)] = 4000
    chains: Annotated[WholeNumber, Field(ge=1, le=256)] = 4
    fixed: Fixed = FrozenMap({})
    tied: Tied = FrozenMap({})
    prior: Priors = FrozenMap({})
    response_surface: SurfaceKeys | None = None

    @model_validator(mode="after")
    def _one_method(self) -> IdentifyKeys:
        if self.response_surface is not None and self.method != "response_surface":
            raise ValueError(
                f'response_surface: belongs to another method than "{self.method}"; write method = "response_surface" '
                "or leave it out"
            )
        return self


class StageKeys(Keys):
    """One step of fabrication; ``mass_kg`` is the total mass after it."""

    name: Name
    kind: StageKind
    mass_kg: Positive
    mass_sd_kg: Positive = 0.005
    model: ModelKeys = ModelKeys()
    tests: tuple[ModalTestKeys, ...] = ()
    identify: IdentifyKeys = IdentifyKeys()
    effects: tuple[EffectKeys, ...] = ()
    material_tests: tuple[MaterialTestKeys, ...] = ()

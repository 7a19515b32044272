"""What steps without tests say of their regions' constants counts where these constants are identified."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from statorhom.study.frozen_map import FrozenMap
from statorhom.study.regions import REGIONS_OF_KIND
from statorhom.study.stages import StageKeys
from statorhom.study.study_file import StudyFile

Value = TypeVar("Value")


def with_inherited_identify(study: StudyFile, index: int) -> StageKeys:
    """A stage's keys with the fixed, tied and prior constants of the untested stages right before it.

    A region that a later one of these stages changes, or that the stage itself speaks of, is left as it has it.

    Parameters
    ----------
    study : the study.
    index : number of the stage.
    """
    keys = study.stages[index]
    if not keys.tests:
        return keys
    own = keys.identify
    spoken = {*own.fixed, *own.tied, *own.prior, *REGIONS_OF_KIND[keys.kind]}
    for earlier in range(index - 1, -1, -1):
        stage = study.stages[earlier]
        if stage.tests:
            break
        said = stage.identify
        own = own.model_copy(
            update={
                "fixed": _joined(own.fixed, said.fixed, spoken),
                "tied": _joined(own.tied, said.tied, spoken),
                "prior": _joined(own.prior, said.prior, spoken),
            }
        )
        spoken |= {*said.fixed, *said.tied, *said.prior, *REGIONS_OF_KIND[stage.kind]}
    return keys.model_copy(update={"identify": own})


def _joined(own: Mapping[str, Value], said: Mapping[str, Value], spoken: set[str]) -> FrozenMap[Value]:
    return FrozenMap({**{region: value for region, value in said.items() if region not in spoken}, **own})

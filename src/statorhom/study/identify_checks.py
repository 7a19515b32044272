"""Whether ``[stages.identify]`` speaks of constants that exist, and does not contradict itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from statorhom.study.message import quoted
from statorhom.study.nearest import hint
from statorhom.study.regions import Symmetry, is_modulus
from statorhom.study.stages import IdentifyKeys

Names = Mapping[Symmetry, tuple[str, ...]]


def check_identify(where: str, keys: IdentifyKeys, symmetries: Mapping[str, Symmetry], names: Names) -> None:
    """Check the names and values of fixed, tied and prior constants.

    Parameters
    ----------
    where : str
        The stage, for messages.
    keys : IdentifyKeys
        What the file says.
    symmetries : mapping
        Symmetry of every region that is declared at this stage.
    names : mapping
        The constants of a symmetry.

    Raises
    ------
    ValueError
        ``problem; remedy`` of the first fault.
    """
    for key, region, constant in _mentioned(keys):
        _check_known(f"{where}.identify.{key}", region, constant, symmetries, names)
    for region, values in keys.fixed.items():
        for constant, value in values.items():
            _check_sign(f"{where}.identify.fixed.{region}.{constant}", constant, value)
    for region, ranges in keys.prior.items():
        for constant, expected in ranges.items():
            _check_sign(f"{where}.identify.prior.{region}.{constant}.low", constant, expected.low)
    _check_poisson(where, keys, symmetries)
    _check_contradictions(where, keys)


def _mentioned(keys: IdentifyKeys) -> Iterator[tuple[str, str, str | None]]:
    for key, regions in (("fixed", keys.fixed), ("prior", keys.prior)):
        for region, constants in regions.items():
            yield key, region, None
            yield from ((key, region, constant) for constant in constants)
    for region, groups in keys.tied.items():
        yield "tied", region, None
        yield from (("tied", region, constant) for group in groups for constant in group)


def _check_known(
    where: str, region: str, constant: str | None, symmetries: Mapping[str, Symmetry], names: Names
) -> None:
    if region not in symmetries:
        remedy = hint(region, symmetries) if symmetries else "declare a symmetry in [stages.model]"
        raise ValueError(f"{where}: no region {quoted(region)} is declared at this stage; {remedy}")
    symmetry = symmetries[region]
    if constant is not None and constant not in names[symmetry]:
        raise ValueError(
            f"{where}.{region}: the {symmetry} region has no constant {quoted(constant)}; "
            f"{hint(constant, names[symmetry])}"
        )


def _check_sign(where: str, constant: str, value: float) -> None:
    if is_modulus(constant) and value <= 0.0:
        raise ValueError(f"{where}: a modulus must be greater than 0, but is {value:g}; correct the number")
    if not is_modulus(constant) and abs(value) > 1.0:
        raise ValueError(f"{where}: {value:g} is no Poisson ratio; type a number between -1 and 1")


def _check_poisson(where: str, keys: IdentifyKeys, symmetries: Mapping[str, Symmetry]) -> None:
    """An isotropic material's ratio has limits of its own; those of the others depend on their moduli."""
    for region, values in keys.fixed.items():
        nu = values.get("nu", 0.0)
        if symmetries[region] == "isotropic" and not -1.0 < nu < 0.5:
            raise ValueError(
                f"{where}.identify.fixed.{region}.nu: {nu:g} is no Poisson ratio of an isotropic material; "
                "type a number above -1 and below 0.5"
            )


def _check_contradictions(where: str, keys: IdentifyKeys) -> None:
    for region, groups in keys.tied.items():
        tied = [constant for group in groups for constant in group]
        place = f"{where}.identify.tied.{region}"
        for group in groups:
            if len(group) < 2:
                raise ValueError(
                    f"{place}: a group has fewer than two constants; name those that share a value"
                )
            if len({is_modulus(constant) for constant in group}) > 1:
                raise ValueError(
                    f"{place}: a modulus cannot equal a Poisson ratio; tie constants of one kind"
                )
        for constant in tied:
            if tied.count(constant) > 1:
                raise ValueError(f"{place}: {constant} occurs twice; name it in one group only")
    for region, values in keys.fixed.items():
        free = [*keys.prior.get(region, ()), *(name for group in keys.tied.get(region, ()) for name in group)]
        for constant in values:
            if constant in free:
                raise ValueError(
                    f"{where}.identify.fixed.{region}.{constant}: is in prior or tied as well; keep one"
                )

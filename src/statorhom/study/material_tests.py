"""``[[stages.material_tests]]``: what mechanical tests of samples gave, to compare with what the modes give."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pydantic import model_validator

from statorhom.study.keys import Keys, Number, Title
from statorhom.study.message import quoted
from statorhom.study.nearest import hint
from statorhom.study.regions import Symmetry, is_modulus


class MaterialTestKeys(Keys):
    """A constant as a test of samples gave it; ``low`` and ``high`` are the samples' range. It decides nothing."""

    name: Title
    region: str
    constant: str
    value: Number
    low: Number | None = None
    high: Number | None = None

    @model_validator(mode="after")
    def _in_its_range(self) -> MaterialTestKeys:
        low, high = (self.value if end is None else end for end in (self.low, self.high))
        if not low <= self.value <= high:
            raise ValueError(
                f"value = {self.value:g} does not lie between low = {low:g} and high = {high:g}; correct them"
            )
        return self


def check_material_tests(
    where: str,
    tests: Sequence[MaterialTestKeys],
    symmetries: Mapping[str, Symmetry],
    constants: Mapping[Symmetry, tuple[str, ...]],
) -> None:
    """Check that the constants exist and are possible.

    Parameters
    ----------
    where : the stage, for messages.
    tests : what the file says.
    symmetries : of the regions that are declared at this stage.
    constants : of the symmetries.

    Raises
    ------
    ValueError
        ``problem; remedy`` of the first fault.
    """
    for test in tests:
        place = f"{where}.material_tests[{test.name}]"
        if test.region not in symmetries:
            remedy = hint(test.region, symmetries) if symmetries else "declare a symmetry in [stages.model]"
            raise ValueError(f"{place}: no region {quoted(test.region)} is declared at this stage; {remedy}")
        symmetry = symmetries[test.region]
        if test.constant not in constants[symmetry]:
            raise ValueError(
                f"{place}: the {symmetry} region has no constant {quoted(test.constant)}; "
                f"{hint(test.constant, constants[symmetry])}"
            )
        low = test.value if test.low is None else test.low
        if is_modulus(test.constant) and low <= 0.0:
            raise ValueError(f"{place}: a modulus must be greater than 0, but is {low:g}; correct the number")

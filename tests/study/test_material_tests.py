"""Material tests in study files: what is wrong with them."""

import pytest

from statorhom.errors import InputFileError
from statorhom.study.study_file import read_study_file

STUDY = """\
schema = 1
name = "plate"
geometry = "plate.toml"
[[stages]]
name = "coupon"
kind = "coupon"
mass_kg = 0.4
[stages.model]
plate = "orthotropic"
[[stages.material_tests]]
name = "tension"
region = "plate"
constant = "E_1_pa"
value = 43.181e9
"""


def read(tmp_path, old="", new=""):
    path = tmp_path / "study.toml"
    assert old in STUDY
    path.write_text(STUDY.replace(old, new) if old else STUDY, encoding="utf-8")
    return read_study_file(path)


def test_a_test_of_samples_is_read(tmp_path):
    (test,) = read(tmp_path).stages[0].material_tests
    assert (test.name, test.value, test.low, test.high) == ("tension", 43.181e9, None, None)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"E_1_pa"', '"E_x_pa"', "has no constant .E_x_pa."),
        ('region = "plate"', 'region = "beam"', "no region .beam. is declared"),
        ("value = 43.181e9", "value = -1.0", "a modulus must be greater than 0, but is -1"),
        (
            "value = 43.181e9",
            "value = 43e9\nlow = 44e9",
            "does not lie between low = 4.4e.10 and high = 4.3e.10",
        ),
        ("value = 43.181e9", "value = 43e9\nhigt = 44e9", "did you mean"),
    ],
)
def test_what_is_wrong_is_one_line(tmp_path, old, new, said):
    with pytest.raises(InputFileError, match=said) as caught:
        read(tmp_path, old, new)
    assert "\n" not in str(caught.value)

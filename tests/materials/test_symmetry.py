import pytest

from statorhom.errors import MaterialError
from statorhom.materials.symmetry import SYMMETRIES, constant_names


def test_the_names_are_those_of_the_files():
    assert constant_names("isotropic") == ("E_pa", "nu")
    assert constant_names("transversely_isotropic") == ("E_p_pa", "E_z_pa", "nu_p", "nu_pz", "G_rz_pa")
    assert constant_names("orthotropic") == (
        *("E_r_pa", "E_t_pa", "E_z_pa", "nu_rt", "nu_rz", "nu_tz"),
        *("G_rt_pa", "G_rz_pa", "G_tz_pa"),
    )


def test_each_class_knows_the_name_it_is_listed_under():
    assert {name: material.symmetry for name, material in SYMMETRIES.items()} == {n: n for n in SYMMETRIES}


def test_the_list_cannot_be_changed():
    with pytest.raises(TypeError):
        SYMMETRIES["cubic"] = object


def test_an_unknown_symmetry_gets_the_nearest_name():
    with pytest.raises(MaterialError, match="'orthotropc': did you mean 'orthotropic'"):
        constant_names("orthotropc")
    with pytest.raises(MaterialError, match="use one of isotropic, transversely_isotropic, orthotropic"):
        constant_names("wood?")

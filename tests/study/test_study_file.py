from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from statorhom.errors import InputFileError
from statorhom.study.study_file import read_study_file
from statorhom.study.supports import FaceSupport

SECOND_STAGE = '[[stages]]\nname = "wound"\nkind = "wound"'
TEST = 'support = "free"\nmodal_table = "modes.csv"'
LINES = 'kind = "lines"\nangles_deg = [158.0, 202.0]\ndeclared = "rigid"'
FIXED = "nu_p = 0.3"
PRIOR = "E_p_pa = { low = 1.5e11, high = 2.05e11 }"


def test_defaults_and_extensions(folder: Any) -> None:
    study = read_study_file(folder.study)
    stack, wound = study.stages
    assert (stack.mass_sd_kg, wound.mass_sd_kg) == (0.005, 0.002)
    assert (stack.identify.method, stack.identify.evaluations, stack.identify.chains) == (
        "annealing",
        4000,
        2,
    )
    assert stack.identify.fixed["lamination"] == {"nu_p": 0.3}
    assert stack.identify.prior["lamination"]["E_p_pa"].high == 2.05e11
    assert (stack.tests[0].role, stack.tests[0].hold_out, stack.tests[0].paths) == (None, (), ("modes.csv",))
    clamped = study.support("clamped")
    assert study.support("free") is None
    assert clamped is not None and clamped.declared == "rigid"


def test_regions_grow_and_the_latest_declaration_holds(folder: Any) -> None:
    study = read_study_file(folder.study)
    assert study.regions(0) == ("lamination",)
    assert study.regions(1) == ("lamination", "winding", "overhang")
    assert study.symmetry(1, "lamination") == "transversely_isotropic"
    assert study.symmetry(1, "winding") == "isotropic"
    assert study.symmetry(0, "winding") is None
    assert study.symmetry(1, "overhang") is None


def test_skipped_step_may_be_declared_later(folder: Any) -> None:
    folder.edit("study.toml", SECOND_STAGE, SECOND_STAGE.replace('kind = "wound"', 'kind = "framed"'))
    folder.edit("study.toml", 'winding = "isotropic"', 'winding = "isotropic"\nframe = "isotropic"')
    assert read_study_file(folder.study).regions(1) == ("lamination", "winding", "overhang", "frame")


def test_faces_and_elastic_supports(folder: Any) -> None:
    faces = (
        'kind = "faces"\nfaces = ["lower_end"]\narcs_deg = [[170, 190]]\n'
        'declared = "elastic"\nnormal_stiffness_n_per_m3 = 1e12'
    )
    folder.edit("study.toml", LINES, faces)
    support = read_study_file(folder.study).support("clamped")
    assert isinstance(support, FaceSupport)
    assert (support.arcs_deg, support.normal_stiffness_n_per_m3) == (((170.0, 190.0),), 1e12)
    assert support.tangential_ratio == 1.0


def test_elastic_without_a_number_is_left_to_the_model(folder: Any) -> None:
    folder.edit("study.toml", 'declared = "rigid"', 'declared = "elastic"')
    assert read_study_file(folder.study).supports[0].declared == "elastic"


def test_raw_records_may_be_one_file_or_several(folder: Any) -> None:
    folder.edit(
        "study.toml", 'frf = "wound.uff"', 'hits = ["hit-1.csv", "hit-2.csv"]\nsample_rate_hz = 48000'
    )
    [test] = read_study_file(folder.study).stages[1].tests
    assert test.paths == ("hit-1.csv", "hit-2.csv")
    folder.edit("study.toml", '["hit-1.csv", "hit-2.csv"]', '"hits.uff"')
    assert read_study_file(folder.study).stages[1].tests[0].paths == ("hits.uff",)


def test_nothing_can_be_changed(folder: Any) -> None:
    study = read_study_file(folder.study)
    with pytest.raises(ValidationError):
        study.stages[0].mass_kg = 1.0
    with pytest.raises(TypeError):
        study.stages[0].identify.fixed["lamination"] = {}


@pytest.mark.parametrize(
    ("old", "new", "fragments"),
    [
        (
            'kind = "wound"',
            'kind = "stack"',
            ["stages[wound].kind", "stack cannot follow stack", "stack, wound, impregnated"],
        ),
        (
            'kind = "wound"',
            'kind = "coupon"',
            ["stages[wound].kind", "a coupon is the one stage of its study"],
        ),
        ('kind = "stack"', 'kind = "impregnated"', ["stages[wound].kind", "wound cannot follow impregnated"]),
        ('name = "wound"', 'name = "Stack"', ["two stages are named", "give each its own name"]),
        (
            'name = "wound"',
            'name = "../up"',
            ["stages[../up].name", '"../up" cannot name results files', "use at most"],
        ),
        ('name = "small"', f'name = "{"x" * 61}"', ["name", "cannot name results files"]),
        ('name = "small"', 'name = ""', ["name", "printable text on one line"]),
        ('name = "wound-clamped"', 'name = "stack-free"', ["two tests are named", '"stack-free"']),
        (
            'name = "clamped"',
            'name = "free"',
            ["supports[free]", '"free" always exists', "delete this support"],
        ),
        (
            'support = "clamped"',
            'support = "clamps"',
            ["tests[wound-clamped].support", 'no support "clamps"', 'did you mean "clamped"?'],
        ),
        (
            'winding = "isotropic"',
            'frame = "isotropic"',
            ["stages[wound].model.frame", "does not change this region", "winding, overhang"],
        ),
        (
            'winding = "isotropic"',
            'lamination = "isotropic"',
            ["stages[wound].model.lamination", "declare it in the step that does"],
        ),
        (
            'winding = "isotropic"',
            'winding = "isotrop"',
            ["stages[wound].model.winding", 'did you mean "isotropic"?'],
        ),
        (
            'winding = "isotropic"',
            "",
            ["stages[wound].model", "nothing is declared for winding", 'add winding = "isotropic"'],
        ),
        (
            'frf = "wound.uff"',
            "",
            ["tests[wound-clamped]", "has no data", "add one of modal_table, frf and hits"],
        ),
        ('frf = "wound.uff"', 'frf = "wound.uff"\nhits = "h.uff"', ["has frf and hits", "keep one of them"]),
        ('frf = "wound.uff"', "hits = []", ["tests[wound-clamped].hits", "at least 1"]),
        ('frf = "wound.uff"', "hits = 3", ["tests[wound-clamped].hits", "must be a list, but is 3"]),
        (
            'frf = "wound.uff"',
            'frf = "wound.uff"\ndirection = "up"',
            ["direction", "use r, theta, x, y or z"],
        ),
        (
            'frf = "wound.uff"',
            'frf = "wound.uff"\ndirection = "--z"',
            ["direction", "use r, theta, x, y or z"],
        ),
        (
            'frf = "wound.uff"',
            'frf = "wound.uff"\nforce_full_scale_n = 0.0',
            ["force_full_scale_n", "greater than 0"],
        ),
        ('frf = "wound.uff"', 'frf = "wound.uff"\nhammer_mm = [1.0, 2.0]', ["hammer_mm: has only 2"]),
        ('frf = "wound.uff"', 'hits = ["a.csv", 3]', ["tests[wound-clamped].hits[#2]", "must be text"]),
        ("[[supports]]", "[supports]", ["supports: must be a list of tables", "double square brackets"]),
        ("mass_sd_kg = 0.002", "mass_sd_kg = 0.0", ["stages[wound].mass_sd_kg", "greater than 0"]),
        ("angles_deg = [158.0, 202.0]", "angles_deg = []", ["supports[clamped].angles_deg", "at least 1"]),
        (
            "angles_deg = [158.0, 202.0]",
            "angles_deg = [158.0, 518.0]",
            ["supports[clamped]", "same line twice"],
        ),
        (
            'declared = "rigid"',
            'declared = "rigid"\nnormal_stiffness_n_per_m2 = 1e9',
            ["supports[clamped]", "a rigid support has no stiffness"],
        ),
        (
            'declared = "rigid"',
            'declared = "elastic"\nnormal_stiffness_n_per_m3 = 1e9',
            ['unknown key "normal_stiffness_n_per_m3"', 'did you mean "normal_stiffness_n_per_m2"?'],
        ),
        (LINES, 'kind = "faces"\ndeclared = "rigid"', ["supports[clamped]", "holds nothing", "add faces"]),
        (
            LINES,
            'kind = "faces"\ndeclared = "rigid"\narcs_deg = [[190, 170]]',
            ["arcs_deg has [190, 170]", "runs upwards"],
        ),
        (FIXED, "nu_pp = 0.3", ["identify.fixed.lamination", 'no constant "nu_pp"', 'did you mean "nu_p"?']),
        (FIXED, "nu_p = 3", ["identify.fixed.lamination.nu_p", "3 is no Poisson ratio"]),
        (FIXED, "E_z_pa = -1e9", ["identify.fixed.lamination.E_z_pa", "modulus must be greater than 0"]),
        (
            FIXED,
            "E_p_pa = 2e11",
            ["identify.fixed.lamination.E_p_pa", "in prior or tied as well", "keep one"],
        ),
        (PRIOR, "E_p_pa = { low = 2e11, high = 1e11 }", ["prior.lamination.E_p_pa", "not below high"]),
        (PRIOR, "E_p_pa = { low = 0, high = 1e11 }", ["prior.lamination.E_p_pa.low", "greater than 0"]),
        (PRIOR, "E_p_pa = { lo = 1e10, high = 1e11 }", ['unknown key "lo"', 'did you mean "low"?']),
        (
            "[stages.identify.fixed.lamination]",
            "[stages.identify.fixed.laminations]",
            ['no region "laminations"', 'did you mean "lamination"?'],
        ),
        (
            "chains = 2",
            'tied = { lamination = [["E_p_pa"]] }',
            ["tied.lamination", "fewer than two constants"],
        ),
        (
            "chains = 2",
            'tied = { lamination = [["E_z_pa", "nu_pz"]] }',
            ["tied.lamination", "cannot equal a Poisson ratio"],
        ),
        (
            "chains = 2",
            'tied = { lamination = [["E_z_pa", "G_rz_pa", "E_z_pa"]] }',
            ["tied.lamination", "E_z_pa occurs twice"],
        ),
        ("chains = 2", "chains = 0", ["stages[stack].identify.chains", "must be at least 1, but is 0"]),
        (TEST, 'modal_table = "modes.csv"', ["tests[stack-free].support", "is missing"]),
        (
            TEST,
            f'{TEST}\nrole = "fitted"',
            ["tests[stack-free].role", '"fitted" is not one of fit, predict', 'did you mean "fit"?'],
        ),
        (TEST, f"{TEST}\nweighed = 1", ["tests[stack-free].weighed", "must be true or false, but is 1"]),
    ],
)
def test_every_fault_is_one_line_with_key_and_remedy(
    folder: Any, old: str, new: str, fragments: list[str]
) -> None:
    folder.edit("study.toml", old, new)
    with pytest.raises(InputFileError) as caught:
        read_study_file(folder.study)
    message = str(caught.value)
    assert message.startswith(f"{folder.study}: ")
    assert "\n" not in message and "; " in message
    for fragment in fragments:
        assert fragment in message


def test_two_faults_show_the_unknown_key_and_are_counted(folder: Any) -> None:
    folder.edit("study.toml", "mass_kg = 3.08", "mass_kg = -3.08")
    folder.edit("study.toml", 'declared = "rigid"', 'declare = "rigid"')
    with pytest.raises(InputFileError, match=r'unknown key "declare".*the file has 2 faults'):
        read_study_file(folder.study)


def test_nothing_to_declare_without_stages(folder: Any) -> None:
    folder.study.write_text('schema = 1\nname = "x"\ngeometry = "g"\nstages = []\n', encoding="utf-8")
    with pytest.raises(InputFileError, match="stages: needs at least 1"):
        read_study_file(folder.study)

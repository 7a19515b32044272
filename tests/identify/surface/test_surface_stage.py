"""A step whose search is a response surface, from the study file to results and report."""

import pytest

from cheap_study import coarse, edit, write_study
from statorhom.errors import InputFileError
from statorhom.identify.chain import chain
from statorhom.report.compose import compose
from statorhom.report.html import render_html
from statorhom.results import read_results
from statorhom.study.study import load_study

TESTS = """\
[[stages.material_tests]]
name = "tension"
region = "lamination"
constant = "E_pa"
value = 190e9
low = 180e9
high = 200e9
[[stages.material_tests]]
name = "compression"
region = "lamination"
constant = "E_pa"
value = 230e9
"""
SURFACE = '[stages.identify]\nmethod = "response_surface"\n[stages.identify.response_surface]\nsurface = "polynomial"\n'


def with_surface(folder, text=SURFACE):
    path = write_study(folder)
    edit(path, "[stages.identify]\nevaluations = 60\nchains = 1\n", text)
    edit(path, '[[stages.tests]]\nname = "stack-free"', TESTS + '[[stages.tests]]\nname = "stack-free"')
    return path


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Results of the study's first step."""
    where = tmp_path_factory.mktemp("surface")
    files = load_study(with_surface(where))
    chain(files, where / "out", coarse()).run(last=0)
    return where / "out"


def test_the_result_says_how_it_was_searched(folder):
    fit = read_results(folder).stages[0].fit
    assert fit.method == "response_surface"
    found = fit.surface
    assert found.design == "latin_hypercube" and found.surface.startswith("polynomial of degree")
    assert found.passed and found.rounds[-1].largest_error_percent < found.limit_percent == 3.0
    assert found.full_solves == found.check_points + sum(r.points for r in found.rounds)
    assert found.objectives == ("(2, 0)", "(2, 1)")
    assert all(len(row) == 2 for row in found.front_percent)
    assert found.band is None and "too few" in found.band_remark


def test_the_constant_is_that_of_the_other_search(folder, tmp_path):
    files = load_study(write_study(tmp_path))
    other = chain(files, tmp_path / "out", coarse()).run(last=0).stages[0]
    mine = read_results(folder).stages[0]
    E, F = (s.regions["lamination"].engineering["E_pa"].value for s in (mine, other))
    assert pytest.approx(F, rel=2e-3) == E


def test_material_tests_stand_beside_the_constant(folder):
    stage = read_results(folder).stages[0]
    E = stage.regions["lamination"].engineering["E_pa"]
    tension, compression = stage.material_tests
    assert tension.identified == E and (tension.low, tension.high) == (180e9, 200e9)
    assert tension.difference_percent == pytest.approx(100 * abs(E.value / 190e9 - 1))
    assert compression.difference_percent == pytest.approx(100 * abs(E.value / 230e9 - 1))


def test_the_tests_mean_value_gives_its_own_frequencies(folder):
    """With the density and nu of the fit all frequencies go by the root of E."""
    stage = read_results(folder).stages[0]
    E = stage.regions["lamination"].engineering["E_pa"].value
    assert [f.mode for f in stage.tested_frequencies] == ["(2, 0)", "(2, 1)"]
    for f in stage.tested_frequencies:
        assert f.tests_hz / f.identified_hz == pytest.approx((210e9 / E) ** 0.5, rel=1e-6)
        assert f.tests_percent == pytest.approx(100 * abs(f.tests_hz / f.measured_hz - 1))


def test_the_report_has_a_section_of_it(folder):
    page = render_html(compose(read_results(folder), folder))
    assert "Search by response surface" in page
    assert "Pareto front" in page and "full solves" in page
    assert "Comparison with material tests" in page and "compression" in page


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            'method = "response_surface"\n[stages.identify.response_surface]\ndegree = 3',
            "only a polynomial has one",
        ),
        (
            'method = "response_surface"\n[stages.identify.response_surface]\ndesign = "sparse_grid"\npoints = 9',
            "only a latin_hypercube",
        ),
        (
            'method = "response_surface"\n[stages.identify.response_surface]\npoints = 900',
            "900 are more than most_points = 300",
        ),
        ('method = "threshold"\n[stages.identify.response_surface]\npoints = 9', "belongs to another method"),
        ('method = "response_surface"\n[stages.identify.response_surface]\ndesing = "x"', "did you mean"),
    ],
)
def test_what_makes_no_sense_is_one_line(tmp_path, text, said):
    with pytest.raises(InputFileError, match=said) as caught:
        load_study(with_surface(tmp_path, f"[stages.identify]\n{text}\n"))
    assert "\n" not in str(caught.value)

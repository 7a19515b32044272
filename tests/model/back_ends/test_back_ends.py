import builtins
import ctypes
import gc
import json
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from boxes import box_mesh
from small_stators import ORTHOTROPIC

from statorhom.errors import MissingDependencyError, SolverError
from statorhom.model.affine import Material
from statorhom.model.back_ends import cholmod, pardiso
from statorhom.model.back_ends.checked import checked
from statorhom.model.back_ends.choice import BACK_ENDS, best_available
from statorhom.model.back_ends.superlu import superlu
from statorhom.model.frames import cartesian
from statorhom.model.general.general_model import general_model

FIGURES = Path(__file__).resolve().parents[3] / "benchmarks" / "figures" / "back_ends.json"
LIBRARIES = {"cholmod": (cholmod, "kvxopt"), "pardiso": (pardiso, "pypardiso")}
MATERIALS = {"box": Material(ORTHOTROPIC.hooke(), 7810.5)}


@pytest.fixture(params=sorted(BACK_ENDS))
def back_end(request):
    if request.param in LIBRARIES:
        try:
            LIBRARIES[request.param][0].library()
        except MissingDependencyError as missing:
            pytest.skip(str(missing))
    return BACK_ENDS[request.param]


@pytest.fixture(scope="module")
def body():
    return general_model(box_mesh((0.12, 0.05, 0.02), (5, 3, 2)), cartesian)


@pytest.fixture(scope="module")
def pair(body):
    return body.stiffness_matrix(MATERIALS), body.mass_matrix(MATERIALS)


def _shifted(pair, shift):
    return sp.csr_array(pair[0] + shift * pair[1])


def test_every_back_end_solves(pair, back_end):
    matrix = _shifted(pair, 1e9)
    solve = back_end(matrix)
    right = np.random.default_rng(7).standard_normal((matrix.shape[0], 3))
    kept = right.copy()
    exact = np.linalg.solve(matrix.toarray(), right)
    for b, x in ((right, exact), (np.asfortranarray(right), exact), (right[:, 1], exact[:, 1])):
        found = solve(b)
        assert found.shape == b.shape
        np.testing.assert_allclose(found, x, atol=1e-9 * np.abs(x).max())
    np.testing.assert_array_equal(right, kept)


def test_every_back_end_finds_the_same_modes(body, back_end):
    reference = body.solve(3e4, MATERIALS, superlu)
    modes = body.solve(3e4, MATERIALS, back_end)
    assert len(reference.frequencies_hz) > 12
    np.testing.assert_allclose(modes.frequencies_hz[6:], reference.frequencies_hz[6:], rtol=1e-10)


def test_factorizations_do_not_disturb_each_other(pair, back_end):
    first, second = _shifted(pair, 1e9), _shifted(pair, 1e11)
    solves = [back_end(first), back_end(second)]
    right = np.ones(first.shape[0])
    for matrix, solve in zip((first, second), solves, strict=True):
        np.testing.assert_allclose(matrix @ solve(right), right, atol=1e-8)
    del solve, solves[1:]
    gc.collect()
    np.testing.assert_allclose(first @ solves[0](right), right, atol=1e-8)


@pytest.mark.parametrize("which", [0, 8, -1])
def test_an_indefinite_matrix_is_refused(pair, back_end, which):
    # one, nine or all but one of the eigenvalues of K - shift M are negative
    values = np.linalg.eigvalsh(np.linalg.inv(np.linalg.cholesky(pair[1].toarray())) @ pair[0].toarray()
                                @ np.linalg.inv(np.linalg.cholesky(pair[1].toarray())).T)  # fmt: skip
    shift = 1e7 if which == 0 else (values[which] + values[which - 1]) / 2
    with pytest.raises(SolverError, match="the matrix is not positive definite; check materials") as caught:
        back_end(_shifted(pair, -shift))
    assert "\n" not in str(caught.value)


def test_one_strongly_negative_direction_is_refused(pair, back_end):
    matrix = _shifted(pair, 1e9)
    matrix[30, 30] = -1e3 * abs(matrix).max()
    with pytest.raises(SolverError, match="the matrix is not positive definite"):
        back_end(matrix)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_tiny_matrices_are_solved(back_end, n):
    assert back_end(sp.csr_array(2.0 * sp.eye_array(n, format="csr")))(np.ones(n)) == pytest.approx(0.5)


def test_a_matrix_with_an_entry_that_is_no_number_is_refused(pair, back_end):
    matrix = _shifted(pair, 1e9)
    matrix.data[11] = np.nan
    with pytest.raises(SolverError):
        back_end(matrix)


def test_a_solve_that_does_not_solve_is_refused(pair):
    matrix = _shifted(pair, 1e9)
    good = superlu(matrix)
    assert checked("ours", matrix, good) is good
    for wrong in (lambda b: good(b) * (1 + 1e-6), lambda b: np.full_like(b, np.nan), np.zeros_like):
        with pytest.raises(
            SolverError, match=r"ours: a solve left a relative residual of .* another back end"
        ):
            checked("ours", matrix, wrong)
    with pytest.raises(SolverError, match="ours: the matrix is not positive definite"):
        checked("ours", sp.csr_array(-matrix), lambda b: -good(b))


def test_pardiso_gives_its_memory_back(pair):
    pypardiso = pytest.importorskip("pypardiso")
    matrix = _shifted(pair, 1e9)
    mkl = pypardiso.ps.libmkl
    mkl.mkl_mem_stat.restype = ctypes.c_int64
    count = ctypes.c_int()
    held = []
    for _ in range(6):
        solve = pardiso.pardiso(matrix)
        del solve
        gc.collect()
        held.append(mkl.mkl_mem_stat(ctypes.byref(count)))
    kept = pardiso.pardiso(matrix)
    assert held[-1] == held[1]
    assert mkl.mkl_mem_stat(ctypes.byref(count)) > held[-1]
    del kept


@pytest.mark.parametrize("name", sorted(LIBRARIES))
def test_a_missing_library_names_the_extra(monkeypatch, pair, name):
    _hide(monkeypatch, LIBRARIES[name][1])
    with pytest.raises(MissingDependencyError, match=r"^\w+: .* pip install 'statorhom\[general\]'$"):
        BACK_ENDS[name](pair[0])


def test_the_choice_is_that_of_the_measurement(monkeypatch):
    for module, _ in LIBRARIES.values():
        monkeypatch.setattr(module, "library", lambda: None)
    largest = json.loads(FIGURES.read_text(encoding="utf-8"))["meshes"][-1]
    assert largest["degrees_of_freedom"] > 140_000
    seconds = {name: figures["band_s"] for name, figures in largest["back_ends"].items()}
    assert set(seconds) == set(BACK_ENDS)
    # CHOLMOD and PARDISO differ by less than a busy machine's noise
    chosen = next(name for name, back_end in BACK_ENDS.items() if back_end is best_available())
    assert seconds[chosen] < 1.1 * min(seconds.values())
    assert max(seconds, key=seconds.__getitem__) == "superlu"


def test_what_is_installed_is_chosen(monkeypatch):
    _hide(monkeypatch, "pypardiso", "kvxopt")
    assert best_available() is superlu


def test_the_better_library_comes_first(monkeypatch):
    for module, _ in LIBRARIES.values():
        monkeypatch.setattr(module, "library", lambda: None)
    assert best_available() is cholmod.cholmod
    _hide_library(monkeypatch, cholmod)
    assert best_available() is pardiso.pardiso


def _hide_library(monkeypatch, module):
    def missing():
        raise MissingDependencyError("gone")

    monkeypatch.setattr(module, "library", missing)


def _hide(monkeypatch, *names):
    real = builtins.__import__

    def without(name, *args, **kwargs):
        if name.split(".")[0] in names:
            raise ModuleNotFoundError(f"No module named {name!r}")
        return real(name, *args, **kwargs)

    for name in names:
        for loaded in [m for m in sys.modules if m.split(".")[0] == name]:
            monkeypatch.delitem(sys.modules, loaded)
    monkeypatch.setattr(builtins, "__import__", without)

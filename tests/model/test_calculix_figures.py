import importlib.util
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from small_stators import stator_mesh

from statorhom.geometry import stator_geometry
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.mesh import mesh_step, uniform
from statorhom.study.geometry_file import read_geometry

ROOT = Path(__file__).resolve().parents[2]
FIGURES = sorted((ROOT / "benchmarks" / "figures").glob("calculix_stack_26k*.json"))
# from the element library of CalculiX's manual: the corners of each edge, in the order of mid-sides 9 … 20
CCX_EDGES = [(1, 2), (2, 3), (3, 4), (4, 1), (5, 6), (6, 7), (7, 8), (8, 5), (1, 5), (2, 6), (3, 7), (4, 8)]
DAT = """

     E I G E N V A L U E   O U T P U T

 MODE NO    EIGENVALUE                       FREQUENCY
                                     REAL PART            IMAGINARY PART
                           (RAD/TIME)      (CYCLES/TIME     (RAD/TIME)

      1  -0.8265118E-03   0.0000000E+00   0.0000000E+00   0.2874911E-01
      2   0.8265104E+08   0.9091261E+04   0.1446919E+04   0.0000000E+00

     P A R T I C I P A T I O N   F A C T O R S

      1   0.1000000E+01   0.1000000E+01   0.1000000E+01   0.1000000E+01
"""


@pytest.fixture(scope="module")
def calculix():
    spec = importlib.util.spec_from_file_location("calculix", ROOT / "benchmarks" / "calculix.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_there_are_figures_of_both_materials():
    assert {json.loads(f.read_text())["material"] for f in FIGURES} == {"isotropic", "transversely_isotropic"}


@pytest.mark.parametrize("file", FIGURES, ids=lambda f: f.stem)
def test_the_cyclic_model_has_calculixs_frequencies(calculix, file):
    figures = json.loads(file.read_text())
    path = ROOT / "geometries" / figures["geometry"]
    assert figures["mesh"] == "uniform(1)"
    half = mesh_step(stator_geometry(read_geometry(path), path).step(("stack",)), uniform(1))
    assert half.full_dof == figures["degrees_of_freedom"] == 26568
    assert figures["constants"] == calculix.CONSTANTS[figures["material"]]
    assert figures["density_kg_per_m3"] == calculix.DENSITY
    theirs = np.array(figures["frequencies_hz"])
    ours = calculix.cyclic_frequencies(half, figures["material"], 1.0001 * theirs.max())
    rigid, elastic = ours[ours <= 1.0], ours[ours > 1.0]
    assert len(rigid) == 6
    assert len(theirs) == 34
    # the file's eigenvalues carry seven digits: both programs solve the same matrices
    np.testing.assert_allclose(elastic[: len(theirs)], theirs, rtol=5e-7)


def test_the_deck_describes_the_mesh_in_calculixs_order(calculix):
    mesh, _, _ = stator_mesh(6).full()
    deck = calculix.input_deck(mesh, "isotropic", 12)
    assert deck.startswith("*NODE, NSET=ALL\n")
    nodes, rest = deck.split("*ELEMENT, TYPE=C3D20, ELSET=STACK\n")
    rows = np.array([line.split(",") for line in nodes.splitlines()[1:]], dtype=float)
    np.testing.assert_array_equal(rows[:, 0], np.arange(1, len(mesh.nodes) + 1))
    np.testing.assert_allclose(rows[:, 1:], mesh.nodes, atol=1e-13)
    table = rest.split("*MATERIAL")[0].replace(",\n", ",").split()
    elements = np.array([row.split(",") for row in table], dtype=int)[:, 1:] - 1
    np.testing.assert_array_equal(np.sort(elements), np.sort(mesh.elements))
    corners = mesh.nodes[elements[:, :8]]
    bottom, up = corners[:, 1] - corners[:, 0], corners[:, 4] - corners[:, 0]
    assert np.all(np.einsum("ei,ei->e", np.cross(bottom, corners[:, 3] - corners[:, 0]), up) > 0)
    for k, (a, b) in enumerate(CCX_EDGES):
        middle = (corners[:, a - 1] + corners[:, b - 1]) / 2
        edge = np.linalg.norm(corners[:, a - 1] - corners[:, b - 1], axis=1)
        assert np.all(np.linalg.norm(mesh.nodes[elements[:, 8 + k]] - middle, axis=1) < 0.3 * edge)
    # CalculiX reads 20 characters per number
    assert max(len(field) for line in nodes.splitlines()[1:] for field in line.split(",")) <= 20


def test_the_deck_gives_the_nine_entries_in_calculixs_order(calculix):
    deck = calculix.input_deck(stator_mesh(6), "transversely_isotropic", 12)
    cards = deck.split("*ELASTIC, TYPE=ORTHO\n")[1].splitlines()
    c = SYMMETRIES["transversely_isotropic"](**calculix.CONSTANTS["transversely_isotropic"]).hooke().matrix
    numbers = [float(n) for n in ",".join(cards[:2]).split(",")]
    # D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323, temperature
    places = [(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2), (5, 5), (4, 4), (3, 3)]
    np.testing.assert_allclose(numbers[:9], [c[p] for p in places], rtol=1e-12)
    assert cards[2:4] == ["*ORIENTATION, NAME=AXES, SYSTEM=CYLINDRICAL", "0.,0.,0.,0.,0.,1."]
    assert "*SOLID SECTION, ELSET=STACK, MATERIAL=CORE, ORIENTATION=AXES" in cards


def test_only_the_eigenvalues_are_read(calculix):
    np.testing.assert_allclose(calculix.read_frequencies(DAT), [0.0, 1446.919], rtol=1e-6)


def test_without_calculix_it_says_what_to_install(calculix, monkeypatch):
    monkeypatch.setattr(calculix.shutil, "which", lambda _: None)
    monkeypatch.setattr(sys, "argv", ["calculix.py"])
    with pytest.raises(SystemExit) as left:
        calculix.main()
    assert "apt-get install calculix-ccx" in left.value.code and "\n" not in left.value.code

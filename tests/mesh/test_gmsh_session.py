import builtins
import signal
import sys
import threading

import numpy as np
import pytest

from example_stators import stator
from statorhom.errors import MissingDependencyError
from statorhom.mesh import mesh_step, uniform
from statorhom.mesh.gmsh_session import OPTIONS, gmsh_session, import_gmsh

gmsh = import_gmsh()


def nodes():
    return mesh_step(stator().step(("stack",)), uniform()).nodes


def importing_raises(monkeypatch, error):
    original = builtins.__import__

    def fail(name, *args, **kwargs):
        if name == "gmsh":
            raise error
        return original(name, *args, **kwargs)

    monkeypatch.delitem(sys.modules, "gmsh")
    monkeypatch.setattr(builtins, "__import__", fail)


def test_a_missing_system_library_is_one_line_with_the_packages(monkeypatch):
    importing_raises(monkeypatch, OSError("libGLU.so.1: cannot open shared\nobject file"))
    with pytest.raises(MissingDependencyError) as error:
        import_gmsh()
    message = str(error.value)
    assert "libGLU.so.1" in message and "\n" not in message
    assert "apt-get install libglu1-mesa libgl1" in message
    assert error.value.__cause__ is None and error.value.__suppress_context__


def test_a_missing_gmsh_says_how_to_install_it(monkeypatch):
    importing_raises(monkeypatch, ModuleNotFoundError("No module named 'gmsh'"))
    with pytest.raises(MissingDependencyError, match="pip install gmsh"):
        nodes()


def test_a_session_leaves_no_gmsh_open_and_the_signal_handler_alone():
    before = signal.getsignal(signal.SIGINT)
    with gmsh_session() as session:
        assert session.isInitialized()
        assert signal.getsignal(signal.SIGINT) is before
    assert not gmsh.isInitialized()
    assert signal.getsignal(signal.SIGINT) is before


def test_it_is_silent(capfd):
    nodes()
    assert capfd.readouterr() == ("", "")


def test_an_exception_closes_the_session_and_the_next_one_works():
    with pytest.raises(ZeroDivisionError), gmsh_session() as session:
        session.model.geo.addPoint(0.0, 0.0, 0.0)
        raise ZeroDivisionError
    assert not gmsh.isInitialized()
    with gmsh_session() as session:
        session.model.geo.synchronize()
        assert session.model.getEntities() == []


def test_threads_take_turns():
    expected = nodes()
    found = [None] * 4

    def work(i):
        found[i] = nodes()

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for mesh in found:
        np.testing.assert_array_equal(mesh, expected)


@pytest.mark.parametrize("fails", [False, True])
def test_a_session_of_somebody_else_stays_as_it_was(fails):
    gmsh.initialize(interruptible=False, readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.ElementOrder", 3)
        gmsh.model.add("theirs")
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        options = {name: gmsh.option.getNumber(name) for name in OPTIONS}
        models, entities = gmsh.model.list(), gmsh.model.getEntities()
        if fails:
            with pytest.raises(ZeroDivisionError), gmsh_session():
                raise ZeroDivisionError
        else:
            inside = nodes()
        assert gmsh.isInitialized() and gmsh.model.getCurrent() == "theirs"
        assert gmsh.model.list() == models and gmsh.model.getEntities() == entities
        assert {name: gmsh.option.getNumber(name) for name in OPTIONS} == options
    finally:
        gmsh.finalize()
    if not fails:
        np.testing.assert_array_equal(inside, nodes())

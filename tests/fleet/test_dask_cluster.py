"""The same work by a dask.distributed scheduler."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from cheap_fleet import Inline, write_fleet
from cheap_study import coarse
from statorhom.errors import IdentificationError, MissingDependencyError
from statorhom.fleet.batch import fit_fleet
from statorhom.fleet.dask_cluster import DaskCluster
from statorhom.fleet.executor import Lost

distributed = pytest.importorskip("distributed", reason="needs the extra dask")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A scheduler with one worker in a thread of this process."""
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0"
    ) as cluster:
        yield cluster.scheduler_address


def double(task: int) -> int:
    return 2 * task


def die_once(marker: Path) -> str:
    if marker.suffix == ".once" and not marker.exists():
        marker.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return marker.name


def die(task: int) -> int:
    if task == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return task


def test_every_task_is_answered_once(address: str) -> None:
    answers = list(DaskCluster(address).run(double, range(7)))
    assert sorted(answers) == [(i, 2 * i) for i in range(7)]


def test_equal_tasks_are_not_taken_for_one(address: str) -> None:
    assert sorted(DaskCluster(address).run(double, [3, 3])) == [(0, 6), (1, 6)]


def test_a_fleet_has_the_results_of_one_process(
    address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("statorhom.fleet.batch.Settings", coarse)
    studies = write_fleet(tmp_path / "studies", 2)
    fleet = fit_fleet(studies, tmp_path / "dask", DaskCluster(address))
    fit_fleet(studies, tmp_path / "inline", Inline())
    assert fleet.errors == {}
    assert (tmp_path / "dask" / "fleet.csv").read_bytes() == (tmp_path / "inline" / "fleet.csv").read_bytes()


def test_no_scheduler(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.fleet.dask_cluster.CONNECT_S", 1)
    with pytest.raises(
        IdentificationError, match=r"^--scheduler \"tcp://127\.0\.0\.1:9\": no scheduler[^\n]*$"
    ):
        list(DaskCluster("tcp://127.0.0.1:9").run(double, [1]))
    with pytest.raises(IdentificationError, match=r"^--scheduler \"ftp://x:1\": no scheduler[^\n]*$"):
        list(DaskCluster("ftp://x:1").run(double, [1]))


def test_no_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.fleet.dask_cluster.CONNECT_S", 1)
    with (
        distributed.LocalCluster(n_workers=0, processes=False, dashboard_address=":0") as cluster,
        pytest.raises(IdentificationError, match=r"^--scheduler [^\n]* no workers; [^\n]*$"),
    ):
        list(DaskCluster(cluster.scheduler_address).run(double, [1]))


def test_without_dask_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with pytest.raises(MissingDependencyError, match=r"statorhom\[dask\]"):
        DaskCluster("tcp://127.0.0.1:8786")


@pytest.mark.slow
def test_tasks_of_killed_workers_are_done_again_or_given_up(tmp_path: Path) -> None:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
    ) as cluster:
        executor = DaskCluster(cluster.scheduler_address)
        tasks = [tmp_path / name for name in ("a", "b.once", "c", "d")]
        answers = list(executor.run(die_once, tasks))
        assert sorted(answers) == [(i, task.name) for i, task in enumerate(tasks)]
        given_up = dict(executor.run(die, range(3)))
        assert isinstance(given_up[1], Lost) and "workers died" in given_up[1].reason


@pytest.mark.slow
def test_a_fleet_with_a_killed_worker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.fleet.batch.Settings", coarse)
    studies = write_fleet(tmp_path / "studies", 8)
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
    ) as cluster:
        killed: list[int] = []

        def announce(_what: str, _count: int):  # type: ignore[no-untyped-def]
            def progress(done: int) -> None:
                if done == 4 and not killed:
                    killed.append(next(iter(cluster.workers.values())).pid)
                    os.kill(killed[0], signal.SIGKILL)

            return progress

        fleet = fit_fleet(
            studies, tmp_path / "dask", DaskCluster(cluster.scheduler_address), announce=announce
        )
    fit_fleet(studies, tmp_path / "inline", Inline())
    assert len(killed) == 1 and fleet.errors == {}
    assert (tmp_path / "dask" / "fleet.csv").read_bytes() == (tmp_path / "inline" / "fleet.csv").read_bytes()

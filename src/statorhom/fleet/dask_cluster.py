"""Workers of a dask.distributed scheduler; they see the results folder under the same path."""

from __future__ import annotations

from asyncio import CancelledError
from collections.abc import Callable, Generator, Sequence
from types import ModuleType

from statorhom.errors import IdentificationError, MissingDependencyError
from statorhom.fleet.executor import Lost, Result, Task
from statorhom.study.message import one_line, quoted

CONNECT_S = 10


class DaskCluster:
    """An `Executor` of a cluster; the scheduler gives a dead worker's tasks to others.

    Parameters
    ----------
    address : of the scheduler, such as ``tcp://host:8786``.

    Raises
    ------
    MissingDependencyError
        Where dask.distributed is not installed.
    """

    def __init__(self, address: str) -> None:
        self._distributed = _import_distributed()
        self._address = address

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Generator[tuple[int, Result | Lost]]:
        """See `Executor.run`; how many deaths are too many is the scheduler's setting ``allowed-failures``."""
        client = self._client()
        futures = {}
        try:
            futures = {client.submit(function, task, pure=False): i for i, task in enumerate(tasks)}
            for future in self._distributed.as_completed(list(futures), loop=client.loop):
                yield futures[future], self._result(future)
        finally:
            client.cancel(list(futures))
            client.close()

    def _client(self):  # type: ignore[no-untyped-def]
        """A connection to a scheduler that has workers.

        Raises
        ------
        IdentificationError
            If there is none.
        """
        try:
            client = self._distributed.Client(self._address, timeout=CONNECT_S, set_as_default=False)
        except (OSError, ValueError) as error:
            raise IdentificationError(
                one_line(
                    f"--scheduler {quoted(self._address)}: no scheduler answers there ({error}); "
                    "start one with: dask scheduler"
                )
            ) from None
        try:
            client.wait_for_workers(1, timeout=CONNECT_S)
        except TimeoutError:
            client.close()
            raise IdentificationError(
                f"--scheduler {quoted(self._address)}: it has no workers; start some with: dask worker {self._address}"
            ) from None
        return client

    def _result(self, future):  # type: ignore[no-untyped-def]
        try:
            return future.result()
        except self._distributed.scheduler.KilledWorker as error:
            return Lost(
                f"its workers died, the last one at {error.last_worker.address}; see the worker's log"
            )
        except CancelledError:
            raise IdentificationError(
                f"--scheduler {quoted(self._address)}: it has gone; start it and the batch again, which goes on where "
                "it was"
            ) from None
        except ModuleNotFoundError as error:
            raise IdentificationError(
                one_line(
                    f"the workers at {self._address} cannot import {error.name}; install statorhom there"
                )
            ) from None


def _import_distributed() -> ModuleType:
    try:
        import distributed
    except ModuleNotFoundError:
        raise MissingDependencyError(
            "dask.distributed is not installed; run: pip install 'statorhom[dask]'"
        ) from None
    return distributed

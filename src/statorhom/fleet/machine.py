"""One machine of a fleet, as it travels to whoever fits it."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from threadpoolctl import threadpool_limits

from statorhom.errors import StatorhomError
from statorhom.identify.chain import Chain, chain
from statorhom.identify.stages.settings import Settings
from statorhom.modes.point_shape import TestShapes
from statorhom.results.schema import Results
from statorhom.study.study import StudyFiles

_ONE_AT_A_TIME = threading.Lock()


@dataclass(frozen=True)
class Machine:
    """A study of the fleet and where its results go.

    Parameters
    ----------
    files : the study.
    folder : of its results.
    bases : folder of the reduced bases that all machines share.
    settings : of the run; a machine keeps one process busy.
    measured : shapes of the tests that have recordings.
    """

    files: StudyFiles
    folder: Path
    bases: Path
    settings: Settings
    measured: Mapping[str, TestShapes] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Name of the study."""
        return self.files.study.name

    @property
    def chain(self) -> Chain:
        """Its steps.

        Raises
        ------
        GeometryError
            If the machine is impossible.
        """
        return chain(self.files, self.folder, self.settings, self.bases, self.measured)

    def finished(self) -> Results | None:
        """Its results, where the folder holds all that the inputs as they stand now ask for.

        Raises
        ------
        ResultsError
            If earlier results are damaged or of another study.
        """
        return self.chain.finished()


@dataclass(frozen=True)
class Ending:
    """How the fit of a machine ended.

    Parameters
    ----------
    error : why it has no results, in one line; empty where it has.
    fault : the traceback, where the program itself is at fault.
    """

    error: str = ""
    fault: str = ""


def fit_machine(machine: Machine) -> Ending:
    """Identify all steps of a machine into its folder; steps that are done already stay.

    Never raises: one machine's error must not cost the others their results. In a process with several threads one
    machine is fitted at a time, because the limit on BLAS's threads and gmsh are the process's.
    """
    try:
        with _ONE_AT_A_TIME, threadpool_limits(limits=1):
            machine.chain.run()
    except StatorhomError as error:
        return Ending(str(error))
    except Exception as error:
        return Ending(f"fault of the program: {type(error).__name__}", traceback.format_exc())
    return Ending()

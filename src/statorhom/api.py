"""The Python face of the program: a study that can be simulated, identified and reported."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from statorhom.diagnose.run import diagnose_study
from statorhom.errors import InputFileError
from statorhom.geometry.stator import StatorGeometry, stator_geometry
from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.chain import chain
from statorhom.identify.processes.announce import Announce, silent
from statorhom.identify.stages.recorded_tests import with_recorded_tables
from statorhom.identify.stages.settings import Settings
from statorhom.report import write_report
from statorhom.results.diagnosis import Diagnosis
from statorhom.results.files import check_folder, read_results
from statorhom.results.schema import Results
from statorhom.study.study import StudyFiles, load_study


@dataclass(frozen=True)
class Study:
    """A study file with everything that it names.

    Examples
    --------
    >>> study = Study.load("measurements/van-der-giet-550w/study.toml")  # doctest: +SKIP
    >>> results = study.run("out")  # doctest: +SKIP
    >>> results.stages[0].regions["lamination"].engineering["E_pa"].value  # doctest: +SKIP
    """

    files: StudyFiles

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Study:
        """Read a study.

        Raises
        ------
        InputFileError
            If a file is missing or breaks the contract; one line says which key and what to do.
        """
        return cls(load_study(path))

    @property
    def name(self) -> str:
        """Name of the study."""
        return self.files.study.name

    @property
    def stage_names(self) -> tuple[str, ...]:
        """Names of the steps in their order."""
        return tuple(stage.name for stage in self.files.study.stages)

    @property
    def default_folder(self) -> Path:
        """Where results go unless told otherwise: beside the study."""
        return self.files.path.parent / f"{self.name}-results"

    @property
    def geometry(self) -> StatorGeometry:
        """The machine's geometry.

        Raises
        ------
        GeometryError
            If it is impossible.
        InputFileError
            If the study is of a coupon.
        """
        return stator_geometry(self.files.geometry, self.files.geometry_path)

    def volumes(self, stage: str) -> Mapping[str, float]:
        """Exact volume of every region after a step (m³)."""
        kinds = tuple(s.kind for s in self.files.study.stages[: self.stage_index(stage) + 1])
        geometry = object_geometry(self.files.drawing, self.files.geometry_path)
        return geometry.step(kinds).exact_volumes()

    def stage_index(self, name: str) -> int:
        """Number of a step.

        Raises
        ------
        InputFileError
            If the study has no such step.
        """
        if name not in self.stage_names:
            known = ", ".join(self.stage_names)
            raise InputFileError(f"{self.files.path}: there is no stage {name!r}; choose one of {known}")
        return self.stage_names.index(name)

    def fit(
        self,
        out: str | os.PathLike[str] | None = None,
        *,
        stage: str | None = None,
        seed: int = 1,
        jobs: int = 1,
        announce: Announce = silent,
    ) -> Results:
        """Identify the steps up to `stage` (default: all); steps that are done already are taken from `out`.

        Raises
        ------
        StatorhomError
            If files, masses or tests do not allow it.
        """
        folder = self.default_folder if out is None else Path(out)
        last = None if stage is None else self.stage_index(stage)
        check_folder(folder)
        recorded = with_recorded_tables(self.files, folder, last, announce)
        settings = Settings(seed=seed, jobs=jobs)
        return chain(recorded.files, folder, settings, measured=recorded.shapes).run(last, announce)

    def run(
        self,
        out: str | os.PathLike[str] | None = None,
        *,
        seed: int = 1,
        jobs: int = 1,
        announce: Announce = silent,
    ) -> Results:
        """Identify all steps and write the report.

        Raises
        ------
        StatorhomError
            If files, masses or tests do not allow it.
        """
        folder = self.default_folder if out is None else Path(out)
        results = self.fit(folder, seed=seed, jobs=jobs, announce=announce)
        write_report(folder)
        return results

    def diagnose(
        self,
        out: str | os.PathLike[str] | None = None,
        *,
        seed: int = 1,
        jobs: int = 1,
        apply: bool = False,
        announce: Announce = silent,
    ) -> Diagnosis:
        """Say what physics the study's model left out; writes diagnosis.json and report.html.

        With `apply` the study is written too as it is with the named effect.

        Raises
        ------
        StatorhomError
            If files, masses or tests do not allow it.
        """
        folder = self.default_folder if out is None else Path(out)
        settings = Settings(seed=seed, jobs=jobs)
        found, _ = diagnose_study(self.files, folder, settings, announce, apply=apply)
        write_report(folder)
        return found

    @staticmethod
    def read(folder: str | os.PathLike[str]) -> Results:
        """Results of an earlier run.

        Raises
        ------
        ResultsError
            If the folder holds none.
        """
        return read_results(Path(folder))

"""Blind benchmark of `statorhom diagnose`: make concealed cases, diagnose them, score the answers.

    python benchmarks/blind/run.py --cases 40 --jobs 2

An interrupted run goes on where it was; `--score` only scores what is there. Table and plot go into FIGURES. With
`--go-on` the cases of the table that stands there already are kept with the commits that answered them, and only the
others are run: the whole list takes longer than a working day.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from blind_cases import blind_cases
from blind_kept import kept_rows, refused, write_refused
from blind_report import write_report
from blind_score import scored
from blind_work import PATIENCE_S, Work, diagnose, each, make

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=None, help="how many of the list; all by default")
    parser.add_argument("--group", default=None, help="only single, nothing, outside, double or ambiguous")
    parser.add_argument("--kind", choices=("tables", "frfs"), default=None, help="only cases with these data")
    parser.add_argument("--series", type=int, default=0, help="other machines and draws than the benchmark's")
    parser.add_argument("--make", action="store_true", help="make the cases and do nothing else")
    parser.add_argument("--work", type=Path, default=ROOT / "blind-work", help="folder of cases and runs")
    parser.add_argument("--figures", type=Path, default=ROOT / "benchmarks" / "figures" / "blind")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--patience", type=float, default=PATIENCE_S, help="seconds of a diagnosis")
    parser.add_argument("--go-on", action="store_true", help="keep the rows of FIGURES/cases.csv")
    parser.add_argument("--score", action="store_true", help="score what is there and do nothing else")
    options = parser.parse_args()
    work = Work(options.work, options.patience)
    cases = [
        case
        for case in blind_cases(options.cases, options.series)
        if options.group in (None, case.group) and options.kind in (None, "tables" if case.tables else "frfs")
    ]
    kept = kept_rows(options.figures) if options.go_on else {}
    hopeless = refused(options.figures) if options.go_on else frozenset()
    new = [case for case in cases if case.name not in kept and case.name not in hopeless]
    if not options.score:
        # a process of its own takes seconds to find that a case is there
        each("made", make, work, [case for case in new if not work.truth(case).exists()], options.jobs)
        write_refused(work.refusals(), options.figures)
    if options.make:
        return
    if not options.score:
        each("diagnosed", diagnose, work, new, options.jobs)
    rows = [row for case in cases if (row := kept.get(case.name) or scored(work, case)) is not None]
    print(write_report(rows, options.figures, len(cases)))


if __name__ == "__main__":
    main()

"""Runs a benchmark suite, all methods, and writes its tables into docs/results.md.

``make bench-paper`` and ``make bench-random`` go on where they were interrupted; with other code,
or ``--fresh``, they begin anew.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import time
from pathlib import Path

from etot_cli.commands.bench_compare import load_report
from etot_cli.reporting.bench_report import AverageModel, BenchReport
from tests.measure.journal import code_digest
from tests.measure.markdown import replace_section, table

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "results.md"
RESULTS = ROOT / "results" / "bench"
ORDER = ("task1", "task2", "task3", "task4", "disturbance", "task5", "task6", "task7")
"""The tasks as in the paper's tables."""
PUBLISHED = {
    "rekep": (0, 5, 4, 0, 0, 0, 4, 0, "16.3 %"),
    "rekep_cot": (8, 7, 0, 8, 0, 1, 5, 2, "38.8 %"),
    "reflect": (8, 7, 8, 10, 10, 2, 5, 3, "66.3 %"),
    "etot": (9, 9, 9, 10, 10, 8, 9, 7, "88.8 %"),
    "etot_without_priori": (9, 5, 4, 10, 5, 5, 9, 2, "61.3 %"),
    "etot_without_reflective": (0, 9, 9, 0, 10, 0, 0, 0, "35.0 %"),
    "etot_without_replan": (9, 9, 8, 10, 0, 8, 9, 7, "75.0 %"),
    "etot_kinematic": (3, 5, 4, 0, 5, 0, 0, 0, "21.3 %"),
}
"""The paper's tables: successes in ten trials on a real robot, with GPT-4o; the last row had a
video-generation model where there is a kinematic one here."""
TABLES = {
    "Methods": ("rekep", "rekep_cot", "reflect", "etot"),
    "Ablations": (
        "etot", "etot_without_priori", "etot_without_reflective", "etot_without_replan",
        "etot_kinematic",
    ),
}  # fmt: skip
LIMIT_S = 45 * 60
"""Demanded of eight methods on eight tasks, ten trials each, on two free cores."""
MEMORY_LIMIT_MIB = 700
LEAST_AVERAGE, LEAST_SHARE = 0.95, 0.9
"""Demanded of ``etot`` on average and on every task."""


def main() -> int:
    """Runs a suite and writes its section; 0 when every demand is met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("suite", choices=("paper", "random"))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--trials", type=int)
    parser.add_argument("--fresh", action="store_true", help="forget an unfinished run")
    parser.add_argument("--as-it-is", type=Path, help="run nothing, write a finished run's tables")
    parser.add_argument("--no-write", action="store_true")
    options = parser.parse_args()
    whole, spent_s = False, 0.0
    folder = options.as_it_is or RESULTS / f"{options.suite}-{code_digest()[:12]}"
    if options.as_it_is is None:
        if options.fresh:
            shutil.rmtree(folder, ignore_errors=True)
        whole = not (folder / "bench.json").exists()
        words = ["bench", f"suites/{options.suite}.yaml", "--jobs", str(options.jobs)]
        words += ["--out" if whole else "--resume", str(folder)]
        words += ["--trials", str(options.trials)] if options.trials else []
        begun = time.monotonic()
        etot = [sys.executable, "-m", "etot_cli", *words]
        done = subprocess.run(etot, cwd=ROOT, check=False)
        spent_s = time.monotonic() - begun
        if done.returncode != 0:
            return done.returncode
    report = load_report(folder)
    sections = paper(report) if options.suite == "paper" else rest(report)
    for title, text in sections.items():
        print(f"\n## {title}\n\n{text}")
        if not options.no_write:
            replace_section(PAGE, title, text)
    # Only a run of all the paper's trials in one go says how long these take.
    timed = spent_s if whole and len(report.trials) == 640 else None
    return max([_demand(item, ok) for item, ok in demands(report, timed)])


def _demand(text: str, met: bool) -> int:
    print(f"{'ok  ' if met else 'MISS'} {text}")
    return 0 if met else 1


def demands(report: BenchReport, spent_s: float | None) -> list[tuple[str, bool]]:
    """What is demanded of a run, and whether it is met."""
    means = {item.method: item for item in report.averages}
    own = [row for row in report.rows if row.method == "etot"]
    order = [means[name].rate for name in ("rekep", "rekep_cot", "reflect", "etot")]
    found = [
        (f"no worker above {MEMORY_LIMIT_MIB} MiB", report.peak_mib < MEMORY_LIMIT_MIB),
        ("no trial that could not be carried out", not any(row.errors for row in report.rows)),
        (f"etot at least {LEAST_AVERAGE:.0%} on average", means["etot"].rate >= LEAST_AVERAGE),
        ("rekep ≤ rekep_cot ≤ reflect < etot", order == sorted(order) and order[2] < order[3]),
    ]
    if any(row.task == "task1" for row in own):
        least = min(own, key=lambda row: row.rate)
        found.append((f"etot at least {LEAST_SHARE:.0%} on every task", least.rate >= LEAST_SHARE))
    if spent_s is not None:
        found.append((f"{spent_s / 60:.0f} min of {LIMIT_S / 60:.0f}", spent_s < LIMIT_S))
    return found


def paper(report: BenchReport) -> dict[str, str]:
    """The paper's two tables, ours above each of the published rows, and what trials cost."""
    cells = {(row.method, row.task): row for row in report.rows}
    means = {item.method: item for item in report.averages}
    tasks = [name for name in ORDER if any(task.name == name for task in report.tasks)]
    titles = {method.name: method.title for method in report.methods}
    found = {}
    for name, methods in TABLES.items():
        rows = []
        for method in (method for method in methods if method in means):
            own = (cells.get((method, task)) for task in tasks)
            shown = [f"{row.successes}/{row.trials}" if row else "–" for row in own]
            rows.append([titles[method], *shown, _rate(means[method])])
            *numbers, average = PUBLISHED[method]
            told = dict(zip(ORDER, numbers, strict=True))
            rows.append(["*published*", *(f"*{told[task]}/10*" for task in tasks), f"*{average}*"])
        heads = ["method", *tasks, "average (95 % interval)"]
        found[f"{name} of the paper, simulated"] = table(heads, rows)
    found["Trials of the paper's tasks"] = costs(report)
    return found


def rest(report: BenchReport) -> dict[str, str]:
    """The table that nobody could tune to."""
    titles = {method.name: method.title for method in report.methods}
    pairs = {pair.second: pair for pair in report.comparisons}
    rows = []
    for item in report.averages:
        pair = pairs.get(item.method)
        against = "–" if pair is None else (
            f"{100 * pair.difference:+.0f} ({100 * pair.ci95[0]:+.0f} to {100 * pair.ci95[1]:+.0f})"
        )  # fmt: skip
        p_value = "–" if pair is None else f"{pair.p_adjusted:.2g}"
        rows.append(
            [titles[item.method], f"{item.successes}/{item.trials}", _rate(item), against, p_value]
        )
    heads = ["method", "solved", "rate (95 % interval)", "points against EToT", "p"]
    title = f"{len(report.tasks)} random problems, all methods"
    return {title: table(heads, rows), "Trials of the random problems": costs(report)}


def costs(report: BenchReport) -> str:
    """What a trial of each method cost, and how its failures are classed."""
    titles = {method.name: method.title for method in report.methods}
    rows = [
        [
            titles[item.method],
            f"{item.planning_s:.1f}", f"{item.nodes:.1f}", f"{item.simulated_s:.0f}",
            *(f"{item.times[name]:.1f}" for name in ("physics", "inverse_kinematics", "reasoning")),
            f"{item.wall_s:.1f}", f"{item.replans:.1f}",
            ", ".join(f"{count} {name}" for name, count in item.failures.items()) or "–",
        ]
        for item in report.averages
    ]  # fmt: skip
    heads = ["per trial", "planning s", "nodes", "simulated s", "physics s", "kinematics s",
             "reasoning s", "all s", "replans", "failures"]  # fmt: skip
    return table(heads, rows)


def _rate(item: AverageModel) -> str:
    low, high = item.ci95
    return f"{100 * item.rate:.1f} % ({100 * low:.0f}–{100 * high:.0f})"


if __name__ == "__main__":
    sys.exit(main())

"""Simulates and plans the random problems, checks the outcomes, and writes docs/results.md.

Run with ``make check-random``; a single problem with
``python -m tests.measure.check_random --only drawer:3 -v``, one family with ``--only drawer``.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from contextlib import closing
from dataclasses import asdict, dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any

from etot_cli.benchmark.problems import Problem
from etot_cli.control.simulator import open_simulator
from etot_cli.errors import EtotError
from etot_cli.planning.options import Limits
from etot_cli.planning.search import search
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment, Outcome
from etot_cli.skills.action import parse_plan
from etot_cli.specs.load import load_task
from etot_cli.specs.task import Task
from tests.measure.final_state import Final
from tests.measure.markdown import replace_section, table
from tests.problems.infeasible import COUNTS, Hopeless, any_problem

RESULTS = Path(__file__).resolve().parents[2] / "docs" / "results.md"
SECTION = "Random problems"
SHARE = 0.95
"""Share of the given plans that must succeed, and of the problems that must be solved."""
PATIENCE = 3
"""A problem is given up, and counts as failed, after this many time limits."""


@dataclass
class Tried:
    """What came of one problem."""

    id: str
    instruction: str
    given: str
    feasible: bool
    """Whether it is, by construction."""
    simulated: str = ""
    """``ok``, or why the given plan failed."""
    planned: str = ""
    """``ok``, or why the outcome of planning is wrong."""
    plan: str = ""
    wrongly_feasible: bool = False
    walls_s: list[float] = field(default_factory=list)


class OutOfPatienceError(Exception):
    """The command did not come back."""


def _alarm(_signal: int, _frame: FrameType | None) -> None:
    raise OutOfPatienceError


def try_problem(arguments: tuple[str, int, float, bool]) -> Tried:
    """Simulates the given plan and plans the problem.

    Args:
        arguments: family, seed, time limit of the search [s], whether to plan.
    """
    family, seed, limit_s, planning = arguments
    made = any_problem(family, seed)
    tried = Tried(
        made.id, made.task["instruction"], " ".join(made.plan), not isinstance(made, Hopeless)
    )
    signal.signal(signal.SIGALRM, _alarm)
    with tempfile.TemporaryDirectory() as folder:
        task = load_task(made.write(Path(folder)))
    if made.plan:
        tried.simulated = _guarded(tried, limit_s, lambda: _simulate(made, task))
    if planning:
        tried.planned = _guarded(tried, limit_s, lambda: _plan(made, task, limit_s, tried))
    return tried


def _guarded(tried: Tried, limit_s: float, run: Any) -> str:
    begun = time.perf_counter()
    signal.setitimer(signal.ITIMER_REAL, PATIENCE * limit_s)
    try:
        return str(run())
    except OutOfPatienceError:
        return f"did not end within {PATIENCE * limit_s:g} s"
    except EtotError as error:
        return f"{type(error).__name__}: {error}"
    except Exception as error:  # one crash must not hide the other outcomes
        return f"CRASH {type(error).__name__}: {error}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        tried.walls_s.append(time.perf_counter() - begun)


def _simulate(made: Problem, task: Task) -> str:
    reasoner = BuiltinReasoner()
    with closing(open_simulator(task.scene, seed=0, jobs=1, worlds=1, record=False)) as simulator:
        state, scene = simulator.start()
        for index, action in enumerate(parse_plan(" ".join(made.plan))):
            result = simulator.submit(state, action).result()
            record = result.outcomes[0].record
            verdict = reasoner.judge(action, record)
            if verdict.outcome is not Outcome.SUCCESS:
                cause = verdict.cause
                said = f"{cause.kind.value} {list(cause.objects)} {cause.text}" if cause else "?"
                return f"step {index + 1} {action}: {verdict.outcome.value}: {said}"
            state, scene = result.end, record.after
    broken = Final(made.task, scene).broken()
    return f"every step succeeded, but {', '.join(broken)} does not hold" if broken else "ok"


def _plan(made: Problem, task: Task, limit_s: float, tried: Tried) -> str:
    with closing(open_simulator(task.scene, seed=0, jobs=1, worlds=1, record=False)) as simulator:
        _, start = simulator.start()
        result = search(
            Assignment(task.instruction, task.goal), simulator, BuiltinReasoner(),
            limits=Limits(time_limit_s=limit_s),
        )  # fmt: skip
    tried.plan = " ".join(str(action) for action in result.plan)
    failed = [node for node in result.tree if node.verdict and node.verdict.cause]
    causes = [(str(node.action), node.verdict.cause) for node in failed if node.verdict]
    said = "; ".join(
        f"{action}: {cause.kind.value} {list(cause.objects)} {cause.text}"
        for action, cause in causes
        if cause
    )
    if result.status.value == "feasible":
        scene = start if result.leaf is None else result.rollouts[result.leaf.id].record.after
        broken = Final(made.task, scene).broken()
        tried.wrongly_feasible = bool(broken) or isinstance(made, Hopeless)
        if isinstance(made, Hopeless):
            return f"wrongly feasible: {tried.plan}"
        if broken:
            return f"wrongly feasible: {', '.join(broken)} does not hold after {tried.plan}"
        return "ok"
    if not isinstance(made, Hopeless):
        return f"{result.status.value} ({result.stopped or len(failed)} failed): {said}"
    wanted = made.reason
    true = any(
        cause.kind.value in wanted.kinds and set(wanted.objects) & set(cause.objects)
        for _, cause in causes
        if cause
    )
    if result.status.value != "infeasible":
        return f"{result.status.value} instead of infeasible: {said}"
    return "ok" if true else f"not a true cause, expected {wanted}: {said} {result.stopped}"


def chosen(only: str) -> list[tuple[str, int]]:
    """Families and seeds: all, ``family``, ``family:seed`` or several of these with commas."""
    found: list[tuple[str, int]] = []
    for item in only.split(",") if only else COUNTS:
        name, _, seed = item.partition(":")
        if name not in COUNTS:
            raise SystemExit(f"no family {name!r}; there are {', '.join(COUNTS)}")
        found += [(name, int(seed))] if seed else [(name, s) for s in range(COUNTS[name])]
    return found


def report(results: list[Tried], wanted: int) -> tuple[str, bool]:
    """The table by family, and whether every demand is met for all the ``wanted`` problems."""
    rows: list[list[str]] = []
    families = list(dict.fromkeys(tried.id.split(":")[0] for tried in results))
    solvable = [tried for tried in results if tried.feasible]
    rest = [tried for tried in results if not tried.feasible]
    groups = [(name, [t for t in results if t.id.split(":")[0] == name]) for name in families]
    for name, group in [*groups, ("all solvable", solvable)]:
        if not group or (name == "all solvable" and not solvable):
            continue
        rows.append(
            [
                name,
                str(len(group)),
                _share(group, "simulated") if group[0].feasible else "–",
                _share(group, "planned"),
                str(sum(tried.wrongly_feasible for tried in group)),
                f"{max(tried.walls_s[-1] for tried in group):.1f} s",
            ]
        )
    if len(results) < wanted:
        rows.append(["not measured yet", str(wanted - len(results)), "", "", "", ""])
    heads = ["family", "problems", "given plan carried out", "planned", "wrongly feasible",
             "slowest plan"]  # fmt: skip
    good = (
        len(results) == wanted
        and sum(t.simulated == "ok" for t in solvable) >= SHARE * len(solvable)
        and sum(t.planned == "ok" for t in solvable) >= SHARE * len(solvable)
        and not any(t.wrongly_feasible for t in results)
        and all(t.planned == "ok" for t in rest)
    )
    return table(heads, rows), good


def _share(group: list[Tried], key: str) -> str:
    return f"{sum(getattr(tried, key) == 'ok' for tried in group)}/{len(group)}"


def left(results: list[Tried]) -> str:
    """What failed, with its reason."""
    rows = [
        [tried.id, part, _cell(reason)]
        for tried in results
        for part, reason in (("given plan", tried.simulated), ("planning", tried.planned))
        if reason not in ("", "ok")
    ]
    return table(["left", "in", "reason"], rows) if rows else ""


def _cell(text: str) -> str:
    return text.replace("|", "/").replace("\n", " ")[:300]


def kept(path: Path | None) -> dict[str, Tried]:
    """Outcomes of a run that was stopped, by problem."""
    if path is None or not path.exists():
        return {}
    lines = path.read_text(encoding="utf-8").splitlines()
    return {tried.id: tried for tried in (Tried(**json.loads(line)) for line in lines)}


def main() -> int:
    """Runs the checks; 0 when every demand is met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", help="family, family:seed, or several with commas")
    parser.add_argument("--time-limit", type=float, default=60.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--resume", type=Path, help="keep outcomes there, and skip what it has")
    parser.add_argument("--as-it-is", action="store_true", help="run nothing, report what is kept")
    parser.add_argument("--no-plan", action="store_true", help="simulate the given plans alone")
    parser.add_argument("--write-tasks", type=Path, help="write the task files there and stop")
    parser.add_argument("--no-write", action="store_true")
    parser.add_argument("-v", "--verbose", action="store_true")
    options = parser.parse_args()
    wanted = chosen(options.only)
    if options.write_tasks:
        options.write_tasks.mkdir(parents=True, exist_ok=True)
        for name, seed in wanted:
            print(any_problem(name, seed).write(options.write_tasks))
        return 0
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    known = kept(options.resume)
    work = [
        (name, seed, options.time_limit, not options.no_plan)
        for name, seed in wanted
        if f"{name}:{seed}" not in known and not options.as_it_is
    ]
    results = [known[f"{name}:{seed}"] for name, seed in wanted if f"{name}:{seed}" in known]
    with ProcessPoolExecutor(options.jobs) as pool:
        for tried in pool.map(try_problem, work):
            results.append(tried)
            if options.resume:
                with options.resume.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(asdict(tried)) + "\n")
            times = ", ".join(f"{wall:.1f} s" for wall in tried.walls_s)
            bad = {tried.simulated, tried.planned} - {"", "ok"}
            print(
                f"{'FAIL' if bad else 'ok  '} {tried.id} ({times}) {tried.instruction}", flush=True
            )
            if bad or options.verbose:
                print(f"      given:     {tried.given}\n      simulated: {tried.simulated}")
                print(
                    f"      found:     {tried.plan}\n      planned:   {tried.planned}", flush=True
                )
    order = {f"{name}:{seed}": index for index, (name, seed) in enumerate(wanted)}
    results.sort(key=lambda tried: order[tried.id])
    text, good = report(results, len(wanted))
    rest = left(results)
    print(f"\n{text}\n\n{rest}")
    if not options.only and not options.no_write and not options.no_plan:
        replace_section(RESULTS, SECTION, f"{text}\n\n{rest}" if rest else text)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

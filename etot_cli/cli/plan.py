"""The command ``etot plan``."""

from __future__ import annotations

import sys
from enum import StrEnum
from math import isnan
from pathlib import Path
from typing import Annotated

import typer

from etot_cli.cli.exits import NO, OK
from etot_cli.cli.interrupts import heed
from etot_cli.cli.options import (
    MAX_JOBS,
    Force,
    Html,
    Json,
    Out,
    Quiet,
    Reasoner,
    ReasonerName,
    Seed,
    TaskFile,
    Vary,
    Verbose,
    VlmHints,
    VlmJudge,
    VlmMaxCalls,
    VlmMaxCost,
    VlmModelName,
    VlmRecord,
    VlmReplay,
    VlmUrl,
    WhenToLook,
    model_settings,
)
from etot_cli.cli.session import Session, errors_placed, read_task
from etot_cli.errors import ServiceError
from etot_cli.planning.options import DEFAULT_MAX_NODES, Ablation, Limits
from etot_cli.specs.bounds import MAX_WORLDS
from etot_cli.specs.look import Look

EXPORTS = (".xml", ".pddl.txt", ".pddl", ".zip")
"""Endings of files that --export writes."""
MAX_TIME_LIMIT_S = 366 * 24 * 3600.0
"""A year: what is longer is no limit, and clocks cannot add just any number."""


class Keep(StrEnum):
    """Whose trajectories are written beside the report."""

    PLAN = "plan"
    ALL = "all"


def _a_number(value: float | None) -> float | None:
    """Refuses nan, which no comparison with a bound catches."""
    if value is not None and isnan(value):
        raise typer.BadParameter("nan is not a number of seconds")
    return value


def plan(
    task: TaskFile,
    reasoner: Reasoner = ReasonerName.BUILTIN,
    vary: Vary = False,
    jobs: Annotated[
        int | None,
        typer.Option(
            "--jobs",
            min=1,
            max=MAX_JOBS,
            metavar="N",
            help="Nodes simulated at the same time; changes no result. "
            "[default: the processor cores]",
        ),
    ] = None,
    without: Annotated[
        list[Ablation] | None,
        typer.Option("--without", help="Switch a mechanism off. May be repeated."),
    ] = None,
    max_nodes: Annotated[
        int, typer.Option("--max-nodes", min=1, metavar="N", help="Actions to simulate at most.")
    ] = DEFAULT_MAX_NODES,
    time_limit: Annotated[
        float | None,
        typer.Option(
            "--time-limit",
            min=0.0,
            max=MAX_TIME_LIMIT_S,
            callback=_a_number,
            metavar="S",
            help="Seconds to search at most. [default: no limit]",
        ),
    ] = None,
    worlds: Annotated[
        int | None,
        typer.Option(
            "--worlds",
            min=1,
            max=MAX_WORLDS,
            metavar="N",
            help="Varied worlds in which the plan's odds are told; a few others have a say in "
            "choosing it. [default: as the task says, else 1]",
        ),
    ] = None,
    look: WhenToLook = Look.EACH,
    vlm_url: VlmUrl = None,
    model: VlmModelName = None,
    judge: VlmJudge = None,
    hints: VlmHints = None,
    record: VlmRecord = None,
    replay: VlmReplay = None,
    max_calls: VlmMaxCalls = None,
    max_cost: VlmMaxCost = None,
    export: Annotated[
        list[Path] | None,
        typer.Option(
            "--export",
            metavar="FILE",
            help="Also write the plan as a behaviour tree (.xml) or a PDDL plan (.pddl.txt), or "
            "the scene as MJCF (.zip). May be repeated.",
        ),
    ] = None,
    keep: Annotated[
        Keep,
        typer.Option("--keep", help="Whose trajectories are written: the plan's, or all."),
    ] = Keep.PLAN,
    html: Html = True,
    out: Out = None,
    force: Force = False,
    seed: Seed = 0,
    json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> int:
    """Find a plan that works in the simulator, and say why others do not.

    Exit code 0: a feasible plan, after which the task's success conditions hold; 1: none found, or
    they do not hold; 2: unusable input; 3: the model's endpoint cannot be used; 130: interrupted.
    """
    vlm = model_settings(
        reasoner, vlm_url=vlm_url, model=model, judge=judge, hints=hints, record=record,
        replay=replay, max_calls=max_calls, max_cost=max_cost,
    )  # fmt: skip
    for file in export or ():
        if not file.name.endswith(EXPORTS):
            raise typer.BadParameter(f"--export {file}: expected a name with {', '.join(EXPORTS)}")
    if export:
        from etot_cli.reporting.files import check_place

        for file in export:
            check_place(file)
    given = read_task(task)
    session = Session("plan", task, out=out, json=json, quiet=quiet, verbose=verbose, force=force)
    from etot_cli.commands.plan import PlanOptions, plan_task

    heed()

    options = PlanOptions(
        task=task,
        seed=seed,
        reasoner=reasoner.value,
        vary=vary,
        record=html,
        jobs=jobs,
        worlds=worlds,
        look=look,
        without=frozenset(without or ()),
        limits=Limits(max_nodes=max_nodes, time_limit_s=time_limit),
        vlm=vlm,
    )
    with session.search_observer() as observer, errors_placed(given):
        planning = plan_task(options, observer, given=given)
    report = planning.report
    from etot_cli.commands.trajectories import write_trajectories

    write_trajectories(planning, session.folder, keep_all=keep is Keep.ALL)
    path = session.save(report)
    if html:
        from etot_cli.commands.pages import write_plan_page

        session.add_page(report, lambda told: write_plan_page(planning, session.folder, told))
    if export:
        from etot_cli.commands.export import write_exports

        for warning in write_exports(planning, export):
            print(f"warning: {warning}", file=sys.stderr)
    from etot_cli.reporting.plan_summary import plan_summary

    code = session.conclude(report, path, lambda out: plan_summary(out, report, path))
    if code == OK and report.success is not None and not report.success.holds:
        return NO
    if code == NO and report.statistics.limit == "service":
        raise ServiceError(report.stopped)
    return code

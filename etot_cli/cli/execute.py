"""The command ``etot execute``."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from etot_cli.cli.interrupts import heed
from etot_cli.cli.options import (
    Force,
    Html,
    Json,
    Out,
    Quiet,
    Seed,
    TaskFile,
    TrialJobs,
    Verbose,
)
from etot_cli.cli.session import Session, errors_placed, read_task
from etot_cli.errors import ServiceError
from etot_cli.planning.options import DEFAULT_MAX_NODES, Limits
from etot_cli.specs.bounds import MAX_TRIALS


class Without(StrEnum):
    """What the loop can go without."""

    REPLAN = "replan"


def execute(
    task: TaskFile,
    robot: Annotated[
        str,
        typer.Option(
            "--robot",
            metavar="NAME",
            help="sim, xarm6 or xarm6:ADDRESS, or worker:COMMAND for a robot in another process.",
        ),
    ] = "sim",
    perception: Annotated[
        str,
        typer.Option(
            "--perception",
            metavar="NAME",
            help="state: true poses with the scene's perception error; camera: RGB-D frames.",
        ),
    ] = "state",
    trials: Annotated[
        int, typer.Option("--trials", min=1, max=MAX_TRIALS, metavar="N", help="How often.")
    ] = 1,
    jobs: TrialJobs = 1,
    disturb: Annotated[
        bool,
        typer.Option(
            "--disturb/--no-disturb", help="Whether what the task says of disturbances happens."
        ),
    ] = True,
    without: Annotated[
        list[Without] | None,
        typer.Option("--without", help="replan: the first plan is the only one."),
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Connect, look and plan, but move nothing.")
    ] = False,
    yes: Annotated[
        bool, typer.Option("--yes", help="A real robot may move without asking.")
    ] = False,
    grasp_url: Annotated[
        str | None,
        typer.Option("--grasp-url", metavar="URL", help="A server that proposes grasps."),
    ] = None,
    max_nodes: Annotated[
        int,
        typer.Option("--max-nodes", min=1, metavar="N", help="Actions to simulate per plan."),
    ] = DEFAULT_MAX_NODES,
    video: Annotated[
        bool, typer.Option("--video", help="Render world.mp4 and twin.mp4 of the first trial.")
    ] = False,
    html: Html = True,
    out: Out = None,
    force: Force = False,
    seed: Seed = 0,
    json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> int:
    """Carry a task out in closed loop: act, look, judge, and plan anew when the world disagrees.

    Exit code 0: every trial did the task and harmed nothing; 1: one did not, or the robot stopped
    at a limit; 2: unusable input; 3: robot, camera or another device is not there or was lost;
    130: interrupted.
    """
    if dry_run and video:
        raise typer.BadParameter("--video shows what is moved, and --dry-run moves nothing")
    given = read_task(task)
    session = Session(
        "execute", task, out=out, json=json, quiet=quiet, verbose=verbose, force=force
    )
    from etot_cli.commands.execute import ExecuteOptions, run_execute

    heed()

    options = ExecuteOptions(
        task=task,
        seed=seed,
        trials=trials,
        jobs=jobs,
        disturb=disturb,
        replan=Without.REPLAN not in (without or ()),
        robot=robot,
        perception=perception,
        dry_run=dry_run,
        yes=yes,
        grasp_url=grasp_url,
        record=(html or video) and not dry_run,
        limits=Limits(max_nodes=max_nodes),
    )
    with session.execution_observer() as observer, errors_placed(given):
        execution = run_execute(options, observer, given=given)
    report = execution.report
    path = session.save(report)
    if execution.trials and not report.interrupted:
        from etot_cli.commands.execute_page import write_execute_page, write_films

        try:
            if video:
                with session.progress("rendering film") as told:
                    write_films(execution, session.folder, told)
                session.save(report)
        except KeyboardInterrupt:
            report.interrupted = True
            session.save(report)
        if html and not report.interrupted:
            session.add_page(
                report, lambda told: write_execute_page(execution, session.folder, told)
            )
    from etot_cli.reporting.run_summary import execute_summary

    code = session.conclude(report, path, lambda out: execute_summary(out, report, path))
    if execution.lost and not report.interrupted:
        raise ServiceError(report.reason)
    return code

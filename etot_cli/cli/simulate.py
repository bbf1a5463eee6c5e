"""The command ``etot simulate``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from etot_cli.cli.exits import OK
from etot_cli.cli.interrupts import heed
from etot_cli.cli.options import (
    Force,
    Html,
    Json,
    Out,
    Quiet,
    Seed,
    TaskFile,
    Vary,
    Verbose,
    WhenToLook,
    folder_name,
    refuse_beside,
)
from etot_cli.cli.session import Session, errors_placed, read_task
from etot_cli.specs.look import Look

if TYPE_CHECKING:
    from etot_cli.specs.start_error import StartError


def simulate(
    context: typer.Context,
    task: TaskFile,
    plan: Annotated[
        str | None,
        typer.Option(
            "--plan",
            metavar="PLAN",
            help="The actions, e.g. '[PICK UP, pen] [PUT INTO, holder]', or a report.json of "
            "etot plan.",
        ),
    ] = None,
    capture: Annotated[
        Path | None,
        typer.Option(
            "--capture",
            parser=folder_name,
            metavar="DIR",
            help="Render an RGB-D capture instead of acting.",
        ),
    ] = None,
    noise: Annotated[
        bool, typer.Option("--noise", help="With --capture: as a Kinect would see it.")
    ] = False,
    vary: Vary = False,
    look: WhenToLook = Look.EACH,
    open_loop: Annotated[
        bool,
        typer.Option(
            "--open-loop", help="Send the trajectories of the plan report as they are, unseeing."
        ),
    ] = False,
    error: Annotated[
        str | None,
        typer.Option(
            "--error",
            metavar="5mm,3deg",
            help="With --open-loop: start poses are off by up to so much, drawn by the seed.",
        ),
    ] = None,
    video: Annotated[bool, typer.Option("--video", help="Render video.mp4.")] = False,
    frames: Annotated[bool, typer.Option("--frames", help="Render frames/*.png.")] = False,
    view: Annotated[
        bool,
        typer.Option(
            "--view",
            help="Look at it afterwards: in MuJoCo's viewer where there is a display, else in a "
            "browser.",
        ),
    ] = False,
    html: Html = True,
    out: Out = None,
    force: Force = False,
    seed: Seed = 0,
    json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> int:
    """Carry a plan out in the simulator, judging every action.

    Exit code 0: the plan works and the task is done; 1: it is not; 2: unusable input; 3: pictures
    were asked for without OpenGL, or --view without a viewer; 130: interrupted.
    """
    if capture is not None:
        about_it = ("task", "capture", "noise", "vary", "seed", "force", "quiet")
        refuse_beside(context, "--capture", about_it)
        from etot_cli.commands.capture import run_capture

        folder = run_capture(task, capture, noisy=noise, seed=seed, vary=vary, force=force)
        print(f"capture: {folder}")
        return OK
    if noise:
        raise typer.BadParameter("--noise needs --capture")
    if plan is None:
        raise typer.BadParameter("missing --plan (or --capture to render the scene)")
    if error is not None and not open_loop:
        raise typer.BadParameter("--error needs --open-loop")
    viewer = None
    if view:
        from etot_cli.commands.view import viewer_here

        viewer = viewer_here()  # before the work: without any viewer it would be for nothing
    start_error = None if error is None else _start_error(error)
    given = read_task(task)
    session = Session(
        "simulate", task, out=out, json=json, quiet=quiet, verbose=verbose, force=force
    )
    from etot_cli.commands.pages import write_simulate_page
    from etot_cli.commands.render import render_files
    from etot_cli.commands.simulate import SimulateOptions, run_simulate

    heed()

    options = SimulateOptions(
        task=task,
        plan=plan,
        seed=seed,
        vary=vary,
        look=look,
        open_loop=open_loop,
        error=start_error,
        record=video or frames or view or html,
    )
    with errors_placed(given):
        simulation = run_simulate(options, session.log(), given=given)
    report = simulation.report
    # Saved before rendering: what happened is on record even where OpenGL is missing.
    path = session.save(report)
    if (video or frames) and not report.interrupted:
        try:
            with session.progress("rendering film") as told:
                render_files(
                    simulation,
                    session.folder,
                    video=video,
                    frames=frames,
                    progress=told,
                )
        except KeyboardInterrupt:
            report.interrupted, report.status = True, "interrupted"
            report.cause = report.cause or "stopped while the pictures were being rendered"
        session.save(report)
    if html and not report.interrupted:
        session.add_page(report, lambda told: write_simulate_page(simulation, session.folder, told))
    from etot_cli.reporting.run_summary import simulate_summary

    code = session.conclude(report, path, lambda out: simulate_summary(out, report, path))
    if viewer is not None and not report.interrupted:
        from etot_cli.commands.view import view as look_at

        look_at(simulation, viewer, lambda text: print(text, file=sys.stderr, flush=True))
    return code


def _start_error(text: str) -> StartError:
    """What ``--error`` says."""
    from etot_cli.specs.start_error import parse_start_error

    try:
        return parse_start_error(text)
    except ValueError as error:
        raise typer.BadParameter(f"--error: {error}") from None

"""The command ``etot reconstruct``."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Annotated

import typer

from etot_cli.cli.exits import INTERRUPTED, NO, OK
from etot_cli.cli.interrupts import heed
from etot_cli.cli.options import Force, Html, Json, Out, Quiet, Seed, Verbose
from etot_cli.cli.session import Session, print_json

FARTHEST_M = 5.0
"""No desk of a robot is farther from its base; a larger number is in another unit [m]."""
LOWEST_M, HIGHEST_M = -0.4, 0.6
"""Where a desk's top may lie over the base [m]; the search for the desk has these bounds too."""


def _pairs(items: list[str] | None, flag: str) -> dict[str, str]:
    """``NAME=VALUE`` options as a mapping."""
    found = {}
    for item in items or []:
        name, separator, value = item.partition("=")
        if not separator or not name or not value:
            raise typer.BadParameter(f"{flag} {item!r}: expected NAME=VALUE")
        found[name] = value
    return found


def _numbers(text: str, flag: str, names: str) -> tuple[float, ...]:
    """Numbers that a flag takes, commas between; those after a ``[`` may be missing."""
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        found = ()
    most = names.count(",") + 1
    if not most - names.count("[") <= len(found) <= most or not all(map(math.isfinite, found)):
        raise typer.BadParameter(f"{flag} {text!r}: expected {names}, numbers with commas between")
    return found


def _workspace(text: str) -> tuple[float, ...]:
    x0, x1, y0, y1 = found = _numbers(text, "--workspace", "X0,X1,Y0,Y1")
    if x0 >= x1 or y0 >= y1:
        raise typer.BadParameter(f"--workspace {text!r}: expected X0 < X1 and Y0 < Y1")
    return _metres(found, f"--workspace {text!r}")


def _metres(found: tuple[float, ...], what: str) -> tuple[float, ...]:
    if max(map(abs, found)) > FARTHEST_M:
        raise typer.BadParameter(f"{what}: expected metres, none beyond ±{FARTHEST_M:g}")
    return found


def _standpoint(text: str) -> tuple[float, ...]:
    x, y, yaw, *top = _numbers(text, "--camera-at", "X,Y,YAW[,TOP]")
    return (*_metres((x, y), f"--camera-at {text!r}"), yaw, *_height(top, f"--camera-at {text!r}"))


def _height(top: list[float], what: str) -> list[float]:
    """The optional height of the desk's top."""
    if top and not LOWEST_M <= top[0] <= HIGHEST_M:
        raise typer.BadParameter(
            f"{what}: expected the desk's top at {LOWEST_M:g} to {HIGHEST_M:g} m"
        )
    return top


def reconstruct(
    capture: Annotated[Path, typer.Argument(metavar="CAPTURE_DIR", help="The capture folder.")],
    instruction: Annotated[
        str | None,
        typer.Option("--instruction", metavar="TEXT", help="Names the objects; writes a task."),
    ] = None,
    auto_masks: Annotated[
        bool, typer.Option("--auto-masks", help="Find masks even where the capture has some.")
    ] = False,
    second: Annotated[
        Path | None,
        typer.Option("--second", metavar="DIR", help="The scene with another joint state."),
    ] = None,
    mesh: Annotated[
        list[str] | None, typer.Option("--mesh", metavar="NAME=FILE", help="A known mesh.")
    ] = None,
    library: Annotated[
        Path | None,
        typer.Option("--library", metavar="FILE", help="Known things with their true sizes."),
    ] = None,
    material: Annotated[
        list[str] | None,
        typer.Option("--material", metavar="NAME=MATERIAL", help="What an object is made of."),
    ] = None,
    workspace: Annotated[
        str | None,
        typer.Option(
            "--workspace",
            metavar="X0,X1,Y0,Y1",
            help="Leave out what stands outside this rectangle of the base frame [m].",
        ),
    ] = None,
    ignore: Annotated[
        list[str] | None,
        typer.Option("--ignore", metavar="NAME", help="Leave this thing out; repeatable."),
    ] = None,
    camera_at: Annotated[
        str | None,
        typer.Option(
            "--camera-at",
            metavar="X,Y,YAW[,TOP]",
            help="Where the camera stands [m] and looks [deg]; height and tilt come from the desk, "
            "its top at TOP [m].",
        ),
    ] = None,
    calibrate: Annotated[
        str | None,
        typer.Option(
            "--calibrate",
            metavar="BOARD",
            help="The camera from a chessboard or ChArUco board in the picture: inner corners, "
            "side of a square, first corner [m] and yaw [deg], as in 9x6,25mm@0.35,-0.1,0.",
        ),
    ] = None,
    masks_url: Annotated[
        str | None, typer.Option("--masks-url", metavar="URL", help="A server that finds masks.")
    ] = None,
    mesh_url: Annotated[
        str | None, typer.Option("--mesh-url", metavar="URL", help="A server that makes meshes.")
    ] = None,
    pose_url: Annotated[
        str | None, typer.Option("--pose-url", metavar="URL", help="A server that finds poses.")
    ] = None,
    articulation_url: Annotated[
        str | None,
        typer.Option("--articulation-url", metavar="URL", help="A server that finds joints."),
    ] = None,
    server_timeout: Annotated[
        float,
        typer.Option("--server-timeout", metavar="S", min=0.1, help="Longest wait for a server."),
    ] = 120.0,
    html: Html = True,
    out: Out = None,
    force: Force = False,
    seed: Seed = 0,
    json: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> int:
    """Turn one RGB-D frame into a scene that etot plan uses.

    Exit code 0: the twin is whole; 1: it is usable in part, or the instruction is not understood,
    see the warnings; 2: the capture is unusable; 3: a server is not there; 130: interrupted.
    """
    area = None if workspace is None else _workspace(workspace)
    place = None if camera_at is None else _standpoint(camera_at)
    if place is not None and calibrate is not None:
        raise typer.BadParameter(
            "--camera-at and --calibrate both say where the camera stands; expected one of them"
        )
    from etot_cli.commands.reconstruct import (
        CameraAt,
        Options,
        Workspace,
        read_board,
        reconstruct_capture,
    )

    heed()

    board = None if calibrate is None else read_board(calibrate)
    session = Session(
        "reconstruct", Path(os.path.abspath(capture)), out=out, json=json, quiet=quiet,  # noqa: PTH100
        verbose=verbose, force=force,
    )  # fmt: skip
    folder = session.folder
    options = Options(
        capture=capture, instruction=instruction, auto=auto_masks, second=second,
        materials=_pairs(material, "--material"),
        meshes={name: Path(file) for name, file in _pairs(mesh, "--mesh").items()},
        library=library, masks_url=masks_url, mesh_url=mesh_url, pose_url=pose_url,
        articulation_url=articulation_url, deadline=server_timeout,
        workspace=None if area is None else Workspace(*area), ignore=tuple(ignore or ()),
        camera_at=None if place is None else CameraAt(*place), seed=seed,
    )  # fmt: skip
    reconstruction = reconstruct_capture(options, folder, board)
    report = reconstruction.report
    session.save(report)
    if html and not report.interrupted:
        from etot_cli.commands.reconstruct_page import write_reconstruct_page

        session.add_page(report, lambda told: write_reconstruct_page(reconstruction, folder))
    if json:
        print_json(report)
    else:
        _show(report, folder, reconstruction.problem, quiet=quiet, verbose=verbose)
    if report.interrupted:
        return INTERRUPTED
    return OK if report.status == "success" else NO


def _show(report: object, folder: Path, problem: str, *, quiet: bool, verbose: bool) -> None:
    """``problem``: why the task's instruction is not understood, or nothing."""
    from etot_cli.reporting.reconstruct_report import ReconstructReport
    from etot_cli.reporting.style import counted
    from etot_cli.specs.reading import visible

    assert isinstance(report, ReconstructReport)  # imported late: --help stays quick
    found = counted(len(report.objects), "object")
    why = f"; not understood: {visible(problem.splitlines()[0])}" if quiet and problem else ""
    print(f"{report.status}: {found}, {folder / (report.scene or '')}{why}")
    if quiet:
        return
    for item in report.objects:
        x, y, _ = item.position
        size = " × ".join(f"{1000 * side:.0f}" for side in item.size)
        print(f"  {item.name}: {item.kind}, {size} mm, at ({x:.3f}, {y:.3f}) on {item.support}; "
              f"{100 * item.fit.explained:.0f} % explained")  # fmt: skip
        for warning in item.warnings if verbose else item.warnings[:2]:
            print(f"    note: {visible(warning)}")
    for warning in report.warnings:
        print(f"  note: {visible(warning)}")
    if "page" in report.files:
        print(f"  page: {folder / report.files['page']}")
    if report.task and not problem:
        print(f"  etot plan {folder / report.task}")

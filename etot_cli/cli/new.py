"""The commands ``etot new`` and ``etot tasks``."""

from __future__ import annotations

import json as jsons
import sys
from pathlib import Path
from typing import Annotated

import typer

from etot_cli.cli.exits import NO, OK


def new(
    file: Annotated[Path, typer.Argument(metavar="TASK.yaml", help="The file to write.")],
    instruction: Annotated[
        str | None,
        typer.Option("--instruction", "-i", metavar="TEXT", help="What the robot is to do."),
    ] = None,
    scene: Annotated[
        str | None,
        typer.Option(
            "--scene", metavar="NAME", help="Shipped scene or task, or a file. [default: desk]"
        ),
    ] = None,
    add: Annotated[
        list[str] | None,
        typer.Option(
            "--object",
            metavar="NAME=KIND@X,Y[,COLOR]",
            help="Add an object; also @on OTHER, @in OTHER. May be repeated.",
        ),
    ] = None,
    move: Annotated[
        list[str] | None,
        typer.Option("--move", metavar="NAME@X,Y", help="Move an object of the scene."),
    ] = None,
    remove: Annotated[
        list[str] | None,
        typer.Option("--remove", metavar="NAME", help="Leave an object of the scene out."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace an existing file.")] = False,
) -> int:
    """Write a task of your own, check it, and draw it from above.

    Asks for what is missing where somebody can answer. Exit code 0: the task is ready; 1: it is
    written, but its instruction is not understood; 2: it cannot be as asked for.
    """
    from etot_cli.commands.new import TEMPLATES, NewOptions, write_task
    from etot_cli.reporting.evidence import whereabouts
    from etot_cli.specs.scene import MAX_OBJECTS
    from etot_cli.specs.shipped import shipped_files

    objects = list(add or [])
    if instruction is None:
        if not sys.stdin.isatty():
            raise typer.BadParameter("missing --instruction")
        if scene is None:
            names = ", ".join(shipped_files("scenes"))
            scene = typer.prompt(f"Starting scene ({names}, or a file)", default="desk")
        if not objects:
            print(f"Objects: NAME=KIND@X,Y[,COLOR]; kinds: {', '.join(TEMPLATES)}")
            for _ in range(MAX_OBJECTS):
                answer = typer.prompt(
                    "Another object (empty: no more)", default="", show_default=False
                )
                if not answer:
                    break
                objects.append(answer)
        instruction = typer.prompt("Instruction")
    made = write_task(
        NewOptions(
            file=file,
            instruction=instruction,
            scene=scene or "desk",
            objects=objects,
            moves=move or (),
            removals=remove or (),
            force=force,
        )
    )
    for name, state in made.state.states.items():
        x, y, z = state.position
        print(f"  {name}: ({x:.3f}, {y:.3f}, {z:.3f}) {whereabouts(state)}")
    print(f"  task: {made.file}")
    print(f"  seen from above: {made.drawing}")
    if made.problem:
        print(f"  not understood: {made.problem}")
        return NO
    for number, plan in enumerate(made.plans, 1):
        print(f"  idea {number}: {plan}")
    if not made.plans:
        print("  the instruction holds already; there is nothing to do")
    print(f"  next: etot plan {made.file}")
    return OK


def tasks(
    name: Annotated[
        str | None, typer.Argument(metavar="NAME", help="Print only where this one's file is.")
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print the list as JSON.")] = False,
) -> int:
    """List the tasks that come with the program."""
    from etot_cli.specs.load import load_task
    from etot_cli.specs.shipped import find_shipped, shipped_files

    if name is not None:
        print(find_shipped("tasks", name))
        return OK
    listed = [(stem, load_task(path), path) for stem, path in shipped_files("tasks").items()]
    if json:
        rows = [
            {"name": stem, "instruction": task.instruction, "file": str(path)}
            for stem, task, path in listed
        ]
        print(jsons.dumps(rows, indent=2, ensure_ascii=False))
        return OK
    for stem, task, path in listed:
        print(f"{stem}: {task.instruction}\n  {path}")
    return OK

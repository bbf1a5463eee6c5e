"""Options that several commands share, in one place. Imports nothing heavy: ``--help`` is quick."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

TaskFile = Annotated[Path, typer.Argument(metavar="TASK.yaml", help="The task file.")]
Out = Annotated[
    Path | None,
    typer.Option(
        "--out",
        metavar="DIR",
        help="Folder for the report and its files. [default: results/<command>/<name>-<time>]",
    ),
]
Seed = Annotated[
    int,
    typer.Option("--seed", min=0, max=2**32 - 1, help="Same inputs and seed, same result."),
]
Json = Annotated[
    bool,
    typer.Option("--json", help="Print the report, and nothing else, on standard output."),
]
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Print the answer only.")]
Verbose = Annotated[bool, typer.Option("-v", "--verbose", help="Print more detail.")]
Vary = Annotated[
    bool,
    typer.Option(
        "--vary", help="Draw poses and parameters from the scene's variation by the seed."
    ),
]

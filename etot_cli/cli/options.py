"""Options that several commands share, in one place. Imports nothing heavy: ``--help`` is quick."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from etot_cli.specs.look import Look

MAX_JOBS = 256
"""Processes at most; more of them than any machine has cores for only use its memory up."""


class ReasonerName(StrEnum):
    """Who proposes, judges and reflects."""

    BUILTIN = "builtin"
    VLM = "vlm"


class JudgeName(StrEnum):
    """Who decides whether an action succeeded."""

    STATE = "state"
    VLM = "vlm"
    BOTH = "both"


TaskFile = Annotated[Path, typer.Argument(metavar="TASK.yaml", help="The task file.")]
Out = Annotated[
    Path | None,
    typer.Option(
        "--out",
        metavar="DIR",
        help="Folder for the report and its files. [default: results/<command>/<name>-<time>]",
    ),
]
Force = Annotated[
    bool,
    typer.Option("--force", help="Replace a report that is in the folder already."),
]
Seed = Annotated[
    int,
    typer.Option("--seed", min=0, max=2**32 - 1, help="Same inputs and seed, same result."),
]
Json = Annotated[
    bool,
    typer.Option("--json", help="Print the report, and nothing else, on standard output."),
]
Html = Annotated[
    bool,
    typer.Option(
        "--html/--no-html",
        envvar="ETOT_HTML",
        help="Write report.html beside the report, with pictures of what was tried.",
    ),
]
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Print the answer only.")]
Verbose = Annotated[bool, typer.Option("-v", "--verbose", help="Print more detail.")]
Vary = Annotated[
    bool,
    typer.Option(
        "--vary", help="Draw poses and parameters from the scene's variation by the seed."
    ),
]
WhenToLook = Annotated[
    Look,
    typer.Option(
        "--look",
        help="When the robot looks at a varied world: before each action, or once at the start, "
        "running the twin's motions as they are.",
    ),
]
Reasoner = Annotated[
    ReasonerName, typer.Option("--reasoner", help="Who proposes, judges and reflects.")
]
VlmJudge = Annotated[
    JudgeName | None,
    typer.Option(
        "--judge",
        help="With --reasoner vlm: who decides whether an action succeeded. [default: both]",
    ),
]
VlmUrl = Annotated[
    str | None,
    typer.Option(
        "--vlm-url",
        metavar="URL",
        help="API base of an OpenAI-compatible server. [env: ETOT_VLM_URL, OPENAI_BASE_URL]",
    ),
]
VlmModelName = Annotated[
    str | None,
    typer.Option("--model", metavar="NAME", help="The server's model. [env: ETOT_VLM_MODEL]"),
]
VlmHints = Annotated[
    bool | None,
    typer.Option(
        "--hints/--no-hints",
        help="With --reasoner vlm: tell the model what the simulator knows of a failure's cause. "
        "[default: hints in simulation, none where a camera sees a real robot]",
    ),
]
VlmRecord = Annotated[
    Path | None,
    typer.Option("--record", metavar="DIR", help="Write every exchange with the model there."),
]
VlmReplay = Annotated[
    Path | None,
    typer.Option("--replay", metavar="DIR", help="Take the model's answers from such a folder."),
]
VlmMaxCalls = Annotated[
    int | None,
    typer.Option("--max-calls", min=0, metavar="N", help="Requests to the model at most."),
]
VlmMaxCost = Annotated[
    float | None,
    typer.Option("--max-cost", min=0.0, metavar="X", help="US dollars for the model at most."),
]

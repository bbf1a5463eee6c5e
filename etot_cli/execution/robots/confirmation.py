"""A person's word before a real arm moves for the first time."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import TextIO

from etot_cli.errors import EtotError

Confirm = Callable[[str], None]
"""Told what is about to happen; returns when that is fine and raises when it is not."""


class NotConfirmedError(EtotError):
    """Nobody said that the robot may move (exit 2)."""


def assumed(_: str) -> None:
    """The word was given beforehand, with ``--yes``."""


def require_terminal(source: TextIO | None = None) -> None:
    """Finds out before anything is planned or connected whether somebody can be asked.

    Raises:
        NotConfirmedError: standard input is no terminal.
    """
    if not (source or sys.stdin).isatty():
        raise NotConfirmedError(
            "the robot moves only after a confirmation, and standard input is no terminal; "
            "expected a terminal, or --yes, or --dry-run"
        )


def ask(question: str, source: TextIO | None = None, sink: TextIO | None = None) -> None:
    """Asks the person at the terminal; the answer is ``yes`` in full.

    Raises:
        NotConfirmedError: there is no terminal, or the answer is another.
    """
    require_terminal(source)
    out = sink or sys.stderr
    print(f"{question}\nType 'yes' to let it move: ", end="", file=out, flush=True)
    answer = (source or sys.stdin).readline().strip()
    if answer.lower() != "yes":
        raise NotConfirmedError(f"the robot was not let to move: the answer was {answer[:40]!r}")

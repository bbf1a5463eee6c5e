"""The page beside an execution's report, and the films of its worlds on demand."""

from __future__ import annotations

from pathlib import Path

from etot_cli.commands.execute import Execution
from etot_cli.reporting.files import write_atomically
from etot_cli.reporting.page.execute_page import execute_page
from etot_cli.world.studio import Progress

PAGE_NAME = "report.html"


def write_execute_files(
    execution: Execution,
    folder: Path,
    progress: Progress | None = None,
    *,
    video: bool,
    html: bool,
) -> Path:
    """Writes the page, and the films that were asked for.

    Raises:
        EtotError: a file cannot be written.
        ServiceError: films were asked for, and OpenGL is not there.
    """
    path = folder / PAGE_NAME
    write_atomically(path, execute_page(execution.report, execution.trials))
    return path

"""The page of an execution of several trials, opened in a browser."""

from __future__ import annotations

from pathlib import Path

import pytest

from etot_cli.commands.execute import ExecuteOptions, run_execute
from etot_cli.commands.execute_page import write_execute_page
from tests.execution.test_command import REMOVED, write
from tests.pages.browser import Browser


@pytest.mark.slow
def test_it_tells_what_happened_in_the_order_in_which_it_did(
    browser: Browser, tmp_path: Path
) -> None:
    moved = REMOVED.replace("remove: chosen", "move: chosen, by: [0, -0.1]")
    execution = run_execute(ExecuteOptions(task=Path(write(tmp_path, moved)), trials=2))
    page = write_execute_page(execution, tmp_path)
    browser.check_looks(page)
    rows = browser.run(
        "return [...document.querySelector('tr.look').closest('table').tBodies[0].rows]"
        ".map(row => row.className)"
    )
    assert rows.index("somebody") < [i for i, kind in enumerate(rows) if kind == "look"][1]
    assert rows.index("action") < len(rows) - 1 - rows[::-1].index("look")
    browser.run("document.querySelector('button[data-zoom]').click()")
    assert browser.run("return document.getElementById('zoom').open")
    assert browser.complaints() == [] and browser.fetched() == []

"""Tables and sections of the results pages."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date
from pathlib import Path

MEASURED = "*Measured"
"""How the line begins that says of which day a section's table is."""


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines)


def replace_section(page: Path, title: str, text: str) -> None:
    """Puts a table under ``## title`` with today's date, in place of the one there; prose stays."""
    lines = page.read_text(encoding="utf-8").splitlines() if page.exists() else ["# Results"]
    heading = f"## {title}"
    if heading not in lines:
        lines += ["", heading, ""]
    start = lines.index(heading) + 1
    end = next((i for i in range(start, len(lines)) if lines[i].startswith("## ")), len(lines))
    prose = [line for line in lines[start:end] if not line.startswith(("|", MEASURED))]
    while prose and not prose[-1].strip():
        prose.pop()
    while prose and not prose[0].strip():
        prose.pop(0)
    dated = f"{MEASURED} {date.today()}.*"
    body = ["", *prose, *([""] if prose else []), dated, "", *text.splitlines(), ""]
    page.write_text(
        "\n".join([*lines[:start], *body, *lines[end:]]).rstrip() + "\n", encoding="utf-8"
    )

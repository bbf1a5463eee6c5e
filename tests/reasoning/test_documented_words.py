"""The words in the documentation are those of the grammar's tables.

``python -m tests.reasoning.test_documented_words`` writes them anew.
"""

from __future__ import annotations

from pathlib import Path

from etot_cli.reasoning.language.words import places
from etot_cli.reasoning.language.words.patterns import spellings

PAGE = Path(__file__).parents[2] / "docs" / "instructions.md"
BEGIN = (
    "<!-- written by tests/reasoning/test_documented_words.py from the grammar's tables -->\n"
    "| relation | said as |\n|---|---|\n"
)
END = "<!-- end -->"


def table() -> str:
    rows = [(str(relation), text) for relation, text in places.NEARBY.items()]
    rows += [(", ".join(map(str, regions)), text) for regions, text in places.REGIONS.items()]
    return "".join(f"| `{name}` | {', '.join(spellings(text)[:6])} |\n" for name, text in rows)


def test_the_page_has_the_words_of_the_grammar() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert f"{BEGIN}{table()}{END}" in page, "run python -m tests.reasoning.test_documented_words"


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8")
    head, _, rest = text.partition(BEGIN)
    PAGE.write_text(f"{head}{BEGIN}{table()}{END}{rest.partition(END)[2]}", encoding="utf-8")

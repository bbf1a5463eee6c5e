"""The words in the documentation are those of the grammar's tables.

``python -m tests.reasoning.test_documented_words`` writes them anew.
"""

from __future__ import annotations

import re
from pathlib import Path

from etot_cli.reasoning.language.words import places
from etot_cli.reasoning.language.words.categories import FRUITING, ROUND, SORTS
from etot_cli.reasoning.language.words.lexicon import KIND_GROUPS
from etot_cli.reasoning.language.words.patterns import spellings

PAGE = Path(__file__).parents[2] / "docs" / "instructions.md"
SAID = {FRUITING: "fruit (where there is no other)", ROUND: "round thing"}
"""How sorts are spoken of whose names are no words."""
TABLE = re.compile(r"(<!-- (relations|nouns|categories): [^\n]*-->\n).*?(<!-- end -->)", re.DOTALL)


def tables() -> dict[str, str]:
    """The page's tables by what they are of."""
    rows = [(str(relation), text) for relation, text in places.NEARBY.items()]
    rows += [(", ".join(map(str, regions)), text) for regions, text in places.REGIONS.items()]
    said = [f"| `{name}` | {', '.join(spellings(text)[:6])} |\n" for name, text in rows]
    nouns = [
        f"| `{kind}` | {'; '.join(', '.join(group) for group in groups)} |\n"
        for kind, groups in KIND_GROUPS.items()
    ]
    sorts = [
        f"| {SAID.get(words) or ', '.join(words.split())} | {len(nouns)} "
        f"| {', '.join(sorted(nouns)[:5])} … |\n"
        for words, nouns in SORTS.items()
    ]
    return {
        "categories": "".join(["| said | nouns | such as |\n|---|---|---|\n", *sorts]),
        "relations": "".join(["| relation | said as |\n|---|---|\n", *said]),
        "nouns": "".join(["| kind | nouns |\n|---|---|\n", *nouns]),
    }


def written(page: str) -> str:
    """The page with the words of the grammar."""
    found = tables()
    return TABLE.sub(lambda match: f"{match[1]}{found[match[2]]}{match[3]}", page)


def test_the_page_has_the_words_of_the_grammar() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert len(TABLE.findall(page)) == len(tables())
    assert page == written(page), "run python -m tests.reasoning.test_documented_words"


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")

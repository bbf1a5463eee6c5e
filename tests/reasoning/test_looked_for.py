"""What is but looked for in one sentence is acted on in the next."""

from __future__ import annotations

import pytest

from etot_cli.reasoning.language.grammar.paraphrasing.normalizing import normalized
from etot_cli.reasoning.language.grammar.text.splitting import sentences_of


@pytest.mark.parametrize(
    "asked",
    [
        "Find the cup.",
        "Please, could you look for the cup?",
        "Can you find the cup?",
        "First locate the cup.",
    ],
)
def test_what_is_looked_for_is_part_of_the_next_sentence(asked: str) -> None:
    (only,) = sentences_of(normalized(f"{asked} Put it on the tray."))
    assert only.endswith("the cup, put it on the tray")


@pytest.mark.parametrize(
    "before", ["Put the pen away and find the cup.", "Find the cup, put it down.", "Take the cup."]
)
def test_what_asks_for_more_is_a_sentence_of_its_own(before: str) -> None:
    assert len(sentences_of(normalized(f"{before} Put it on the tray."))) == 2

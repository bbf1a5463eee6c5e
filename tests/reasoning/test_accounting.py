"""A reading that leaves no trace of a word is no reading, whatever rule read over it."""

from __future__ import annotations

import pytest

from etot_cli.reasoning.language.grammar.sentences.accounting import unaccounted
from etot_cli.reasoning.language.grammar.sentences.reader import read

NOUNS = frozenset({"cup", "plate", "drawer"})
PLAIN = "put the cups on the plate and open the drawer"
WORDS = """
    two 3 not never without non neither no all every each both either any other another same only
    remaining red left rightmost far big smallest second top lower open closed first last before
    after finally
"""


@pytest.mark.parametrize("word", WORDS.split())
def test_a_word_without_a_trace_is_missed(word: str) -> None:
    (sentence,) = read(PLAIN, NOUNS).sentences
    words = PLAIN.split()
    for reading in sentence.readings:
        assert unaccounted(words, reading) is None
        if word != "open":  # of which there is one already
            assert unaccounted([*words[:2], word, *words[2:]], reading) == word
    (plain,) = read("put the cup on the plate", NOUNS).sentences
    for reading in plain.readings:
        assert unaccounted(["put", "the", word, "cup"], reading) == word

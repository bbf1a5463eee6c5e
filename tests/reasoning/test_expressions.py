"""Expressions that are compiled late say what ``re`` says."""

import gc
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

import etot_cli.reasoning.language.otherwise
import etot_cli.reasoning.language.refusing  # noqa: F401
from etot_cli.reasoning.language.words.expressions import Expression, _demanded

PIECES = (
    "ab", "cd ", r"\b", "(ab|cd)", "(?:cd)?", "ab?", "c*", "d+", "[abc]", "[^a]d", r"(?=cd)",
    "^", "$", ".", "b{2}", "(?<!a)", r"\w+", "(?:ab|(?:cd)?)", "(?:ab|cd)", "(?P<it>cd|b)",
    "(?<=ab)", "(?!cd|ab)", "(?:a|bc d)?", "(ab|)", r"\n", "(?:ab(?: c)?|cd)",
)  # fmt: skip


@given(st.lists(st.sampled_from(PIECES), min_size=1, max_size=4), st.text("abcd \nB", max_size=12))
@pytest.mark.parametrize("flags", [re.NOFLAG, re.IGNORECASE])
def test_nothing_is_passed_over_that_would_fit(
    flags: re.RegexFlag, pieces: list[str], text: str
) -> None:
    pattern = "".join(pieces)
    try:
        expected = re.sub(pattern, "x", text, flags=flags)
    except re.error:
        return  # such as "ab?" before "b{2}"
    assert Expression(pattern, flags).sub("x", text) == expected


def test_alternatives_in_no_bracket_are_told() -> None:
    with pytest.raises(ValueError, match="brackets"):
        Expression("ab|cd").search("cd")


def test_every_expression_of_the_grammar_keeps_its_alternatives_in_brackets() -> None:
    gc.unfreeze()  # what was there before the first test is told, too
    expressions = [each for each in gc.get_objects() if isinstance(each, Expression)]
    gc.freeze()
    assert len(expressions) > 400
    for expression in expressions:
        list(_demanded(expression._pattern))


@pytest.mark.parametrize(
    ("pattern", "text"),
    [("gimme", "gimme that"), ("can't? wait", "can' wait"), (r"i\.e\.", "i.e."), ("[|]ab", "|ab")],
)
def test_what_stands_in_a_pattern_is_found(pattern: str, text: str) -> None:
    assert Expression(pattern).sub("", text) != text
    assert Expression(pattern).sub("", "zz") == "zz"

"""Rules for requests whose verb stands first, behind "only" ("only then should it go …")."""

from __future__ import annotations

from etot_cli.reasoning.language.grammar.parsers.combinators import either, one_of, sequence, some
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.sentences.chains import JOINED, chained
from etot_cli.reasoning.language.grammar.sentences.clauses import LED_CLAUSE, plain
from etot_cli.reasoning.language.grammar.syntax.clauses import MoveClause, put_to
from etot_cli.reasoning.language.words import predicates

INVERTED = sequence(
    either(
        # "Only after that has been done should the pen be put in the cup"
        sequence("(should|may|can|could|must|shall|will) you", LED_CLAUSE),
        sequence("(are|do) you [allowed|supposed|free] [to]", LED_CLAUSE),
        plain(
            sequence(
                "should, may, can, could, must, shall, will, is, are, has, have, does, do",
                ALL_THINGS,
                f"[to] (go|come|be ({predicates.DONE_WITH_IT}))",
                DESTINATIONS,
                build=put_to,
            )
        ),
        plain(
            sequence(
                "should, may, can, could, must, shall, will, is, are, has, have",
                ALL_THINGS,
                "[to] be",
                one_of({True: "opened, pulled open", False: "closed, shut"}),
                build=MoveClause,
            )
        ),
    ),
    some(JOINED, most=6),
    build=chained,
)
"""What is asked for behind a condition that begins with "only" or "not"."""

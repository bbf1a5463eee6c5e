"""Rules for doors and drawers that are set to a state, or of which a state is told by name."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import COLON, COMMA, LIST, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, State
from etot_cli.reasoning.language.words import manner, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import LEVELS, SIDES, is_descriptive, singular

_ITS = "(the|its|their|an|a)"
_STATE = "(state|position)"
_IN_STATE = sequence(OPEN_OR_CLOSED, _STATE)
_FINAL = optional("final, end, desired, required, target, resulting, wanted")
_STATE_OF = "state, position, status"
_ITS_STATE = either(
    sequence(optional("the"), _FINAL, noun_phrase, _STATE_OF),
    sequence(noun_phrase, "'s", _FINAL, _STATE_OF),
    sequence(optional("the"), _FINAL, _STATE_OF, "of, for", noun_phrase),
)


def _so(np: NounPhrase, word: str) -> EnsureClause:
    """How one thing is to be."""
    return EnsureClause((State((_the(np),), word=word),))


def _the(np: NounPhrase) -> NounPhrase:
    """With the article that tables leave out."""
    return np if np.determiner or np.owner else replace(np, determiner="the")


_TO_STATE = either(
    sequence("[back] to be, [back] to, to ~colon, ~colon", OPEN_OR_CLOSED),
    sequence(f"[back] (to|into|in) {_ITS}, [back] (to|into)", _IN_STATE),
)
SET_TO_STATE = quiet(
    either(
        sequence(
            verbs.SET_TO,
            separated(
                sequence(
                    NP_LIST,
                    silent(optional(manner.FROM_STATE)),
                    _TO_STATE,
                    build=lambda nps, word: State(nps, word=word),
                ),
                LIST,
            ),
            build=EnsureClause,
        ),
        sequence(verbs.SET_TO, _ITS_STATE, "to", OPEN_OR_CLOSED, build=_so),
        *(
            sequence(NP_LIST, *said, build=lambda nps, word: EnsureClause((State(nps, word=word),)))
            for said in (
                (predicates.TO_BE_DONE, f"[then] ({verbs.SET_TO_BE})", _TO_STATE),
                (predicates.MODAL, f"in {_ITS}", _IN_STATE),
            )
        ),
        sequence(
            verbs.KEEP,
            NP_LIST,
            f"in {_ITS}",
            _IN_STATE,
            build=lambda nps, word: EnsureClause((State(nps, word=word, kept=True),)),
        ),
    )
)
"""What is to be brought to a state ("return the drawer to the closed state")."""


def _each(kind: NounPhrase, items: tuple[tuple[NounPhrase, str], ...]) -> EnsureClause | None:
    """How each of several things of a kind is to be, most of them told by a word for which; a
    heading that is none of theirs ("initial conditions: …") is read elsewhere.
    """
    several = singular(kind.head) != kind.head
    named = all(_tells_which(np) or singular(kind.head) in np.words for np, _ in items)
    if not (named or kind.words in _OF_ANY_KIND):
        return None
    states = tuple(State((_of(kind, np),), word=word) for np, word in items)
    return EnsureClause(states) if several and not kind.determiner and not kind.modifiers else None


_WHICH = {*LEVELS, *SIDES}
_OF_ANY_KIND = (("doors",), ("drawers",))
"""What may be called otherwise each by itself ("doors: microwave open, oven closed")."""


def _tells_which(np: NounPhrase) -> bool:
    """Whether only what tells a thing from its like is said of it."""
    return bool(np.words) and all(w in _WHICH or is_descriptive(w) for w in np.words)


def _of(kind: NounPhrase, np: NounPhrase) -> NounPhrase:
    """A thing of a kind where only what tells it from the others is said ("top" of "drawers")."""
    told = _tells_which(np)
    words = (*np.words, *kind.words[:-1], singular(kind.head)) if told else np.words
    return _the(replace(np, words=words, text=" ".join(words) if told else np.text))


_ARE = either(COMMA, "is, should be, must be, to be")
_ROWS = separated(sequence(noun_phrase, optional(_ARE), OPEN_OR_CLOSED), LIST)
STATE_NAMED = quiet(
    either(
        sequence(_ITS_STATE, _ARE, OPEN_OR_CLOSED, build=_so),
        sequence(
            NP_LIST,
            COLON,
            phrase("close, shut", "closed"),
            build=lambda nps, word: EnsureClause((State(nps, word=word),)),
        ),
        sequence(
            optional("set[ting]"),
            noun_phrase,
            "states, positions",
            COLON,
            _ROWS,
            build=lambda np, rows: _each(_several(np), rows),
        ),
        sequence(optional("set[ting]"), noun_phrase, COLON, _ROWS, build=_each),
    )
)
"""How something is to be in the end, in a headline ("final door state: closed")."""


def _several(np: NounPhrase) -> NounPhrase:
    """What "drawer states" are the states of."""
    one = bool(np.words) and singular(np.head) == np.head
    return replace(np, words=(*np.words[:-1], f"{np.head}s")) if one else np

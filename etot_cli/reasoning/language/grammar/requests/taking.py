"""Rules for clauses that pick things up, take them away, empty and uncover what holds them."""

from __future__ import annotations

from typing import Any

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    quiet,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    EMPTY_WORDS,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.requests.piles import COLOR
from etot_cli.reasoning.language.grammar.requests.poses import GRASPED, HELD_SO, KEPT_SO, POSES
from etot_cli.reasoning.language.grammar.requests.unstacking import UNSTACK, is_stack
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    PickClause,
    RemoveClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    NounPhrase,
    Things,
)
from etot_cli.reasoning.language.words import manner, places, verbs
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS
from etot_cli.reasoning.language.words.patterns import spellings

SOURCE = sequence(places.SOURCE, noun_phrase)


def _pick(
    ahead: Any, before: Any, verb: str, things: Things, source: Any, after: Any
) -> PickClause | None:
    if (before and after and before != after) or (ahead and source):
        return None
    poses = tuple(dict.fromkeys(before or after or ()))
    gathered = verb in _GATHERED and things.may_be_several and things.phrases[-1].modifiers
    got = things.taken_from(ahead or source or None)
    return PickClause(got, poses, far_fetched=int(bool(gathered)), fetched=verb in _FETCHED)


_GATHERED = frozenset(spellings(verbs.GATHER))


_FETCHED = frozenset(spellings("fetch[ing], get[ting], retriev(e|ing)"))


PICK = sequence(
    optional(sequence("in, inside, on, from", noun_phrase, OPTIONAL_COMMA), None),
    optional(
        either(
            sequence(POSES, OPTIONAL_COMMA, EMPTY_WORDS),
            sequence(
                HELD_SO, "[~comma] (to|in order to|so as to|and), ~comma, (when|while) [you [are]]"
            ),
        ),
        None,
    ),
    phrase(verbs.PICK),
    THINGS,
    optional("up, straight up"),
    optional(
        either(
            SOURCE,
            sequence("(from|off [of]) the top of, clear of", noun_phrase),
            phrase(places.FROM_THERE, ""),
        ),
        None,
    ),
    silent(optional(manner.BY_HAND)),
    optional(GRASPED, None),
    KEPT_SO,
    build=_pick,
)


NEEDED = either(
    sequence(ALL_THINGS, "need[s]", verbs.PICK, optional("up"), build=PickClause),
    sequence(ALL_THINGS, "need[s]", verbs.REMOVE, optional(SOURCE, None), build=RemoveClause),
)
"""What a thing "needs" ("the cup needs picking up")."""
HAND_OVER = quiet(
    sequence(
        f"hand[ing], giv(e|ing), pass[ing], {verbs.FETCH}",
        THINGS,
        either(phrase("[over] to me"), phrase("over [here], here", "")),
        build=lambda things, to: PickClause(things, to=to),
    )
)


DESKS = [(noun,) for noun in DESK_NOUNS]


def _taken(things: Things, source: NounPhrase) -> RemoveClause | None:
    """What is lifted off the desk is picked up."""
    return None if source.words[-1:] in DESKS else RemoveClause(things, source)


def _removed(verb: str, things: Things, source: NounPhrase | None) -> RemoveClause | None:
    """What is taken from where it is; a tower that is taken down is taken apart."""
    apart = verb in ("take down", "taking down", "break down") and source is None
    stack = len(things.phrases) == 1 and is_stack(things.phrases[0])
    return None if apart and stack else RemoveClause(things, source)


_AWAY = "out, off, away, down"


REMOVE = either(
    sequence(phrase(verbs.REMOVE), THINGS, optional(SOURCE, None), build=_removed),
    UNSTACK,
    sequence(verbs.UNSTACK, THINGS, SOURCE, build=RemoveClause),
    sequence(
        # "Unstack green from blue"
        f"{verbs.UNSTACK}, {verbs.TAKE}, lift[ing]",
        COLOR,
        places.SOURCE,
        COLOR,
        build=lambda color, source: RemoveClause(Things((color,)), source),
    ),
    # Without a source "unload" and "clear" are rather said of what holds them.
    sequence("unload[ing], clear[ing]", THINGS, SOURCE, build=RemoveClause),
    sequence(
        phrase(f"{verbs.BRING}, whisk[ing]"),
        THINGS,
        phrase(_AWAY),
        optional(SOURCE, None),
        build=lambda verb, things, away, source: _removed(f"{verb} {away}", things, source),
    ),
    sequence("lift[ing]", THINGS, "out, off", build=RemoveClause),
    sequence(f"{verbs.GET_OUT}, whisk[ing]", THINGS, "out of, off [of]", noun_phrase, build=_taken),
    sequence(f"{verbs.TAKE}, {verbs.FREE}", THINGS, SOURCE, build=_taken),
    sequence(
        # "Free the cup from the pen" is said of what is in it, "free the pen from the cup" of the
        # pen: only one of them is where that says.
        "clear[ing], empty[ing], free[ing], rid[ding], reliev(e|ing)",
        noun_phrase,
        "of, from",
        THINGS,
        build=lambda source, things: RemoveClause(things, source, freed=True),
    ),
)

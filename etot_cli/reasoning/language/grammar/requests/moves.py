"""Rules for opening and closing, by whichever handle, and for what is to be so if it is not."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    optional,
    phrase,
    quiet,
    sequence,
    silent,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EMPTY_WORDS,
    LIST,
    OPTIONAL_COMMA,
    ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.input import NO_WORD
from etot_cli.reasoning.language.grammar.phrases.being_so import OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.contents import WITH_IN_IT
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.phrases.turns import TURN, turns_of
from etot_cli.reasoning.language.grammar.requests.doors import SET_TO_STATE
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause, MoveClause, Turns
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, predicates, small_words, verbs
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep

_ONE = frozenset({"a", "an", "some", "one", "one of the", "any of the", "any one of the"})


def _if_not_so(subjects: tuple[NounPhrase, ...], word: str, moved: MoveClause) -> MoveClause | None:
    """In "if the drawer is closed, open it": what is open already stays so anyway."""
    again = moved.things.phrases[0].pronoun and len(moved.things.phrases) == 1
    # "If one of the drawers is open, close it" is about the one that is
    one = any(np.determiner in _ONE or np.head in ("anything", "something") for np in subjects)
    if not again or one or moved.opens == (word == "open"):
        return None
    return MoveClause(Things(subjects), moved.opens, guarded=True)


def _in_turn(moved: MoveClause) -> MoveClause | None:
    """Several things that are named, in the order in which they are."""
    nps = moved.things.phrases
    return replace(moved, turns=Turns(all=nps)) if nps[1:] and not moved.things.either else None


def _lifted(things: Things) -> MoveClause:
    """What swings up when it is opened: rather taken, and "it" is what was taken hold of."""
    again = all(np.pronoun for np in things.phrases)
    return MoveClause(things, opens=True, far_fetched=1 + again)


def _shut_with(np: NounPhrase, inside: Modifier) -> MoveClause | None:
    """What is shut with something in it, told as in "close the drawer with the pen in it"."""
    text = f"{np.text} with {inside.phrases[0].text} in it"
    told = replace(np.told_by(inside), text=text)
    shut = inside.prep is Prep.CONTAINING and not np.pronoun
    return MoveClause(Things((told,)), opens=False) if shut else None


def _whatever_opened(text: str) -> MoveClause:
    things = Things((NounPhrase(words=("everything",), text=text),))
    return MoveClause(things, opens=False, whatever_opened=True)


_AHEAD = ((), (COMMA,), ("and",), ("then",), ("please",))
_CLOSE_IT = sequence(
    # "Open the drawer, put the pen in, close"
    Parser(lambda given, at: [(at, NOTHING)] if given.words[:at][-1:] in _AHEAD else []),
    "close [again], shut [again]",
    ahead(COMMA, "and", "then", NO_WORD),
    build=lambda: MoveClause(Things((NounPhrase(pronoun="it", text="it"),)), opens=False),
)
_PLAIN_MOVE = either(
    _CLOSE_IT,
    sequence(
        verbs.CLOSE,
        optional("again"),
        phrase(verbs.WHATEVER_OPENED),
        optional("again, afterwards"),
        build=_whatever_opened,
    ),
    sequence("lift[ing] [up], rais(e|ing)", THINGS, build=_lifted),
    *(
        sequence(verb, THINGS, "up", build=lambda things, opens=opens: MoveClause(things, opens))
        for verb, opens in (("open[ing]", True), ("clos(e|ing), shut[ting]", False))
    ),
    *(
        sequence(verb, THINGS, build=lambda things, opens=opens: MoveClause(things, opens))
        for verb, opens in (
            (
                f"{verbs.OPEN}, (pull[ing]|slid(e|ing)|draw[ing]|eas(e|ing)) out",
                True,
            ),
            (f"{verbs.CLOSE}, (push[ing]|slid(e|ing)|eas(e|ing)|shov(e|ing)) [back] in", False),
        )
    ),
    sequence(
        # "Slide the drawer shut with the pen in it"
        verbs.PUSH_SHUT,
        noun_phrase,
        manner.CLOSED_STATE,
        silent(optional("again")),
        WITH_IN_IT,
        build=_shut_with,
    ),
    *(
        sequence(
            verb, THINGS, particle, build=lambda things, opens=opens: MoveClause(things, opens)
        )
        for verb, particle, opens in (
            (verbs.PULL_OPEN, manner.OPEN_STATE, True),
            ("swing[ing], fling[ing], throw[ing]", "wide", True),
            (verbs.PUSH_SHUT, manner.CLOSED_STATE, False),
            (verbs.PUSH, manner.TO, False),
            ("pull[ing], slid(e|ing), draw[ing], eas(e|ing)", f"[{manner.FULLY}] out", True),
            ("push[ing], slid(e|ing), eas(e|ing), shov(e|ing)", f"[back|{manner.FULLY}] in", False),
            (
                "giv(e|ing)",
                f"{manner.A_PUSH} [so [that] it is|until it is|till it is] (shut|closed),"
                f" {manner.A_PUSH} to (close|shut) it",
                False,
            ),
        )
    ),
)


def _by_handle(handled: tuple[NounPhrase, ...], moved: MoveClause) -> MoveClause | None:
    """In "grasp the handle of the drawer and open it" that is the drawer."""
    again = bool(moved.things.phrases[0].pronoun)
    if again != bool(handled):
        return None
    return replace(moved, things=Things(handled)) if again else moved


def _handled(np: NounPhrase) -> tuple[NounPhrase, ...] | None:
    """What has the handle of "the drawer handle" and "the drawer's handle"."""
    if np.head != "handle":
        return None
    return (
        (replace(np, words=np.words[:-1]),) if np.words[1:] else (np.owner,) if np.owner else None
    )


_HANDLED = either(
    phrase("the handle, its handle", ()),
    sequence("the handle of", noun_phrase, build=lambda np: (np,)),
    sequence(noun_phrase, build=_handled),
)
_BY_HANDLE = either(
    sequence("(pull|pulling|use|grab|grip|hold) (the|its) handle to", _PLAIN_MOVE),
    # "Lift the mug by its handle" is rather about where it is taken.
    sequence(
        _PLAIN_MOVE,
        "(by|with|using) (the|its) handle",
        build=lambda moved: replace(moved, far_fetched=moved.far_fetched + 1),
    ),
    sequence(
        verbs.PICK,
        _HANDLED,
        either(LIST, sequence(OPTIONAL_COMMA, small_words.THEN_JOINTS)),
        _PLAIN_MOVE,
        build=_by_handle,
    ),
)
MOVE = either(
    _PLAIN_MOVE,
    SET_TO_STATE,
    quiet(_BY_HANDLE),
    *(
        sequence(THINGS, said, build=lambda things, opens=opens: MoveClause(things, opens))
        for said, opens in (
            (f"need[s] ({verbs.OPEN.replace(',', '|')})", True),
            (f"need[s] ({verbs.CLOSE.replace(',', '|')})", False),
        )
    ),
    sequence(
        # "Put the pen in and shut the door behind it"
        _PLAIN_MOVE,
        "(behind|on) (it|them)",
        build=lambda moved: None if moved.opens else moved,
    ),
    sequence(
        _PLAIN_MOVE,
        OPTIONAL_COMMA,
        either(phrase(manner.UNLESS_OPEN, True), phrase(manner.UNLESS_CLOSED, False)),
        build=lambda moved, opens: replace(moved, guarded=True) if moved.opens == opens else None,
    ),
    sequence(
        _PLAIN_MOVE,
        OPTIONAL_COMMA,
        valued(TURN, lambda turn: turns_of((turn,))),
        build=lambda moved, turns: replace(moved, turns=turns),
    ),
    sequence(_PLAIN_MOVE, OPTIONAL_COMMA, manner.IN_THIS_ORDER, build=_in_turn),
    sequence(
        # "Both drawers should be open, the lower one first"
        THINGS,
        f"{predicates.MODAL}, {predicates.TO_BE_DONE}",
        OPEN_OR_CLOSED,
        OPTIONAL_COMMA,
        valued(TURN, lambda turn: turns_of((turn,))),
        build=lambda things, word, turns: MoveClause(things, word == "open", turns=turns),
    ),
)
_THEN = either(COMMA, sequence(OPTIONAL_COMMA, "then"))


def _if_not_there(
    subjects: tuple[NounPhrase, ...], where: tuple[Destination, ...], things: Things, there: Any
) -> EnsureClause | None:
    """In "if the cup is not on the tray, put it there": if it is, it stays there anyway."""
    same = [(item.toward, item.targets) for item in where]
    again = same == [(item.toward, item.targets) for item in there]
    (here, *more) = there
    inside = all(item.toward is Toward.INSIDE for item in where)
    words = ("there", *(("in there", "in", "inside") if inside else ("on there",)))
    several = more or where[1:] or where[0].targets[1:]
    again |= here.toward is Toward.HERE and here.word in words and not several
    alone = len(things.phrases) == 1 and bool(things.phrases[0].pronoun)
    return EnsureClause((State(subjects, where, kept=True),)) if alone and again else None


_IF = "[only] if, in case"
_SO_FAR = "already|yet|currently|still|now"
_NOW = optional(f"({_SO_FAR}|right now|at the moment|by now)")
_NOT_SO = valued(OPEN_OR_CLOSED, lambda word: "closed" if word == "open" else "open")
_IF_SO = either(
    sequence(
        _IF,
        NP_LIST,
        f"({predicates.BE.replace(',', '|')}|'s) [{_SO_FAR}], (should|happen[s] to) [{_SO_FAR}] be",
        OPEN_OR_CLOSED,
    ),
    sequence(_IF, NP_LIST, f"(is|are) not [{_SO_FAR}]", _NOT_SO),
    sequence("unless", NP_LIST, f"(is|are|happen[s] to be) [{_SO_FAR}]", _NOT_SO),
)
_IF_EMPTY = either(
    sequence(
        "(if there is|in case there is|should there be) (nothing|not anything) [left|else]",
        "in, inside, on",
        noun_phrase,
    ),
    sequence(_IF, noun_phrase, f"is [{_SO_FAR}] empty"),
)


def _if_empty(np: NounPhrase, moved: MoveClause) -> MoveClause | None:
    """What is closed if nothing is in it is what is empty, and nothing else."""
    (again, *more) = moved.things.phrases
    known = np.determiner in THE_WORDS and np.words and not more and again.pronoun == "it"
    empty = Things((replace(np, words=("empty", *np.words)),))
    return replace(moved, things=empty) if known else None


IF_NOT_SO = quiet(
    either(
        sequence(_IF_EMPTY, _NOW, _THEN, EMPTY_WORDS, _PLAIN_MOVE, build=_if_empty),
        sequence(
            _IF_SO,
            _NOW,
            _THEN,
            EMPTY_WORDS,
            _PLAIN_MOVE,
            build=lambda found, moved: _if_not_so(found[0], found[1], moved),
        ),
        sequence(
            "if",
            NP_LIST,
            "(is|are) not [already|yet|currently]",
            DESTINATIONS,
            optional("already, yet, by now"),
            _THEN,
            EMPTY_WORDS,
            verbs.SET_DOWN,
            THINGS,
            DESTINATIONS,
            build=_if_not_there,
        ),
    )
)
"""A sentence of its own: what follows it might be asked for in that case only."""

"""Rules for how things are to be in the end, one after the other, however that is announced."""

from __future__ import annotations

from operator import add

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.ensuring import ENSURE
from etot_cli.reasoning.language.grammar.conditions.falling import UNHARMED
from etot_cli.reasoning.language.grammar.conditions.predicates import BOTH_ARE
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    sequence,
    silent,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, LIST, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.being_so import ensured
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.phrases.states import ALL_SO, STATE, states
from etot_cli.reasoning.language.grammar.requests.emptying import (
    IS_EMPTY,
    NOTHING_THERE,
    is_emptying,
)
from etot_cli.reasoning.language.grammar.requests.putting import PUT
from etot_cli.reasoning.language.grammar.sentences.chains import BARE_CHAIN, CHAIN, WITH_MORE_SO
from etot_cli.reasoning.language.grammar.sentences.headlines import HEADLINE, PLACED
from etot_cli.reasoning.language.grammar.sentences.joining import Joined, chained, joint
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading, plain
from etot_cli.reasoning.language.grammar.sentences.topics import NAMED
from etot_cli.reasoning.language.grammar.sentences.wishes import TOLD_APART
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    EnsureClause,
    PutClause,
    PutGroup,
    RemoveClause,
    SwapClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Things
from etot_cli.reasoning.language.words import frames, predicates, small_words, verbs


def _swapped(things: Things, rest: Reading) -> Reading | None:
    """Two things that swap places, as it is said again ("swap them, the cup on the tray, …")."""
    groups: list[PutGroup] = []
    for said in rest:
        match said.clause:
            case PutClause(groups=placed):
                groups += placed
            case EnsureClause(states=states):
                if not all(so.destinations and not (so.denied or so.kept) for so in states):
                    return None
                groups += (PutGroup(Things(so.subjects), so.destinations) for so in states)
            case _:
                return None
    swap = SwapClause(things, placed=PutClause(tuple(groups)))
    return (replace(rest[0], clause=swap),)


def _all_wanted(wanted: Reading) -> Reading | None:
    """What is wanted off something, or empty, and what goes where besides ("the pen from the cup"
    may go there, too); or how several things are to be, the first of which with something in it
    (alone, it may be wanted itself).
    """
    first = wanted[0].clause
    match first:
        case RemoveClause():
            said = {*first.things.text.split()}
            so = bool(first.source or {"off", "out"} & said) or is_emptying(first)
        case AvoidClause(avoid=Avoid.PUT, not_left=True):
            so = True
        case EnsureClause():
            so = all(
                isinstance(said.clause, EnsureClause | AvoidClause | RemoveClause)
                for said in wanted
            )
        case _:
            return None
    return wanted if so and wanted[1:] else None


_SO_OR_EMPTY = plain(
    either(sequence(STATE, build=lambda state: EnsureClause((state,))), IS_EMPTY, NOTHING_THERE)
)
_IN_THE_END = either(_SO_OR_EMPTY, plain(either(BOTH_ARE, TOLD_APART)), HEADLINE)
"""How things are, where it is said that they are to be so in the end."""


def _made_so(first: Reading, more: Joined) -> Reading | None:
    """How things are to be, some of them empty; else it is one clause."""
    done = chained(first, more)
    so = done and all(isinstance(said.clause, EnsureClause) for said in done)
    return None if so else done


END_STATES = either(
    sequence(
        # "Here is how the shelf should look: books on the upper board, …"
        either(
            sequence("(here|this|that) is how", NAMED, "(should|must|has to|is to) (look|be)"),
            sequence(NAMED, "(should|must|has to) (look|be) like this"),
            sequence(frames.LIKE_THIS, NAMED, "like this, as follows, this way"),
        ),
        COMMA,
        either(CHAIN, PLACED),
        build=add,
    ),
    sequence(
        # "Set up the shelf so that the cans are on the upper board", "sort the pens so that the red
        # one ends up in the cup and the others on the tray"
        verbs.ARRANGE,
        NAMED,
        small_words.SO_THAT,
        plain(
            either(
                sequence(states, build=EnsureClause),
                sequence(
                    NP_LIST,
                    f"{predicates.BE}, {predicates.LIES}, go[es], belong[s]",
                    ALL_SO,
                    build=lambda nps, said: ensured(*said(nps)),
                ),
            )
        ),
        build=add,
    ),
    sequence(
        # "I want the cup off the tray and the plate there instead", "I want the box with the pen in
        # it and the tray empty"
        predicates.WANTED,
        sequence(BARE_CHAIN, build=_all_wanted),
    ),
    sequence(
        verbs.SWAP,
        THINGS,
        silent(optional(verbs.SWAPPED_ROUND)),
        either(COMMA, sequence(OPTIONAL_COMMA, small_words.SO_THAT)),
        sequence(
            either(_IN_THE_END, plain(either(PUT, ENSURE))),
            some(joint("and", LIST, _IN_THE_END), most=2),
            build=chained,
        ),
        build=_swapped,
    ),
    sequence(
        f"{frames.TASK}, {small_words.END_STATE}",
        _IN_THE_END,
        some(either(joint("and", LIST, _IN_THE_END), WITH_MORE_SO), most=6),
        build=chained,
    ),
    sequence(
        # "Make sure that the box holds the pen and that nothing is on the tray"
        verbs.ENSURE,
        _SO_OR_EMPTY,
        some(
            joint("and", LIST, optional("that"), either(_SO_OR_EMPTY, plain(UNHARMED))),
            least=1,
            most=5,
        ),
        build=_made_so,
    ),
)

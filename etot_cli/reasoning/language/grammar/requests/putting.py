"""Rules for clauses that put things somewhere, with what is said about how and in which order."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
    some,
    spanned,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.trees import UNSAID
from etot_cli.reasoning.language.grammar.phrases.as_many import AS_MANY
from etot_cli.reasoning.language.grammar.phrases.coordination import said_of_all
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, INTO, ONTO
from etot_cli.reasoning.language.grammar.phrases.gapping import RESPECTIVE_GROUPS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import (
    ALL_THINGS,
    CHOICE,
    NP_LIST,
    THINGS,
)
from etot_cli.reasoning.language.grammar.phrases.states import EACH_SHOULD
from etot_cli.reasoning.language.grammar.phrases.steads import PLACE_OF, TAKES_A_PLACE
from etot_cli.reasoning.language.grammar.phrases.successions import (
    FIRST_THEN,
    FROM_FIRST_TO_LAST,
    put_in_turn,
)
from etot_cli.reasoning.language.grammar.phrases.where_not import INSTEAD
from etot_cli.reasoning.language.grammar.requests.additions import (
    CONDITION,
    EXTRA,
    EXTRAS,
    kept_together,
    left,
    put_of,
)
from etot_cli.reasoning.language.grammar.requests.carrying import CARRIED
from etot_cli.reasoning.language.grammar.requests.filling import RECEIVED
from etot_cli.reasoning.language.grammar.requests.finding_places import PLACE_FOUND
from etot_cli.reasoning.language.grammar.requests.flanking import FLANKING, WITH_OTHERS
from etot_cli.reasoning.language.grammar.requests.laying import PUT_DOWN
from etot_cli.reasoning.language.grammar.requests.piles import PUT_ON_COLOR
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUPS
from etot_cli.reasoning.language.grammar.requests.throwing import INSERTED, THROWN
from etot_cli.reasoning.language.grammar.requests.word_order import (
    ALONG_WITH,
    FOLLOWING,
    FRONTED,
    IS_WHERE,
    LISTED,
    NAMED_BEHIND,
    OUT_OF_THE_ROW,
    SAID_AHEAD,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup, Turns, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import (
    forbidden,
    manner,
    nouns,
    places,
    predicates,
    small_words,
    verbs,
)
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, STATES, singular
from etot_cli.reasoning.language.words.patterns import spellings

_STACKS = frozenset(spellings(nouns.STACK))


def _got(gathered: bool, groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    several = gathered and all(group.things.may_be_several for group in groups)
    put = put_of(groups, extras)
    return None if put is None else replace(put, far_fetched=0 if several else 2)


def _stacked(groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    """Each thing on or in another; several on one are a tower."""
    (np, *more), (where, *_) = groups[0].things.phrases, groups[0].destinations
    nested = where.toward is Toward.INSIDE and singular(np.head) == np.head and not more
    put = put_of(groups, extras) if nested or extras or len(groups) > 1 else None
    # "Stack the cups on the tray, the blue one first" lays none beside another.
    in_turn = put is not None and (put.ordered or put.turns != Turns())
    return None if in_turn and groups[0].things.may_be_several else put


def _spread(things: Things, over: tuple[NounPhrase, ...], extras: Any) -> PutClause | None:
    """Several things over some places; one thing is not to be divided."""
    group = PutGroup(things, (Destination(Toward.TO, over),))
    return put_of((group,), extras, Grouping.SPREAD) if things.may_be_several else None


def _beneath(below: Things, above: Things) -> PutClause | None:
    """What something is put under comes to lie on that."""
    several = below.may_be_several or any(np.head in DESK_NOUNS for np in above.phrases)
    put = put_to(above, (Destination(Toward.ON, below.phrases),))
    return None if several else replace(put, far_fetched=1)


def _one_and_the_other(one: Things, where: tuple[Destination, ...], more: Any) -> PutClause | None:
    """Where one of some things is to be, and the other one; in what is closed it may stay so."""
    groups = [PutGroup(one, where)]
    for said, there in more:
        other = NounPhrase("the other", ("one",), text=said)
        groups.append(PutGroup(Things((other,)), there))
        if any(word in STATES for item in there for np in item.targets for word in np.words):
            return None
    return PutClause(tuple(groups), wherever=True)


PUT = either(
    AS_MANY,
    PUT_ON_COLOR,
    PLACE_FOUND,
    RECEIVED,
    sequence(
        either(
            sequence(CHOICE, predicates.MODAL),
            sequence(predicates.WANTED, CHOICE, optional("to be")),
            sequence(verbs.ENSURE, CHOICE, predicates.BE),
        ),
        DESTINATIONS,
        some(
            sequence(
                LIST, phrase("the other [one]"), silent(optional(predicates.BE)), DESTINATIONS
            ),
            most=1,
        ),
        build=_one_and_the_other,
    ),
    sequence(
        either(
            sequence(ALL_THINGS, predicates.MODAL),
            valued(sequence(NP_LIST, EACH_SHOULD, build=said_of_all), Things),
            sequence(predicates.WANTED, ALL_THINGS, optional(predicates.TO_BE_THERE)),
            sequence(predicates.CAN, ALL_THINGS, predicates.BE_PUT),
        ),
        DESTINATIONS,
        some(EXTRA, least=1, most=2),
        build=lambda things, where, extras: put_of((PutGroup(things, where),), extras),
    ),
    sequence(
        optional("let, have"),
        ALL_THINGS,
        TAKES_A_PLACE,
        build=lambda things, stead: put_to(things, (stead,)),
    ),
    sequence(
        # "Give the cup's place to the jar"
        "giv(e|ing)",
        PLACE_OF,
        "[over] to",
        ALL_THINGS,
        build=lambda np, things: put_to(things, (Destination(Toward.STEAD, (np,), "place"),)),
    ),
    FLANKING,
    sequence(
        either(FIRST_THEN, FROM_FIRST_TO_LAST),
        either(
            predicates.MODAL,
            sequence(
                COMMA,
                either(
                    sequence(verbs.PUT, "them [both|all], both [of them], all of them"),
                    sequence("both [of them], all of them, they [both|all]", predicates.MODAL),
                    "both [of them], all [of them]",
                ),
            ),
        ),
        DESTINATIONS,
        silent(optional(sequence(OPTIONAL_COMMA, manner.IN_THIS_ORDER))),
        build=put_in_turn,
    ),
    WITH_OTHERS,
    sequence(
        "(finish|complete|top|crown|extend) [off|up]",
        noun_phrase,
        "with",
        ALL_THINGS,
        build=lambda np, things: (
            put_to(things, (Destination(Toward.ON, (np,)),)) if np.head in _STACKS else None
        ),
    ),
    sequence(
        # "Make sure that the box is on the tray with the pen in it"
        either(
            silent(phrase(verbs.ENSURE)),
            silent(sequence(verbs.ARRANGE, "things, everything, it", small_words.SO_THAT)),
        ),
        ALL_THINGS,
        f"{predicates.BE}, {predicates.LIES}",
        DESTINATIONS,
        CONDITION,
        build=lambda things, where, so: replace(put_to(things, where), conditions=(so,)),
    ),
    SAID_AHEAD,
    FRONTED,
    IS_WHERE,
    FOLLOWING,
    LISTED,
    NAMED_BEHIND,
    ALONG_WITH,
    OUT_OF_THE_ROW,
    sequence(
        # "Pick up the plum and place in the bowl"; "put away" and "set down" are no such words.
        verbs.PLACE,
        either(INTO, ONTO),
        build=lambda where: put_to(Things((NounPhrase(pronoun=UNSAID, text="it"),)), (where,)),
    ),
    sequence(verbs.PUT, FIRST_THEN, OPTIONAL_COMMA, DESTINATIONS, build=put_in_turn),
    sequence(verbs.SET, THINGS, "under, underneath, beneath", THINGS, build=_beneath),
    sequence(
        verbs.DISTRIBUTE,
        THINGS,
        silent(optional("out, up")),
        places.AMONG,
        NP_LIST,
        EXTRAS,
        build=_spread,
    ),
    sequence(
        # "Put the cups in the box and the bin, in any combination"
        f"{verbs.SET}, {verbs.FETCH}",
        ALL_THINGS,
        one_of({Toward.INSIDE: places.INTO, Toward.ON: places.ONTO}),
        NP_LIST,
        OPTIONAL_COMMA,
        manner.ANYHOW,
        build=lambda things, toward, nps: (
            put_to(things, (Destination(toward, nps),)) if things.may_be_several else None
        ),
    ),
    sequence(verbs.STACK, PUT_GROUPS, EXTRAS, build=_stacked),
    PUT_DOWN,
    THROWN,
    INSERTED,
    spanned(sequence(verbs.KEEP, PUT_GROUPS, EXTRAS, build=left), kept_together),
    sequence(
        # "Get the pen in the box" is rather about the pen that is there.
        either(phrase("get[ting]", False), phrase(verbs.GATHER, True)),
        PUT_GROUPS,
        EXTRAS,
        build=_got,
    ),
    sequence(
        either(sequence(forbidden.DO_NOT, verbs.PUT), predicates.NOT_WANTED),
        THINGS,
        INSTEAD,
        build=put_to,
    ),
    sequence(ALL_THINGS, predicates.NOT_BE, INSTEAD, build=put_to),
    sequence(verbs.PUT, RESPECTIVE_GROUPS, build=PutClause),
    CARRIED,  # last: of readings alike, the one before it tells how words were taken
)

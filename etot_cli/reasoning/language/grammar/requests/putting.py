"""Rules for clauses that put things somewhere, with what is said about how and in which order."""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    one_of,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    silent,
    some,
    spanned,
    valued,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    LIST,
    LIST_COMMA,
    OPTIONAL_COMMA,
    WORDS,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.parsers.trees import UNSAID
from etot_cli.reasoning.language.grammar.phrases.as_many import AS_MANY
from etot_cli.reasoning.language.grammar.phrases.beside import BESIDE
from etot_cli.reasoning.language.grammar.phrases.coordination import (
    all_of,
    coordinated,
    said_of_all,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import (
    DESTINATIONS,
    DIRECTED,
    INTO,
    ONTO,
)
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
from etot_cli.reasoning.language.grammar.phrases.where_not import INSTEAD, WHERE
from etot_cli.reasoning.language.grammar.requests.additions import (
    CONDITION,
    EXTRA,
    EXTRAS,
    kept_together,
    left,
    put_of,
)
from etot_cli.reasoning.language.grammar.requests.flanking import (
    ON_BOTH_SIDES,
    beside_others,
    flanking,
    to_others,
)
from etot_cli.reasoning.language.grammar.requests.laying import LAID_DOWN, rather_laid_down
from etot_cli.reasoning.language.grammar.requests.piles import PUT_ON_COLOR
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUP, PUT_GROUPS
from etot_cli.reasoning.language.grammar.requests.taking import SOURCE
from etot_cli.reasoning.language.grammar.requests.throwing import INSERTED, THROWN
from etot_cli.reasoning.language.grammar.requests.word_order import (
    ALONG_WITH,
    BROUGHT,
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
    ONWARD,
    RECEIVER,
    Beside,
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
from etot_cli.reasoning.language.words.lexicon import (
    STATES,
    singular,
)
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

_GOING = either(
    sequence(ALL_THINGS, predicates.MODAL),
    sequence(predicates.WANTED, ALL_THINGS, f"{predicates.DONE}, to (go|be)"),
)


_STACKS = frozenset(spellings(nouns.STACK))


DOWN = (Destination(Toward.HERE, word="down"),)


BACK = (Destination(Toward.HOME),)


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
    beside = put is not None and put.turns != Turns() and groups[0].things.may_be_several
    return None if beside else put


def _put_away(verb: str, groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    """Each thing to its place; "put away everything on the tray" tells what, and not where to."""
    away = verb.endswith("away") and any(group.things.are_any for group in groups)
    if verb.split()[-1] in ("return", "returning", "back"):
        groups = tuple(replace(group, back=True) for group in groups)
    return None if away else put_of(groups, extras)


def _spread(things: Things, over: tuple[NounPhrase, ...], extras: Any) -> PutClause | None:
    group = PutGroup(things, (Destination(Toward.TO, over),))
    return put_of((group,), extras, Grouping.SPREAD)


def _in_after(things: Things, said: str) -> PutClause:
    """Where what was spoken of went."""
    np = NounPhrase(pronoun=said.split()[-1], text=said.split()[-1])
    return put_to(things, (Destination(Toward.WITH, (np,), said),))


def _changing(
    np: NounPhrase, words: tuple[str, ...], source: NounPhrase, where: tuple[Destination, ...]
) -> PutClause | None:
    """From one place to another, both of which have one noun."""
    noun = (*words[:-1], singular(words[-1]))
    if noun == words:
        return None
    named = tuple(w.going_to(lambda to: to.called(*noun) if to.is_elliptic else to) for w in where)
    at = source.called(*noun) if source.is_elliptic else source
    return put_to(Things((np,)).taken_from(at), named)


def _safely(things: Things, rather: bool = True) -> PutClause:
    """Out of the way, of what "the ball in front of the drawer" is said to be in front of, unless
    what comes next ``rather`` tells of what.
    """
    marks = [
        m for np in things.phrases for m in np.modifiers if m.prep in (Prep.FRONT, Prep.BEHIND)
    ]
    if len(things.phrases) > 1 or [m.denied for m in marks] != [False]:
        return replace(put_to(things, DOWN), far_fetched=int(rather))
    away = (Beside(Nearby.AWAY, m.phrases, m.phrases[0].text) for m in marks)
    return put_to(things, (Destination(Toward.BESIDE, beside=tuple(away)),))


def _taken_away(verb: str, things: Things, where: tuple[Beside, ...]) -> PutClause | None:
    """Away from where something stands beside another one; what is in or on that is taken out."""
    if any(item.relation is not Nearby.AWAY for item in where):
        return None
    beside = any(item.text.startswith(_FROM_BESIDE) for item in where)
    put = put_to(things, (Destination(Toward.BESIDE, beside=where),))
    return put if beside else replace(put, far_fetched=1)


def _received(place: NounPhrase, thing: NounPhrase) -> PutGroup:
    return PutGroup(Things((thing,)), (Destination(Toward.TO, (place,)),))


def brought(things: Things, source: Any, where: tuple[Destination, ...]) -> PutGroup:
    """Things from one place to another; "from the lower to the upper board" speaks of boards."""
    lent = source and where[0].targets and coordinated(source, where[0].targets[:1])
    if source and all(item.toward is Toward.TO and not item.word for item in where):
        where = tuple(replace(item, word=ONWARD) for item in where)
    return PutGroup(things.taken_from(lent[0] if lent else source), where)


def _rather_there(text: str, clause: PutClause) -> PutClause:
    """In "grab the cup on top of the shelf" the cup may as well be there by now."""
    return replace(clause, far_fetched=clause.far_fetched + ("on top of" in text))


def _down_or_back(things: Things, where: tuple[Destination, ...]) -> PutClause:
    """Down, or where it was; behind "carry it to the bowl" "and release it" asks for no more."""
    again = any(np.pronoun for np in things.phrases)
    return replace(put_to(things, where), far_fetched=int(again))


OUT_AND_INTO = sequence(
    SOURCE, either(DIRECTED, sequence(LIST, optional(f"go[es], {predicates.LIES}"), DESTINATIONS))
)
"""From one place to another ("out of the box and on the desk")."""


_FROM_BESIDE = ("from ", "away from the front", "away from in front")
_A_PLACE = """
    a [new|nice|good|free|safe|proper] (place|spot|home|seat) [~comma], [some|enough] (room|space)
"""


_ALLOWED = {("you", "may"), ("you", "can"), ("you", "could")}
_NOT_ALLOWED = Parser(
    lambda given, at: [] if _ALLOWED & {*pairwise(given.words[:at])} else [(at, NOTHING)]
)
"""Who says that "you may move it somewhere else" leaves open whether it is moved."""
_NEEDS_A_PLACE = """
    [still] (needs|need|deserves) (a|its|their) [new|safe|proper] (place|spot|home|places|homes),
    (should|must|has to|have to|is to|are to) find (a|its|their) [new|safe|proper] (place|spot|home)
"""


_COMES_AND_GOES = """
    [should|must|has to|have to|can] come[s] (out|off) [of (it|there)] and
    [should|must|has to|have to|can|to] (go|goes|be put|stand|sit|lie|rest)
"""


def _one_and_the_other(one: Things, where: tuple[Destination, ...], more: Any) -> PutClause | None:
    """Where one of some things is to be, and the other one; in what is closed it may stay so."""
    groups = [PutGroup(one, where)]
    for said, there in more:
        other = NounPhrase("the other", ("one",), text=said)
        groups.append(PutGroup(Things((other,)), there))
        if any(word in STATES for item in there for np in item.targets for word in np.words):
            return None
    return PutClause(tuple(groups), wherever=True)


def _suiting(said: tuple[NounPhrase, Things]) -> tuple[PutClause, ...]:
    """What "will do for" something: that goes in there, or it goes in that, whichever can hold the
    other.
    """
    first, things = said
    inside = [(things, first), *((Things((first,)), np) for np in things.phrases[:1])]
    several = things.phrases[1:]
    return tuple(
        put_to(what, (Destination(Toward.INSIDE, (where,)),))
        for what, where in (inside[:1] if several else inside)
    )


PUT = either(
    AS_MANY,
    PUT_ON_COLOR,
    sequence("find[ing], giv(e|ing)", THINGS, _A_PLACE, WHERE, build=put_to),
    sequence(verbs.FIND, _A_PLACE, "for", THINGS, OPTIONAL_COMMA, WHERE, build=put_to),
    sequence(
        either(
            sequence(verbs.FIND, places.A_SAFE_PLACE, "for", THINGS),
            sequence(verbs.FIND, _A_PLACE, "for", THINGS, OPTIONAL_COMMA, places.SAFELY),
            sequence("find[ing], giv(e|ing)", THINGS, places.A_SAFE_PLACE),
            sequence(ALL_THINGS, "[still] (needs|need|deserves)", places.A_SAFE_PLACE),
        ),
        build=_safely,
    ),
    sequence(
        "find[ing] [a|some|enough] (room|space|place|spot)",
        DESTINATIONS,
        "for",
        THINGS,
        build=lambda where, things: put_to(things, where),
    ),
    sequence(ALL_THINGS, _NEEDS_A_PLACE, WHERE, build=put_to),
    variants(sequence(noun_phrase, "(will|would) do for", ALL_THINGS), _suiting),
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
        either(
            sequence(ALL_THINGS, f"{predicates.MODAL}, {predicates.COME_AWAY}"),
            sequence(
                predicates.WANTED, ALL_THINGS, optional(f"{predicates.DONE}, to (come|get|go)")
            ),
        ),
        OUT_AND_INTO,
        build=lambda things, moved: PutClause((brought(things, *moved),)),
    ),
    sequence(ALL_THINGS, _COMES_AND_GOES, DESTINATIONS, build=put_to),
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
    sequence(
        # "The ball should change jars: from the big one into the small one"
        noun_phrase,
        "[should|must|shall|has to|is to|needs to] change[s]",
        WORDS,
        either(COLON, OPTIONAL_COMMA),
        "from",
        noun_phrase,
        DIRECTED,
        build=_changing,
    ),
    sequence(
        # With what is opened next it is rather out of the way of that.
        either(
            sequence(f"{verbs.PUT}, {verbs.FETCH}", THINGS),
            sequence(ALL_THINGS, predicates.MODAL),
            sequence(
                predicates.WANTED, ALL_THINGS, silent(optional(f"to be, {predicates.TO_BE_THERE}"))
            ),
            sequence(verbs.ENSURE, ALL_THINGS, predicates.BE),
        ),
        either(
            phrase("aside, to one side", False),
            sequence(_NOT_ALLOWED, phrase(places.SOMEWHERE_ELSE, False)),
            phrase(places.SAFELY, True),
        ),
        build=_safely,
    ),
    sequence(verbs.PUT_ASIDE, THINGS, build=partial(_safely, rather=False)),
    sequence(phrase(f"{verbs.TAKE}, {verbs.REMOVE}"), THINGS, BESIDE, build=_taken_away),
    sequence(
        ALL_THINGS,
        predicates.COME_AWAY,
        optional("[back|right] (out|off|down|over)"),
        DIRECTED,
        build=put_to,
    ),
    sequence(
        either(sequence(noun_phrase, predicates.RECEIVE), sequence("giv(e|ing)", noun_phrase)),
        ALL_THINGS,
        optional(phrase("each"), ""),
        build=lambda np, things, said: put_to(
            things, (Destination(Toward.TO, all_of((np,), said), RECEIVER),)
        ),
    ),
    sequence(
        # "Box A gets the cup and box B the plate"
        sequence(noun_phrase, predicates.RECEIVE, noun_phrase, build=_received),
        some(sequence(LIST, noun_phrase, noun_phrase, build=_received), least=1, most=4),
        build=lambda first, more: PutClause((first, *more)),
    ),
    sequence(
        BROUGHT,
        optional(sequence(DESTINATIONS, OPTIONAL_COMMA), ()),
        optional("one"),
        ON_BOTH_SIDES,
        noun_phrase,
        silent(optional(places.ONE_AT_EACH_SIDE)),
        build=lambda things, where, said, np: flanking(things, said, np, where),
    ),
    sequence(
        BROUGHT,
        places.NEARBY[Nearby.NEXT_TO],
        noun_phrase,
        OPTIONAL_COMMA,
        "one (on|to) (each|either) side",
        build=lambda things, np: flanking(things, "each", np),
    ),
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
    quiet(
        sequence(
            either(
                sequence(verbs.SET_DOWN, THINGS, phrase("with, together with, in with")),
                sequence(verbs.THROW, THINGS, phrase("in with")),
                sequence(_GOING, phrase("with, together with, in with")),
            ),
            NP_LIST,
            build=beside_others,
        )
    ),
    sequence(
        # "Drop the small ball in after it"
        either(sequence(f"{verbs.SET_DOWN}, {verbs.THROW}", THINGS), _GOING),
        phrase("in (after|behind|along with) (it|them)"),
        build=_in_after,
    ),
    quiet(
        sequence(
            either(sequence("add[ing]", ALL_THINGS), sequence(ALL_THINGS, "go[es], belong[s]")),
            phrase("to"),
            NP_LIST,
            build=to_others,
        )
    ),
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
    sequence(verbs.DISTRIBUTE, THINGS, places.AMONG, NP_LIST, EXTRAS, build=_spread),
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
    spanned(
        sequence(phrase(verbs.SET_DOWN), PUT_GROUPS, EXTRAS, build=_put_away), rather_laid_down
    ),
    sequence(ALL_THINGS, "need[s]", verbs.SET_DOWN, DESTINATIONS, build=put_to),
    LAID_DOWN,
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
    sequence(forbidden.DO_NOT, verbs.PUT, THINGS, INSTEAD, build=put_to),
    sequence(verbs.PUT, RESPECTIVE_GROUPS, build=PutClause),
    spanned(
        sequence(
            verbs.BRING,
            separated(
                sequence(
                    THINGS,
                    # "Off the tray and onto the shelf"
                    optional(sequence(SOURCE, optional(LIST)), None),
                    DIRECTED,
                    build=brought,
                ),
                LIST,
                most=5,
            ),
            # "Get the cup and the pen onto the tray, pen in the cup"
            some(sequence(LIST_COMMA, PUT_GROUP), most=3),
            EXTRAS,
            build=lambda groups, more, extras: put_of((*groups, *more), extras),
        ),
        _rather_there,
    ),
    sequence(
        # "Clear it all off the tray and onto the shelf"
        f"{verbs.REMOVE}, clear[ing], unload[ing]",
        sequence(THINGS, sequence(SOURCE, optional(LIST)), DIRECTED, build=brought),
        build=lambda group: PutClause((group,)),
    ),
    *(
        sequence(verb, THINGS, particle, build=partial(_down_or_back, where=where))
        for verb, particle, where in (
            (verbs.PUT_DOWN, optional("down"), DOWN),
            (verbs.LAY, "down", DOWN),
            (verbs.PUT_BACK, optional("back"), BACK),
        )
    ),
)

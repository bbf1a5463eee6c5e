"""What is filled, loaded, used for things or covered, or receives them."""

from __future__ import annotations

from functools import partial
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    quiet,
    sequence,
    some,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import LIST, OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.parsers.trees import UNPLACED
from etot_cli.reasoning.language.grammar.phrases.coordination import all_of
from etot_cli.reasoning.language.grammar.phrases.destinations import TARGETS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.phrases.turns import TURN
from etot_cli.reasoning.language.grammar.requests.additions import put_of
from etot_cli.reasoning.language.grammar.requests.emptying import emptied
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    CoverClause,
    PutClause,
    PutGroup,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    FILLED,
    RECEIVER,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import places, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import matches_any, singular
from etot_cli.reasoning.language.words.nouns import BODY_NOUNS
from etot_cli.reasoning.language.words.places import ON_IT, Prep

_UPON_IT = (Destination(Toward.HERE, word=ON_IT),)


def _lidded(lids: Things) -> PutClause | None:
    """What was filled gets its lid ("put the lid on")."""
    named = all(np.words and singular(np.words[-1]) == "lid" for np in lids.phrases)
    return put_to(lids, _UPON_IT) if named else None


def _back_on(things: Things) -> PutClause:
    """What was taken off something goes back on that."""
    return PutClause((PutGroup(things, _UPON_IT, back=True),))


def _filled(toward: Toward, np: NounPhrase, things: Things) -> PutClause:
    return put_to(things, (Destination(toward, (np,), FILLED),))


def _filled_in_turn(toward: Toward, np: NounPhrase, things: Things, turns: Any) -> PutClause | None:
    return put_of(_filled(toward, np, things).groups, turns)


def _used(
    np: NounPhrase, toward: Toward, things: Things, more: Any, no: NounPhrase | None = None
) -> PutClause:
    """Each of several vessels gets what it is used for; ``no``: that is not used for it."""
    pairs = (_filled(toward, np, things), *(_filled(Toward.TO, *pair) for pair in more))
    groups = tuple(group for put in pairs for group in put.groups)
    if no is not None:
        ruled_out = Destination(toward, (no,), denied=True)
        groups = tuple(replace(g, destinations=(*g.destinations, ruled_out)) for g in groups)
    return PutClause(groups)


def _used_for(
    nps: tuple[NounPhrase, ...], things: Things | None, toward: Toward
) -> PutClause | None:
    """Things go into or onto any of several, or what was spoken of does into or onto one."""
    if things is not None and len(nps) == 1:
        return None  # that is told above
    if things is None and any(matches_any(np.head, BODY_NOUNS) for np in nps):
        return None  # "use both hands to lift it" is about how
    them = NounPhrase(pronoun=UNPLACED, text="them")
    return put_to(things or Things((them,)), (Destination(toward, nps, FILLED),))


def _fits(things: Things, more: tuple[Things, ...], nps: tuple[NounPhrase, ...]) -> PutClause:
    """What things may be put in, or on: any of some places."""
    all_of_them = tuple(np for each in (things, *more) for np in each.phrases)
    return put_to(Things(all_of_them), (Destination(Toward.TO, nps, FILLED),))


_AS_WELL = "as well as [for], ~comma [and] [also] for, and for"
_WILL_DO = (
    "(is|are|will be|would be) [both|equally|also|just] (fine|ok|okay), (will|would) do [fine]"
)
_ANY_OF = sequence(either(TARGETS, NP_LIST), optional("[~comma] or both"))


FILL = quiet(
    either(
        sequence(
            one_of({Toward.INSIDE: verbs.FILL, Toward.TO: verbs.LOAD}),
            noun_phrase,
            "with",
            THINGS,
            some(sequence(OPTIONAL_COMMA, optional("but, and"), TURN), most=2),
            build=_filled_in_turn,
        ),
        sequence(
            # "Load the pan with the egg, and the tray with the cup"
            one_of({Toward.INSIDE: verbs.FILL, Toward.TO: verbs.LOAD}),
            noun_phrase,
            "with",
            ALL_THINGS,
            some(
                sequence(LIST, noun_phrase, "with", ALL_THINGS, build=lambda *pair: pair),
                least=1,
                most=4,
            ),
            build=lambda toward, np, things, more: _used(np, toward, things, more),
        ),
        sequence(
            "use, choose, select",
            noun_phrase,
            one_of(
                {
                    Toward.INSIDE: f"to (hold|keep|store), {places.TO_HOLD}",
                    Toward.ON: places.TO_BEAR,
                    Toward.TO: "for",
                }
            ),
            ALL_THINGS,
            some(sequence(LIST, noun_phrase, "for", ALL_THINGS, build=lambda *pair: pair), most=4),
            optional(sequence(OPTIONAL_COMMA, "[and|but] not", noun_phrase), None),
            build=_used,
        ),
        sequence(
            # "For the pen the cup or the mug will do"
            "for",
            ALL_THINGS,
            some(sequence(_AS_WELL, ALL_THINGS), most=3),
            OPTIONAL_COMMA,
            either(sequence("use", TARGETS), sequence(TARGETS, _WILL_DO)),
            build=_fits,
        ),
        sequence(
            TARGETS,
            _WILL_DO,
            "for",
            ALL_THINGS,
            build=lambda nps, things: _fits(things, (), nps),
        ),
        sequence(
            # "Use the bigger of the two cups to put the pen in"
            verbs.USE,
            noun_phrase,
            "to",
            verbs.SET,
            ALL_THINGS,
            one_of({Toward.INSIDE: places.INTO, Toward.ON: places.ONTO}),
            build=lambda np, things, toward: _filled(toward, np, things),
        ),
        *(
            sequence(
                "use",
                _ANY_OF,
                optional(sequence("for", ALL_THINGS), None),
                build=partial(_used_for, toward=toward),
            )
            for toward in (Toward.INSIDE, Toward.TO)
        ),
    )
)


COVER = either(
    sequence(verbs.PLACE, THINGS, "on", build=_lidded),
    sequence(verbs.PLACE, THINGS, "back on [again], on again", build=_back_on),
    sequence(verbs.COVER, THINGS, "with", THINGS, build=CoverClause),
    sequence(verbs.COVER, THINGS, optional("with (its|their|a) lid"), build=CoverClause),
    sequence(verbs.UNCOVER, ALL_THINGS, build=partial(emptied, held=Prep.ON)),
)


def _received(place: NounPhrase, thing: NounPhrase) -> PutGroup:
    return PutGroup(Things((thing,)), (Destination(Toward.TO, (place,)),))


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


RECEIVED = either(
    variants(sequence(noun_phrase, "(will|would) do for", ALL_THINGS), _suiting),
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
)

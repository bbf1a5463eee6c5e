"""Rules for clauses that say how things are to be in the end."""

from __future__ import annotations

from functools import partial
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.permitted import anything_but
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    silent,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import LIST, OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.being_so import (
    ALWAYS,
    IS_OPEN_OR_CLOSED,
    NONE,
    OPEN_OR_CLOSED,
    PREDICATE,
    ensured,
    not_left,
    opposite,
    state_of,
    there_is_none,
)
from etot_cli.reasoning.language.grammar.phrases.coordination import disagrees, said_of_all
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.gapping import RESPECTIVE_PLACES, respective
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.phrases.states import (
    ALL_SO,
    EACH_SHOULD,
    IN_OR_ON_IT,
    being,
    containing,
    each_so,
    holding,
    holding_only,
    states,
)
from etot_cli.reasoning.language.grammar.phrases.staying import KEPT_THERE, STAYS, kept_so
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    AS_FOUND,
    AS_SAID,
    Destination,
    NounPhrase,
    State,
    Toward,
)
from etot_cli.reasoning.language.words import forbidden, manner, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, THING_NOUNS, matches_any, word_set
from etot_cli.reasoning.language.words.nouns import is_only


def _held(np: NounPhrase, held: NounPhrase) -> State:
    return State((held,), (Destination(Toward.INSIDE, (np,)),))


def _borne_by(np: NounPhrase, below: NounPhrase) -> EnsureClause | None:
    """What stands on something that it "needs under it"; "something" may be anything."""
    vague = np.pronoun or below.pronoun or matches_any(below.head, THING_NOUNS)
    return None if vague else EnsureClause((State((np,), (Destination(Toward.ON, (below,)),)),))


def _arranged(np: NounPhrase, said: tuple[State, ...]) -> EnsureClause | None:
    """What "arrange everything so that …" asks for stands behind it."""
    general = (*THING_NOUNS, "stack", "tower", "pile")
    vague = np.head in DESK_NOUNS or matches_any(np.head, general)
    plain = (np.pronoun == "it" or (vague and len(np.words) == 1)) and not np.modifiers
    return EnsureClause(said) if plain else None


_GOING = word_set(
    "go goes belong belongs put placed moved brought set stored stowed laid dropped inserted"
)
"""Of what is to be done, rather than how it is to be in the end."""


def _going(verb: str, clause: EnsureClause | None) -> EnsureClause | None:
    """What goes, belongs or is to be put somewhere; what "go" there are several things."""
    if clause is None:
        return None
    if _GOING & {*verb.split()}:
        going = tuple(replace(state, going=not state.word) for state in clause.states)
        clause = replace(clause, states=going)
    odd = disagrees(clause.states[0].subjects, verb)
    return replace(clause, far_fetched=OF_SEVERAL) if odd else clause


def _respectively(
    said: tuple[tuple[NounPhrase, ...], str], where: tuple[Destination, ...]
) -> EnsureClause | None:
    """Each of several things in a place of its own."""
    nps, verb = said
    groups = respective(nps, where)
    if groups is None:
        return None
    states = tuple(State(group.things.phrases, group.destinations) for group in groups)
    going = bool(_GOING & {*verb.split()})
    return EnsureClause(tuple(replace(state, going=going) for state in states))


def _so_wanted(cost: int, nps: tuple[NounPhrase, ...], said: Any) -> EnsureClause | None:
    """How things are to be; "I want the plate on the right" is rather about the plate there."""
    clause = ensured(*said(nps))
    return None if clause is None else replace(clause, far_fetched=cost)


_ALL = phrase("both, all")


_BE_TOGETHER = silent(phrase(predicates.TO_BE_THERE))


_TOGETHER = either(
    sequence(NP_LIST, _BE_TOGETHER, optional(_ALL, ""), build=said_of_all),
    sequence(
        NP_LIST,
        OPTIONAL_COMMA,
        one_of({said: f"{said} [of them]" for said in ("both", "all")}),
        optional(_BE_TOGETHER),
        build=said_of_all,
    ),
)


def _may_be(nps: tuple[NounPhrase, ...], may: str, state: str) -> EnsureClause | None:
    """What can be closed by then is to be closed; "may be closed" asks for it or not, who knows."""
    if _none(nps):
        return ensured(state_of(nps, state))
    alone = any(is_only(np.determiner) for np in nps)
    if alone or (may == "may be" and state != "open"):
        return None
    return EnsureClause((State(nps, word=state, allowed=may == "may be"),))


OF_SEVERAL = 2
"""How far-fetched it is that one thing is meant where several are spoken of."""


_THERE = (Destination(Toward.HERE, word=AS_SAID),)


def _none(nps: tuple[NounPhrase, ...]) -> bool:
    """Whether something is said of no such thing."""
    return all(np.determiner in NONE for np in nps)


def _none_left(nps: tuple[NounPhrase, ...], word: str) -> EnsureClause | None:
    """Who leaves none of some things open closes them."""
    return ensured(state_of(nps, word)) if _none(nps) else None


def _meant_for(nps: tuple[NounPhrase, ...], where: NounPhrase) -> State:
    """That things are in what they are for."""
    return State(nps, (Destination(Toward.INSIDE, (where,)),))


_STILL_NEEDED = "(i|we) [will|shall|do] still (need|want|require), (i|we) (will|shall) need"
"""Before what is to be left open or closed."""
_ARE_STILL = sequence(
    NP_LIST, silent(optional("[to be] [left|kept]")), OPEN_OR_CLOSED, build=not_left
)

ENSURE = either(
    sequence(verbs.ENSURE, states, build=EnsureClause),
    sequence(
        "let, have",
        NP_LIST,
        "be",
        OPEN_OR_CLOSED,
        build=lambda nps, word: ensured(state_of(nps, word)),
    ),
    sequence(
        # "Those parcels are for the bin"
        NP_LIST,
        "is for, are for",
        noun_phrase,
        build=lambda nps, where: EnsureClause((_meant_for(nps, where),)),
    ),
    sequence(
        # "The butter is for the white bowl and the cheese for the black one"
        NP_LIST,
        "is for, are for",
        noun_phrase,
        some(
            sequence(LIST, NP_LIST, "[is|are] for", noun_phrase, build=_meant_for),
            least=1,
            most=4,
        ),
        build=lambda nps, where, more: EnsureClause((_meant_for(nps, where), *more)),
    ),
    sequence(
        # "The beaker is for the red vial and the tray for the marker"
        noun_phrase,
        "is for",
        NP_LIST,
        some(
            sequence(
                LIST, noun_phrase, "for", NP_LIST, build=lambda np, held: _meant_for(held, np)
            ),
            most=4,
        ),
        build=lambda np, held, more: EnsureClause((_meant_for(held, np), *more), far_fetched=1),
    ),
    sequence(
        # "The cup and the pen belong on the tray and in the box, respectively"
        either(
            sequence(NP_LIST, phrase(predicates.MODAL)),
            sequence(NP_LIST, phrase("go")),
            sequence(
                verbs.ENSURE,
                NP_LIST,
                phrase(f"{predicates.BE}, {predicates.LIES}, go[es], belong[s]"),
            ),
            sequence(predicates.WANTED, NP_LIST, optional(phrase(predicates.TO_BE_THERE), "")),
            sequence(predicates.CAN, NP_LIST, phrase(predicates.BE_PUT)),
        ),
        RESPECTIVE_PLACES,
        build=_respectively,
    ),
    sequence(
        # "The vase needs a mat under it"
        noun_phrase,
        "needs, need, wants, (should|must|has to|needs to|is to) (have|get|stand on|sit on)",
        noun_phrase,
        "under it, underneath it, beneath it, below it, under them, underneath them",
        build=_borne_by,
    ),
    sequence(verbs.ARRANGE, noun_phrase, small_words.SO_THAT, states, build=_arranged),
    sequence(
        f"{verbs.KEEP}, {_STILL_NEEDED}",
        NP_LIST,
        OPEN_OR_CLOSED,
        silent(optional(manner.AS_NOW)),
        ALWAYS,
        build=kept_so,
    ),
    sequence(
        # "Open the drawer, put the pen in, leave open"
        verbs.KEEP,
        OPEN_OR_CLOSED,
        build=lambda word: kept_so((NounPhrase(pronoun="it", text="it"),), word),
    ),
    sequence(
        # "Leave the oven with its door open"
        either(
            sequence(verbs.KEEP, noun_phrase, "with"),
            sequence(noun_phrase, f"{predicates.MODAL}, stay[s], remain[s]", "with"),
            sequence(noun_phrase, "(should|must) have"),
        ),
        "(its|the) door[s]",
        OPEN_OR_CLOSED,
        build=lambda np, state: EnsureClause((State((np,), word=state),)),
    ),
    sequence(NP_LIST, predicates.MODAL, OPEN_OR_CLOSED, small_words.ALL_ALONG, build=kept_so),
    sequence(
        # "The drawer gets closed", "the drawer ends closed"
        NP_LIST,
        "get[s], end[s] [up]",
        OPEN_OR_CLOSED,
        build=lambda nps, state: EnsureClause((State(nps, word=state),)),
    ),
    sequence(
        # "… and then that drawer can be closed"
        NP_LIST,
        phrase("(can|may|could) be"),
        OPEN_OR_CLOSED,
        build=_may_be,
    ),
    sequence(forbidden.DO_NOT, verbs.KEEP, NP_LIST, OPEN_OR_CLOSED, build=not_left),
    sequence(verbs.KEEP, NP_LIST, OPEN_OR_CLOSED, build=_none_left),
    sequence(
        verbs.KEEP,
        NP_LIST,
        manner.AS_FOUND,
        build=lambda nps: EnsureClause((State(nps, word=AS_FOUND),)),
    ),
    sequence(
        # "No cup but the red one is allowed on the tray"
        NP_LIST,
        "(is|are) (allowed|permitted|welcome|wanted) [to (be|stand|lie|go|stay)]",
        DESTINATIONS,
        build=lambda nps, so: ensured(state_of(nps, so)) if _none(nps) else None,
    ),
    sequence(
        # "Only the cup is allowed on the tray"
        "only",
        NP_LIST,
        "(is|are) (allowed|permitted|welcome) [to be], (may|can) be",
        DESTINATIONS,
        build=lambda nps, so: ensured(
            opposite((anything_but(nps, tuple(np for item in so for np in item.targets)),), so)
        ),
    ),
    sequence(
        # "I do not need the microwave open anymore"
        either(
            sequence("(i|we) do not need", _ARE_STILL, small_words.ANY_MORE),
            sequence("(i|we) no longer (need|want)", _ARE_STILL),
        ),
    ),
    sequence(
        "(i|we) do not want",
        sequence(noun_phrase, build=there_is_none),
        optional(predicates.TO_BE_THERE),
        DESTINATIONS,
        optional(small_words.ANY_MORE),
        build=lambda nps, so: ensured(state_of(nps, so)),
    ),
    quiet(
        sequence(
            either(
                sequence(NP_LIST, predicates.NOT_BE),
                sequence(
                    "(i|we) do not want",
                    either(
                        NP_LIST,
                        sequence(
                            separated(noun_phrase, "or, nor"),
                            build=lambda nps: nps if nps[1:] else None,
                        ),
                    ),
                    optional(predicates.TO_BE_THERE),
                    optional("left, lying, standing, sitting"),
                ),
                sequence(
                    "neither",
                    separated(noun_phrase, "nor"),
                    f"{predicates.MODAL}, {predicates.STAY}",
                    build=lambda nps: nps if nps[1:] else None,
                ),
            ),
            either(IS_OPEN_OR_CLOSED, DESTINATIONS),
            optional(f"{small_words.ANY_MORE}, like (this|that)"),
            build=lambda nps, so: ensured(opposite(nps, so)),
        )
    ),
    *(
        # "…, the tape should not", "…, the can should": go there, which was spoken of
        sequence(NP_LIST, said, build=lambda nps, so=so: ensured(so(nps, _THERE)))
        for said, so in (
            ("(does|do|should|must) not", opposite),
            ("does, do, should, must, shall", State),
        )
    ),
    sequence(
        # "The tray should have the cup in it and the box the plate"
        containing(predicates.CONTAIN),
        some(sequence(LIST, noun_phrase, noun_phrase, build=_held), least=1, most=4),
        build=lambda first, more: EnsureClause((first, *more)),
    ),
    sequence(
        predicates.WANTED,
        either(
            containing("to (contain|hold|have)"),
            containing("to (carry|bear|support)", Toward.ON),
            holding_only(predicates.HOLDING),
        ),
        build=lambda state: EnsureClause((state,)),
    ),
    valued(
        either(
            sequence(optional("let"), STAYS),
            KEPT_THERE,
            being(f"(end[s]|wind[s]|finish[es]) up [{predicates.BEING}]"),
            containing(predicates.CONTAIN),
            containing(predicates.TO_CARRY, Toward.ON),
            sequence(noun_phrase, predicates.END_WITH, NP_LIST, IN_OR_ON_IT, build=holding),
        ),
        lambda state: EnsureClause((state,)),
    ),
    quiet(
        sequence(
            NP_LIST,
            EACH_SHOULD,
            PREDICATE,
            build=lambda *said: ensured(each_so(*said)),
        )
    ),
    sequence(
        NP_LIST,
        phrase(predicates.MODAL),
        ALL_SO,
        build=lambda nps, verb, said: _going(verb, ensured(*said(nps))),
    ),
    *(
        sequence(*said, ALL_SO, build=partial(_so_wanted, cost))
        for cost, said in (
            (0, (predicates.WANTED, _TOGETHER)),
            (1, (predicates.WANTED, NP_LIST)),
            (0, (predicates.CAN, NP_LIST, predicates.BE_PUT)),
            (0, (predicates.THERE_BE, NP_LIST, silent(optional(predicates.BEING)))),
            (0, (verbs.ENSURE, predicates.THERE_IS, NP_LIST)),
            (0, (sequence(predicates.THERE_NOT_BE, noun_phrase, build=there_is_none),)),
        )
    ),
)

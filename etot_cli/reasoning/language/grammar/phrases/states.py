"""Rules for what is to be open, closed or somewhere."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    Rule,
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    silent,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.being_so import NONE, PREDICATE, ensured, state_of
from etot_cli.reasoning.language.grammar.phrases.coordination import all_of
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.phrases.staying import KEPT_THERE, STAYS, staying
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    State,
    Toward,
)
from etot_cli.reasoning.language.words import predicates, small_words
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep

IN_OR_ON_IT = either(phrase("in it, inside", Toward.INSIDE), phrase("on it", Toward.ON))
_AS_WELL = sequence(OPTIONAL_COMMA, f"and, {small_words.AS_WELL_AS}", NP_LIST)


def holding(
    np: NounPhrase, held: tuple[NounPhrase, ...], toward: Toward, more: tuple[NounPhrase, ...] = ()
) -> State | None:
    """What is in or on something; "the cup on it" is no cup on another one that it has."""
    behind = held[-1].modifiers[-1:]
    told = any(n.pronoun == "it" for m in behind if m.prep in (Prep.IN, Prep.ON) for n in m.phrases)
    return None if told and held[1:] else State((*held, *more), (Destination(toward, (np,)),))


def _holding_together(np: NounPhrase, held: tuple[NounPhrase, ...], toward: Toward) -> State | None:
    """What one thing is to hold "together", which says that of one anyway."""
    one = singular(np.head) == np.head or np.determiner.startswith("one of")
    return holding(np, held, toward) if held[1:] and one else None


def _holding_only(np: NounPhrase, held: NounPhrase, toward: Toward, said: str) -> State | None:
    """What alone is in or on something ("the box should hold the pen only")."""
    plain = held.determiner in ("the", "my", "this", "that") and not held.pronoun
    alone = replace(held, determiner="only the")
    return holding(np, (alone,), toward) if plain and said else None


_AND_NO_MORE = phrase("only, alone")


def holding_only(verb: str, toward: Toward = Toward.INSIDE) -> Parser:
    """What alone is in or on something, as it is said behind that."""
    return sequence(
        noun_phrase,
        verb,
        noun_phrase,
        optional(IN_OR_ON_IT, toward),
        _AND_NO_MORE,
        build=_holding_only,
    )


def containing(verb: str, toward: Toward = Toward.INSIDE) -> Parser:
    """What is in or on something, by a verb for that; ``toward``: where none is said."""
    return either(
        holding_only(verb, toward),
        sequence(noun_phrase, verb, NP_LIST, optional(IN_OR_ON_IT, toward), build=holding),
        sequence(noun_phrase, verb, NP_LIST, IN_OR_ON_IT, _AS_WELL, build=holding),
        sequence(
            noun_phrase,
            verb,
            NP_LIST,
            optional(IN_OR_ON_IT, toward),
            "together",
            build=_holding_together,
        ),
    )


_WITH_OTHERS = optional(
    either(
        sequence(OPTIONAL_COMMA, small_words.ALONG_WITH, NP_LIST),
        sequence(COMMA, small_words.IN_ADDITION, NP_LIST),
    ),
    (),
)
"""Behind where things are, what else is there; "in the box as well as the cup" may say where."""


def each_so(
    nps: tuple[NounPhrase, ...], said: str, predicate: Any, more: tuple[NounPhrase, ...] = ()
) -> State | None:
    """How several things are; no one thing is "both" so."""
    if more and (said or isinstance(predicate, str) or not isinstance(predicate[0], Destination)):
        return None
    nps = (*nps, *more)
    one = len(nps) == 1 and bool(nps[0].words) and singular(nps[0].head) == nps[0].head
    return None if said == "both" and one else state_of(all_of(nps, said), predicate)


_EACH = one_of({said: f"{said} [of them]" for said in ("each", "both", "all")})
EACH_SHOULD = either(
    sequence(
        # "Must both be put", "are both to go"
        "should, must, shall, can, could, may, are, are to, have [to], need [to]",
        _EACH,
        f"[[meant|supposed] to] (be|go|stand|lie|sit|end up|(be|get) ({predicates.DONE}))",
    ),
    sequence(_EACH, predicates.MODAL),
    sequence(predicates.MODAL, OPTIONAL_COMMA, _EACH),
)
"""What several things are to be, and whether all or both of them."""


def being(verb: str) -> Parser:
    """How things are, by a verb for that."""
    return sequence(
        NP_LIST,
        verb,
        optional(phrase("both, all"), ""),
        PREDICATE,
        _WITH_OTHERS,
        build=each_so,
    )


_NONE_MAY_BE = sequence(
    NP_LIST,
    "(may|can|could|will|shall|is to|are to) (be [left|found|standing]|stand|lie)",
    PREDICATE,
    build=lambda nps, so: state_of(nps, so) if {np.determiner for np in nps} <= {*NONE} else None,
)
STATE = either(
    being(f"{predicates.BE}, {predicates.LIES}"),
    _NONE_MAY_BE,
    STAYS,
    KEPT_THERE,
    containing("contains, holds, has, have"),
    containing(predicates.CARRIES, Toward.ON),
)
_BY_THEN = silent(optional(small_words.BY_THE_END))
states = Rule(
    sequence(
        silent(optional(small_words.END_STATE)),
        separated(STATE, sequence(_BY_THEN, LIST, optional("that")), most=6),
    )
)
_TO_BE_SO = optional(
    f"[to] (be|end up|go|stand|sit|lie|stay), {predicates.DONE}, {predicates.BE_PUT}"
)


# "…, the ball in the cup": the verb is left out.
_AND_SO = sequence(LIST, NP_LIST, _TO_BE_SO, PREDICATE, build=state_of)
ALL_SO = sequence(
    PREDICATE,
    _WITH_OTHERS,
    either(
        some(_AND_SO, most=4),
        sequence(small_words.BY_THE_END, some(_AND_SO, least=1, most=4)),
    ),
    build=lambda predicate, others, more: lambda nps: (each_so(nps, "", predicate, others), *more),
)
BESIDES_SO = either(
    sequence(
        # "…: the cup, containing the pen"; who is "holding the pen" may be the hand
        "containing",
        NP_LIST,
        build=lambda held: ensured(
            State(held, (Destination(Toward.INSIDE, (NounPhrase(pronoun="it", text="it"),)),))
        ),
    ),
    sequence(
        "with",
        NP_LIST,
        silent(
            optional(
                f"[still|left] (lying|standing|sitting|resting), safely, staying, {predicates.DONE}"
            )
        ),
        ALL_SO,
        silent(optional("instead")),
        build=lambda nps, said: ensured(*said(nps)),
    ),
    sequence(
        "with",
        NP_LIST,
        "staying, remaining, (kept|left) [standing|lying|sitting]",
        PREDICATE,
        small_words.ALL_ALONG,
        build=lambda nps, said: ensured(staying(nps, "", said, True)),
    ),
)
"""What is said of other things behind what is asked for (", with the cup on the desk")."""

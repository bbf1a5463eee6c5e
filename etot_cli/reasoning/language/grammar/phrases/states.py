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
    IN_HAND,
    LIST,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.coordination import all_of
from etot_cli.reasoning.language.grammar.phrases.destinations import (
    DESTINATIONS,
    destination,
    of_one_noun,
)
from etot_cli.reasoning.language.grammar.phrases.gapping import other_sides
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.phrases.where_not import WHERE
from etot_cli.reasoning.language.grammar.syntax.clauses import EnsureClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import forbidden, manner, nouns, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, THING_NOUNS, matches_any, singular
from etot_cli.reasoning.language.words.places import Prep

NONE = {"no": "all", "none of the": "all the", "neither": "both", "neither of the": "both"}
"""Denials before a noun, and of which things what is denied is said."""


SHUT = phrase(manner.CLOSED_STATE, "closed")


OPEN_OR_CLOSED = either(phrase(manner.OPEN_STATE, "open"), SHUT)


IS_OPEN_OR_CLOSED = either(phrase(manner.IS_OPEN, "open"), SHUT)
"""Behind "not"; what is not to be opened may be open already."""
_NOT_SO = sequence(
    "(not|no longer) [left|kept]",
    either(IS_OPEN_OR_CLOSED, DESTINATIONS),
    silent(optional("anymore, any more, any longer")),
    build=lambda found: ("not", found),
)
_NEITHER_THERE = sequence(
    "neither",
    either(
        sequence(
            separated(destination, "nor", most=3),
            build=lambda found: of_one_noun(found) if found[1:] else None,
        ),
        # Nothing ever goes there.
        sequence(DESTINATIONS, "nor on the (floor|ground)"),
    ),
    build=lambda found: ("not", found),
)


_STILL_SO = sequence("still", WHERE, build=lambda where: ("still", where))
"""Where things are to stay."""


SO = either(OPEN_OR_CLOSED, IN_HAND, _NOT_SO, DESTINATIONS)
"""How things are."""


_OPENED = "opened"
"""Of "none" that says what is not to be done, not how it is to be."""
PREDICATE = either(
    phrase("opened [up]", _OPENED),
    IS_OPEN_OR_CLOSED,
    IN_HAND,
    _NOT_SO,
    _NEITHER_THERE,
    sequence(optional(sequence("out of the way", OPTIONAL_COMMA)), WHERE),
    _STILL_SO,
)
"""How things are to be."""


def state_of(subjects: tuple[NounPhrase, ...], predicate: Any) -> State | None:
    """What is to be so: a word for a state, or where things are to be."""
    if "still" in predicate:
        denied = any(np.determiner in NONE for np in subjects)
        return None if denied else State(subjects, predicate[1], kept=True)
    if predicate == _OPENED:
        predicate = "open"
        if any(np.determiner in NONE for np in subjects):
            return None
    if all(np.determiner in NONE for np in subjects) and "not" not in predicate:
        every = tuple(replace(np, determiner=NONE[np.determiner]) for np in subjects)
        return _opposite(every, predicate)
    if isinstance(predicate, str):
        return State(subjects, word=predicate)
    return opposite(subjects, predicate[1]) if "not" in predicate else State(subjects, predicate)


def opposite(subjects: tuple[NounPhrase, ...], so: str | tuple[Destination, ...]) -> State | None:
    """What is not to be so is to be the opposite; "not all are open" may leave some that are."""
    if any({"off", "out"} & {*np.text.split()} and _is_taken(np) for np in subjects):
        return None  # nobody wants "the cup off the tray" to be nowhere else
    several = any(quantity not in nouns.THE_WORDS for np in subjects if (quantity := np.determiner))
    left = ([item.words for item in np.modifiers] in ([], [("left",)]) for np in subjects)
    bare = all(left) and subjects[0].words == ("anything",)  # then it is to be empty
    emptied = bare and not any(isinstance(item, Destination) and item.beside for item in so)
    return None if several or emptied else _opposite(subjects, so)


def _is_taken(np: NounPhrase) -> bool:
    """Whether a phrase says from where something is to go."""
    return any(item.prep is Prep.FROM for item in np.modifiers)


def not_left(subjects: tuple[NounPhrase, ...], word: str) -> EnsureClause | None:
    """What is not to be left so; "any drawer" is all of them."""
    if all(np.determiner in ("a", "an", "any") for np in subjects):
        subjects = tuple(replace(np, determiner="all") for np in subjects)
        return EnsureClause((_opposite(subjects, word),))
    return ensured(opposite(subjects, word))


def there_is_none(np: NounPhrase) -> tuple[NounPhrase, ...] | None:
    """What there should not be ("a cup", "any cups", "cups"): no such thing."""
    one = np.determiner in ("a", "an", "any", "") and not {*np.words} & {"", *THING_NOUNS}
    return (replace(np, determiner="no"),) if one and np.words else None


def _opposite(subjects: tuple[NounPhrase, ...], so: str | tuple[Destination, ...]) -> State:
    if not isinstance(so, str):
        return State(subjects, so, denied=True)
    return State(subjects, word="closed" if so == "open" else "open", denied=True)


ALWAYS = optional(phrase(small_words.ALL_ALONG, True), False)


def _is_no_demand(state: State) -> bool:
    """Whether it says of everything alike that it is to be on the desk, in whatever is there."""
    (np, *more), where = state.subjects, state.destinations
    general = not (more or np.modifiers or np.without) and matches_any(
        np.head, (*THING_NOUNS, "everything")
    )
    on_desk = [
        at.toward is Toward.ON and not at.beside and [t.head in DESK_NOUNS for t in at.targets]
        for at in where
    ]
    return general and len(np.words) == 1 and on_desk == [[True]] and not state.denied


def _staying(nps: tuple[NounPhrase, ...], said: str, predicate: Any, always: bool) -> State | None:
    """What stays so; of what "may" do so nothing is asked."""
    state = state_of(nps, predicate)
    if state is not None and _is_no_demand(state):
        return None  # nothing is to leave the desk
    none = all(np.determiner in NONE for np in nps)
    allowed = bool({"can", "may"} & {*said.split()}) and not none
    return None if state is None else replace(state, kept=True, always=always, allowed=allowed)


STAYS = sequence(NP_LIST, phrase(verbs.STAY), PREDICATE, ALWAYS, build=_staying)


IN_OR_ON_IT = either(phrase("in it, inside", Toward.INSIDE), phrase("on it", Toward.ON))


_AS_WELL = sequence(OPTIONAL_COMMA, "and, as well as, together with, along with", NP_LIST)


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


_WITH_OTHERS = optional(sequence(OPTIONAL_COMMA, "together with, along with", NP_LIST), ())
"""Behind where things are, what else is there."""


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
        f"[[meant|supposed] to] (be|go|stand|lie|sit|end up|(be|get) ({verbs.DONE}))",
    ),
    sequence(_EACH, verbs.MODAL),
    sequence(verbs.MODAL, OPTIONAL_COMMA, _EACH),
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


def _kept_there(nps: tuple[NounPhrase, ...], toward: Toward, np: NounPhrase) -> State | None:
    """What stays where it is rather than fall, or be taken away; what leaves the desk, on which
    nothing is said to stay by that, comes to harm.
    """
    lost = toward is not Toward.INSIDE and np.head in DESK_NOUNS
    none = all(n.determiner in NONE for n in nps)
    if none:  # none of those that are there now
        there = Modifier(Prep.FROM, (np,))
        nps = tuple(replace(n, determiner=NONE[n.determiner]).told_by(there) for n in nps)
    return None if lost else State(nps, (Destination(toward, (np,)),), kept=True)


_NONE_OF_THEM = sequence(
    NP_LIST, build=lambda nps: nps if {np.determiner for np in nps} <= {*NONE} else None
)
_AWAY_FROM = one_of({Toward.ON: "off [of]", Toward.INSIDE: "out of", Toward.TO: "from"})
KEPT_THERE = either(
    sequence(
        either(
            sequence(NP_LIST, verbs.NOT_FALL),
            sequence(forbidden.DO_NOT, "let", NP_LIST, verbs.FALL),
        ),
        one_of({Toward.ON: "off [of], from", Toward.INSIDE: "out of"}),
        noun_phrase,
        build=_kept_there,
    ),
    sequence(
        # "The mug must not be taken off the shelf"
        NP_LIST,
        either(
            phrase(verbs.NOT_LEAVE, Toward.TO),
            sequence(verbs.NOT_BE_TAKEN, _AWAY_FROM),
        ),
        noun_phrase,
        build=_kept_there,
    ),
    sequence(
        _NONE_OF_THEM,
        either(phrase(verbs.LEAVE, Toward.TO), sequence(verbs.BE_TAKEN, _AWAY_FROM)),
        noun_phrase,
        build=_kept_there,
    ),
)
_NONE_MAY_BE = sequence(
    NP_LIST,
    "(may|can|could|will|shall|is to|are to) (be [left|found|standing]|stand|lie)",
    PREDICATE,
    build=lambda nps, so: state_of(nps, so) if {np.determiner for np in nps} <= {*NONE} else None,
)
STATE = either(
    being(f"{verbs.BE}, {verbs.LIES}"),
    _NONE_MAY_BE,
    STAYS,
    KEPT_THERE,
    containing("contains, holds, has, have"),
    containing(verbs.CARRIES, Toward.ON),
)


_BY_THEN = silent(optional(small_words.BY_THE_END))
states = Rule(
    sequence(
        silent(optional(small_words.END_STATE)),
        separated(STATE, sequence(_BY_THEN, LIST, optional("that")), most=6),
    )
)


def ensured(*said_states: State | None) -> EnsureClause | None:
    """How things are to be in the end; None where one of the states is none."""
    said = tuple(state for state in said_states if state is not None)
    if len(said) < len(said_states):
        return None
    if len(said) > 1 and all(state.destinations for state in said):
        groups = tuple(PutGroup(Things(state.subjects), state.destinations) for state in said)
        there = [group.destinations for group in other_sides(groups)]
        said = tuple(replace(s, destinations=w) for s, w in zip(said, there, strict=True))
    return EnsureClause(said)


_TO_BE_SO = optional(f"[to] (be|end up|go|stand|sit|lie|stay), {verbs.DONE}, {verbs.BE_PUT}")


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


_KEPT_SO = "kept, left, staying, remaining"


def kept_so(nps: tuple[NounPhrase, ...], word: str, always: bool = True) -> EnsureClause:
    """What is to be open or closed all along."""
    return EnsureClause((State(nps, word=word, kept=True, always=always),))


WITH_KEPT_SO = sequence(
    "with",
    NP_LIST,
    either(
        sequence(_KEPT_SO, OPEN_OR_CLOSED, ALWAYS),
        sequence(OPEN_OR_CLOSED, phrase(small_words.ALL_ALONG, True)),
    ),
    build=lambda nps, said: kept_so(nps, *said),
)
"""What is to be open or closed all along ("with the drawer kept shut")."""
MEANWHILE_SO = either(
    sequence("while", STAYS, build=ensured),
    WITH_KEPT_SO,
    sequence(
        # "…, the drawer staying shut", "… while keeping the drawer shut"
        either(
            sequence(COMMA, NP_LIST, _KEPT_SO),
            sequence(OPTIONAL_COMMA, "while keeping", NP_LIST),
        ),
        OPEN_OR_CLOSED,
        ALWAYS,
        build=kept_so,
    ),
    sequence(
        either(
            sequence(COMMA, NP_LIST, "staying, remaining"),
            sequence(OPTIONAL_COMMA, "[while] keeping", NP_LIST),
        ),
        DESTINATIONS,
        small_words.ALL_ALONG,
        build=lambda nps, where: ensured(_staying(nps, "", where, True)),
    ),
    # "…, the pen not in the cup"
    sequence(
        COMMA,
        silent(optional("but")),
        NP_LIST,
        _NOT_SO,
        build=lambda nps, so: ensured(state_of(nps, so)),
    ),
)
"""What stays as it is while something else is done, which no comma has to set apart."""
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
                f"[still|left] (lying|standing|sitting|resting), safely, staying, {verbs.DONE}"
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
        build=lambda nps, said: ensured(_staying(nps, "", said, True)),
    ),
)
"""What is said of other things behind what is asked for (", with the cup on the desk")."""

"""Rules for clauses that put things somewhere and name the place before the thing, or the things
last.
"""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    quiet,
    sequence,
    silent,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    not_after,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.phrases.turns import TURN
from etot_cli.reasoning.language.grammar.phrases.where_not import WHERE
from etot_cli.reasoning.language.grammar.requests.additions import (
    BY_COLOR,
    CONDITION,
    GROUPING,
    put_of,
)
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, predicates, small_words, verbs
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import (
    NUMBERS,
    is_descriptive,
    singular,
)

BROUGHT = either(
    sequence(f"{verbs.PUT}, get[ting], {verbs.GATHER}", THINGS),
    sequence(predicates.WANTED, ALL_THINGS),
    sequence(ALL_THINGS, predicates.MODAL),
)
"""What is to go somewhere, in any mood."""
SAID_AHEAD = sequence(
    BROUGHT,
    either(
        sequence(either(GROUPING, BY_COLOR), OPTIONAL_COMMA),
        sequence(COMMA, either(TURN, CONDITION), COMMA),
        valued(sequence(OPTIONAL_COMMA, manner.IN_THIS_ORDER, OPTIONAL_COMMA), lambda _: ()),
    ),
    WHERE,
    build=lambda things, said, where: put_of(put_to(things, where).groups, (said,)),
)
"""What may follow the place stands before it."""


def _fronted(where: tuple[Destination, ...], nps: tuple[NounPhrase, ...]) -> PutClause | None:
    """A place and what goes there; "next to the tape" is no "next, to the tape", and "to the big
    bowl" no bowl to the big one.
    """
    last = [*where[-1].targets, *(np for item in where[-1].beside for np in item.phrases)][-1:]
    if not nps[0].determiner and any(
        not (np.words or np.pronoun) or is_descriptive(np.head) for np in last
    ):
        return None
    # "Take it out and put in the cup" rather puts it into that.
    vague = any(item.toward is Toward.TO or item.word == "in" for item in where)
    return replace(put_to(Things(nps), where), far_fetched=int(vague))


def _in_order(
    where: tuple[Destination, ...], ahead: bool, nps: tuple[NounPhrase, ...], behind: bool
) -> PutClause | None:
    """The same, in the order in which things are named where that is said."""
    put = _fronted(where, nps)
    return None if put is None else replace(put, ordered=ahead or behind)


_IN_THIS_ORDER = optional(
    sequence(
        OPTIONAL_COMMA,
        phrase(manner.IN_THIS_ORDER, True),
        either(COLON, OPTIONAL_COMMA),
    ),
    False,
)
FRONTED = quiet(
    sequence(
        either(
            # "The pen is to be taken out and put in the cup" puts no cup in there.
            sequence(not_after(*predicates.BEING_TAKEN), verbs.PUT, DESTINATIONS),
            sequence(
                DESTINATIONS,
                OPTIONAL_COMMA,
                either(verbs.PUT, "go[es], belong[s], come[s]"),
            ),
        ),
        _IN_THIS_ORDER,
        NP_LIST,
        _IN_THIS_ORDER,
        build=_in_order,
    )
)
"""The place before the thing."""
IS_WHERE = quiet(
    sequence(
        DESTINATIONS,
        OPTIONAL_COMMA,
        "is [exactly|just|precisely|also] where",
        either(
            sequence(NP_LIST, predicates.MODAL),
            sequence(predicates.WANTED, NP_LIST, optional(predicates.TO_BE_THERE)),
        ),
        build=_fronted,
    )
)
"""The same, told of the place ("in the box is where the pen belongs")."""
PLACE_AHEAD = quiet(
    sequence(
        DESTINATIONS,
        OPTIONAL_COMMA,
        NP_LIST,
        build=lambda where, nps: (
            _fronted(where, nps) if all(item.targets or item.beside for item in where) else None
        ),
    )
)
"""The same, where the verb was said before ("…, and beside it, the spoon")."""
_THESE = "(this|these|the following) [things|objects|items]"
FOLLOWING = sequence(
    either(
        sequence(f"{verbs.PUT}, set up, arrange, lay out, have", _THESE, DESTINATIONS, COMMA),
        sequence(
            either(sequence(_THESE, predicates.MODAL), "what (goes|belongs|should go|should be)"),
            DESTINATIONS,
            COLON,
        ),
    ),
    NP_LIST,
    build=lambda where, nps: put_to(Things(nps), where),
)


def _counted(whole: NounPhrase, nps: tuple[NounPhrase, ...]) -> bool:
    """Whether so many things are named as was said ("both fruits, apple and pear")."""
    return {"both": 2, **NUMBERS}.get((whole.determiner.split() or [""])[-1]) == len(nps)


def _named_behind(
    whole: NounPhrase, where: tuple[Destination, ...], nps: tuple[NounPhrase, ...]
) -> PutClause | None:
    """Several things that are announced together; "the green one" is one of these."""
    noun = singular(whole.head)
    every = noun == whole.head and whole.words == ("everything",)
    counted = _counted(whole, nps)
    some = not whole.determiner and is_category(whole.head)  # "food in the basket: …"
    several = nps[1:] or (not whole.determiner and nps[0].is_elliptic)
    if not several or not (every or counted or some or whole.determiner in _ALL_THESE):
        return None
    if noun == whole.head and not (every or counted or some):
        return None
    named = (np.called(noun) if np.is_elliptic else np for np in nps)
    return put_to(Things(tuple(named), whole=whole), where)


_ALL_THESE = ("", "the", "these", "those", "all", "all the")
_THAT_IS = "(that is|those are|namely|meaning) [~comma]"
_LISTED = sequence(COMMA, _THAT_IS, NP_LIST, OPTIONAL_COMMA)
LISTED = quiet(
    sequence(
        either(
            sequence(verbs.PUT, noun_phrase, _LISTED),
            sequence(noun_phrase, _LISTED, predicates.MODAL),
            sequence(
                # "Both fruits, apple and pear, must go in the bowl"
                noun_phrase,
                sequence(COMMA, NP_LIST, COMMA),
                predicates.MODAL,
                build=lambda whole, nps: (
                    (replace(whole, determiner=whole.determiner.split()[-1]), nps)
                    if _counted(whole, nps)
                    else None
                ),
            ),
            sequence(predicates.WANTED, noun_phrase, _LISTED, optional("to (go|be)")),
        ),
        DESTINATIONS,
        build=lambda found, where: _named_behind(found[0], where, found[1]),
    )
)
"""The same before the place ("the fruit, that is the apple and the pear, goes in the bowl")."""
NAMED_BEHIND = quiet(
    sequence(
        either(
            sequence(f"{verbs.PUT}, {verbs.TIDY}, {verbs.GATHER}", noun_phrase),
            sequence(noun_phrase, predicates.MODAL),
            sequence(predicates.WANTED, noun_phrase),
        ),
        DESTINATIONS,
        COMMA,
        optional(f"{_THAT_IS}, i mean"),
        NP_LIST,
        build=_named_behind,
    )
)
"""What goes somewhere is named one by one at the end."""
ANNOUNCED = quiet(
    either(
        sequence(noun_phrase, DESTINATIONS, either(COLON, COMMA), NP_LIST, build=_named_behind),
        sequence(DESTINATIONS, COLON, NP_LIST, build=_fronted),
    )
)
"""The same without a verb ("food in the basket: the apple and the pear", "in the basket: …")."""
ALONG_WITH = sequence(
    verbs.PUT,
    NP_LIST,
    DESTINATIONS,
    # "On the box as well as the mug" may say where.
    silent(
        either(
            sequence(OPTIONAL_COMMA, small_words.ALONG_WITH),
            sequence(COMMA, small_words.IN_ADDITION),
        )
    ),
    NP_LIST,
    build=lambda things, where, more: put_to(Things((*things, *more)), where),
)
OUT_OF_THE_ROW = sequence(
    # "Move the red cube out of the row and set it down beside the box"
    either(
        sequence(f"{verbs.FETCH}, {verbs.PICK}, {verbs.TAKE}", THINGS),
        sequence(
            ALL_THINGS, predicates.TO_BE_DONE, f"{predicates.TAKEN_FROM}, {predicates.TAKEN_UP}"
        ),
    ),
    "(out of|from) (the|its|their) (row|line)",
    optional(LIST),
    optional(
        either(
            sequence(optional("then"), verbs.SET_DOWN, "it, them"),
            sequence(optional("then"), optional("be"), predicates.DONE_WITH_IT),
        )
    ),
    DESTINATIONS,
    build=put_to,
)
"""Where things stand among others says nothing of where they go."""

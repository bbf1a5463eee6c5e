"""Rules for towers that are told upon a base, one layer upon the other."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    optional,
    phrase,
    quiet,
    sequence,
    some,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    LIST,
    LIST_COMMA,
    OPTIONAL_COMMA,
    WORDS,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup, TowerClause
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import manner, places, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import NUMBERS, singular

_Based = tuple[NounPhrase, tuple[int, tuple[str, ...]]]
_OF_SO_MANY = optional(
    sequence(
        "(of|out of|from) [all] [the]",
        one_of({count: said for said, count in NUMBERS.items()}),
        WORDS,
    ),
    (0, ()),
)
"""Of how many things a tower is to be (0: not said), and how these are called."""
_OF_A_TOWER = optional(
    sequence(f"(of|for) ({verbs.A_TOWER}|the (tower|stack|pile))", _OF_SO_MANY), (0, ())
)
_BASE = either(
    sequence(
        "us(e|ing), tak(e|ing), mak(e|ing), have, let, choose, keep",
        noun_phrase,
        manner.AS_BASE,
        _OF_A_TOWER,
    ),
    sequence(
        noun_phrase,
        "should, must, shall, will, can",
        manner.AS_BASE,
        _OF_A_TOWER,
    ),
    sequence(
        f"(start|begin) ({verbs.A_TOWER}|the (tower|stack|pile)) (with|on|from)",
        noun_phrase,
        build=lambda np: (np, (0, ())),
    ),
    sequence("(start|begin) with", noun_phrase, manner.AS_BASE, build=lambda np: (np, (0, ()))),
)


def _then(parser: Parser) -> Parser:
    return sequence(OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA, parser)


_PUT = f"{verbs.PUT}, {verbs.STACK}, go[es]"
NEXT = either(
    sequence(OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA),
    LIST,
)
_UPON = some(
    sequence(NEXT, optional(_PUT), noun_phrase, optional("goes"), manner.ATOP),
    most=4,
)
_ON_IT = f"[right|directly] (on|onto|upon|on top of|over|above) it, on top, {manner.UPON_THAT}"


def _layered(based: _Based, second: NounPhrase, more: tuple[NounPhrase, ...]) -> TowerClause | None:
    """What is named one upon the other, as many of that name as were announced."""
    first, (count, words) = based
    nps = (first, second, *more)
    one_each = all(singular(np.head) == np.head for np in nps)
    nouns = {*map(singular, words[-1:]), "one"}
    announced = not count or (count == len(nps) and all(np.head in nouns for np in nps))
    return TowerClause(Things(nps), upward=True) if one_each and announced else None


ON_A_BASE = quiet(
    either(
        sequence(
            _BASE,
            either(NEXT, COMMA),
            optional(_PUT),
            noun_phrase,
            optional("goes"),
            _ON_IT,
            _UPON,
            build=_layered,
        ),
        sequence(
            _BASE,
            OPTIONAL_COMMA,
            "with",
            noun_phrase,
            manner.AT_TOP,
            build=lambda based, top: _layered(based, top, ()),
        ),
        sequence(
            _BASE,
            OPTIONAL_COMMA,
            "with",
            noun_phrase,
            manner.AT_MIDDLE,
            LIST,
            noun_phrase,
            manner.AT_TOP,
            build=lambda based, middle, top: _layered(based, middle, (top,)),
        ),
    )
)
"""Something is the base of a tower, and what goes on it is told from there up."""


def _placed(lowest: NounPhrase, layers: tuple[PutGroup, ...]) -> TowerClause | None:
    """What stands at the bottom, be it a piece of furniture, and each layer on or in one below."""
    below, groups = [lowest], list[PutGroup]()
    for layer in layers:
        (np,), (where,) = layer.things.phrases, layer.destinations
        (target,) = where.targets
        under = [item for item in below if item.words == target.words]
        if target.pronoun or target.words == ("one",):
            under = [below[-1]] if target.text in ("it", "that", "that one") else []
        if not under:
            return None
        groups.append(PutGroup(layer.things, (replace(where, targets=(under[-1],)),)))
        below.append(np)
    return TowerClause(Things(tuple(below)), placed=PutClause(tuple(groups)))


_GOES = optional(f"{predicates.BE}, {predicates.LIES}, go[es]")
PLACED_LAYERS = quiet(
    sequence(
        sequence(noun_phrase, _GOES, manner.AT_BOTTOM),
        some(
            sequence(
                NEXT,
                noun_phrase,
                _GOES,
                one_of(
                    {
                        Toward.INSIDE: "in, inside, into",
                        Toward.ON: "[right|directly] (on|onto|upon|on top of|above|over)",
                    }
                ),
                noun_phrase,
                build=lambda np, to, below: PutGroup(Things((np,)), (Destination(to, (below,)),)),
            ),
            least=1,
            most=4,
        ),
        build=_placed,
    )
)
"""What is at the bottom, and where each of the others goes ("box at the bottom, cup on it, …")."""
SO = either(
    sequence(optional("like this"), COMMA),
    sequence(OPTIONAL_COMMA, "with, where, so that, such that"),
)
"""Before what goes where in a tower."""
_SO_MANY = sequence(one_of({n: said for said, n in NUMBERS.items()}), optional(WORDS, ()))
A_TOWER = sequence(
    f"{verbs.BUILD}, {predicates.WANT}",
    either(
        sequence(verbs.A_TOWER, optional(sequence("of [the]", _SO_MANY), (0, ()))),
        sequence("a", _SO_MANY, "tower, stack, pile"),
    ),
)
"""What is to be built, of how many things (0: not said) and how these are called."""


def _as_many_placed(
    announced: tuple[int, tuple[str, ...]], tower: TowerClause
) -> TowerClause | None:
    """A tower of as many things as were announced, if it was said how many."""
    count, words = announced
    return tower if count in (0, len(tower.things.phrases)) and not words else None


LAYERED = either(
    sequence(
        verbs.STACK,
        optional(either(phrase("things, these things", ()), THINGS), ()),
        optional("up"),
        SO,
        PLACED_LAYERS,
        build=lambda whole, tower: replace(tower, whole=whole or None),
    ),
    sequence(A_TOWER, SO, PLACED_LAYERS, build=_as_many_placed),
)
"""The same behind what is to be built."""
FIRST_TO_LAST = sequence(
    "first",
    noun_phrase,
    some(either(sequence(LIST_COMMA, noun_phrase), _then(noun_phrase)), most=4),
    _then(noun_phrase),
    build=lambda first, more, last: (first, *more, last),
)
"""The layers of a tower in the order in which it is built."""
ONE_ON_THE_OTHER = sequence(
    optional("first"),
    noun_phrase,
    places.ONTO,
    noun_phrase,
    some(sequence(NEXT, noun_phrase, f"{manner.ATOP}, {manner.UPON_THAT}"), least=1, most=4),
    build=lambda second, first, more: (first, second, *more),
)
"""The layers of a tower, from the bottom up."""

"""Rules for where something is to go."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

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
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    OPTIONAL_COMMA,
    alternatives,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.beside import (
    ABREAST,
    ABREAST_SO,
    BESIDE_IT,
    BESIDES,
    PART_OF_IT,
)
from etot_cli.reasoning.language.grammar.phrases.colors import ONE_OF_A_COLOR
from etot_cli.reasoning.language.grammar.phrases.coordination import coordinated, with_noun_of
from etot_cli.reasoning.language.grammar.phrases.levels import AT_AN_END, AT_LEVEL, NEXT_LEVEL
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ONE_TOLD_BEHIND, tells_which
from etot_cli.reasoning.language.grammar.phrases.steads import (
    INSTEAD_OF_IT,
    STEAD,
    WITH,
    told_by_it,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    TOP,
    Destination,
    Modifier,
    NounPhrase,
    Toward,
    has_choice,
    in_a_stance,
)
from etot_cli.reasoning.language.words import manner, nouns, places, small_words
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

THE_DESK = NounPhrase("the", ("desk",), text="the desk")
"""What has room for anything."""


def _any_target(nps: tuple[NounPhrase, ...] | None) -> tuple[NounPhrase, ...] | None:
    """One of several; what stands behind "a cup" in "a cup, the red or the blue one" tells which
    that is.
    """
    return None if nps is None or tells_which(*nps) else coordinated(nps[0], nps[1:])


TARGETS = either(
    sequence(alternatives(noun_phrase, 5), build=_any_target),
    valued(ONE_TOLD_BEHIND, lambda one: one.phrases),
)
_HOMES = frozenset(spellings(places.HOME))


def _toward(toward: Toward) -> Callable[[tuple[NounPhrase, ...]], Destination | None]:
    """Where things go, but for where they were ("to its original position")."""

    def build(targets: tuple[NounPhrase, ...]) -> Destination | None:
        home = any(f"{said} {np.text}" in _HOMES for np in targets for said in ("to", "in"))
        upon = any(np.head in spellings(nouns.STACK) for np in targets)
        return None if home else Destination(Toward.ON if upon else toward, targets)

    return build


def _onto(said: str, targets: tuple[NounPhrase, ...]) -> Destination | None:
    where = _toward(Toward.ON)(targets)
    return replace(where, word=TOP) if where is not None and TOP in said else where


def _upon(said: str, targets: tuple[NounPhrase, ...]) -> Destination | None:
    """On what things go; "on the way" tells when."""
    when = any(np.text == "the way" for np in targets)
    return None if when else Destination(Toward.ON, targets, TOP if TOP in said else "")


_RIGHT = optional("right")
"""Before where something goes it is no side ("right into the far corner")."""
INTO = sequence(_RIGHT, places.INTO, TARGETS, build=_toward(Toward.INSIDE))
ONTO = sequence(
    _RIGHT,
    phrase(places.ONTO),
    either(TARGETS, ONE_OF_A_COLOR),
    build=_upon,
)


def _upon_what_is_in(outer: Destination, np: NounPhrase) -> Destination | None:
    """On what lies in a vessel ("in the basket on top of the towel")."""
    (around, *more) = outer.targets
    if more or outer.word or around.pronoun or np.pronoun or np.modifiers:
        return None
    return Destination(Toward.ON, (np.told_by(Modifier(Prep.IN, (around,))),))


_AT_END = sequence(
    _RIGHT,
    one_of(places.AT_END),
    TARGETS,
    build=lambda end, targets: Destination(Toward.ON, targets, end),
)
OVER = sequence(
    places.OVER, TARGETS, build=lambda targets: Destination(Toward.ON, targets, places.OVER)
)
_to = sequence(places.TO, TARGETS, build=_toward(Toward.TO))
_ON_OR_IN = either(INTO, ONTO, _to)
_in_front = sequence(
    places.IN_FRONT,
    not_ahead("of"),
    build=lambda: Destination(
        Toward.TO, (NounPhrase("the", ("front",), text=places.IN_FRONT),), places.IN_FRONT
    ),
)
_free = either(
    sequence(
        f"(to|in|into|at|on|onto) ({places.FREE_SPOT}) (on [top of]|of)",
        TARGETS,
        build=_toward(Toward.ON),
    ),
    sequence(
        f"(to|in|into|at) ({places.FREE_SPOT}) (in|inside)", TARGETS, build=_toward(Toward.INSIDE)
    ),
    sequence(places.SOMEWHERE_FREE, either(ONTO, INTO)),
    sequence(either(ONTO, INTO), places.SOMEWHERE_FREE),
)
_top_of = sequence(
    places.ONTO,
    noun_phrase,
    "'s",
    "top, surface",
    build=lambda np: Destination(Toward.ON, (np,), TOP),
)
_beside_something = valued(BESIDES, lambda found: Destination(Toward.BESIDE, beside=found))


def _and_beside(surface: Parser) -> Parser:
    """In or on something, and where on that ("onto the table, somewhere left of the cup")."""
    return sequence(
        surface,
        OPTIONAL_COMMA,
        optional(places.SOMEWHERE),
        BESIDES,
        build=lambda where, found: replace(where, beside=found),
    )


_on_beside = _and_beside(_ON_OR_IN)
_place = either(
    _ON_OR_IN,
    _AT_END,
    OVER,
    _in_front,
    _free,
    _top_of,
    AT_LEVEL,
    NEXT_LEVEL,
    AT_AN_END,
    WITH,
    sequence(WITH, OPTIONAL_COMMA, either(INTO, ONTO), build=told_by_it),
    sequence(
        # "To the tray, where the pen already is"
        _ON_OR_IN,
        OPTIONAL_COMMA,
        WITH,
        build=lambda around, where: told_by_it(where, around),
    ),
    STEAD,
    sequence(
        STEAD,
        OPTIONAL_COMMA,
        either(INTO, ONTO),
        build=lambda stead, around: replace(stead, around=(around,)),
    ),
    sequence(
        either(INTO, ONTO),
        either(STEAD, INSTEAD_OF_IT),
        build=lambda around, stead: replace(stead, around=(around,)),
    ),
    valued(
        either(phrase(places.HERE), phrase("(up|down) there", "there")),
        lambda text: Destination(Toward.HERE, word=text),
    ),
    sequence(
        phrase("there [too|also|as well]", "there"),
        OPTIONAL_COMMA,
        BESIDES,
        build=lambda text, found: Destination(Toward.HERE, word=text, beside=found),
    ),
    valued(phrase(places.SAME_PLACE), lambda _: Destination(Toward.HERE, word="the same place")),
    valued(phrase(places.HOME), lambda text: Destination(Toward.HOME, word=text)),
    _beside_something,
    sequence(
        ABREAST,
        BESIDES,
        build=lambda abreast, found: Destination(Toward.BESIDE, beside=(*found, *abreast)),
    ),
    sequence(INTO, OPTIONAL_COMMA, places.ONTO, noun_phrase, build=_upon_what_is_in),
    _on_beside,
    sequence(
        _ON_OR_IN,
        COMMA,
        PART_OF_IT,
        build=lambda surface, part: replace(surface, beside=part),
    ),
    sequence(
        either(ABREAST, sequence(BESIDES, COMMA), BESIDE_IT),
        _ON_OR_IN,
        build=lambda found, surface: replace(surface, beside=found),
    ),
    sequence(
        ABREAST,
        either(ONTO, _to),
        ABREAST_SO,
        build=lambda abreast, surface, so: replace(surface, beside=(*abreast, *so)),
    ),
)
destination = Rule(
    sequence(
        optional(places.SOMEWHERE),
        either(
            _place,
            sequence(
                places.UP_OR_DOWN,
                either(_ON_OR_IN, _beside_something, _on_beside, WITH, STEAD),
            ),
            sequence("directly, straight", either(INTO, ONTO)),
        ),
    )
)


def of_one_noun(found: tuple[Destination, ...]) -> tuple[Destination, ...]:
    """Places of which the last one's noun is said for all ("in the red or in the blue box")."""
    *before, last = found
    if not before or not last.targets:
        return found
    lent = (item.going_to(partial(with_noun_of, named=last.targets[-1])) for item in before)
    return (*lent, last)


_any_of_them = sequence(separated(destination, small_words.OR, most=5), build=of_one_noun)
_NOT_LYING = f"({manner.NOT_LYING}) [~comma]"
STANCE = either(
    sequence(phrase(manner.STANDS, Nearby.UPRIGHT), optional(_NOT_LYING)),
    phrase(manner.LAID, Nearby.LYING),
    # "Should stand, not lie, in the box"
    sequence(optional("standing"), _NOT_LYING, build=lambda: Nearby.UPRIGHT),
)
"""How things are to be where they go, before that place."""


def _if_several(found: tuple[Destination, ...]) -> tuple[Destination, ...] | None:
    """Places, one of which is meant."""
    return found if has_choice(found) else None


DESTINATIONS = Rule(
    either(
        _any_of_them,
        sequence(STANCE, _any_of_them, build=in_a_stance),
        sequence(small_words.EITHER, _any_of_them, build=_if_several),
        sequence(
            OPTIONAL_COMMA,
            "be it, whether",
            separated(destination, "~comma be it, [~comma] or [be it]", most=5),
            build=lambda where: _if_several(of_one_noun(where)),
        ),
        sequence(
            _any_of_them,
            OPTIONAL_COMMA,
            manner.NOT_BOTH,
            build=_if_several,
        ),
    )
)
_directed = either(
    sequence(places.INTO_DIRECTED, TARGETS, build=_toward(Toward.INSIDE)),
    sequence(phrase(places.ONTO_DIRECTED), TARGETS, build=_onto),
    _to,
    _free,
)
DIRECTED = sequence(
    optional(small_words.EITHER),
    separated(either(_directed, _and_beside(_directed)), small_words.OR, most=5),
    build=lambda *found: of_one_noun(found[-1]),
)

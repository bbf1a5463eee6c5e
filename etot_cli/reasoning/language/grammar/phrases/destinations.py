"""Rules for where something is to go."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from operator import add
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Rule,
    either,
    one_of,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    some,
    spanned,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    EXACTLY,
    OPTIONAL_COMMA,
    after,
    alternatives,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.abreast import ABREAST, ABREAST_SO, EACH_OTHER
from etot_cli.reasoning.language.grammar.phrases.colors import ONE_OF_A_COLOR
from etot_cli.reasoning.language.grammar.phrases.coordination import coordinated, with_noun_of
from etot_cli.reasoning.language.grammar.phrases.levels import AT_AN_END, AT_LEVEL, NEXT_LEVEL
from etot_cli.reasoning.language.grammar.phrases.modifiers import (
    BETWEEN,
)
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import (
    BE_IT,
    EITHER_SIDE,
    one_out_of,
    one_so,
    tells_which,
)
from etot_cli.reasoning.language.grammar.phrases.steads import (
    INSTEAD_OF_IT,
    STEAD,
    WITH,
    told_by_it,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Beside,
    Destination,
    Modifier,
    NounPhrase,
    Toward,
    has_choice,
    in_a_stance,
)
from etot_cli.reasoning.language.words import manner, nouns, places, small_words, verbs
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

TOP = "top"
"""The word of a destination on top of something: of a shelf, its top board. What is "at the top"
or the bottom has boards."""
AS_SAID = "there, as was said"
"""The word of a destination that is left out, which the clause before says."""
ONWARD = "onward"
"""The word of a destination to which something goes from another one, to which it is likened."""
ACROSS = "over to"
"""The word of a destination that things are brought over to, be it into it or beside it."""
FILLED = "filled"
"""The word of a destination that is filled or loaded: what has an inside is so there."""
THE_DESK = NounPhrase("the", ("desk",), text="the desk")
"""What has room for anything."""
RECEIVER = "receiver"
"""The word of a destination that is said to get something."""


def _any_target(nps: tuple[NounPhrase, ...] | None) -> tuple[NounPhrase, ...] | None:
    """One of several; what stands behind "a cup" in "a cup, the red or the blue one" tells which
    that is.
    """
    return None if nps is None or tells_which(*nps) else coordinated(nps[0], nps[1:])


TARGETS = either(
    sequence(alternatives(noun_phrase, 5), build=_any_target),
    # "In one of the cups, be it the red or the blue one"
    sequence(
        noun_phrase,
        EITHER_SIDE,
        build=lambda np, sides: None if (one := one_so(np, sides)) is None else one.phrases,
    ),
    sequence(noun_phrase, COMMA, BE_IT, alternatives(noun_phrase, 3), build=one_out_of),
)


_HOMES = frozenset(spellings(places.HOME))


def _toward(toward: Toward) -> Callable[[tuple[NounPhrase, ...]], Destination | None]:
    """Where things go, but for where they were ("to its original position")."""

    def build(targets: tuple[NounPhrase, ...]) -> Destination | None:
        home = any(f"{said} {np.text}" in _HOMES for np in targets for said in ("to", "in"))
        upon = any(np.head in spellings(nouns.STACK) for np in targets)
        return None if home else Destination(Toward.ON if upon else toward, targets)

    return build


def _region(regions: tuple[Nearby, ...], phrases: Any) -> tuple[Beside, ...]:
    return tuple(Beside(relation, () if phrases is None else (phrases,)) for relation in regions)


def _beside(relation: Nearby, *nps: NounPhrase) -> tuple[Beside, ...]:
    return (Beside(relation, nps),)


_NEARBY = one_of({**places.NEARBY, Nearby.NEAR: places.GOES_NEAR, Nearby.AWAY: places.GOES_AWAY})
_REGION = one_of(places.REGIONS)
_ITS_SIDE = one_of(places.ITS_SIDE)
_SIDE_OF_IT = one_of(
    {Nearby.LEFT: "left [hand] side, left", Nearby.RIGHT: "right [hand] side, right"}
)
_REGION_OF_IT = one_of(places.REGION_OF_IT)
BESIDE = spanned(
    either(
        sequence(
            EXACTLY,
            _NEARBY,
            noun_phrase,
            optional("than (it is|they are) [now], than (now|before), as possible"),
            build=_beside,
        ),
        sequence(places.ACROSS, noun_phrase, build=lambda np: _beside(Nearby.NEAR, np)),
        sequence(
            _ITS_SIDE,
            build=lambda relation: _beside(relation, NounPhrase(pronoun="it", text="its side")),
        ),
        sequence(
            "on, to, at, onto",
            noun_phrase,
            "'s",
            _SIDE_OF_IT,
            build=lambda np, relation: _beside(relation, np),
        ),
        sequence(
            "in, on, to, at, onto, near, by",
            noun_phrase,
            "'s",
            _REGION_OF_IT,
            build=lambda np, regions: _region(regions, np),
        ),
        ABREAST,
        sequence(ABREAST, ABREAST_SO, build=add),
        valued(BETWEEN, lambda pair: (Beside(Nearby.BETWEEN, pair),)),
        sequence(
            EXACTLY,
            _REGION,
            optional(sequence("of, belonging to", noun_phrase), None),
            build=_region,
        ),
    ),
    lambda text, found: tuple(replace(item, text=text) for item in found),
)
_SIDES_OF_IT = {Nearby.AT_LEFT: Nearby.LEFT, Nearby.AT_RIGHT: Nearby.RIGHT}
_OF_THE_DESK = frozenset({"far", "half", "part", "end", "edge", "border"})
"""With such words a side is that of the desk, whatever is said before."""


def _besides(first: tuple[Beside, ...], more: Any) -> tuple[Beside, ...]:
    """All that is said of where; "next to the cup, on the right" is on the cup's right."""
    found = list(first)
    for behind_comma, also in more:
        (near, *others), (item, *further) = found, also
        of_it = behind_comma and not (others or further)
        found += (_side_of(near, item) if of_it else item, *further)
    return tuple(found)


def _side_of(near: Beside, item: Beside) -> Beside:
    """A bare side behind "next to the cup" as a side of the cup."""
    side = _SIDES_OF_IT.get(item.relation)
    bare = not (item.phrases or _OF_THE_DESK & {*item.text.split()})
    known = near.relation in (Nearby.NEXT_TO, Nearby.NEAR) and near.phrases[1:] == ()
    if side is None or not (bare and known) or EACH_OTHER in near.phrases:
        return item
    return replace(item, relation=side, phrases=near.phrases)


BESIDES = sequence(
    BESIDE,
    some(
        either(
            sequence(COMMA, BESIDE, build=lambda also: (True, also)),
            sequence("and, but", BESIDE, build=lambda also: (False, also)),
        ),
        most=3,
    ),
    build=_besides,
)
_RIGHT = optional("right")
"""Before where something goes it is no side ("right into the far corner")."""
INTO = sequence(_RIGHT, places.INTO, TARGETS, build=_toward(Toward.INSIDE))
ONTO = sequence(
    _RIGHT,
    phrase(places.ONTO),
    either(TARGETS, ONE_OF_A_COLOR),
    build=lambda said, targets: Destination(Toward.ON, targets, TOP if TOP in said else ""),
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


_to = sequence(_RIGHT, places.TO, TARGETS, build=_toward(Toward.TO))
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
_BESIDE_IT = sequence(
    EXACTLY,
    one_of(places.NEARBY),
    phrase("it, them"),
    build=lambda near, said: _beside(near, NounPhrase(pronoun=said, text=said)),
)
_on_beside = sequence(
    either(ONTO, _to, INTO),
    OPTIONAL_COMMA,
    optional(places.SOMEWHERE),
    BESIDES,
    build=lambda surface, found: replace(surface, beside=found),
)
_WHERE_IT_IS = either(WITH, STEAD)
_place = either(
    INTO,
    ONTO,
    _AT_END,
    OVER,
    _to,
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
        either(INTO, ONTO, _to),
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
        # "On the table, left side"
        either(ONTO, _to, INTO),
        COMMA,
        optional("the"),
        spanned(_REGION_OF_IT, lambda text, found: (found, text)),
        build=lambda surface, said: replace(
            surface, beside=tuple(Beside(near, text=said[1]) for near in said[0])
        ),
    ),
    sequence(
        either(ABREAST, sequence(BESIDES, COMMA), _BESIDE_IT),
        either(ONTO, _to, INTO),
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
                either(INTO, ONTO, _to, _beside_something, _on_beside, _WHERE_IT_IS),
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
        sequence(
            small_words.EITHER,
            _any_of_them,
            build=_if_several,
        ),
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


def denied(out: tuple[Destination, ...]) -> tuple[Destination, ...]:
    """Where things are not to be."""
    return tuple(replace(item, denied=True) for item in out)


def _but_not(
    where: tuple[Destination, ...], out: tuple[Destination, ...]
) -> tuple[Destination, ...]:
    """Where things go and where not; "next to the cup, not on the right" is not on its right."""
    if len(where) == 1 and len(where[0].beside) == 1:
        (near,) = where[0].beside
        out = tuple(
            replace(item, beside=tuple(_side_of(near, side) for side in item.beside))
            if not item.targets
            else item
            for item in out
        )
    return (*where, *denied(out))


def rather(out: tuple[Destination, ...], where: tuple[Destination, ...]) -> Any:
    """A place in place of others ("not in the red box but in the blue one", which is a box)."""
    (*_, noun) = ("", *(np.head for item in out for np in item.targets))

    def named(np: NounPhrase) -> NounPhrase:
        return np.called(noun) if noun and np.head == "one" else np

    return (*(item.going_to(named) for item in where), *denied(out))


_BUT = sequence(OPTIONAL_COMMA, "but [rather|instead]")
INSTEAD = sequence(DESTINATIONS, _BUT, DESTINATIONS, build=rather)
"""Behind "not": where things are not to go, and where they are."""


def _is_permitted(before: tuple[str, ...]) -> bool:
    """Whether what may go anywhere but to one place is only kept from that."""
    return bool({"can", "may", "could", "might"} & {*before}) and "you" not in before


_ANYWHERE_BUT = sequence(
    Parser(
        lambda given, at: [] if _is_permitted(given.words[max(at - 4, 0) : at]) else [(at, NOTHING)]
    ),
    places.ANYWHERE,
    OPTIONAL_COMMA,
    f"{nouns.CONTRAST}, {nouns.EXCEPT}, [and|but] never",
    either(
        separated(destination, "or, nor", most=3),
        sequence(TARGETS, build=lambda nps: (Destination(Toward.TO, nps),)),
    ),
    build=lambda out: (Destination(Toward.ON, (THE_DESK,)), *denied(out)),
)
"""All that is said is where things are not to go: they go somewhere else on the desk."""
WHERE = Rule(
    either(
        DESTINATIONS,
        _ANYWHERE_BUT,
        sequence(
            DESTINATIONS,
            OPTIONAL_COMMA,
            either(
                f"{nouns.CONTRAST}, [and|but] never, anywhere (but|except)",
                sequence(after("anywhere"), "except"),
                sequence(after("rather", "prefer"), "than"),
            ),
            optional(verbs.BEING),
            separated(destination, "or, nor", most=3),
            not_ahead("first", "last"),  # "…, not the cup first" is no place
            build=_but_not,
        ),
        sequence(
            # "On top of the box instead of under it"
            DESTINATIONS,
            OPTIONAL_COMMA,
            "(instead of|rather than|not|and not) (under|underneath|below|beneath) [it|them]",
            build=lambda where: where if all(item.toward is Toward.ON for item in where) else None,
        ),
        sequence("not", INSTEAD),
        quiet(
            sequence("neither", separated(destination, "nor, or"), _BUT, DESTINATIONS, build=rather)
        ),
    )
)
"""Where things are to go, and where they are not."""
_directed = either(
    sequence(places.INTO_DIRECTED, TARGETS, build=_toward(Toward.INSIDE)),
    sequence(places.ONTO_DIRECTED, TARGETS, build=_toward(Toward.ON)),
    _to,
    _free,
)
_directed = either(
    _directed,
    sequence(
        # "Out of the box and onto the table, somewhere left of the cup"
        _directed,
        OPTIONAL_COMMA,
        optional(places.SOMEWHERE),
        BESIDES,
        build=lambda surface, found: replace(surface, beside=found),
    ),
)
DIRECTED = sequence(
    optional(small_words.EITHER),
    separated(_directed, small_words.OR, most=5),
    build=lambda *found: of_one_noun(found[-1]),
)

"""Rules for things with the place where they go, and for several such pairs in a row."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Rule,
    either,
    one_of,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    silent,
    some,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    WORDS,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.beside import BESIDE
from etot_cli.reasoning.language.grammar.phrases.contrasts import NONE_OF_THEM
from etot_cli.reasoning.language.grammar.phrases.coordination import all_of
from etot_cli.reasoning.language.grammar.phrases.destinations import STANCE
from etot_cli.reasoning.language.grammar.phrases.gapping import lending_nouns
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.phrases.of_which import OF_WHICH, told_apart
from etot_cli.reasoning.language.grammar.phrases.where_not import WHERE
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    ACROSS,
    FILLED,
    Beside,
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
    in_a_stance,
)
from etot_cli.reasoning.language.words import fillers, manner, predicates, small_words
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.world.spatial import Nearby

_MANNER = silent(some(phrase(fillers.WITHOUT_MEANING), least=1, most=2))
_ASIDE = silent(either(OPTIONAL_COMMA, sequence(OPTIONAL_COMMA, _MANNER, OPTIONAL_COMMA)))


_SO_THAT_IT_IS = sequence(
    OPTIONAL_COMMA,
    f"{small_words.SO_THAT}, until, till",
    either(sequence("it, they", predicates.BE), "it (stands|sits|lies), they (stand|sit|lie)"),
)
_PARTICLE = f"""
    down, up, away, back, over, out, inside, out of the way, together, {manner.ONE_BY_ONE}
"""


def _quantified(things: Things, said: str) -> Things | None:
    """Things of which it is said before the place that each of them, or all, go there."""
    nps = tuple(all_of((np,), said) for np in things.phrases)
    single = all(singular(np.head) == np.head for np in things.phrases)
    if len(nps) > 1 and (single or (said == "both" and len(nps) == 2)):
        nps = tuple((np,) for np in things.phrases)  # "the cup and the scissors both"
        if said == "each":
            (first,), *more = nps
            each = f"each of {first.determiner}".strip()
            nps = ((replace(first, determiner=each),), *more)
    several = len(nps) > 1 or nps[0] != things.phrases[:1]
    return replace(things, phrases=sum(nps, ())) if several and not things.either else None


def _group(
    things: Things, how: Nearby | str | None, said: tuple[Destination, ...]
) -> PutGroup | None:
    """Things and where they go; "everything back" is what has been there, which nobody knows, and
    "back in its place" is its own.
    """
    where = in_a_stance(how, said) if isinstance(how, Nearby) else said
    if where is None:
        return None
    if how == "over":
        to = (item.toward is Toward.TO and not item.word for item in where)
        where = tuple(replace(w, word=ACROSS) if so else w for w, so in zip(where, to, strict=True))
    if how == "together" and sum(len(item.targets) for item in where if not item.denied) > 1:
        return None  # which is more than a way to say "put" where there is a choice
    home = how == "back" and any(item.toward is Toward.STEAD for item in where)
    sweeping = any(np.words == ("everything",) and not np.modifiers for np in things.phrases)
    return (
        None
        if (how == "back" and sweeping) or home
        else PutGroup(things, where, back=how == "back")
    )


def _per_place(np: NounPhrase, words: tuple[str, ...]) -> PutGroup | None:
    """One for each of several places ("one cup per saucer")."""
    each = NounPhrase("each", words, text=f"each {' '.join(words)}")
    one = np.determiner in ("one", "a", "an") and np.words and not np.modifiers
    return PutGroup(Things((np,)), (Destination(Toward.TO, (each,)),)) if one else None


def _tabled(things: Things, place: NounPhrase) -> PutGroup | None:
    """What a table says of things; "mugs on the tray: the white ones" rather says which."""
    where = (Destination(Toward.TO, (place,), FILLED),)
    return None if place.is_elliptic else PutGroup(things, where)


def _none_so(things: Things, denied: Modifier) -> Things | None:
    """Several things of which none is so."""
    (np, *more) = things.phrases
    several = not more and singular(np.head) != np.head
    return replace(things, phrases=(np.told_by(denied),)) if several else None


def _of_which(things: Things, parts: tuple[tuple[str, Modifier], ...]) -> Things | None:
    """Several things of which so many are of some sort."""
    told = None if things.phrases[1:] else told_apart(things.phrases[0], parts)
    return None if told is None else replace(things, phrases=told)


_PUT_GROUP = sequence(
    either(
        THINGS,
        sequence(THINGS, COMMA, NONE_OF_THEM, COMMA, build=_none_so),
        sequence(THINGS, COMMA, OF_WHICH, COMMA, build=_of_which),
        sequence(
            THINGS,
            silent(optional("away")),
            OPTIONAL_COMMA,
            one_of({said: f"{said} [of them]" for said in ("both", "all", "each")}),
            build=_quantified,
        ),
    ),
    optional(
        either(
            phrase(f"standing [up], {manner.KEPT_UPRIGHT}", Nearby.UPRIGHT),
            sequence(silent(phrase("down")), STANCE),
            phrase(_PARTICLE),
        ),
        None,
    ),
    either(_ASIDE, silent(_SO_THAT_IT_IS)),
    WHERE,
    silent(optional(manner.LET_GO, "")),
    silent(optional(sequence(OPTIONAL_COMMA, "contents and all"), "")),
    build=_group,
)
PUT_GROUP = either(
    _PUT_GROUP,
    sequence(
        # "Move it over the bowl and let go"
        THINGS,
        "over, above, [to] right above",
        noun_phrase,
        OPTIONAL_COMMA,
        manner.LET_GO,
        build=lambda things, np: PutGroup(things, (Destination(Toward.TO, (np,)),)),
    ),
    quiet(
        sequence(
            THINGS,
            COLON,
            noun_phrase,
            build=_tabled,
        )
    ),
    quiet(sequence(noun_phrase, "per, to each, to every", WORDS, build=_per_place)),
)


_OTHER_SIDE = {Nearby.LEFT: Nearby.RIGHT, Nearby.RIGHT: Nearby.LEFT}


def _on_opposite_sides(
    first: Things, side: Nearby, other: Things, where: tuple[Beside, ...]
) -> tuple[PutGroup, ...] | None:
    """Two things, of which the place of the second tells that of the first, too ("the cup left and
    the mug right of the plate").
    """
    if [item.relation for item in where] != [_OTHER_SIDE[side]]:
        return None
    sides = (replace(where[0], relation=side), *where)
    told = (Destination(Toward.BESIDE, beside=(item,)) for item in sides)
    return tuple(PutGroup(t, (at,)) for t, at in zip((first, other), told, strict=True))


_ON_OPPOSITE_SIDES = sequence(
    THINGS,
    one_of({Nearby.LEFT: "left", Nearby.RIGHT: "right"}),
    LIST,
    THINGS,
    BESIDE,
    build=_on_opposite_sides,
)
PUT_GROUPS = Rule(
    either(variants(separated(PUT_GROUP, LIST, most=5), lending_nouns), _ON_OPPOSITE_SIDES)
)
PAIRS = quiet(
    sequence(
        separated(
            sequence(
                noun_phrase,
                noun_phrase,
                build=lambda np, place: PutGroup(
                    Things((np,)), (Destination(Toward.TO, (place,)),)
                ),
            ),
            LIST,
            most=6,
        ),
        build=lambda groups: PutClause(groups) if groups[1:] else None,
    )
)
"""Things and their places, with nothing in between ("sort: bolts left bin, nuts right bin")."""

"""Rules for where something is to go and where not: in one place rather than in another."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Rule,
    either,
    one_of,
    optional,
    quiet,
    separated,
    sequence,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, after, not_ahead
from etot_cli.reasoning.language.grammar.phrases.beside import side_of
from etot_cli.reasoning.language.grammar.phrases.destinations import (
    DESTINATIONS,
    TARGETS,
    THE_DESK,
    destination,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, NounPhrase, Toward
from etot_cli.reasoning.language.words import nouns, places, predicates
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS


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
            replace(item, beside=tuple(side_of(near, side) for side in item.beside))
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


def _elsewhere(toward: Toward, nps: tuple[NounPhrase, ...]) -> tuple[Destination, ...] | None:
    """Any place but some, with the desk for what is left; the desk is not left out of that."""
    out = denied((Destination(toward, nps),))
    desk = any(np.head in DESK_NOUNS for np in nps)
    return None if desk else (Destination(Toward.ON, (THE_DESK,)), *out)


ELSEWHERE = sequence(
    OPTIONAL_COMMA,
    nouns.CONTRAST,
    one_of({Toward.INSIDE: "into", Toward.ON: "onto"}),
    TARGETS,
    build=_elsewhere,
)
"""Behind what is taken out or emptied, where that is not to go; "not in the red one" may be said of
what is emptied.
"""
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
            optional(f"back, {predicates.BEING}"),
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

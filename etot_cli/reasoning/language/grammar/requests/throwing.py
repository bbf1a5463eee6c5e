"""Rules for throwing things away and inserting them, where the place is often left out."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import LIST
from etot_cli.reasoning.language.grammar.phrases.destinations import INTO, ONTO
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import places, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import BINS


def _away(text: str, things: Things, into: Destination | None) -> PutClause | None:
    """Into what is named as a bin, or the only one; who throws away "everything in the drawer"
    means what is in there.
    """
    if into is not None:
        plain = _is_bin(into) or not into.targets
        fits = (plain or text.startswith(("discard", "dispos"))) and not things.are_any
        return replace(put_to(things, (into,)), far_fetched=int(not plain)) if fits else None
    to, noun = (Toward.ON, "shelf") if text.startswith("shelv") else (Toward.INSIDE, "trash")
    return put_to(things, (Destination(to, (NounPhrase("the", (noun,), text=text),)),))


def _is_bin(into: Destination) -> bool:
    """Whether it is called one."""
    return not BINS.isdisjoint(
        word for np in into.targets for word in "_".join(np.words).split("_")
    )


def _slid(groups: tuple[PutGroup, ...]) -> PutClause | None:
    """What is slid to something is pushed along."""
    toward = {place.toward for group in groups for place in group.destinations}
    return None if Toward.TO in toward else PutClause(groups)


def _into_bins(groups: tuple[PutGroup, ...]) -> PutClause | None:
    """Nothing is thrown elsewhere."""
    places = [place for group in groups for place in group.destinations]
    return (
        PutClause(groups) if all(_is_bin(place) or not place.targets for place in places) else None
    )


_THEREIN = valued(phrase(places.THEREIN), lambda text: Destination(Toward.HERE, word=text))
_GROUPS = separated(
    sequence(
        THINGS,
        sequence(either(INTO, ONTO, _THEREIN), build=lambda place: (place,)),
        build=PutGroup,
    ),
    LIST,
    most=3,
)
INSERTED = sequence(
    "insert[ing]",
    THINGS,
    build=lambda things: put_to(things, (Destination(Toward.HERE, word="in"),)),
)
"""Into what was opened or named before."""
THROWN = quiet(
    either(
        sequence(verbs.SLIDE, _GROUPS, build=_slid),
        sequence(verbs.THROW, _GROUPS, build=_into_bins),
        sequence(
            ALL_THINGS,
            predicates.TO_BE_THROWN,
            INTO,
            build=lambda things, into: _into_bins((PutGroup(things, (into,)),)),
        ),
        sequence(
            phrase(f"{verbs.THROW_AWAY}, shelv(e|ing)"),
            THINGS,
            optional(either(INTO, _THEREIN), None),
            build=_away,
        ),
        sequence(
            verbs.THROW,
            THINGS,
            phrase("away, out"),
            optional(either(INTO, _THEREIN), None),
            build=lambda things, text, into: _away(text, things, into),
        ),
    )
)

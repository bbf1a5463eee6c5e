"""Rules for putting things on both sides of something, or beside others that were not meant."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    quiet,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.requests.word_order import BROUGHT
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Beside,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import places, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby


def flanking(
    things: Things, said: str, mark: NounPhrase, on: tuple[Destination, ...] = ()
) -> PutClause | None:
    """Two things, one to the left and one to the right of another ("a cup on each side of it"),
    ``on`` what that is on; one alone may only be on either side.
    """
    around = on[0] if on else Destination(Toward.BESIDE)
    if len(on) > 1 or around.beside or (on and around.toward is not Toward.ON):
        return None
    (np, *more) = things.phrases
    single = not more and singular(np.head) == np.head and "either" not in said
    if single and np.determiner not in ("a", "an", "one", "two", "both"):
        return None
    if not more and np.determiner in ("a", "an", "one"):
        things = Things((replace(np, determiner="two"),))
    sides = (Nearby.LEFT, Nearby.RIGHT)
    where = tuple(replace(around, beside=(Beside(side, (mark,), mark.text),)) for side in sides)
    return None if things.either else PutClause((PutGroup(things, where),), Grouping.SEPARATELY)


ON_BOTH_SIDES = phrase(places.ON_BOTH_SIDES)


FLANKED = sequence(
    "and, with", ALL_THINGS, ON_BOTH_SIDES, phrase("it", NounPhrase(pronoun="it", text="it")),
    build=flanking,
)  # fmt: skip
"""Behind a clause about that ("… in the middle, with a cup on either side of it")."""


def _beside_others(found: tuple[Things, str], others: tuple[NounPhrase, ...]) -> PutClause | None:
    """In or on what other things are in or on ("put the spoon with the forks")."""
    things, said = found
    where = Destination(Toward.WITH, others, f"{said} {Things(others).text}")
    if all({"other", "others", "rest"} & {*np.determiner.split(), *np.words} for np in others):
        # "With the other pens"; in "the rag in the jar with the other brush" they rather tell which
        told = any(item.prep is Prep.IN for np in things.phrases for item in np.modifiers)
        return replace(put_to(things, (where,)), far_fetched=2 * told)
    out_of = (m.prep is Prep.FROM for np in things.phrases for m in np.modifiers)
    there = [[item.prep for item in np.modifiers] in ([Prep.IN], [Prep.ON]) for np in others]
    if all(there) and said != "in with":
        # "With the pen in the cup" is where the pen is, if that is there.
        return replace(put_to(things, (where,)), far_fetched=2)
    described = any(np.modifiers for np in others) or not all(out_of)
    inside = said == "in with"
    known = (*THE_WORDS, *([""] if inside else ()))  # "in with teddy", "in with it"
    named = not described and all(
        (np.words or (inside and np.pronoun)) and np.determiner in known for np in others
    )
    return put_to(things, (where,)) if named else None


def _to_others(things: Things, said: str, others: tuple[NounPhrase, ...]) -> PutClause | None:
    """In or on what other things are in or on ("add the spoon to the forks in the drawer")."""
    told = all(any(m.prep in (Prep.IN, Prep.ON) for m in np.modifiers) for np in others)
    where = Destination(Toward.WITH, others, f"{said} {Things(others).text}")
    return replace(put_to(things, (where,)), far_fetched=2) if told else None


_GOING = either(
    sequence(ALL_THINGS, predicates.MODAL),
    sequence(predicates.WANTED, ALL_THINGS, f"{predicates.DONE}, to (go|be)"),
)


def _in_after(things: Things, said: str) -> PutClause:
    """Where what was spoken of went."""
    np = NounPhrase(pronoun=said.split()[-1], text=said.split()[-1])
    return put_to(things, (Destination(Toward.WITH, (np,), said),))


FLANKING = either(
    sequence(
        BROUGHT,
        optional(sequence(DESTINATIONS, OPTIONAL_COMMA), ()),
        optional("one"),
        ON_BOTH_SIDES,
        noun_phrase,
        silent(optional(places.ONE_AT_EACH_SIDE)),
        build=lambda things, where, said, np: flanking(things, said, np, where),
    ),
    sequence(
        BROUGHT,
        places.NEARBY[Nearby.NEXT_TO],
        noun_phrase,
        OPTIONAL_COMMA,
        "one (on|to) (each|either) side",
        build=lambda things, np: flanking(things, "each", np),
    ),
)


WITH_OTHERS = either(
    quiet(
        sequence(
            either(
                sequence(verbs.SET_DOWN, THINGS, phrase("with, together with, in with")),
                sequence(verbs.THROW, THINGS, phrase("in with")),
                sequence(_GOING, phrase("with, together with, in with")),
            ),
            NP_LIST,
            build=_beside_others,
        )
    ),
    sequence(
        # "Drop the small ball in after it"
        either(sequence(f"{verbs.SET_DOWN}, {verbs.THROW}", THINGS), _GOING),
        phrase("in (after|behind|along with) (it|them)"),
        build=_in_after,
    ),
    quiet(
        sequence(
            either(sequence("add[ing]", ALL_THINGS), sequence(ALL_THINGS, "go[es], belong[s]")),
            phrase("to"),
            NP_LIST,
            build=_to_others,
        )
    ),
)

"""Rules for turning things upright or on their side, swapping and replacing them."""

from __future__ import annotations

from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    optional,
    phrase,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COLON,
    OPTIONAL_COMMA,
    not_ahead,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.coordination import of_each
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.requests.unstacking import is_stack
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    PutClause,
    ReorientClause,
    SwapClause,
    put_to,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import (
    forbidden,
    frames,
    manner,
    predicates,
    small_words,
    verbs,
)
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.world.spatial import Nearby

_stood_up = partial(ReorientClause, stance=Nearby.UPRIGHT)
_laid_down = partial(ReorientClause, stance=Nearby.LYING)


def _still_standing(things: Things) -> ReorientClause | None:
    """What is upright; a tower that is to be "standing" is to be there."""
    tower = any(is_stack(np) for np in things.phrases)
    return None if tower else ReorientClause(things, Nearby.UPRIGHT)


_IT = Things((NounPhrase(pronoun="it", text="it"),))
_THEM = Things((NounPhrase(pronoun="them", text="them"),))
_HOW = sequence(
    optional("around, round"),
    optional(phrase(f"{manner.UPRIGHT}, {manner.TURNED_UP}", Nearby.UPRIGHT), None),
    optional(phrase(manner.IF_NEEDED, True), False),
    build=lambda *how: how,
)
"""Behind what is turned: to stand, or only if it has to be."""
TURNED = either(
    sequence(verbs.REORIENTED, _HOW),
    sequence(
        "tipped, stood, set",
        f"back {manner.UPRIGHT}, {manner.UPRIGHT}, {manner.TURNED_UP}",
        build=lambda: (Nearby.UPRIGHT, False),
    ),
)
"""What is done with a thing that is turned, in the passive."""
_INTO = "in, into, inside, down into, to"


def _into_it(things: Things, np: NounPhrase) -> PutClause:
    """What is turned "so that it points into" what it is put "in" then."""
    return put_to(things, (Destination(Toward.INSIDE, (np,)),))


TURNED_INTO = sequence(
    verbs.REORIENT,
    THINGS,
    manner.FITS_INTO,
    _INTO,
    noun_phrase,
    OPTIONAL_COMMA,
    "and then, and, then, ~comma",
    verbs.PLACE,
    "(it|them) (in|inside|into it) [there|it]",
    build=_into_it,
)
_upright_meanwhile = partial(ReorientClause, stance=Nearby.UPRIGHT, meanwhile=True)
HELD_MEANWHILE = either(
    sequence(
        "[always|while|by] (keeping|holding)",
        THINGS,
        manner.LEVEL,
        silent(optional(manner.ON_THE_WAY)),
        build=_upright_meanwhile,
    ),
    sequence(
        forbidden.WITHOUT,
        either(
            sequence(verbs.TILT, THINGS),
            sequence("letting", THINGS, verbs.TILTS),
        ),
        silent(optional(manner.ON_THE_WAY)),
        build=_upright_meanwhile,
    ),
    sequence(forbidden.WITHOUT, THINGS, verbs.TILTING, build=_upright_meanwhile),
    phrase(manner.TURNED_AS_NEEDED, ReorientClause(_IT, meanwhile=True)),
)
"""Behind what is put somewhere: how it is turned, or kept, meanwhile."""
KEPT_UPRIGHT = either(
    sequence(
        "[always] (keep|hold|keeping|holding)",
        THINGS,
        manner.LEVEL,
        silent(phrase(manner.ON_THE_WAY)),
        build=_upright_meanwhile,
    ),
    sequence(
        forbidden.DO_NOT,
        either(sequence(verbs.TILT, THINGS), sequence("let", THINGS, verbs.TILTS)),
        silent(optional(manner.ON_THE_WAY)),
        build=_upright_meanwhile,
    ),
    sequence(
        silent(optional(f"{verbs.ENSURE}, {small_words.SO_THAT}")),
        ALL_THINGS,
        f"(does|do|must|should|may|can|is to|are to|will) not ({verbs.TILTS}|be (tilted|tipped))",
        build=_upright_meanwhile,
    ),
)
"""The same in a clause of its own."""


def _kept_upright(things: Things) -> ReorientClause:
    """What is to stay upright; "it" is what is put somewhere meanwhile."""
    again = all(np.pronoun for np in things.phrases)
    return ReorientClause(things, Nearby.UPRIGHT, meanwhile=again)


def _staying_so(things: Things, stance: Nearby) -> ReorientClause:
    """What stays as it stands or lies."""
    upright = stance is Nearby.UPRIGHT
    return _kept_upright(things) if upright else ReorientClause(things, stance)


def _standing(things: Things) -> ReorientClause | None:
    """What stands upright besides; "it" would be what is put somewhere."""
    return None if any(np.pronoun for np in things.phrases) else _stood_up(things)


def _held_upright(things: Things) -> ReorientClause | None:
    """What "hold it upright" says of what is put somewhere; else it is to be in the hand."""
    again = all(np.pronoun for np in things.phrases)
    return _upright_meanwhile(things) if again else None


def turned(things: Things, how: tuple[Nearby | None, bool]) -> ReorientClause:
    """Things that are turned, to stand or as they have to be."""
    stance, to_fit = how
    return ReorientClause(things, stance, meanwhile=to_fit)


REORIENT = either(
    sequence(
        phrase(verbs.REORIENT),
        THINGS,
        _HOW,
        build=lambda verb, things, how: turned(
            things, (Nearby.UPRIGHT, how[1]) if verb == "upright" else how
        ),
    ),
    sequence(
        verbs.ORIENTATION,
        either(
            phrase("its (orientation|pose)", _IT),
            phrase("their orientation[s]", _THEM),
            sequence("the (orientation|pose) of", THINGS),
            sequence(THINGS, "'s (orientation|pose)"),
        ),
        either(_HOW, phrase("to (upright|vertical|standing)", (Nearby.UPRIGHT, False))),
        build=turned,
    ),
    sequence(verbs.TURNING_OF, THINGS, build=ReorientClause),
    sequence(
        either(
            sequence(ALL_THINGS, predicates.TO_BE_DONE),
            sequence(predicates.WANTED, ALL_THINGS, optional("to be")),
            sequence("have, having, get, getting", ALL_THINGS),
            sequence(predicates.CAN, ALL_THINGS, "[please] be"),
            sequence(frames.WISH_IF, ALL_THINGS, predicates.WERE_DONE),
        ),
        TURNED,
        build=turned,
    ),
    sequence(ALL_THINGS, "need[s]", verbs.REORIENT, _HOW, build=turned),
    TURNED_INTO,
    KEPT_UPRIGHT,
    sequence(
        verbs.TURN,
        THINGS,
        f"back {manner.UPRIGHT}, {manner.UPRIGHT}, {manner.TURNED_UP}",
        build=_stood_up,
    ),
    sequence(verbs.KEEP, THINGS, f"{manner.UPRIGHT}, {manner.TURNED_UP}", build=_kept_upright),
    sequence("hold[ing]", THINGS, f"{manner.ERECT}, level", build=_held_upright),
    sequence(
        f"{verbs.LAY}, {verbs.TIP}",
        THINGS,
        optional("down"),
        manner.LYING,
        build=_laid_down,
    ),
    sequence(
        either(
            sequence(ALL_THINGS, predicates.STAY),
            sequence(verbs.ENSURE, ALL_THINGS, predicates.STAY),
        ),
        either(
            phrase(f"{manner.ERECT}, standing [up]", Nearby.UPRIGHT),
            phrase(manner.LAID, Nearby.LYING),
        ),
        silent(optional(manner.ON_THE_WAY)),
        build=_staying_so,
    ),
    sequence(
        either(
            sequence(ALL_THINGS, predicates.MODAL),
            sequence(verbs.ENSURE, ALL_THINGS, f"{predicates.BE}, {predicates.LIES}"),
            sequence(
                predicates.WANTED, ALL_THINGS, silent(optional(f"to (be|stand), {predicates.DONE}"))
            ),
        ),
        either(phrase(manner.ERECT, Nearby.UPRIGHT), phrase(manner.LAID, Nearby.LYING)),
        silent(optional(manner.ON_THE_WAY)),
        build=ReorientClause,
    ),
    sequence(
        either(
            sequence(ALL_THINGS, predicates.MODAL, "[still] standing [up]"),
            sequence(verbs.ENSURE, ALL_THINGS, "(is|are) standing [up], stands, stand"),
        ),
        silent(optional("there")),
        build=_still_standing,
    ),
    sequence(
        verbs.PUT_DOWN,
        THINGS,
        manner.LYING,
        build=_laid_down,
    ),
)
_STILL_ERECT = sequence(
    silent(
        either(
            sequence(
                optional("still, kept, left, both, all, staying, remaining"), phrase(manner.ERECT)
            ),
            phrase("(still|left|both|all) standing"),
        )
    ),
    silent(optional(f"{small_words.BY_THE_END}, {small_words.ALL_ALONG}")),
)
STANDING_BESIDES = sequence(optional("with"), ALL_THINGS, _STILL_ERECT, build=_standing)
STAYING_UPRIGHT = sequence(
    ALL_THINGS, f"{predicates.BE}, {predicates.STAY}", _STILL_ERECT, build=_standing
)
"""Which others stand upright, behind what is asked for (", with the cup upright")."""
STANDS_UP = either(
    sequence(
        ALL_THINGS, optional(f"{predicates.BE}, {predicates.LIES}"), manner.ERECT, build=_stood_up
    ),
    sequence(ALL_THINGS, optional("is, are, (has|have) been"), TURNED, build=turned),
)
HAVING_TURNED = either(
    sequence(
        verbs.REORIENTED,
        THINGS,
        _HOW,
        build=turned,
    ),
    sequence(
        "a (turn|rotation|reorientation|re orientation|flip) of", THINGS, build=ReorientClause
    ),
)
"""What has been turned by then ("having turned it, …", "after a rotation of the pen, …")."""
"""What stands by then ("once it is upright, …")."""


def _replaced(old: NounPhrase, new: NounPhrase) -> PutClause:
    return put_to(Things((new,)), (Destination(Toward.STEAD, (old,), "replace"),))


def _exchanged(
    old: NounPhrase, new: NounPhrase, where: tuple[Destination, ...]
) -> PutClause | None:
    """What goes where something else is by now, which makes room for it."""
    (around, *more) = where
    if more or around.toward not in (Toward.ON, Toward.INSIDE) or old.pronoun:
        return None
    stead = Destination(Toward.STEAD, (old,), "instead of", around=(around,))
    return put_to(Things((new,)), (stead,))


def _swapped(things: Things) -> SwapClause:
    """Things that swap places; "the blocks in the red bowl and the blue bowl" are those in both
    bowls.
    """
    first, *more = things.phrases
    several = singular(first.head) != first.head and all(np.head != first.head for np in more)
    each = of_each(things.phrases) if more and several and not things.either else None
    return SwapClause(things if each is None else replace(things, phrases=each))


SWAP = either(
    sequence(
        verbs.SWAP,
        optional(verbs.SWAPPED_ROUND),
        THINGS,
        optional(verbs.SWAPPED_ROUND),
        not_ahead(COLON),  # what it explains would be done beside it
        build=_swapped,
    ),
    sequence(
        predicates.WANTED,
        "the (positions|places) of",
        THINGS,
        "[to be] (exchanged|swapped|switched)",
        build=_swapped,
    ),
    sequence(
        optional(f"have, let, make, can, could, may, {predicates.WANT}"),
        THINGS,
        verbs.CHANGE_PLACES,
        build=_swapped,
    ),
    sequence(
        noun_phrase,
        verbs.CHANGE_PLACES,
        "with",
        noun_phrase,
        build=lambda one, other: SwapClause(Things((one, other))),
    ),
    sequence(
        "swap[ping], exchang(e|ing), switch[ing]",
        noun_phrase,
        "with, for, by",
        noun_phrase,
        optional(verbs.SWAPPED_ROUND),
        build=lambda one, two: SwapClause(Things((one, two))),
    ),
    sequence(
        # "Exchange the cup for the bottle on the tray", where the cup is on it
        "swap[ping], exchang(e|ing), switch[ing]",
        noun_phrase,
        "for",
        noun_phrase,
        DESTINATIONS,
        build=_exchanged,
    ),
    sequence("replac(e|ing)", noun_phrase, "with, for, by", noun_phrase, build=_replaced),
)

"""Rules for things for which a place is to be found, or that are to be out of the way."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    either,
    optional,
    phrase,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, THINGS
from etot_cli.reasoning.language.grammar.phrases.where_not import WHERE
from etot_cli.reasoning.language.grammar.requests.laying import DOWN
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, put_to
from etot_cli.reasoning.language.grammar.syntax.phrases import Beside, Destination, Things, Toward
from etot_cli.reasoning.language.words import places, predicates, verbs
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby


def _safely(things: Things, rather: bool = True) -> PutClause:
    """Out of the way, of what "the ball in front of the drawer" is said to be in front of, unless
    what comes next ``rather`` tells of what.
    """
    marks = [
        m for np in things.phrases for m in np.modifiers if m.prep in (Prep.FRONT, Prep.BEHIND)
    ]
    if len(things.phrases) > 1 or [m.denied for m in marks] != [False]:
        return replace(put_to(things, DOWN), far_fetched=int(rather))
    away = (Beside(Nearby.AWAY, m.phrases, m.phrases[0].text) for m in marks)
    return put_to(things, (Destination(Toward.BESIDE, beside=tuple(away)),))


_A_PLACE = """
    a [new|nice|good|free|safe|proper] (place|spot|home|seat) [~comma], [some|enough] (room|space)
"""
_ALLOWED = {("you", "may"), ("you", "can"), ("you", "could")}
_NOT_ALLOWED = Parser(
    lambda given, at: [] if _ALLOWED & {*pairwise(given.words[:at])} else [(at, NOTHING)]
)
"""Who says that "you may move it somewhere else" leaves open whether it is moved."""
_NEEDS_A_PLACE = """
    [still] (needs|need|deserves) (a|its|their) [new|safe|proper] (place|spot|home|places|homes),
    (should|must|has to|have to|is to|are to) find (a|its|their) [new|safe|proper] (place|spot|home)
"""
PLACE_FOUND = either(
    sequence("find[ing], giv(e|ing)", THINGS, _A_PLACE, WHERE, build=put_to),
    sequence(verbs.FIND, _A_PLACE, "for", THINGS, OPTIONAL_COMMA, WHERE, build=put_to),
    sequence(
        either(
            sequence(verbs.FIND, places.A_SAFE_PLACE, "for", THINGS),
            sequence(verbs.FIND, _A_PLACE, "for", THINGS, OPTIONAL_COMMA, places.SAFELY),
            sequence("find[ing], giv(e|ing)", THINGS, places.A_SAFE_PLACE),
            sequence(ALL_THINGS, "[still] (needs|need|deserves)", places.A_SAFE_PLACE),
        ),
        build=_safely,
    ),
    sequence(
        "find[ing] [a|some|enough] (room|space|place|spot)",
        DESTINATIONS,
        "for",
        THINGS,
        build=lambda where, things: put_to(things, where),
    ),
    sequence(ALL_THINGS, _NEEDS_A_PLACE, WHERE, build=put_to),
    sequence(
        # With what is opened next it is rather out of the way of that.
        either(
            sequence(f"{verbs.PUT}, {verbs.FETCH}", THINGS),
            sequence(ALL_THINGS, predicates.MODAL),
            sequence(
                predicates.WANTED, ALL_THINGS, silent(optional(f"to be, {predicates.TO_BE_THERE}"))
            ),
            sequence(verbs.ENSURE, ALL_THINGS, predicates.BE),
        ),
        either(
            phrase("aside, to one side", False),
            sequence(_NOT_ALLOWED, phrase(places.SOMEWHERE_ELSE, False)),
            phrase(places.SAFELY, True),
        ),
        build=_safely,
    ),
    sequence(verbs.PUT_ASIDE, THINGS, build=partial(_safely, rather=False)),
)

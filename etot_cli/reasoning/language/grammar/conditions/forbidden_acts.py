"""Rules for acts that are forbidden, as they stand behind "do not", "without" or "must not be"."""

from __future__ import annotations

from functools import partial

from etot_cli.reasoning.language.grammar.conditions.falling import (
    LEAVE_THE_DESK,
    NOTHING_HARMED,
    OFF_THE_DESK,
    not_dropped,
    not_spilled,
    unharmed,
    unhit,
)
from etot_cli.reasoning.language.grammar.conditions.instruments import LET_MEET, WITH_IT, with_it
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import COMMA, OPTIONAL_COMMA
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, DIRECTED
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.requests.emptying import ANYTHING
from etot_cli.reasoning.language.grammar.syntax.clauses import Avoid, AvoidClause
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    TOP,
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import forbidden, small_words, verbs
from etot_cli.reasoning.language.words.places import Prep


def _undisturbed(things: Things) -> AvoidClause | None:
    """What is not to be moved; "without pushing it off the desk" says where it stays."""
    off = any(item.prep is Prep.FROM for np in things.phrases for item in np.modifiers)
    return None if off else AvoidClause(Avoid.MOVE, things)


def _not_brought(things: Things, where: tuple[Destination, ...]) -> AvoidClause | None:
    """Where things are not to be moved; "without moving the cup on top of it" is about that cup."""
    on_top = any(destination.word == TOP for destination in where)
    return None if on_top else AvoidClause(Avoid.PUT, things, where)


def _taken_from(things: Things, it: str) -> Things:
    """What is not to be taken out or off; anything is all that is in or on what was spoken of."""
    if things.phrases[0].words != ("anything",):
        return things
    held = Modifier(Prep.FROM, (NounPhrase(pronoun=it, text=it),))
    return Things((things.phrases[0].told_by(held),))


def _left_stacked(things: Things) -> AvoidClause | None:
    """What lies upon each other is left so by who moves none of it; "it" may be one of these."""
    pronouns = any(np.pronoun for np in things.phrases)
    return None if pronouns else AvoidClause(Avoid.MOVE, things)


def _unused(nps: tuple[NounPhrase, ...], things: Things | None) -> AvoidClause:
    """What is not to be used is not to hold or bear things, some or any."""
    return AvoidClause(Avoid.PUT, things or ANYTHING, (Destination(Toward.TO, nps),))


def _strictest(done: tuple[Avoid, ...]) -> Avoid | None:
    """What rules out all that must not be done: what is not touched is not moved, either."""
    kinds = {*done}
    return Avoid.TOUCH if Avoid.TOUCH in kinds else kinds.pop() if len(kinds) == 1 else None


_OR = either(sequence(OPTIONAL_COMMA, "or, nor"), COMMA)
DONE = sequence(
    separated(
        one_of(
            {
                Avoid.TOUCH: forbidden.TOUCHED,
                Avoid.MOVE: forbidden.DISTURBED,
                Avoid.HIT: forbidden.WAS_HIT,
            }
        ),
        _OR,
        most=3,
    ),
    build=_strictest,
)
DONE_OR_TURNED = either(DONE, one_of({Avoid.OPEN: "opened", Avoid.CLOSE: "closed, shut"}))
"""Behind "must not be": one or several things that are not to happen ("lifted or shifted")."""
_DOING = sequence(
    separated(
        one_of(
            {
                Avoid.TOUCH: forbidden.TOUCH,
                Avoid.MOVE: f"{forbidden.DISTURB}, {verbs.PICK}",
                Avoid.HIT: forbidden.HIT,
            }
        ),
        _OR,
        most=3,
    ),
    build=lambda done: _strictest(done) if done[1:] else None,
)
"""Several such things behind "do not" or "without" ("lift or move")."""
TOUCHED_OR_MOVED = one_of(
    {Avoid.TOUCH: forbidden.TOUCH, Avoid.MOVE: forbidden.DISTURB, Avoid.HIT: forbidden.HIT}
)
FORBIDDEN = either(
    sequence(_DOING, THINGS, build=AvoidClause),
    sequence(
        one_of(
            {
                Avoid.HARM: forbidden.HARM,
                Avoid.MOVE: verbs.PICK,
                Avoid.OPEN: verbs.OPEN,
                Avoid.CLOSE: verbs.CLOSE,
            }
        ),
        THINGS,
        optional(small_words.TRAILING_THEN),
        build=AvoidClause,
    ),
    sequence(
        either(
            sequence(
                one_of({Avoid.TOUCH: forbidden.TOUCH, Avoid.HIT: forbidden.HIT}),
                THINGS,
                build=AvoidClause,
            ),
            sequence(forbidden.DISTURB, THINGS, build=_undisturbed),
            sequence(
                forbidden.UPSET, THINGS, "over", build=partial(AvoidClause, Avoid.HIT, over=True)
            ),
        ),
        WITH_IT,
        optional(small_words.TRAILING_THEN),
        build=with_it,
    ),
    LET_MEET,
    sequence("drop[ping], los(e|ing)", THINGS, build=not_dropped),
    sequence("spill[ing]", THINGS, build=not_spilled),
    sequence("let[ting]", THINGS, f"{forbidden.TO_THE_FLOOR}, {OFF_THE_DESK}", build=unharmed),
    sequence(
        "drop[ping], throw[ing], knock[ing], push[ing], roll[ing]",
        THINGS,
        "[off the (desk|table)] [down] (on|onto|to) the (floor|ground)",
        build=unharmed,
    ),
    sequence(
        "let[ting]",
        "anything",
        f"{forbidden.FALL_DOWN}, {LEAVE_THE_DESK}",
        build=lambda: NOTHING_HARMED,
    ),
    sequence(
        "drop[ping], spill[ing], break[ing], knock[ing] over",
        "anything",
        build=lambda: NOTHING_HARMED,
    ),
    sequence(phrase(verbs.BRING, Avoid.MOVE), THINGS, "away, down", build=AvoidClause),
    sequence(
        either(
            sequence(
                verbs.BRING,
                THINGS,
                either(
                    phrase("(out|off) [of] [it|there]", "it"), phrase("(out|off) [of] them", "them")
                ),
                build=_taken_from,
            ),
            sequence(verbs.REMOVE, THINGS),
        ),
        build=lambda things: AvoidClause(Avoid.MOVE, things, taken=True),
    ),
    sequence("let[ting]", THINGS, phrase(forbidden.TOPPLE), build=unhit),
    sequence(phrase(verbs.SET, Avoid.PUT), THINGS, DESTINATIONS, build=AvoidClause),
    sequence(
        # "Do not take the cup anywhere"
        phrase(f"{verbs.SET_DOWN}, {verbs.FETCH}", Avoid.MOVE),
        THINGS,
        "anywhere, away",
        optional(small_words.TRAILING_THEN),
        build=AvoidClause,
    ),
    sequence(
        "leav(e|ing)",
        THINGS,
        silent(optional("lying, standing, sitting")),
        DESTINATIONS,
        build=lambda things, where: AvoidClause(Avoid.PUT, things, where, not_left=True),
    ),
    sequence(verbs.SHIFT, THINGS, DIRECTED, build=_not_brought),
    sequence(f"{verbs.UNSTACK}, {verbs.DISMANTLE}", THINGS, build=_left_stacked),
    sequence("tak(e|ing), pull[ing]", THINGS, "apart", build=_left_stacked),
    sequence(verbs.USE, NP_LIST, optional(sequence("for", THINGS), None), build=_unused),
    sequence(
        TOUCHED_OR_MOVED,
        forbidden.ANYTHING_ELSE,
        build=lambda avoid: AvoidClause(avoid, None),
    ),
)
NO_CONTACT = sequence(
    one_of({Avoid.TOUCH: forbidden.NO_TOUCH, Avoid.HIT: forbidden.NO_HIT}),
    THINGS,
    build=AvoidClause,
)
AVOIDED = sequence(
    "avoid, [while] avoiding",
    either(NO_CONTACT, sequence(THINGS, build=partial(AvoidClause, Avoid.TOUCH))),
)

"""Rules for what must not be done."""

from __future__ import annotations

from functools import partial, reduce
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.falling import (
    LEAVE_THE_DESK,
    NOTHING_HARMED,
    OFF_THE_DESK,
    UNHARMED,
    neither_of,
    not_dropped,
    unharmed,
    unhit,
)
from etot_cli.reasoning.language.grammar.conditions.instruments import (
    LET_MEET,
    MEETING,
    NOT_MET,
    WITH_IT,
    with_it,
)
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    silent,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    OPTIONAL_COMMA,
    WORDS,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.being_so import NONE, OPEN_OR_CLOSED, not_left
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, DIRECTED
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS, NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.requests.arrangements import HELD_MEANWHILE
from etot_cli.reasoning.language.grammar.requests.emptying import ANYTHING
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    Avoid,
    AvoidClause,
    Clause,
    EnsureClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import forbidden, nouns, places, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS
from etot_cli.reasoning.language.words.places import Prep


def _avoid(avoid: Avoid, things: Things, where: Any = ()) -> AvoidClause:
    return AvoidClause(avoid, things, where or ())


def _undisturbed(things: Things) -> AvoidClause | None:
    """What is not to be moved; "without pushing it off the desk" says where it stays."""
    off = any(item.prep is Prep.FROM for np in things.phrases for item in np.modifiers)
    return None if off else _avoid(Avoid.MOVE, things)


def _left_stacked(things: Things) -> AvoidClause | None:
    """What lies upon each other is left so by who moves none of it; "it" may be one of these."""
    pronouns = any(np.pronoun for np in things.phrases)
    return None if pronouns else _avoid(Avoid.MOVE, things)


def _not_wanted(things: Things) -> AvoidClause | None:
    """What is to be left alone; "any cups on the tray" are not to be there."""
    told = any(np.determiner in ("any", "a", "an", "") and np.modifiers for np in things.phrases)
    return None if told else AvoidClause(Avoid.MOVE, things, negated=True)


def _unused(nps: tuple[NounPhrase, ...], things: Things | None) -> AvoidClause:
    """What is not to be used is not to hold or bear things, some or any."""
    return AvoidClause(Avoid.PUT, things or ANYTHING, (Destination(Toward.TO, nps),))


def _none_disturbed(np: NounPhrase, avoid: Avoid) -> AvoidClause | None:
    """What is done to none of some things is done to nothing of them."""
    if np.determiner not in NONE:
        return None
    every = replace(np, determiner=NONE[np.determiner])
    return AvoidClause(avoid, Things((every,)), negated=True)


def _neither(nps: tuple[NounPhrase, ...]) -> Things | None:
    return Things(nps) if nps[1:] else None


def left_where_it_is(things: Things, at: tuple[Modifier, ...]) -> AvoidClause | None:
    """What stays where it is, with where that is ("leave the cup where it is on the tray")."""
    if len(things.phrases) > 1 or any(item.prep not in (Prep.ON, Prep.IN) for item in at):
        return None
    np = reduce(NounPhrase.told_by, at, things.phrases[0])
    return None if np.pronoun else _avoid(Avoid.MOVE, replace(things, phrases=(np,)))


def _not_falling_off(nps: tuple[NounPhrase, ...], np: NounPhrase) -> Clause:
    """What is not to fall off something stays there; what falls off the desk, wherever on that it
    is, comes to harm.
    """
    if np.head in DESK_NOUNS:
        return unharmed(Things(nps))
    return EnsureClause((State(nps, (Destination(Toward.ON, (np,)),), kept=True),))


def _strictest(done: tuple[Avoid, ...]) -> Avoid | None:
    """What rules out all that must not be done: what is not touched is not moved, either."""
    kinds = {*done}
    return Avoid.TOUCH if Avoid.TOUCH in kinds else kinds.pop() if len(kinds) == 1 else None


_OR = either(sequence(OPTIONAL_COMMA, "or, nor"), COMMA)
_DONE = sequence(
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
_DONE_OR_TURNED = either(_DONE, one_of({Avoid.OPEN: "opened", Avoid.CLOSE: "closed, shut"}))
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


_TOUCHED_OR_MOVED = one_of(
    {Avoid.TOUCH: forbidden.TOUCH, Avoid.MOVE: forbidden.DISTURB, Avoid.HIT: forbidden.HIT}
)
_FORBIDDEN = either(
    sequence(_DOING, THINGS, build=_avoid),
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
        build=_avoid,
    ),
    sequence(
        either(
            sequence(
                one_of({Avoid.TOUCH: forbidden.TOUCH, Avoid.HIT: forbidden.HIT}),
                THINGS,
                build=_avoid,
            ),
            sequence(forbidden.DISTURB, THINGS, build=_undisturbed),
            sequence(phrase(forbidden.UPSET, Avoid.HIT), THINGS, "off, down", build=_avoid),
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
    sequence(phrase(verbs.BRING, Avoid.MOVE), THINGS, "away, down", build=_avoid),
    sequence(
        either(
            sequence(verbs.BRING, THINGS, "(out|off) [of] [it|them|there]"),
            sequence(verbs.REMOVE, THINGS),
        ),
        build=lambda things: AvoidClause(Avoid.MOVE, things, taken=True),
    ),
    sequence("let[ting]", THINGS, phrase(forbidden.TOPPLE), build=unhit),
    sequence(phrase(verbs.SET, Avoid.PUT), THINGS, DESTINATIONS, build=_avoid),
    sequence(
        # "Do not take the cup anywhere"
        phrase(f"{verbs.SET_DOWN}, {verbs.FETCH}", Avoid.MOVE),
        THINGS,
        "anywhere, away",
        optional(small_words.TRAILING_THEN),
        build=_avoid,
    ),
    sequence(
        "leav(e|ing)",
        THINGS,
        silent(optional("lying, standing, sitting")),
        DESTINATIONS,
        build=lambda things, where: AvoidClause(Avoid.PUT, things, where, not_left=True),
    ),
    sequence(phrase(verbs.SHIFT, Avoid.PUT), THINGS, DIRECTED, build=_avoid),
    sequence(f"{verbs.UNSTACK}, {verbs.DISMANTLE}", THINGS, build=_left_stacked),
    sequence("tak(e|ing), pull[ing]", THINGS, "apart", build=_left_stacked),
    sequence(verbs.USE, NP_LIST, optional(sequence("for", THINGS), None), build=_unused),
    sequence(
        _TOUCHED_OR_MOVED,
        forbidden.ANYTHING_ELSE,
        build=lambda avoid: AvoidClause(avoid, None),
    ),
)
_NO_CONTACT = sequence(
    one_of({Avoid.TOUCH: forbidden.NO_TOUCH, Avoid.HIT: forbidden.NO_HIT}), THINGS, build=_avoid
)
_AVOIDED = sequence(
    "avoid, [while] avoiding",
    either(_NO_CONTACT, sequence(THINGS, build=partial(AvoidClause, Avoid.TOUCH))),
)
AVOID = either(
    _AVOIDED,
    quiet(
        sequence(
            # "Touching nothing else"
            _TOUCHED_OR_MOVED,
            "nothing else",
            build=lambda avoid: AvoidClause(avoid, None, negated=True),
        )
    ),
    sequence(
        # "No contact with the vase", "there must be no collision with the vase"
        "[there (must|should|shall|may|is to|has to) be] no",
        _NO_CONTACT,
        silent(optional(small_words.ALL_ALONG)),
        build=lambda clause: replace(clause, negated=True),
    ),
    sequence(
        # "Nothing may be put on the desk"
        either(verbs.NOTHING_GOES, sequence(phrase(verbs.SET), "nothing")),
        DESTINATIONS,
        build=lambda *said: AvoidClause(Avoid.PUT, ANYTHING, said[-1], negated=True),
    ),
    sequence(optional(verbs.ENSURE), either(NOT_MET, UNHARMED)),
    sequence(
        # "Mind the apple"
        "mind, watch out for, [be|being] (careful|gentle|cautious) with",
        THINGS,
        build=not_dropped,
    ),
    sequence("hands off, paws off", THINGS, build=partial(AvoidClause, Avoid.TOUCH)),
    sequence(
        THINGS,
        "(is|are|remains|remain|stays|stay) (off limits|out of bounds|taboo|untouchable|tabu)",
        build=partial(AvoidClause, Avoid.TOUCH),
    ),
    sequence(
        forbidden.DO_NOT,
        _FORBIDDEN,
        silent(optional(small_words.ALL_ALONG)),
        build=lambda clause: replace(clause, negated=True),
    ),
    sequence(
        forbidden.NEED_NOT,
        _FORBIDDEN,
        build=lambda clause: replace(clause, negated=True, needless=True),
    ),
    sequence(
        THINGS,
        forbidden.NEED_NOT_BE,
        build=partial(AvoidClause, Avoid.MOVE, negated=True, needless=True),
    ),
    sequence(
        THINGS,
        "(need not|(does|do) not (need|have) to) be",
        one_of({Avoid.CLOSE: "closed, shut", Avoid.OPEN: "opened"}),
        optional("again"),
        optional(small_words.TRAILING_THEN),
        build=lambda things, avoid: AvoidClause(avoid, things, negated=True, needless=True),
    ),
    sequence(
        THINGS,
        forbidden.NEED_NOT_GO,
        DESTINATIONS,
        build=partial(AvoidClause, Avoid.PUT, negated=True, needless=True),
    ),
    sequence(
        # "The cup can go anywhere but the drawer"
        THINGS,
        f"{forbidden.MAY_GO}",
        places.ANYWHERE,
        OPTIONAL_COMMA,
        f"{nouns.EXCEPT}, {nouns.CONTRAST}",
        either(DESTINATIONS, sequence(NP_LIST, build=lambda nps: (Destination(Toward.TO, nps),))),
        build=lambda things, where: AvoidClause(Avoid.PUT, things, where, negated=True),
    ),
    sequence(
        # "None of the cups may be moved"
        noun_phrase,
        f"({forbidden.MAY}) be [ever]",
        _DONE_OR_TURNED,
        build=_none_disturbed,
    ),
    sequence(
        # "Neither the cup nor the can may be moved"
        "neither",
        sequence(separated(noun_phrase, sequence(OPTIONAL_COMMA, "nor")), build=_neither),
        either(
            sequence(
                f"({forbidden.MAY}) be [ever]",
                _DONE_OR_TURNED,
            ),
            phrase(f"({forbidden.MAY}) move", Avoid.MOVE),
        ),
        build=lambda things, avoid: AvoidClause(avoid, things, negated=True),
    ),
    sequence(verbs.NOT_WANTED, THINGS, build=_not_wanted),
    sequence(
        # "Move neither the cup nor the can", "touch neither cup"
        one_of(
            {
                Avoid.TOUCH: forbidden.TOUCH,
                Avoid.MOVE: verbs.SHIFT,
                Avoid.OPEN: verbs.OPEN,
                Avoid.CLOSE: verbs.CLOSE,
            }
        ),
        either(
            sequence("neither", separated(noun_phrase, "nor"), build=_neither),
            sequence("neither [of the]", WORDS, build=neither_of),
        ),
        build=lambda avoid, things: AvoidClause(avoid, things, negated=True),
    ),
    sequence(
        either(
            sequence(THINGS, forbidden.NOT_TO_BE),
            sequence(
                # "Make sure that the cup does not get moved"
                verbs.ENSURE,
                THINGS,
                f"{forbidden.NOT_TO_BE}, (is|are) not [ever], (does|do) not [ever] get",
            ),
        ),
        either(_DONE, phrase("opened", Avoid.OPEN)),
        build=lambda things, avoid: AvoidClause(avoid, things),
    ),
    sequence(
        # "It will not budge" is what happens to it.
        either(
            sequence(THINGS, "(must|should|shall|may|is to|are to) not"),
            sequence(verbs.ENSURE, THINGS, "(does|do|will|can) not"),
        ),
        "[ever] (move|budge|shift)",
        build=partial(AvoidClause, Avoid.MOVE),
    ),
)


WITHOUT = sequence(
    OPTIONAL_COMMA,
    either(
        sequence(forbidden.WITHOUT, _FORBIDDEN),
        sequence(
            forbidden.WITHOUT,
            f"{forbidden.UPSET}, {forbidden.DISTURB}, {forbidden.HIT}",
            NP_LIST,
            "off [of], from",
            noun_phrase,
            build=lambda nps, np: EnsureClause(
                (State(nps, (Destination(Toward.ON, (np,)),), kept=True),)
            ),
        ),
        sequence(
            forbidden.WITHOUT,
            either(
                sequence(NP_LIST, f"[ever] ({forbidden.FALLING}) [down] (off [of]|from), leaving"),
                sequence("let[ting]", NP_LIST, f"{verbs.FALL} (off [of]|from)"),
            ),
            noun_phrase,
            build=_not_falling_off,
        ),
        sequence(
            forbidden.WITHOUT,
            either(
                sequence(THINGS, forbidden.FALLING_TO_THE_FLOOR),
                sequence("drop[ping]", THINGS, "(on|onto|to) the (floor|ground)"),
            ),
            build=unharmed,
        ),
        sequence(forbidden.WITHOUT, either(MEETING, _NO_CONTACT)),
        sequence(small_words.SO_THAT, either(NOT_MET, UNHARMED)),
        HELD_MEANWHILE,
        sequence(forbidden.WITHOUT, THINGS, phrase(forbidden.TOPPLING), build=unhit),
        sequence(forbidden.WITHOUT, THINGS, forbidden.GETTING_TO_THE_FLOOR, build=unharmed),
        sequence(
            forbidden.WITHOUT,
            THINGS,
            "[ever] (being|getting)",
            _DONE,
            build=lambda things, avoid: AvoidClause(avoid, things),
        ),
        sequence(
            forbidden.WITHOUT,
            forbidden.ANYTHING_ELSE,
            "being, getting",
            _DONE,
            build=lambda avoid: AvoidClause(avoid, None),
        ),
        sequence(forbidden.WITHOUT, verbs.KEEP, NP_LIST, OPEN_OR_CLOSED, build=not_left),
        sequence("[and|but] nothing else", build=lambda: AvoidClause(Avoid.MOVE, None)),
        _AVOIDED,
    ),
)
KEEP_OUT = sequence(
    either(
        sequence(verbs.KEEP, THINGS),
        sequence(optional(verbs.ENSURE), ALL_THINGS, verbs.STAY_OUT),
    ),
    either(phrase("out of", Toward.INSIDE), phrase("off [of]", Toward.ON)),
    NP_LIST,
    build=lambda things, toward, nps: AvoidClause(
        Avoid.PUT, things, (Destination(toward, nps),), negated=True
    ),
)

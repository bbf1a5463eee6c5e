"""Rules for what must not be done."""

from __future__ import annotations

from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.conditions.falling import (
    UNHARMED,
    neither_of,
    not_dropped,
    unharmed,
    unhit,
)
from etot_cli.reasoning.language.grammar.conditions.forbidden_acts import (
    AVOIDED,
    DONE,
    DONE_OR_TURNED,
    FORBIDDEN,
    NO_CONTACT,
    TOUCHED_OR_MOVED,
)
from etot_cli.reasoning.language.grammar.conditions.instruments import MEETING, NOT_MET
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
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, WORDS, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.being_so import NONE, OPEN_OR_CLOSED, not_left
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import (
    ALL_THINGS,
    NP_LIST,
    THINGS,
)
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
    NounPhrase,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import (
    forbidden,
    nouns,
    places,
    predicates,
    small_words,
    verbs,
)
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS
from etot_cli.reasoning.language.words.places import Prep

_BESIDE = {Prep.NEAR, Prep.NEXT_TO, Prep.LEFT, Prep.RIGHT, Prep.BEHIND, Prep.FRONT, Prep.BETWEEN}


def _not_wanted(things: Things) -> AvoidClause | None:
    """What is to be left alone; "any cups on the tray" are not to be there, "the cup by the tray"
    may be to go away.
    """
    told = any(
        (np.determiner in ("any", "a", "an", "") and np.modifiers)
        or any(it.prep in _BESIDE for it in np.modifiers)
        for np in things.phrases
    )
    return None if told else AvoidClause(Avoid.MOVE, things, negated=True)


def _none_disturbed(np: NounPhrase, avoid: Avoid) -> AvoidClause | None:
    """What is done to none of some things is done to nothing of them."""
    if np.determiner not in NONE:
        return None
    every = replace(np, determiner=NONE[np.determiner])
    return AvoidClause(avoid, Things((every,)), negated=True)


def _neither(nps: tuple[NounPhrase, ...]) -> Things | None:
    return Things(nps) if nps[1:] else None


def _not_leaving(nps: tuple[NounPhrase, ...], np: NounPhrase) -> EnsureClause:
    """What is not to be pushed off something stays there."""
    return EnsureClause((State(nps, (Destination(Toward.ON, (np,)),), kept=True),))


def _not_falling_off(nps: tuple[NounPhrase, ...], np: NounPhrase) -> Clause:
    """What is not to fall off something stays there; what falls off the desk, wherever on that it
    is, comes to harm.
    """
    if np.head in DESK_NOUNS:
        return unharmed(Things(nps))
    return _not_leaving(nps, np)


_THE_REST = Things((NounPhrase(words=("the rest",), text="nothing else"),))
NOTHING_ELSE = sequence(
    either(
        sequence(
            either(
                sequence(predicates.LEAVING, "nothing else"),
                sequence("nothing else", optional(predicates.NOTHING_ELSE_THERE)),
                "there (is to|must|should|shall|may|can) be nothing else",
            ),
            DESTINATIONS,
        ),
        sequence(
            "it (should|must|may|is to) (contain|hold|carry|bear|have) nothing else",
            build=lambda *_: (Destination(Toward.TO, (NounPhrase(pronoun="it", text="it"),)),),
        ),
    ),
    build=lambda *said: AvoidClause(Avoid.PUT, _THE_REST, said[-1], not_left=True),
)
"""That what has been put somewhere is to be alone there ("… and nothing else in it")."""
NOTHING_MORE = phrase("nothing else", AvoidClause(Avoid.MOVE, None, not_left=True))
"""Behind all that is asked for."""
AVOID = either(
    AVOIDED,
    quiet(
        sequence(
            # "Touching nothing else"
            TOUCHED_OR_MOVED,
            "nothing else",
            build=lambda avoid: AvoidClause(avoid, None, negated=True),
        )
    ),
    sequence(
        # "No contact with the vase", "there must be no collision with the vase"
        "[there (must|should|shall|may|is to|has to) be] no",
        NO_CONTACT,
        silent(optional(small_words.ALL_ALONG)),
        build=lambda clause: replace(clause, negated=True),
    ),
    sequence(
        # "Nothing may be put on the desk"
        either(predicates.NOTHING_GOES, sequence(phrase(verbs.SET), "nothing")),
        DESTINATIONS,
        build=lambda *said: AvoidClause(Avoid.PUT, ANYTHING, said[-1], negated=True),
    ),
    sequence(optional(verbs.ENSURE), NOTHING_ELSE),
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
        FORBIDDEN,
        silent(optional(small_words.ALL_ALONG)),
        build=lambda clause: replace(clause, negated=True),
    ),
    sequence(
        forbidden.NEED_NOT,
        FORBIDDEN,
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
        # "None of the cups may be moved", "I want no cup moved"
        either(
            sequence(noun_phrase, f"({forbidden.MAY}) be [ever]"),
            sequence(predicates.WANTED, noun_phrase, silent(optional("to be"))),
        ),
        DONE_OR_TURNED,
        build=_none_disturbed,
    ),
    sequence(
        # "Neither the cup nor the can may be moved"
        "neither",
        sequence(separated(noun_phrase, sequence(OPTIONAL_COMMA, "nor")), build=_neither),
        either(
            sequence(
                f"({forbidden.MAY}) be [ever]",
                DONE_OR_TURNED,
            ),
            phrase(f"({forbidden.MAY}) move", Avoid.MOVE),
        ),
        build=lambda things, avoid: AvoidClause(avoid, things, negated=True),
    ),
    sequence(predicates.NOT_WANTED, THINGS, build=_not_wanted),
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
        either(DONE, phrase("opened", Avoid.OPEN)),
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
        sequence(
            forbidden.WITHOUT,
            either(
                FORBIDDEN,
                sequence(
                    f"{forbidden.UPSET}, {forbidden.DISTURB}, {forbidden.HIT}",
                    NP_LIST,
                    "off [of], from",
                    noun_phrase,
                    build=_not_leaving,
                ),
                sequence(
                    either(
                        sequence(
                            NP_LIST, f"[ever] ({forbidden.FALLING}) [down] (off [of]|from), leaving"
                        ),
                        sequence("let[ting]", NP_LIST, f"{predicates.FALL} (off [of]|from)"),
                    ),
                    noun_phrase,
                    build=_not_falling_off,
                ),
                sequence(
                    THINGS,
                    f"{forbidden.FALLING_TO_THE_FLOOR}, {forbidden.GETTING_TO_THE_FLOOR}",
                    build=unharmed,
                ),
                MEETING,
                NO_CONTACT,
                sequence(THINGS, phrase(forbidden.TOPPLING), build=unhit),
                sequence(
                    THINGS,
                    "[ever] (being|getting)",
                    DONE,
                    build=lambda things, avoid: AvoidClause(avoid, things),
                ),
                sequence(
                    forbidden.ANYTHING_ELSE,
                    "being, getting",
                    DONE,
                    build=lambda avoid: AvoidClause(avoid, None),
                ),
                sequence(verbs.KEEP, NP_LIST, OPEN_OR_CLOSED, build=not_left),
            ),
        ),
        sequence(small_words.SO_THAT, UNHARMED),
        HELD_MEANWHILE,
        # "… and no blocks moved"
        sequence(
            silent(optional("and, but, with")),
            noun_phrase,
            silent(optional("being")),
            DONE_OR_TURNED,
            build=_none_disturbed,
        ),
    ),
)
KEEP_OUT = sequence(
    either(
        sequence(verbs.KEEP, THINGS),
        sequence(optional(verbs.ENSURE), ALL_THINGS, predicates.STAY_OUT),
    ),
    either(phrase("out of", Toward.INSIDE), phrase("off [of]", Toward.ON)),
    NP_LIST,
    build=lambda things, toward, nps: AvoidClause(
        Avoid.PUT, things, (Destination(toward, nps),), negated=True
    ),
)

"""Rules for what is not to happen to things on the way: that they fall, or come to harm."""

from __future__ import annotations

from functools import partial

from etot_cli.reasoning.language.grammar.parsers.combinators import either, one_of, phrase, sequence
from etot_cli.reasoning.language.grammar.parsers.common import WORDS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.syntax.clauses import Avoid, AvoidClause, ReorientClause
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.words import forbidden, predicates
from etot_cli.reasoning.language.words.lexicon import DESK_NOUNS, THING_NOUNS, matches_any, singular
from etot_cli.world.spatial import Nearby


def unharmed(things: Things) -> AvoidClause:
    """What is not to come to harm; whatever "it" may be, nothing is to."""
    again = all(np.pronoun for np in things.phrases)
    return AvoidClause(Avoid.HARM, None if again else things)


def not_dropped(things: Things) -> AvoidClause | None:
    """What is not to be let fall; "do not drop the cup on the tray" says where not."""
    return None if any(np.modifiers for np in things.phrases) else unharmed(things)


def not_spilled(things: Things) -> AvoidClause | None:
    """What is not to be spilled; "any paint" is what some thing holds, of which no scene tells."""
    some = any(np.words and np.determiner in ("", "any", "some") for np in things.phrases)
    return None if some else unharmed(things)


def unhit(things: Things, said: str) -> AvoidClause:
    """What nothing is to knock down, or over, be it in the hand or not."""
    over = bool({"over", "topple", "toppling"} & {*said.split()})
    return AvoidClause(Avoid.HIT, things, over=over)


def _not_toppled(things: Things, said: str) -> AvoidClause | ReorientClause:
    """What is not to fall: nothing knocks it over, and "it", which is put somewhere, stands."""
    if not all(np.pronoun for np in things.phrases):
        return unhit(things, said)
    over = {"over", "topple"} & {*said.split()}
    if over and any(np.pronoun in ("they", "them", "these", "those") for np in things.phrases):
        return AvoidClause(Avoid.HIT, things, over=True)
    return ReorientClause(things, Nearby.UPRIGHT, meanwhile=True) if over else unharmed(things)


def neither_of(words: tuple[str, ...]) -> Things:
    """Both of two things."""
    several = words if singular(words[-1]) != words[-1] else (*words[:-1], f"{words[-1]}s")
    return Things((NounPhrase("both", several, text=f"neither {' '.join(words)}"),))


_TOPPLE = forbidden.TOPPLE.replace(",", "|")
NOTHING_HARMED = AvoidClause(Avoid.HARM, None)
_DESK = "|".join(sorted(DESK_NOUNS))
_WILL_NOT = "(does|do|will|can|may|should|must|shall) not"
OFF_THE_DESK = f"({predicates.FALL}) (off [of]|from|over the edge of) the [edge of the] ({_DESK})"

LEAVE_THE_DESK = f"""
    {OFF_THE_DESK}|leave the ({_DESK})|be (taken|removed|moved|lifted) (off [of]|from) the ({_DESK})
"""


def _of_none(no: str, words: tuple[str, ...]) -> Things:
    """Some things, of which something is to happen to none."""
    return neither_of(words) if no == "neither" else Things((NounPhrase("all", words),))


def _some_unharmed(things: Things) -> AvoidClause | None:
    """Of some things none is to come to harm; "no object" is anything at all."""
    return None if matches_any(things.phrases[0].head, THING_NOUNS) else unharmed(things)


_THEM = Things((NounPhrase(pronoun="them", text="neither of them"),))
_NONE_OF = either(
    sequence(
        one_of({"neither": "neither [of the]", "no": "no, none of the"}), WORDS, build=_of_none
    ),
    phrase("neither [of (them|the two)], none of them", _THEM),
)


UNHARMED = either(
    sequence(THINGS, f"{_WILL_NOT} ({forbidden.TO_THE_FLOOR})", build=unharmed),
    sequence(
        # It may well be put into something; what falls off the desk is lost.
        THINGS,
        f"{_WILL_NOT} [ever] {OFF_THE_DESK}",
        build=unharmed,
    ),
    sequence(
        THINGS,
        f"(({predicates.NOT_LEAVE})|({predicates.NOT_BE_TAKEN}) (off [of]|from)) the ({_DESK})",
        build=unharmed,
    ),
    sequence(
        THINGS,
        f"[be] not on the (floor|ground), (is|are|does|do|must|should|may|can) not [be|get]"
        f" ({forbidden.HARMED})",
        build=unharmed,
    ),
    sequence("do not let", THINGS, f"(be|get) ({forbidden.HARMED})", build=unharmed),
    sequence(
        _NONE_OF,
        f"{forbidden.TOPPLES}, (may|must|should|will|can|shall|is to|does) ({_TOPPLE})",
        build=partial(AvoidClause, Avoid.HIT, negated=True, over=True),
    ),
    sequence(_NONE_OF, f"({forbidden.MUST}) [ever] ({LEAVE_THE_DESK})", build=_some_unharmed),
    sequence(THINGS, phrase(f"{_WILL_NOT} ({_TOPPLE})"), build=_not_toppled),
    phrase(
        f"nothing ({forbidden.FALLS_DOWN}), "
        f"nothing (should|must|may|shall) ({forbidden.FALL_DOWN}), "
        f"({forbidden.NOTHING}) ({forbidden.MUST}) [ever] ({LEAVE_THE_DESK}), "
        f"({forbidden.NOTHING}) leaves the ({_DESK}), "
        f"({forbidden.NOTHING}) ((is|gets)|({forbidden.MUST}) (be|get)) ({forbidden.HARMED}), "
        f"{forbidden.EVERYTHING} ({predicates.STAY}) on the ({_DESK})",
        NOTHING_HARMED,
    ),
)
"""What is not to happen to things on the way."""

"""Rules for what stays where it is, untouched, while something else is done."""

from __future__ import annotations

from functools import partial, reduce

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
    some,
    spanned,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.modifiers import MODIFIER
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.requests.emptying import stays_empty
from etot_cli.reasoning.language.grammar.syntax.clauses import Avoid, AvoidClause, Clause
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase, Things, Toward
from etot_cli.reasoning.language.words import manner, predicates, verbs
from etot_cli.reasoning.language.words.lexicon import word_set
from etot_cli.reasoning.language.words.places import Prep


def _left_where_it_is(things: Things, at: tuple[Modifier, ...]) -> AvoidClause | None:
    """What stays where it is, with where that is ("leave the cup where it is on the tray")."""
    if len(things.phrases) > 1 or any(item.prep not in (Prep.ON, Prep.IN) for item in at):
        return None
    np = reduce(NounPhrase.told_by, at, things.phrases[0])
    return None if np.pronoun else AvoidClause(Avoid.MOVE, replace(things, phrases=(np,)))


_AWAY_FROM = "[well|far] (away from|clear of)"
_ON_THE_WAY = f"""
    [~comma] (while|when|as) (doing (it|so|that|this)|you do (it|so|that|this)), {manner.ON_THE_WAY}
"""
_EVERYTHING_ELSE = "everything else, anything else, all else, the rest of it"
_NOTHING_ELSE = "nothing else|no other (object|objects|thing|things|item|items)"
_OTHERS = "the others [of them], the rest of them"
_THERE = "[up|down|over] (there|here)"
_STAYS = either(
    sequence(predicates.LEFT_THERE, optional(f"{manner.AS_IT_IS}, put, {_THERE}, out")),
    phrase(predicates.KEEP_ITS_PLACE),
    sequence(predicates.STILL_BE, manner.WHERE_IT_IS),
)
_THE_REST = Things((NounPhrase(words=("the rest",), text="everything else"),))
_THE_OTHERS = Things((NounPhrase(words=("the others",), text="the others"),))
_ALL_ELSE = either(
    phrase(_EVERYTHING_ELSE, _THE_REST),
    phrase("the rest", Things((NounPhrase(words=("the rest",), text="the rest"),))),
    phrase(_OTHERS, _THE_OTHERS),
)
OTHERS_STILL = sequence(
    either(
        sequence(_ALL_ELSE, _STAYS),
        phrase(
            f"({_NOTHING_ELSE}) (should|must|shall|may|can|is to|are to) "
            "(be (moved|touched|changed|disturbed|displaced)|move|change)",
            _THE_REST,
        ),
        sequence("leav(e|ing), keep[ing]", _ALL_ELSE, optional(manner.AS_IT_IS)),
        sequence(
            "(apart|aside) from (that|this), other than (that|this)",
            OPTIONAL_COMMA,
            either(
                sequence("leav(e|ing) everything, keep[ing] everything", manner.AS_IT_IS),
                sequence("everything", predicates.LEFT_THERE, optional(manner.AS_IT_IS)),
            ),
            build=lambda: _THE_REST,
        ),
    ),
    build=partial(AvoidClause, Avoid.MOVE),
)
UNTOUCHED = either(
    sequence(_ALL_ELSE, manner.UNTOUCHED, build=partial(AvoidClause, Avoid.MOVE)),
    phrase(
        f"({_NOTHING_ELSE}) (moved|touched|changed|disturbed|displaced)",
        AvoidClause(Avoid.MOVE, _THE_REST),
    ),
    sequence(THINGS, manner.UNTOUCHED, build=partial(AvoidClause, Avoid.MOVE, left=True)),
)
"""The same without a verb ("bolts untouched")."""
_FINE = (
    "(is|are) [just] (fine|good|ok|okay|alright) (there|as (it is|they are)|where (it is|they are))"
)
_OF_ONE = word_set("stays remains keeps retains")


_WHERE_PUT = (" stay", " stays", " remain", " remains", " there", " standing")
"""Behind "it" this is said of what has just been put somewhere, not of what was there."""


def _in_number(text: str, clause: AvoidClause) -> AvoidClause | None:
    """What stays as it is; of "then the pen, and the cup stays where it is" the cup alone does."""
    things = clause.things
    it = things is not None and all(np.pronoun == "it" for np in things.phrases)
    if it and text.endswith(_WHERE_PUT):
        return None
    several = things is not None and len(things.phrases) > 1 and not things.either
    return None if several and _OF_ONE & {*text.split()} else clause


def _said_to_stay(clause: Clause) -> Clause:
    return replace(clause, left=True) if isinstance(clause, AvoidClause) else clause


_BARE = one_of({False: "[completely|totally|entirely] empty", True: "clear, bare, free"})
_STAYS_EMPTY = either(
    sequence(noun_phrase, predicates.LEFT_THERE, _BARE),
    sequence("leav(e|ing), keep[ing]", noun_phrase, _BARE),
)


def _stays_bare(found: tuple[NounPhrase, bool]) -> AvoidClause:
    """What stays without anything; what is kept free is so already."""
    np, free = found
    return replace(stays_empty(np, toward=Toward.TO), as_it_is=free)


_KEPT_STILL = either(
    sequence(_STAYS_EMPTY, build=_stays_bare),
    sequence(
        spanned(
            sequence(
                optional(f"let, {verbs.ENSURE}"),
                THINGS,
                either(_STAYS, _FINE),
                build=partial(AvoidClause, Avoid.MOVE),
            ),
            _in_number,
        ),
        build=lambda clause: clause,
    ),
    sequence(
        "let[ting], leav(e|ing)", THINGS, "be, in peace", build=partial(AvoidClause, Avoid.MOVE)
    ),
    OTHERS_STILL,
    sequence(
        either(
            sequence("leav(e|ing), keep[ing]", THINGS),
            sequence(optional("let"), THINGS, predicates.LEFT_THERE),
        ),
        manner.WHERE_IT_IS,
        some(MODIFIER, least=1, most=2),
        build=_left_where_it_is,
    ),
    sequence(
        # After "the cups" rather one of them that is left out.
        either(
            sequence(verbs.KEEP, THINGS, f"{manner.AS_IT_IS}, {_THERE}"),
            # "Upright as it is": how it stands no more than where
            sequence(verbs.KEEP, THINGS, "[~comma] upright", manner.AS_NOW),
            sequence(
                f"leav(e|ing) [me|us], keep[ing], {verbs.IGNORE}, you can leave",
                THINGS,
                optional("out"),
            ),
        ),
        build=lambda things: AvoidClause(Avoid.MOVE, things, as_it_is=True, far_fetched=2),
    ),
    sequence(
        "keep[ing], stay[ing]",
        "[your] (hand|hands|gripper|fingers|arm|), [well] clear",
        "off, [well] (away from|clear of), of",
        THINGS,
        silent(optional(_ON_THE_WAY)),
        build=partial(AvoidClause, Avoid.TOUCH),
    ),
    sequence("keep[ing], staying", _AWAY_FROM, THINGS, build=partial(AvoidClause, Avoid.TOUCH)),
    sequence(
        # "The cup should be on the desk and stay away from the plate" tells where it stands.
        "keep[ing], stay[ing]",
        _AWAY_FROM,
        THINGS,
        silent(phrase(_ON_THE_WAY)),
        build=partial(AvoidClause, Avoid.TOUCH),
    ),
)
KEEP_STILL = valued(_KEPT_STILL, _said_to_stay)

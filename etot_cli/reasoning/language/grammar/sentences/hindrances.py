"""Rules for what is said to stand in the way of something before, or behind, what is asked for."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    Parser,
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import ALL_THINGS
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.words import hindrances as words
from etot_cli.reasoning.language.words.places import Prep

Words = tuple[str, ...]


def _hindering(np: NounPhrase, hindered: NounPhrase, said: Words = ()) -> Things | None:
    """What is in the way of something; of several of a sort rather that which it is in the way of
    ("one holder is blocked by the apple").
    """
    if np.pronoun and hindered.pronoun:
        return None
    if hindered.determiner.split()[:1] in (["one"], ["a"], ["an"]):
        by = Modifier(Prep.HINDERED, (np,), said)
        return Things((replace(hindered, determiner="the").told_by(by),))
    np = replace(np, determiner="the") if np.determiner in ("a", "an") else np
    if hindered.words:  # of two holders "the holder" is that which it is in the way of
        hindered = hindered.told_by(Modifier(Prep.HINDERED, (np,)))
    return Things((np.told_by(Modifier(Prep.HINDERING, (hindered,), said)),))


def _hindered(hindered: NounPhrase, *said: Any) -> Things | None:
    """The same, said of what it is in the way of."""
    (np,), told = _parted(said)
    return _hindering(np, hindered, told)


def _hindered_by(np: NounPhrase, *said: Any) -> Things | None:
    """The same, said of what is in the way."""
    (hindered,), told = _parted(said)
    return _hindering(np, hindered, told)


def _standing_out(np: NounPhrase, *said: Any) -> Things:
    """What sticks out of what it is in or on."""
    (around, *_), told = _parted(said)
    return Things((np.told_by(Modifier(Prep.FROM, (around,), told)),))


def _parted(said: Iterable[Any]) -> tuple[list[NounPhrase], Words]:
    """The phrases among what was said, and the other words."""
    nps: list[NounPhrase] = []
    told: Words = ()
    for item in said:
        if isinstance(item, NounPhrase):
            nps.append(item)
        elif isinstance(item, str):
            told += (item,)
        else:
            more, words_too = _parted(item)
            nps, told = nps + more, told + words_too
    return nps, told


def _in_state(np: NounPhrase, state: str) -> Things:
    return Things((np.told_by(Modifier(Prep.QUALITY, words=(state,))),))


def _named(*nps: NounPhrase | None) -> Things | None:
    """All that is named."""
    named = tuple(np for np in nps if np is not None and np.words)
    return Things(named) if named else None


def _kept(patterns: str) -> Parser:
    """A phrase that stays in the tree."""
    return valued(phrase(patterns), lambda said: tuple(said.split()))


_OF_IT = sequence(
    either("of, from, in, on, over the (edge|rim|top|side) of", _kept("[of] the top of")),
    noun_phrase,
)
_TOO_FAR = optional(_kept(words.TOO_FAR))
_FOR_IT_TO_MOVE = sequence("for", noun_phrase, _kept(words.TO_MOVE))
_IS_WHY = either(
    sequence("because of, due to, with, thanks to", noun_phrase, silent(optional(words.THERE))),
    sequence(
        words.AS_LONG_AS,
        noun_phrase,
        either(
            silent(phrase(words.IS_THERE)),
            _kept(words.TOO_BIG),
            sequence(words.STANDS_OUT, silent(optional(_OF_IT)), _TOO_FAR),
            silent(sequence(words.BLOCKS, noun_phrase)),
        ),
    ),
)
HINDRANCE = either(
    sequence(noun_phrase, words.BLOCKS, noun_phrase, build=_hindering),
    sequence("there is, there are", noun_phrase, words.BLOCKING, noun_phrase, build=_hindering),
    sequence(noun_phrase, words.BLOCKED_BY, noun_phrase, build=_hindered),
    sequence(noun_phrase, words.KEEPS, noun_phrase, _kept(words.FROM_MOVING), build=_hindered_by),
    sequence(
        noun_phrase,
        either(sequence(_kept(words.TOO_BIG), "to"), "(makes|make) it (impossible|hard) to"),
        _kept(words.MOVE),
        noun_phrase,
        build=_hindered_by,
    ),
    sequence(noun_phrase, _kept(words.WILL_NOT_MOVE), _IS_WHY, build=_hindered),
    sequence(
        _kept(words.CAN_NOT_MOVE),
        noun_phrase,
        _IS_WHY,
        build=lambda said, np, why: _hindered(np, said, why),
    ),
    sequence(
        "because of, due to, with",
        noun_phrase,
        silent(optional(words.THERE)),
        OPTIONAL_COMMA,
        noun_phrase,
        _kept(words.WILL_NOT_MOVE),
        build=_hindered_by,
    ),
    sequence(
        noun_phrase,
        either(
            sequence(
                f"{words.STANDS_OUT}, {words.STUCK}", _OF_IT, _TOO_FAR, optional(_FOR_IT_TO_MOVE)
            ),
            sequence(words.STANDS_OUT, _TOO_FAR, _FOR_IT_TO_MOVE),
            sequence(_kept(words.TOO_BIG), _FOR_IT_TO_MOVE),
        ),
        build=_standing_out,
    ),
    sequence("there is, there are", noun_phrase, words.STANDING_OUT, _OF_IT, build=_standing_out),
    sequence(
        noun_phrase,
        one_of({"ajar": words.SLIGHTLY_OPEN, "empty": words.FREE}),
        build=_in_state,
    ),
)
"""What is so in the scene, or the instruction is refused."""
UNFIT = either(
    sequence(
        noun_phrase,
        either(
            sequence(words.UNFIT, optional(sequence("in, into, inside", noun_phrase), None)),
            sequence(words.TOO_BIG, "for", noun_phrase),
        ),
        build=_named,
    ),
    sequence(silent(phrase(words.SOMEBODY_DID_NOT)), ALL_THINGS, silent(optional(words.PROPERLY))),
    sequence(ALL_THINGS, words.NOT_QUITE),
    sequence(ALL_THINGS, words.STANDS_OUT, silent(_TOO_FAR)),
    sequence(ALL_THINGS, silent(_kept(words.DOES_NOT_MOVE))),
    sequence("there is, there are", ALL_THINGS, "in the way"),
    sequence(noun_phrase, words.ROOM_FOR_ONE, build=_named),
)
"""What is said of things, asks for nothing, and is not to be seen in the scene."""

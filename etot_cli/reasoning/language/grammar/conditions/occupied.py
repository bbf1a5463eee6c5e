"""Rules for what is in or on something already, said before what is asked for in that case."""

from __future__ import annotations

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import either, sequence
from etot_cli.reasoning.language.grammar.parsers.common import noun_phrase
from etot_cli.reasoning.language.grammar.phrases.descriptions import DESCRIBED
from etot_cli.reasoning.language.grammar.phrases.free_relatives import ALREADY_THERE
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase, Things
from etot_cli.reasoning.language.words import predicates
from etot_cli.reasoning.language.words.places import Prep


def _holding(vessel: NounPhrase, content: NounPhrase) -> Things | None:
    """A vessel by what is in it; before it that, of which others may be spoken of next."""
    if not vessel.words or vessel.modifiers or content.modifiers:
        return None
    known = content.determiner not in _INDEFINITE or content.words == ("object",)
    if vessel.determiner in _INDEFINITE:
        vessel = replace(vessel, determiner="the")  # the one that this is true of
    holding = vessel.told_by(Modifier(Prep.WITH, (content,)))
    return Things((holding,) if known else (_within(content, holding), holding))


def _held(content: NounPhrase, vessel: NounPhrase) -> Things | None:
    """What is in a vessel, which it alone tells where it is but "one holder"."""
    if not content.words or content.modifiers or vessel.modifiers:
        return None
    if vessel.determiner.split()[:1] in (["one"], ["a"], ["an"]):
        return _holding(vessel, content)
    return Things((_within(content, vessel),))


def _within(content: NounPhrase, vessel: NounPhrase) -> NounPhrase:
    return content.told_by(Modifier(Prep.FROM, (vessel,)))


_INDEFINITE = ("a", "an", "one", "some")


ALREADY = either(
    sequence(
        noun_phrase,
        "is already, are already, 's already",
        either(DESCRIBED, ALREADY_THERE),
        build=lambda np, said: Things((np.told_by(said),)),
    ),
    sequence(
        noun_phrase, f"{predicates.TAKEN_BY}, {predicates.HOLDS}", noun_phrase, build=_holding
    ),
    sequence(
        noun_phrase,
        "[already] (has|holds) [already|still|now]",
        noun_phrase,
        "(in|on) it, inside, on top, sticking out [of it|at the top]",
        build=_holding,
    ),
    sequence(
        noun_phrase,
        predicates.TAKEN_ALREADY,
        build=lambda vessel: _holding(vessel, NounPhrase("an", ("object",), text="anything")),
    ),
    sequence(
        "there (is|are) [already|still|now], (i|we|you) already have",
        noun_phrase,
        "in, inside, on [top of]",
        noun_phrase,
        build=_held,
    ),
)

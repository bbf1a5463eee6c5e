"""What "the first", "the second one" and "the latter" mean by the order of naming."""

from __future__ import annotations

from msgspec import Struct

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.reference.memory.antecedents import Mention
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.words.expressions import Expression
from etot_cli.reasoning.language.words.lexicon import OF_TWO, ORDINALS, same_noun
from etot_cli.reasoning.language.words.places import Prep

_FROM = Expression(r"\bfrom (?:the )?(left|right|front|back|top|bottom|above|below)\b")
_MOVED = (Role.THEME, Role.PART)


class InTurn(Struct, frozen=True):
    """Things by when they were named.

    Args:
        meant: which of them a number means; None where there are fewer.
        named: all that may be counted.
        sure: nothing else can have been counted, such as a row in space.
    """

    meant: Thing | None
    named: tuple[Thing, ...]
    sure: bool


def in_turn(phrase: NounPhrase, role: Role, discourse: Discourse) -> InTurn | None:
    """What a number alone means by the order of naming; None where less than two things were named
    that may be counted, or they were counted in space themselves ("the first pen … the second").

    Raises:
        ReferenceProblem: "the former" of other than two things.
    """
    number, *nouns = phrase.words or ("",)
    nouns = [noun for noun in nouns if noun != "one"]
    of_two = number in OF_TWO
    plain = phrase.determiner == "the" and not (phrase.modifiers or phrase.owner)
    if not plain or nouns[1:] or not (of_two or number in ORDINALS):
        return None
    single = [
        m
        for m in discourse.mentions
        if len(options := discourse.referents[m.referent].options) == len(options[0]) == 1
        and not discourse.is_desk(m.referent)
    ]
    noun = nouns[0] if nouns else discourse.last_noun(role) or ""
    if nouns or not (of_two or role in _MOVED):
        single = [m for m in single if same_noun(m.noun, noun)]
    if any({*m.adjectives} & {*ORDINALS} for m in single):
        return None
    together = _named_together(single, discourse)
    if of_two:
        if len(together) != 2 or nouns:
            raise ReferenceProblem(phrase.text, "no two things were named just before", 3)
        return InTurn(together[OF_TWO[number]], together, sure=True)
    moved = _things([m for m in single if m.role in _MOVED], discourse)
    named = together if not nouns and moved == together else _things(single, discourse)
    if len(named) < 2:
        return None
    index = ORDINALS[number]
    meant = named[index] if index < len(named) else None
    return InTurn(meant, named, sure=not nouns and named == together)


def counted_likewise(phrase: NounPhrase, discourse: Discourse) -> NounPhrase:
    """A number counts from the side that another one was counted from before it ("the second cup
    from the right on the first").
    """
    number, *nouns = phrase.words or ("",)
    if number not in ORDINALS or phrase.modifiers or nouns[1:]:
        return phrase
    for mention in reversed(discourse.mentions):
        alike = not nouns or nouns == ["one"] or same_noun(nouns[0], mention.noun)
        if alike and {*mention.adjectives} & {*ORDINALS}:
            side = _FROM.search(discourse.referents[mention.referent].text)
            told = Modifier(Prep.SIDE, words=("from", side[1])) if side else None
            return phrase.told_by(told) if told else phrase
    return phrase


def _named_together(mentions: list[Mention], discourse: Discourse) -> tuple[Thing, ...]:
    """The things that were named in one breath last, where they were."""
    for clause in dict.fromkeys(m.clause for m in reversed(mentions)):
        said = [m for m in mentions if m.clause == clause and m.role in _MOVED]
        if len(things := _things(said, discourse)) > 1:
            return things
    return ()


def _things(mentions: list[Mention], discourse: Discourse) -> tuple[Thing, ...]:
    return tuple(dict.fromkeys(discourse.things(*(m.referent for m in mentions))))

"""Rules for how things have to be by now, so that something is asked for."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    phrase,
    separated,
    sequence,
    some,
    spanned,
)
from etot_cli.reasoning.language.grammar.parsers.common import OPTIONAL_COMMA, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.being_so import NONE, OPEN_OR_CLOSED
from etot_cli.reasoning.language.grammar.phrases.coordination import coordinated
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Condition,
    Destination,
    NounPhrase,
    Toward,
)
from etot_cli.reasoning.language.grammar.text.splitting import QUESTION
from etot_cli.reasoning.language.words import nouns, predicates, small_words

EMPTY = "empty"
_NOW = optional("still, already, now, currently, at the moment, right now, at present")
_THERE = (Toward.INSIDE, Toward.ON, Toward.TO)
_ALL = ("both", "all", "each", "every")


def condition_of(nps: tuple[NounPhrase, ...], denied: bool, so: Any) -> Condition | None:
    """How things are that the scene knows: open, closed, empty, in or on something."""
    none = len(nps) == 1 and nps[0].determiner in NONE
    if none:  # "if none of the drawers is open"
        nps = (replace(nps[0], determiner=NONE[nps[0].determiner]),)
    every = bool(nps[1:]) or nps[0].determiner.split()[:1] in [[said] for said in _ALL]
    plain = nouns.THE_WORDS | {"", "both", *(("all", "all the") if none else ())}
    known = all(np.pronoun or np.determiner in plain for np in nps)
    if not known or (none and denied):
        return None
    some = False if every and not denied else None
    match so:
        case str():
            return Condition(nps, word=so, denied=denied or none, some=some)
        case (Destination(toward=at, targets=(_,), beside=(), denied=False) as where,) if (
            at in _THERE and not _is_in_the_way(where)
        ):
            return Condition(nps, place=where, denied=denied or none, some=some)
    return None


def _is_in_the_way(where: Destination) -> bool:
    """Whether somebody would have to try, to know it."""
    return where.targets[0].head == "way"


def _one_of_them(nps: tuple[NounPhrase, ...], so: Any) -> Condition | None:
    """That one of several things is so, or more of them."""
    found = coordinated(nps[0], nps[1:]) if nps[1:] else None
    condition = None if found is None else condition_of(found, *so)
    return None if condition is None or condition.denied else replace(condition, some=True)


def _neither_of_them(nps: tuple[NounPhrase, ...], so: Any) -> Condition | None:
    """That nothing of several things is so."""
    found = _one_of_them(nps, so)
    return None if found is None else replace(found, denied=True, some=False)


def with_it(condition: Condition, it: NounPhrase | None) -> Condition | None:
    """A condition with what "it" is in it; None where a pronoun stays unclear."""
    subjects, where = condition.subjects, condition.place

    def named(np: NounPhrase) -> NounPhrase:
        return it if it is not None and np.pronoun == "it" else np

    condition = replace(
        condition,
        subjects=tuple(map(named, subjects)),
        place=None if where is None else where.going_to(named),
    )
    if any(np.pronoun and np is not it for np in condition.named):
        return None
    return condition


def _joined(first: Condition, more: tuple[tuple[bool, Any], ...]) -> Condition | None:
    """Several conditions, of which all have to hold, or one; of what is not "open or empty" it is
    not clear what is denied, and of "and" and "or" not what comes first.
    """
    if len({either for either, _ in more}) != 1:
        return None
    (about, *others) = first.subjects
    it = None if others or first.place else about
    found: list[Condition] = []
    for _, said in more:
        same = not isinstance(said, Condition)
        part = condition_of(first.subjects, *said) if same else with_it(said, it)
        if part is None or (same and (first.denied or first.some)):
            return None
        found.append(part)
    return replace(first, more=tuple(found), either=more[0][0])


_WORD = either(OPEN_OR_CLOSED, phrase("empty", EMPTY), DESTINATIONS)
_SO = sequence(
    _NOW,
    optional(phrase("not, no longer", True), False),
    _NOW,
    _WORD,
    _NOW,
    build=lambda denied, so: (denied, so),
)
_BE = f"is, are, {predicates.LIES}"
_ONE = either(
    sequence(NP_LIST, _BE, _SO, build=lambda nps, so: condition_of(nps, *so)),
    sequence(
        optional("either"),
        separated(noun_phrase, sequence(OPTIONAL_COMMA, "or"), most=3),
        _BE,
        _SO,
        build=_one_of_them,
    ),
    sequence(
        "neither",
        separated(noun_phrase, sequence(OPTIONAL_COMMA, "nor"), most=3),
        _BE,
        _SO,
        build=_neither_of_them,
    ),
    sequence(
        "there is nothing [left|lying|standing] (in|inside|on)",
        noun_phrase,
        _NOW,
        build=lambda np: condition_of((np,), False, EMPTY),
    ),
)
_IS_SO = either(
    _ONE,
    sequence(
        _ONE,
        some(
            sequence(
                OPTIONAL_COMMA,
                one_of({False: "and, and if", True: "or, or if"}),
                either(_ONE, sequence(optional(_BE), _SO)),
                build=lambda *said: said,
            ),
            least=1,
            most=2,
        ),
        build=_joined,
    ),
)


def _said(text: str, condition: Condition | None) -> Condition | None:
    said = text.removesuffix(QUESTION).strip()
    return None if condition is None else replace(condition, text=said)


IS_SO = spanned(_IS_SO, _said)
"""How things are."""
ASKED = either(
    spanned(
        sequence("is, are", NP_LIST, _SO, QUESTION, build=lambda nps, so: condition_of(nps, *so)),
        _said,
    ),
    sequence("(check|see|look|find out) (if|whether)", IS_SO),
)
"""How things may be, which somebody is to see."""
CONDITION = either(
    sequence(small_words.IF, IS_SO),
    sequence(small_words.ONLY_IF, IS_SO, build=lambda said: replace(said, only=True)),
    sequence(small_words.UNLESS, IS_SO, build=lambda said: replace(said, so=not said.so)),
)

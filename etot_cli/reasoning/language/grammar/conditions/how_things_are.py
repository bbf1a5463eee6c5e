"""Rules for how things have to be by now, so that something is asked for."""

from __future__ import annotations

from functools import partial
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
    Modifier,
    NounPhrase,
    Toward,
)
from etot_cli.reasoning.language.grammar.text.splitting import QUESTION
from etot_cli.reasoning.language.words import nouns, predicates, small_words
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.places import Prep

EMPTY = "empty"
NOW = optional("still, already, now, currently, at the moment, right now, at present")
_THERE = (Toward.INSIDE, Toward.ON, Toward.TO)
_ALL = ("both", "all", "each", "every")
_SOME = frozenset({"", "a", "an", "any", "some", "one", "no", "any of the", "one of the"})
_STATES = frozenset({"open", "closed", EMPTY})
EVERYTHING = "everything"
_ANYTHING = frozenset({"anything", "something", "nothing"})


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


def _there_is(np: NounPhrase, so: Any) -> Condition | None:
    """That something is in or on something, or in a state, whichever it is ("a pen in the cup")."""
    noun, anything = np.head, np.head in _ANYTHING
    if np.determiner not in _SOME or np.modifiers or np.owner or noun in ("", "left"):
        return None
    much = np.determiner in ("", "some") and singular(noun) == noun and not np.may_be_much
    if np.words[1:] or isinstance(so, str) if anything else much:
        return None  # of tea in a cup no scene knows, and "it" is no one of what is open
    every = replace(np, determiner="every" if singular(noun) == noun else "all")
    condition = condition_of((replace(np, determiner="the"),), False, so)
    if condition is None:
        return None
    where, told = condition.place, replace(np, determiner="the")
    if anything:
        told = replace(np, words=(EVERYTHING,))
    elif np.determiner.endswith("of the"):
        told = told.called(singular(noun))
    if where is None:
        told = replace(told, words=(condition.word, *told.words))
    else:
        at = Prep.IN if where.toward is Toward.INSIDE else Prep.ON
        told = told.told_by(Modifier(at, where.targets))
    none = np.determiner == "no" or noun == "nothing"
    return replace(condition, subjects=(every,), denied=none, some=not none, there=told)


def _holding(holder: NounPhrase, denied: bool, what: NounPhrase, at: Toward) -> Condition | None:
    """That there is something in or on a thing, said of that ("the cup has a pen in it")."""
    where = (Destination(at, (holder,)),)
    if what.determiner in nouns.THE_WORDS:
        return condition_of((what,), denied, where)
    found = _there_is(what, where)
    if not denied or found is None:
        return found
    return None if found.denied else replace(found, denied=True, some=False)


def _such_a(np: NounPhrase) -> Condition | None:
    """That there is one in some state ("an open drawer")."""
    state, *words = np.words or ("",)
    return _there_is(replace(np, words=(*words,)), state) if state in _STATES else None


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
    NOW,
    optional(phrase("not, no longer", True), False),
    NOW,
    _WORD,
    NOW,
    build=lambda denied, so: (denied, so),
)
_STANDING = optional("left, lying, standing, sitting, left (lying|standing|sitting)")
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
)
_EMPTY = sequence(
    "there is nothing [left|lying|standing] (in|inside|on)",
    noun_phrase,
    NOW,
    build=lambda np: condition_of((np,), False, EMPTY),
)
_WHAT = either(noun_phrase, phrase("nothing", NounPhrase("", ("nothing",), text="nothing")))
_OF_SOME = either(
    sequence(NOW, _WHAT, NOW, _STANDING, _WORD, NOW, build=_there_is),
    sequence(NOW, noun_phrase, NOW, build=_such_a),
)
_HOLDS = one_of({False: "has, contains, holds", True: "does not (have|contain|hold)"})
_WITHIN = one_of(
    {Toward.INSIDE: "in (it|there), inside [it]", Toward.ON: "on (it|top), on top of it"}
)
_THERE_IS = either(
    sequence(noun_phrase, NOW, _HOLDS, NOW, _WHAT, NOW, _WITHIN, NOW, build=_holding),
    sequence(
        noun_phrase,
        one_of({False: "contains", True: "does not contain"}),
        _WHAT,
        build=partial(_holding, at=Toward.INSIDE),
    ),
    sequence("there (is|are)", _OF_SOME),
    sequence(_WHAT, _BE, NOW, _STANDING, _WORD, NOW, build=_there_is),
)
_IS_SO = either(
    _ONE,
    _THERE_IS,
    sequence(
        either(_ONE, _EMPTY),
        some(
            sequence(
                OPTIONAL_COMMA,
                one_of({False: "and, and if", True: "or, or if"}),
                either(_ONE, _EMPTY, sequence(optional(_BE), _SO)),
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
    spanned(sequence("(is|are) there", _OF_SOME, QUESTION), _said),
    sequence("(check|see|look|find out) (if|whether)", IS_SO),
)
"""How things may be, which somebody is to see."""
CONDITION = either(
    sequence(small_words.IF, IS_SO),
    sequence(small_words.ONLY_IF, IS_SO, build=lambda said: replace(said, only=True)),
    sequence(small_words.UNLESS, IS_SO, build=lambda said: replace(said, so=not said.so)),
)

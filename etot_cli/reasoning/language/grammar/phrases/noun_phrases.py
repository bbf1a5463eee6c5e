"""Rules for several noun phrases in a row: all of them, or a choice."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
    Rule,
    at_end,
    either,
    optional,
    phrase,
    separated,
    sequence,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    DESCRIPTIVE,
    LIST,
    LIST_COMMA,
    OPTIONAL_COMMA,
    WORDS,
    ahead,
    alternatives,
    exceptions,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.colors import COLORS_ALONE, ONES_OF_A_COLOR
from etot_cli.reasoning.language.grammar.phrases.comparing import COMPARED, WHICHEVER_IS, the_more
from etot_cli.reasoning.language.grammar.phrases.coordination import (
    coordinated,
    of_each,
    told_together,
)
from etot_cli.reasoning.language.grammar.phrases.naming import NAMED
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase, Things
from etot_cli.reasoning.language.words import manner, predicates, small_words
from etot_cli.reasoning.language.words.categories import MASS_NOUNS
from etot_cli.reasoning.language.words.lexicon import (
    NUMBERS,
    is_descriptive,
    same_noun,
    singular,
    word_set,
)
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.patterns import openings_of


def _both(both: Any, nps: tuple[NounPhrase, ...] | None) -> tuple[NounPhrase, ...] | None:
    return None if nps is None or (both and len(nps) < 2) else nps


def begins_like_a_verb(np: NounPhrase) -> bool:
    """Whether a phrase may be a clause: "open right drawer" behind "close left drawer and" is."""
    return not np.determiner and len(np.words) > 1 and np.words[0] in ("open", "shut", "empty")


def _listed(first: NounPhrase, more: tuple[Any, ...]) -> tuple[NounPhrase, ...] | None:
    """Several phrases; in "the cup, the left one" and "off it, the cup" no "and" says that there
    are two, and the "and" in "the red, green and large blue blocks" is that of the list.
    """
    if any(begins_like_a_verb(np) for _, np in more):
        return None
    if any(np.joined and not (said or np.determiner) for said, np in more):
        return None
    joined = any(said for said, _ in more)
    apposed = any(
        np.head == "one" or (np.determiner == "one" and not np.words and np.modifiers)
        for _, np in more
    )
    renamed = any(
        np.determiner.startswith("any")
        and np.words == first.words[len(first.words) - len(np.words) :]
        for _, np in more
    )
    if renamed or ((apposed or first.pronoun) and not joined and more):
        return None
    found = coordinated(first, tuple(np for _, np in more))
    if found and found[1:] and first.head == "contents" and first.modifiers:
        found = of_each((first, *(np for _, np in more))) or found
    return None if found is None else told_together(found)


def _parts(
    whole: str, words: tuple[str, ...], parts: tuple[tuple[str, ...], ...]
) -> tuple[NounPhrase, ...] | None:
    """Each of several things that the words behind them tell apart ("both cups, red and blue");
    "large first, small last" rather tells an order.
    """
    if any(part[1:] and part[-1] in ("first", "last") for part in parts):
        return None
    if len(parts) < 2 or NUMBERS.get(whole.split()[-1], len(parts)) != len(parts):
        return None
    each = ((*words[:-1], *part, singular(words[-1])) for part in parts)
    return tuple(NounPhrase("the", said, text=f"the {' '.join(said)}") for said in each)


def with_all(every: NounPhrase, one: NounPhrase) -> tuple[NounPhrase, ...] | None:
    """All of some things, one of which is named besides ("all cups, including the red one")."""
    whole = every.determiner.split()[:1] in (["all"], ["both"], ["every"], ["each"])
    whole = whole or (every.determiner in THE_WORDS and singular(every.head) != every.head)
    alike = one.is_elliptic or (one.words and same_noun(every.head, one.head))
    told = one.determiner in THE_WORDS and (one.modifiers or one.words[1:])
    if not (whole and every.words and not every.modifiers and alike and told):
        return None
    return (replace(every, including=one),)


_INCLUDING = either(
    sequence(
        noun_phrase,
        OPTIONAL_COMMA,
        "including, even",
        noun_phrase,
        either(COMMA, at_end),
        build=with_all,
    ),
    sequence(noun_phrase, COMMA, noun_phrase, "included", either(COMMA, at_end), build=with_all),
)
_PART = sequence(optional("the, a, an"), some(DESCRIPTIVE, least=1, most=3), optional("one"))
_PARTS = sequence(
    phrase("the, these, both, both the, the two, the three, all three, all three the, all two"),
    WORDS,
    COMMA,
    separated(_PART, LIST, most=4),
    either(COMMA, at_end),
    build=_parts,
)
_MODAL = openings_of((predicates.MODAL,))
_BEFORE_VERB = Parser(lambda given, at: [(at, NOTHING)] if given.ahead[at] in _MODAL else [])
_TOO = optional(sequence("too, as well", OPTIONAL_COMMA, _BEFORE_VERB))
"""Behind the last of several things of which something is said next."""
_LIST = sequence(
    noun_phrase,
    some(
        either(
            sequence(LIST_COMMA, noun_phrase, build=lambda np: (False, np)),
            sequence(
                OPTIONAL_COMMA, small_words.AND, noun_phrase, _TOO, build=lambda np: (True, np)
            ),
        ),
        most=9,
    ),
    build=_listed,
)


def _out_of(nps: tuple[NounPhrase, ...]) -> bool:
    """Whether some of all these are meant ("one of the apple and the pear")."""
    number, of, *_ = (*nps[0].determiner.split(), "", "")
    single = singular(nps[0].head) == nps[0].head and nps[0].head not in MASS_NOUNS
    return bool(nps[1:]) and of == "of" and single and number in (*NUMBERS, "either")


def _one_among(nps: tuple[NounPhrase, ...]) -> Things | None:
    """One of several things that are named one by one."""
    (number, _, *the), text = nps[0].determiner.split(), nps[0].text.split(maxsplit=2)
    first = replace(nps[0], determiner=" ".join(the), text=text[-1])
    return Things((first, *nps[1:]), either=True) if number in ("one", "either") else None


_COORDINATION = sequence(_LIST, build=lambda nps: None if _out_of(nps) else nps)
_NEITHER = sequence(alternatives(noun_phrase, 3), build=lambda nps: nps if nps[1:] else None)
noun_phrase.define(NAMED)
exceptions.define(either(_COORDINATION, ONES_OF_A_COLOR, _NEITHER))
AHEAD_OF_PLACES = word_set("in on into onto inside to")
"""What a place of what alone goes there begins with."""


_KNOWN_ONES = [[word] for word in (*THE_WORDS, "both", "all")]


def _and_nothing_else(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...] | None:
    """What alone is to be somewhere ("the cup and nothing else"); behind a phrase that tells where
    its thing is, that may be said of what goes there.
    """
    (first, *more) = nps
    told = any(np.modifiers or np.pronoun for np in nps)
    if told or first.determiner.split()[:1] not in _KNOWN_ONES:
        return None
    return (replace(first, determiner=f"only {first.determiner}"), *more)


NP_LIST = Rule(
    either(
        _PARTS,
        sequence(
            _COORDINATION,
            OPTIONAL_COMMA,
            small_words.AND_NO_MORE,
            OPTIONAL_COMMA,
            ahead(*AHEAD_OF_PLACES),
            build=_and_nothing_else,
        ),
        sequence(optional(phrase("both"), None), _COORDINATION, build=_both),
        _INCLUDING,
        COLORS_ALONE,
    )
)


def _one_of(nps: tuple[NounPhrase, ...]) -> Things | None:
    """One of several things; "what is in a cup or a bowl" is no choice between that and a bowl."""
    landmarks = [any(item.phrases for item in np.modifiers) for np in nps]
    if any(landmarks[:-1]) and not landmarks[-1]:
        return None
    whole = coordinated(nps[0], nps[1:]) if len(nps) > 1 else None
    return None if whole is None else Things(whole, either=True)


def one_not_both(things: Things) -> Things | None:
    """A choice that is told to be none of both: "either cup" is then one of two."""
    (np, *more) = things.phrases
    if things.either:
        return things
    one, *of = np.determiner.removeprefix("exactly ").removeprefix("only ").split() or ("",)
    if more or one not in ("either", "any", "one") or "other" in of:
        return None
    return Things((replace(np, determiner=f"{one} of the two"),))


_ANY_ONE = (["a"], ["an"], ["one"], ["any"], ["either"])


def one_so(np: NounPhrase, sides: tuple[tuple[str, ...], ...]) -> Things | None:
    """One of some things, told apart behind them ("a ball, left or right")."""
    *said, noun = np.words or ("",)
    one = np.determiner.split()[:1] in _ANY_ONE
    if not one or np.modifiers or not noun:
        return None
    each = ((*said, *side, singular(noun)) for side in sides)
    return Things(tuple(NounPhrase("a", w, text=f"a {' '.join(w)}") for w in each), either=True)


def tells_which(one: NounPhrase, *nps: NounPhrase) -> bool:
    """Whether phrases behind one of some things may tell which it is."""
    any_one = one.determiner.split()[:1] in _ANY_ONE and len(one.words) == 1
    return (
        any_one
        and bool(nps[1:])
        and all(np.is_elliptic or all(map(is_descriptive, np.words or (".",))) for np in nps)
    )


def _one_out_of(np: NounPhrase, nps: tuple[NounPhrase, ...] | None) -> Things | None:
    """One of some things, which are named behind that ("a vessel, be it the cup or the bowl")."""
    one = np.determiner.split()[:1] in _ANY_ONE and not np.modifiers
    named = nps and nps[1:] and all(item.words and not item.is_elliptic for item in nps)
    return Things(nps, either=True) if nps and one and named else None


_BE_IT = "be it, whether [it is]"
EITHER_SIDE = sequence(
    COMMA,
    optional(f"either, {_BE_IT}"),
    sequence(_PART, "or [be it]", _PART, build=lambda *sides: sides),
    either(COMMA, at_end),
)
"""Behind one of some things: which they are."""
ONE_TOLD_BEHIND = either(
    sequence(noun_phrase, EITHER_SIDE, build=one_so),
    sequence(noun_phrase, COMMA, _BE_IT, alternatives(noun_phrase, 3), build=_one_out_of),
)
"""One of some things, and behind it which they are ("one of the cups, be it the red or …")."""
COMPARED_CHOICE = sequence(
    alternatives(noun_phrase, 3),
    COMMA,
    WHICHEVER_IS,
    COMPARED,
    either(COMMA, at_end),
    build=lambda nps, compared: None if (np := the_more(compared, nps)) is None else Things((np,)),
)
"""One of some things by comparing them ("the pen or the pencil, whichever is shorter")."""
ALL_THINGS = valued(NP_LIST, Things)
"""Several things, and no choice between them."""
CHOICE = Rule(
    either(
        COMPARED_CHOICE,
        sequence(alternatives(noun_phrase, 5), build=_one_of),
        sequence(_LIST, build=lambda nps: _one_among(nps) if _out_of(nps) else None),
        ONE_TOLD_BEHIND,
        sequence(
            alternatives(noun_phrase, 1),
            "~comma [but] not both ~comma",
            build=lambda nps: _one_of(nps) if nps[1:] else None,
        ),
        sequence(
            noun_phrase,
            OPTIONAL_COMMA,
            manner.NOT_BOTH,
            OPTIONAL_COMMA,
            build=lambda np: one_not_both(Things((np,))),
        ),
    )
)
"""One of several things."""
THINGS = Rule(either(ALL_THINGS, CHOICE))

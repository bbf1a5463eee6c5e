"""Rules for stacks that there are: they are taken apart, or turned bottom to top."""

from __future__ import annotations

from functools import partial
from typing import Any

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    NOTHING,
    Parser,
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
    LIST,
    OPTIONAL_COMMA,
    WORDS,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS, ONTO
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import THINGS
from etot_cli.reasoning.language.grammar.requests.additions import EXTRAS, put_of
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    PutClause,
    PutGroup,
    RemoveClause,
    TowerClause,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    Things,
)
from etot_cli.reasoning.language.grammar.text.splitting import COLON
from etot_cli.reasoning.language.words import manner, nouns, places, predicates, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import NUMBERS, singular
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep

_STACKS = spellings(nouns.STACK)


def is_stack(np: NounPhrase) -> bool:
    """Whether it is called a stack."""
    return np.head in _STACKS


def _part_of(stack: NounPhrase, determiner: str, *words: str) -> NounPhrase:
    """What a stack is made of."""
    text = f"{determiner} {' '.join(words)} of {stack.text}"
    return NounPhrase(determiner, words, (Modifier(Prep.OF, (stack,)),), text=text)


def _taken_apart(things: Things) -> RemoveClause | None:
    """A stack, or the things that make one up; nothing else has parts that can be taken off."""
    (np, *more) = things.phrases
    if is_stack(np) and not more:
        return RemoveClause(Things((_part_of(np, "all", "objects"),)), stacked=True)
    several = more or singular(np.head) != np.head
    return RemoveClause(things, stacked=True) if several else None


_UPPER_ONE = "the (upper|top|topmost) (one|ones)"


def _separated(things: Things) -> RemoveClause | None:
    """What lies upon each other; "the red and the blue blocks" are rather to be sorted."""
    sorts = things.phrases[1:] and any(singular(np.head) != np.head for np in things.phrases)
    return None if sorts else _taken_apart(things)


def _of_a_pile(np: NounPhrase) -> RemoveClause | None:
    return _taken_apart(Things((np,))) if is_stack(np) else None


def _from_upon(words: tuple[str, ...], others: tuple[str, ...]) -> RemoveClause | None:
    """All of a sort that lie on others of that sort, wherever that is so."""
    if others not in ((), ("one",), words) or singular(words[-1]) != words[-1]:
        return None
    several = (*words[:-1], f"{words[-1]}s")
    things = Things((NounPhrase("all", several, text=" ".join(several)),))
    return RemoveClause(things, stacked=True)


WHEREVER = sequence(
    "wherever (there is|you (find|see)), where there is, wherever",
    "a",
    WORDS,
    optional("is, lies, stands, sits, standing, lying, sitting"),
    places.ONTO,
    "another, another of them",
    optional(WORDS, ()),
    COMMA,
    either(
        sequence("tak(e|ing), lift[ing], remov(e|ing)", _UPPER_ONE, optional("off, down, away")),
        sequence("tak(e|ing) (off|down), lift[ing] (off|down)", _UPPER_ONE),
    ),
    build=_from_upon,
)
"""Of all of them the upper ones are taken off."""
_APART = "tak(e|ing), break[ing], pull[ing]"
_NO_MORE = Parser(lambda given, at: [] if given.ahead[at] in ("by", COLON) else [(at, NOTHING)])
"""What comes next says where each of them goes, or how."""
UNSTACK = sequence(
    either(
        WHEREVER,
        sequence(verbs.UNSTACK, THINGS, build=partial(RemoveClause, stacked=True)),
        sequence(f"{verbs.UNSTACK}, {verbs.DISMANTLE}", noun_phrase, build=_of_a_pile),
        sequence("tak(e|ing), break[ing]", noun_phrase, "down", build=_of_a_pile),
        sequence(_APART, THINGS, "apart", build=_taken_apart),
        sequence("separat(e|ing)", THINGS, optional("from each other"), _NO_MORE, build=_separated),
        sequence(
            "separat(e|ing)",
            noun_phrase,
            "from",
            noun_phrase,
            _NO_MORE,
            build=lambda *pair: _separated(Things(pair)),
        ),
    ),
    silent(optional(sequence(OPTIONAL_COMMA, f"{manner.STANDS_SINGLY}, {manner.NOT_STACKED}"))),
)


def _spread(
    stack: NounPhrase, said: Any, where: tuple[Destination, ...], extras: Any
) -> PutClause | None:
    """All that a stack is made of goes to one place."""
    determiner, words = said
    if not is_stack(stack) or (words and singular(words[-1]) == words[-1]):
        return None
    parts = Things((_part_of(stack, determiner, *(words or ("objects",))),))
    return put_of((PutGroup(parts, where),), extras)


_COUNT, _ALL_OF_SO_MANY = (
    one_of({f"{all_of_them} {said}": said for said in NUMBERS if said != "one"})
    for all_of_them in ("the", "all")
)
_ITS_PARTS = either(
    sequence(phrase("its, all its, all of its, the", "all"), WORDS, build=lambda *said: said),
    sequence("its, the", _COUNT, WORDS, build=lambda *said: said),
    sequence("all [of] [the|its]", _ALL_OF_SO_MANY, WORDS, build=lambda *said: said),
    sequence(
        optional("all, all of"),
        "them [all], its parts, everything, all of it",
        build=lambda: ("all", ()),
    ),
)
SPREAD = sequence(
    f"{_APART}, {verbs.UNSTACK}, {verbs.DISMANTLE}",
    noun_phrase,
    optional("apart"),
    either(sequence(OPTIONAL_COMMA, small_words.THEN_JOINTS, OPTIONAL_COMMA), LIST),
    verbs.SET_DOWN,
    _ITS_PARTS,
    DESTINATIONS,
    EXTRAS,
    build=_spread,
)
"""A stack is taken apart, and all of it goes to one place."""
_END = one_of({"bottom": manner.AT_BOTTOM, "middle": manner.AT_MIDDLE, "top": manner.AT_TOP})
_PLAIN = sequence(noun_phrase, build=lambda np: np if np.words and not np.modifiers else None)
_ENDS = either(
    separated(
        sequence(_PLAIN, optional(predicates.BE), _END, build=lambda np, end: (np, end)),
        LIST,
        most=3,
    ),
    sequence(
        _PLAIN,
        optional(f"{predicates.BE}, {predicates.LIES}"),
        f"{places.ONTO}, above, over",
        _PLAIN,
        build=lambda upper, lower: ((upper, "top"), (lower, "bottom")),
    ),
)


def _on_each_other(
    lower: NounPhrase, base: Destination, upper: NounPhrase, upon: Destination
) -> Any:
    """The ends of a stack, with what it stands on ("blue on the tray and green on blue")."""
    same = [np.text for np in upon.targets] == [lower.text]
    more = ((base, _BASE), (upon.targets[0], _AGAIN))
    return ((lower, "bottom"), (upper, "top"), *more) if same else None


_BASE, _AGAIN = "base", "again"
_ONTO_A_BASE = sequence(ONTO, build=lambda where: (where,))
_ON_EACH_OTHER = sequence(_PLAIN, ONTO, LIST, _PLAIN, ONTO, build=_on_each_other)


def _turned_over(said: tuple[Things, tuple[Destination, ...]], ends: Any) -> TowerClause | None:
    """The same stack, or what makes one up, from top to bottom."""
    things, base = said
    named = {end: np for np, end in ends}
    (np, *more) = things.phrases
    stack = not more and (is_stack(np) or singular(np.head) != np.head)
    told = stack and len(named) == len(ends)
    foot, again = named.pop(_BASE, None), named.pop(_AGAIN, None)
    if foot and base and [to.words for to in foot.targets] != [to.words for to in base[0].targets]:
        return None
    base = base or ((foot,) if foot else ())
    layers = () if again is None else (again,)
    tower = TowerClause(things, reverses=True, base=base, again=layers, **named)
    return tower if told else None


_SO = either(COMMA, sequence(OPTIONAL_COMMA, f"with, that is, {small_words.SO_THAT}"))
REVERSED = quiet(
    sequence(
        either(
            sequence(
                f"{verbs.REVERSE}, (revers(e|ing)|flip[ping]|invert[ing]) the order (of|in)",
                THINGS,
                optional(_ONTO_A_BASE, ()),
                build=lambda things, base: (things, base),
            ),
            sequence(
                f"{predicates.WANT}, {verbs.TURN}, {verbs.STACK}, {verbs.BUILD}, {verbs.REBUILD}",
                THINGS,
                optional(_ONTO_A_BASE, ()),
                manner.TURNED_OVER,
                optional(_ONTO_A_BASE, ()),
                build=lambda things, before, after: (
                    None if before and after else (things, before or after)
                ),
            ),
        ),
        optional(sequence(_SO, either(_ENDS, _ON_EACH_OTHER)), ()),
        build=_turned_over,
    )
)

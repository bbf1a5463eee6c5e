"""Rules for what several things share that is said once: a noun at the end, "respectively"."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.combinators import (
    either,
    one_of,
    optional,
    separated,
    sequence,
    variants,
)
from etot_cli.reasoning.language.grammar.parsers.common import LIST, noun_phrase
from etot_cli.reasoning.language.grammar.phrases.destinations import destination
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import NP_LIST
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Beside,
    Destination,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.words import places
from etot_cli.reasoning.language.words.lexicon import (
    LEVELS,
    THING_NOUNS,
    is_descriptive,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

_SIDES: dict[tuple[str, ...], Nearby] = {("left",): Nearby.LEFT, ("right",): Nearby.RIGHT}
_REGIONS = {Nearby.LEFT: Nearby.AT_LEFT, Nearby.RIGHT: Nearby.AT_RIGHT}
_ACROSS = {
    Nearby.LEFT: Nearby.RIGHT, Nearby.AT_LEFT: Nearby.AT_RIGHT,
    Nearby.FRONT: Nearby.BEHIND, Nearby.AT_FRONT: Nearby.AT_BACK,
}  # fmt: skip
_OTHER_SIDE = ("the other", "side")
_ACROSS |= {other: side for side, other in _ACROSS.items()}


def lending_nouns(groups: tuple[PutGroup, ...]) -> Sequence[tuple[PutGroup, ...]]:
    """The groups as they stand, and with the last place's noun lent to those that leave theirs out
    ("A in the top and B in the bottom drawer"); what that is part of is said for all. Of "the
    drawer", which nothing tells from others, there is no front one ("A to the front, B in it").
    """
    groups = other_sides(groups)
    last = [np for np in _targets(groups[-1]) if not _is_bare(np) and np.words]
    nouns = {np.words[-1] for np in last}
    alone = [np.determiner for np in last] == ["the"] and not last[0].modifiers
    alone = alone and not any(map(_tells, last[0].words[:-1]))
    if len(nouns) != 1 or alone or matches_any(last[0].words[-1], THING_NOUNS):
        return (groups,)
    noun, whole = last[0].words[-1], [item for item in last[0].modifiers if item.prep is Prep.OF]

    def with_noun(np: NounPhrase) -> NounPhrase:
        return replace(np, words=(*np.words, noun)) if _is_bare(np) else np

    def with_whole(np: NounPhrase) -> NounPhrase:
        told = np.words[-1:] == (noun,) and any(map(_tells, np.words)) and not np.modifiers
        return replace(np, modifiers=tuple(whole)) if told else np

    lent = (*(group.going_to(with_noun) for group in groups[:-1]), groups[-1])
    shared = tuple(group.going_to(with_whole) for group in lent[:-1])
    if whole and shared != lent[:-1]:
        return ((*shared, groups[-1]),)
    bare = [item.relation for group in groups for where in group.destinations
            for item in where.beside if not item.phrases]  # fmt: skip
    if lent != groups and Nearby.AT_CENTRE in bare:
        return ()  # "A in the top, B in the middle and C in the bottom drawer": the middle one
    return (groups,) if lent == groups else (groups, lent)


def other_sides(groups: tuple[PutGroup, ...]) -> tuple[PutGroup, ...]:
    """In "A to the left of C and B to the right" the right is that of C; so it is the other way
    round, "A to the left and B to the right of C".
    """
    found = [groups[0]]
    if len(groups) > 1:
        found = [told_beside(groups[0], beside_what(groups[1]))]
    for group in groups[1:]:
        group = told_beside(_but_there(group, found[-1]), beside_what(found[-1]))
        found.append(group)
    return tuple(found)


def _but_there(group: PutGroup, before: PutGroup) -> PutGroup:
    """A group that goes "anywhere but there" does not go where the one before it does."""
    (*there, last) = group.destinations
    named = last.denied and (last.toward, last.word) == (Toward.HERE, "there")
    if not (there and named) or any(item.beside for item in before.destinations):
        return group
    out = (replace(item, denied=True) for item in before.destinations if not item.denied)
    return replace(group, destinations=(*there, *out))


def beside_what(group: PutGroup) -> tuple[Beside, ...]:
    """The landmarks of where something goes."""
    found = (item for where in group.destinations for item in where.beside if item.phrases)
    return tuple({item.phrases: item for item in found}.values())


def told_beside(group: PutGroup, marks: Sequence[Beside]) -> PutGroup:
    """A group that goes to a bare side, with the landmark that the other group has, or with the
    surface of which that goes to the other side.
    """
    (first, *more) = group.destinations
    bare = [item.relation for item in first.beside if not item.phrases]
    side = next((near for near, at in _REGIONS.items() if [at] == bare), None)
    if [(np.determiner, *np.words, *np.modifiers) for np in first.targets] == [_OTHER_SIDE]:
        side = _ACROSS.get(marks[0].relation) if len(marks) == 1 else None
        marks = [replace(m, relation=Nearby.LEFT) for m in marks]
    elif first.toward is Toward.TO:
        named = first.targets[0].modifiers  # "to the left of D" has its own
        side = None if named else _SIDES.get(first.targets[0].words)
        side = Nearby.FRONT if first.word == places.IN_FRONT else side
    else:
        marks = [m for m in marks if m.relation in (*_REGIONS, *_REGIONS.values())]
    if side is None or more or len(marks) != 1 or first.targets[1:]:
        return group
    relation = side if marks[0].relation.landmarks else _REGIONS.get(side)
    if relation is None:
        return group
    beside = (replace(marks[0], relation=relation),)
    return replace(group, destinations=(Destination(Toward.BESIDE, beside=beside),))


def _targets(group: PutGroup) -> list[NounPhrase]:
    return [np for item in group.not_denied.destinations for np in item.targets]


def _tells(word: str) -> bool:
    return is_descriptive(word) or word in LEVELS


def _is_bare(np: NounPhrase) -> bool:
    """Whether a phrase has an article and adjectives, and nothing else."""
    adjectives = np.words and all(map(_tells, np.words))
    return bool(np.determiner and adjectives) and not np.modifiers


def respective(
    things: tuple[NounPhrase, ...], where: tuple[Destination, ...]
) -> tuple[PutGroup, ...] | None:
    """Each thing with its own place."""
    if len(things) != len(where) or len(things) < 2:
        return None
    groups = (PutGroup(Things((np,)), (to,)) for np, to in zip(_single(things), where, strict=True))
    return other_sides(tuple(groups))


def _one_each(np: NounPhrase, where: tuple[Destination, ...]) -> tuple[PutGroup, ...] | None:
    """In each of several places one ("one apple each on the tray and in the bowl")."""
    if len(where) == 1:  # "in the two bowls"
        where = (where[0].going_to(lambda to: replace(to, determiner=f"each of {to.determiner}")),)
    several = where[1:] or all(singular(to.head) != to.head for to in where[0].targets)
    fits = several and np.determiner in ("one", "a", "an")
    return tuple(PutGroup(Things((np,)), (to,)) for to in where) if fits else None


def _single(nps: tuple[NounPhrase, ...]) -> tuple[NounPhrase, ...]:
    """Those that a plural noun stands for which they share ("the left and right bowls")."""
    if not any(np.loose or _is_bare(np) for np in nps):
        return nps
    return tuple(
        replace(
            np,
            determiner=np.determiner or "the",
            words=(*np.words[:-1], *map(singular, np.words[-1:])),
            loose=False,
        )
        for np in nps
    )


_PLACES = either(
    sequence(
        one_of({Toward.INSIDE: places.INTO, Toward.ON: places.ONTO, Toward.TO: places.TO}),
        NP_LIST,
        build=lambda to, nps: tuple(Destination(to, (np,)) for np in _single(nps)),
    ),
    separated(destination, LIST, most=4),
)
_ON_BOTH_SIDES = sequence(
    one_of(places.BOTH_SIDES),
    noun_phrase,
    build=lambda sides, mark: tuple(
        Destination(Toward.BESIDE, beside=(Beside(side, (mark,), mark.text),)) for side in sides
    ),
)
RESPECTIVE_PLACES = either(
    sequence(_PLACES, "[again|once again|once more] [~comma] respectively"),
    sequence("respectively [~comma]", _PLACES),
)
"""As many places as things, in the order of these."""
RESPECTIVE_GROUPS = either(
    sequence(NP_LIST, RESPECTIVE_PLACES, build=respective),
    sequence(NP_LIST, _ON_BOTH_SIDES, optional("[~comma] respectively"), build=respective),
    variants(
        sequence(noun_phrase, "each", either(_PLACES, _ON_BOTH_SIDES), build=_one_each),
        lending_nouns,
    ),
)

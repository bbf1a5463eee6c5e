"""Rules for what is said behind a place: together, upright, lying, in which order, with what."""

from __future__ import annotations

from functools import partial
from typing import Any

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.parsers.combinators import (
    at_end,
    either,
    one_of,
    optional,
    phrase,
    sequence,
    silent,
    some,
    valued,
)
from etot_cli.reasoning.language.grammar.parsers.common import (
    COMMA,
    NOUN_WORD,
    OPTIONAL_COMMA,
    noun_phrase,
)
from etot_cli.reasoning.language.grammar.phrases.being_so import SO, state_of
from etot_cli.reasoning.language.grammar.phrases.coordination import all_of
from etot_cli.reasoning.language.grammar.phrases.descriptions import PLAIN_MODIFIER, quality_alone
from etot_cli.reasoning.language.grammar.phrases.destinations import DESTINATIONS
from etot_cli.reasoning.language.grammar.phrases.noun_phrases import (
    NP_LIST,
    one_not_both,
    with_all,
)
from etot_cli.reasoning.language.grammar.phrases.of_which import OF_WHICH, told_apart
from etot_cli.reasoning.language.grammar.phrases.turns import ONE_BEFORE_ANOTHER, TURN, turns_of
from etot_cli.reasoning.language.grammar.requests.put_groups import PUT_GROUPS
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause, PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    Destination,
    Modifier,
    NounPhrase,
    State,
    Things,
    in_a_stance,
)
from etot_cli.reasoning.language.words import manner, nouns
from etot_cli.reasoning.language.words.lexicon import same_noun, singular
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby

GROUPING = either(
    phrase(manner.ANYHOW, Grouping.ANY),
    phrase(manner.TOGETHER, Grouping.TOGETHER),
    phrase(manner.SEPARATELY, Grouping.SEPARATELY),
)
BY_COLOR = phrase(manner.BY_COLOR, ("color", ()))


def _still_so(nps: tuple[NounPhrase, ...], still: bool, predicate: Any) -> State | None:
    """How things are to be; "still" so they are by now, or it is told that they are not."""
    state = state_of(nps, predicate)
    return replace(state, kept=True) if state and still and state.destinations else state


def _still_there(nps: tuple[NounPhrase, ...], still: bool, where: tuple[Destination, ...]) -> State:
    """Where things are to be that are there by now."""
    return State(nps, where, kept=still)


CONDITION = sequence(
    "with",
    NP_LIST,
    optional(phrase("still [standing|lying|sitting|resting]", True), False),
    silent(optional("standing, lying, sitting, resting")),
    SO,
    build=_still_so,
)
_BACK_THERE = sequence(
    "with",
    noun_phrase,
    "back",
    DESTINATIONS,
    build=lambda np, where: ("back", State((np,), where)),
)
"""What is to be where it was by now on what goes somewhere."""
_STILL_SO = sequence(
    NP_LIST,
    phrase("still [standing|lying|sitting|resting]", True),
    DESTINATIONS,
    build=_still_there,
)
"""The same without a word before it ("…, the pen still inside it")."""
_CONDITIONS = sequence(
    "with",
    PUT_GROUPS,
    build=lambda groups: (
        ("with", tuple(State(group.things.phrases, group.destinations) for group in groups))
        if groups[1:] and not any(group.things.either for group in groups)
        else None
    ),
)
"""Several things that are to be beside another, each on a side of its own."""
_RATHER = "with, unless that tells which"


def _unless_told_by(found: Any) -> Any:
    """In "in the jar with the pen and the cap in the box", without a comma, the pen rather tells
    which jar, where that is so.
    """
    several = isinstance(found, State) and len(found.subjects) > 1
    return (_RATHER, (found,)) if several else found


_EXTRA = sequence(
    either(
        CONDITION,
        _CONDITIONS,
        _BACK_THERE,
        sequence(
            phrase(manner.STANDING, ("stance", Nearby.UPRIGHT)),
            silent(optional(f"{manner.NOT_LYING}, {manner.ON_THE_WAY}, {manner.AS_NOW}")),
        ),
        phrase(manner.LYING, ("stance", Nearby.LYING)),
        manner.FITTING,
        sequence(optional("but, and, with"), either(GROUPING, TURN)),
        BY_COLOR,
        sequence("last", OPTIONAL_COMMA, "after", NP_LIST, build=lambda nps: ("behind", nps)),
        sequence("first", OPTIONAL_COMMA, "before", NP_LIST, build=lambda nps: ("ahead", nps)),
        valued(OF_WHICH, lambda parts: ("of which", parts)),
        sequence("including, even", noun_phrase, build=lambda np: ("including", np)),
        phrase(manner.ONE_EACH, ("each", ())),
        sequence(
            "one",
            either("per, for each, to each", sequence("in, into, on, onto", "each, every")),
            some(NOUN_WORD, least=1, most=3),
            build=lambda words: ("apart", words),
        ),
        phrase("each, apiece", ("apart", ())),
        sequence(
            either(
                sequence(phrase("all, both"), either("of them", at_end)),
                sequence(phrase(nouns.ALL_SO_MANY), optional("of them")),
                sequence(phrase(nouns.THE_SO_MANY), "of them"),
                one_of(
                    {
                        "all of it": "all of it, the whole lot [of it]",
                        "each of the": "each of them",
                        "every one of the": "every [single|last] one [of them]",
                    }
                ),
            ),
            build=lambda said: ("whole", said),
        ),
        phrase(manner.NOT_BOTH, ("one", ())),
        sequence(
            either(
                phrase("(that|which) is [currently]", False),
                phrase("(that|which) are [currently]", True),
            ),
            either(PLAIN_MODIFIER, quality_alone),
            build=lambda several, modifier: ("that", (several, modifier)),
        ),
        phrase(manner.IN_THIS_ORDER, ("ordered", ())),
        f"{manner.ONE_BY_ONE}, in (any|whatever) order",
        manner.NOT_REVERSED,
        phrase(manner.OR_REVERSED, ("exchanged", ())),
    ),
    build=lambda *found: found[0] if found else (),
)
EXTRA = either(
    sequence(COMMA, either(_EXTRA, _STILL_SO, ONE_BEFORE_ANOTHER)),
    sequence(_EXTRA, build=_unless_told_by),
)
EXTRAS = some(EXTRA, most=3)


def _back_on(things: Things, so: State) -> State:
    """How something is to be again "back on it", which the thing that goes somewhere is told by:
    "it" is that ("the tin under the jar on the shelf, with the jar back on it").
    """
    (np, *more), (upon,) = things.phrases, so.subjects
    told_by = {at.words for item in np.modifiers if item.prep in _BEARS for at in item.phrases}
    if more or upon.words not in told_by:
        return so
    where = (item.going_to(lambda at: np if at.pronoun == "it" else at) for item in so.destinations)
    return replace(so, destinations=tuple(where))


_BEARS = (Prep.UNDER, Prep.BEARING, Prep.CONTAINING, Prep.WITH)
"""How what has something on or in it is told by that."""


def _each_of(whole: NounPhrase, words: tuple[str, ...]) -> NounPhrase:
    """Each place of what things go to: "on the shelf, one on each board"; a drawer is one."""
    if same_noun(whole.head, words[-1]):
        return whole
    several = (*words[:-1], f"{words[-1]}s")
    return NounPhrase("the", several, (Modifier(Prep.OF, (whole,)),), text=" ".join(several))


def _going_along(
    groups: tuple[PutGroup, ...], nps: tuple[NounPhrase, ...]
) -> tuple[PutGroup, ...] | None:
    """What goes to the same place before or after something ("in the oven last, after the pie");
    None where that may be another place, or it is not told what that is.
    """
    targets = [np for group in groups for item in group.destinations for np in item.targets]
    known = all(np.words and np.determiner in THE_WORDS and not np.is_elliptic for np in nps)
    others = any({*np.words} & {"others", "rest"} for np in nps)
    same = len(targets) == 1 and all(np.pronoun or np.determiner in THE_WORDS for np in targets)
    if groups[1:] or others or not (known and same):
        return None
    return tuple(replace(groups[0], things=Things((np,)), along=True) for np in nps)


def put_of(
    groups: tuple[PutGroup, ...], extras: Any, grouping: Grouping = Grouping.ANY
) -> PutClause | None:
    """A clause of what goes where with what is said about it, None where that does not fit."""
    groupings = [item for item in extras if isinstance(item, Grouping)]
    conditions = tuple(item for item in extras if isinstance(item, State))
    said = [item for item in extras if isinstance(item, tuple) and item]
    conditions += tuple(
        state for name, states in said if name in ("with", _RATHER) for state in states
    )
    conditions += tuple(_back_on(groups[0].things, so) for name, so in said if name == "back")
    for one in (np for name, np in said if name == "including"):
        every = [np for group in groups for np in group.things.phrases]
        all_told = with_all(every[0], one) if len(every) == 1 else None
        if all_told is None:
            return None
        groups = (replace(groups[0], things=replace(groups[0].things, phrases=all_told)),)
    for parts in (parts for name, parts in said if name == "of which"):
        told = told_apart(groups[0].things.phrases[0], parts)
        if told is None or groups[1:] or groups[0].things.phrases[1:]:
            return None
        groups = (replace(groups[0], things=replace(groups[0].things, phrases=told)),)
    named = {item[0] for item in said}
    for name, nps in (item for item in said if item[0] in ("ahead", "behind")):
        others = _going_along(groups, nps)
        if others is None:
            return None
        groups = (*groups, *others) if name == "ahead" else (*others, *groups)
        named.add("ordered")
    turns = turns_of(said)
    if each := next((words for name, words in said if name == "apart" and words), ()):
        groups = tuple(group.going_to(partial(_each_of, words=each)) for group in groups)
    if "apart" in named and not groupings and len(groups) == 1:
        groupings = [Grouping.SEPARATELY]
    elif "apart" in named:
        return None
    if "one" in named:
        one = one_not_both(groups[0].things)
        if one is None or groups[1:]:
            return None
        groups = (replace(groups[0], things=one),)
    if "exchanged" in named:
        pair = _either_way(groups)
        if pair is None or groupings:
            return None
        groups, groupings = (pair,), [Grouping.SEPARATELY]
    if len(groupings) > 1 or turns is None:
        return None
    grouping = groupings[0] if groupings else grouping
    described = [_that_are(groups, *item[1]) for item in said if item[0] == "that"]
    if described:
        (only, *more) = described
        if more or only is None:
            return None
        groups = only
    for whole in (item[1] for item in said if item[0] == "whole"):
        things = groups[0].things
        nps = all_of(things.phrases, whole)
        if (nps == things.phrases and not nps[1:]) or groups[1:]:
            return None
        groups = (replace(groups[0], things=replace(things, phrases=nps)),)
    for stance in (item[1] for item in said if item[0] == "stance"):
        there = [in_a_stance(stance, group.destinations) for group in groups]
        if None in there:
            return None
        groups = tuple(replace(g, destinations=w or ()) for g, w in zip(groups, there, strict=True))
    return PutClause(
        groups,
        grouping,
        conditions,
        turns,
        by_color="color" in named,
        far_fetched=2 * len(described) + 2 * (_RATHER in named),
        one_each="each" in named,
        ordered="ordered" in named,
    )


def _either_way(groups: tuple[PutGroup, ...]) -> PutGroup | None:
    """Two things to two places, either to either ("A in X and B in Y, or the other way around");
    None where that cannot be.
    """
    things = [np for group in groups for np in group.things.phrases]
    places = [np for group in groups for at in group.destinations for np in at.targets]
    plain = all(
        np.determiner in THE_WORDS and np.words and singular(np.head) == np.head
        for np in (*things, *places)
    )
    (first, *more) = (at for group in groups for at in group.destinations)
    alike = [replace(at, targets=first.targets) for at in more] == [first] and not first.beside
    if not (len(groups) == len(things) == len(places) == 2 and plain and alike):
        return None
    return PutGroup(Things(tuple(things)), (replace(first, targets=tuple(places)),))


def left(groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    """A clause that leaves things where they are; to keep the board "clear of the duck" may mean
    what goes onto it as well as where it stands.
    """
    beside = (near for group in groups for at in group.destinations for near in at.beside)
    if any(near.text.startswith("clear of") for near in beside):
        return None
    found = put_of(groups, extras)
    return None if found is None else replace(found, stays=True)


def kept_together(text: str, clause: PutClause) -> PutClause:
    """What is kept together in one of several places is brought there."""
    together = "together" in text.replace(",", "").split() and clause.grouping is Grouping.ANY
    return replace(clause, stays=False, grouping=Grouping.TOGETHER) if together else clause


def _that_are(
    groups: tuple[PutGroup, ...], several: bool, modifier: Modifier
) -> tuple[PutGroup, ...] | None:
    """Things that are described behind the place ("everything on the rack that is black")."""
    (np, *more), (group, *others) = groups[0].things.phrases, groups
    bare = np.words[-1:] in (("everything",), ("anything",), ("something",))
    plural = not bare and np.determiner in ("those", "these", "all", "all the", "all those")
    if more or others or np.modifiers or plural != several or not (bare or plural):
        return None
    things = Things((replace(np, modifiers=(modifier,), text=f"{np.text} that"),))
    return (replace(group, things=things),)

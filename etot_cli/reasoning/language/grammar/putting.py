"""Rules for clauses that put things somewhere, with what is said about how and in which order."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from etot_cli.reasoning.builtin.goal import Grouping
from etot_cli.reasoning.language.grammar.common import (
    BE,
    COMMA,
    LIST,
    OPTIONAL_COMMA,
    OR,
    WITH,
)
from etot_cli.reasoning.language.grammar.destinations import (
    DESTINATIONS,
    DIRECTED,
    INTO,
    ONTO,
    destination,
)
from etot_cli.reasoning.language.grammar.gapping import RESPECTIVE_GROUPS, lending_nouns
from etot_cli.reasoning.language.grammar.modifiers import PLAIN_MODIFIER, noun_phrase, quality_alone
from etot_cli.reasoning.language.grammar.noun_phrases import NP_LIST, THINGS
from etot_cli.reasoning.language.grammar.parsing import (
    NOTHING,
    Parser,
    Rule,
    either,
    optional,
    phrase,
    quiet,
    separated,
    sequence,
    silent,
    some,
    valued,
    variants,
)
from etot_cli.reasoning.language.grammar.states import PREDICATE, state_of
from etot_cli.reasoning.language.grammar.syntax import (
    Destination,
    Modifier,
    NounPhrase,
    PutClause,
    PutGroup,
    State,
    Things,
    Toward,
)
from etot_cli.reasoning.language.grammar.taking import OPTIONAL_SOURCE, from_source
from etot_cli.reasoning.language.grammar.turns import TURN, turns_of
from etot_cli.reasoning.language.words import manner, places, small_words, verbs
from etot_cli.reasoning.language.words.lexicon import NUMBERS

_MANNER = silent(some(phrase(small_words.WITHOUT_MEANING), least=1, most=2))
GROUPING = either(
    phrase(manner.ANYHOW, Grouping.ANY),
    phrase(manner.TOGETHER, Grouping.TOGETHER),
    phrase(manner.SEPARATELY, Grouping.SEPARATELY),
)
CONDITION = sequence(WITH, NP_LIST, PREDICATE, build=state_of)
EXTRA = sequence(
    OPTIONAL_COMMA,
    either(
        GROUPING,
        CONDITION,
        phrase(manner.STANDING, ("upright", ())),
        silent(phrase(manner.FITTING)),
        sequence(
            silent(phrase(places.BUT_NOT)),
            separated(destination, OR, most=3),
            build=lambda found: ("not", found),
        ),
        sequence(silent(optional(phrase("but"), None)), TURN, build=lambda turn: turn),
        phrase(manner.BY_COLOR, ("color", ())),
        phrase(manner.ONE_EACH, ("each", ())),
        phrase("each, apiece", ("apart", ())),
        sequence(
            either(
                phrase("(that|which) is [currently]", False),
                phrase("(that|which) are [currently]", True),
            ),
            either(PLAIN_MODIFIER, quality_alone),
            build=lambda several, modifier: ("that", (several, modifier)),
        ),
        silent(phrase(f"{manner.IN_THIS_ORDER}, one (by one|after the other|after another)")),
    ),
    build=lambda *found: found[0] if found else (),
)


def _put(
    groups: tuple[PutGroup, ...], extras: Any, grouping: Grouping = Grouping.ANY
) -> PutClause | None:
    groupings = [item for item in extras if isinstance(item, Grouping)]
    conditions = tuple(item for item in extras if isinstance(item, State))
    said = [item for item in extras if isinstance(item, tuple) and item]
    turns = turns_of(said)
    named = {item[0] for item in said}
    ruled_out = tuple(place for item in said if item[0] == "not" for place in item[1])
    if "apart" in named and not groupings and len(groups) == 1:
        groupings = [Grouping.SEPARATELY]
    elif "apart" in named:
        return None
    if len(groupings) > 1 or turns is None:
        return None
    grouping = groupings[0] if groupings else grouping
    described = [_that_are(groups, *item[1]) for item in said if item[0] == "that"]
    if described:
        (only, *more) = described
        if more or only is None:
            return None
        groups = only
    if "upright" in named:
        groups = tuple(replace(group, upright=True) for group in groups)
    return PutClause(
        groups,
        grouping,
        conditions,
        turns,
        ruled_out,
        by_color="color" in named,
        far_fetched=2 * len(described),
        one_each="each" in named,
    )


def _left(groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    found = _put(groups, extras)
    return None if found is None else replace(found, stays=True)


def _kept(groups: tuple[PutGroup, ...], extras: Any) -> PutClause | None:
    """Some of several are kept where they are; to keep "the cup" there says nothing to do."""
    said = [phrase.determiner for group in groups for phrase in group.things.phrases]
    some = all(determiner in ("a", "an", *NUMBERS) for determiner in said)
    return _left(groups, extras) if some else None


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


_ASIDE = silent(
    either(OPTIONAL_COMMA, sequence(OPTIONAL_COMMA, _MANNER, OPTIONAL_COMMA, build=lambda: ()))
)


def _group(directions: Parser, particle: str) -> Parser:
    return sequence(
        THINGS,
        optional(either(phrase(manner.STANDING, True), phrase(particle, False)), False),
        _ASIDE,
        directions,
        build=lambda things, upright, where: PutGroup(things, where, upright),
    )


PUT_GROUP = _group(
    DESTINATIONS,
    "down, up, away, back, over, inside, somewhere, anywhere, some place, "
    "one (by one|at a time|after the other|after another)",
)
_GROUPED = sequence(
    silent(phrase(verbs.PUT)),
    THINGS,
    GROUPING,
    DESTINATIONS,
    build=lambda things, grouping, where: PutClause((PutGroup(things, where),), grouping),
)
_IN_TURNS = sequence(
    silent(phrase(verbs.PUT)),
    THINGS,
    COMMA,
    TURN,
    COMMA,
    DESTINATIONS,
    build=lambda things, turn, where: _put((PutGroup(things, where),), (turn,)),
)
_WITH_WHAT_IT_HOLDS = sequence(
    silent(phrase(verbs.PUT)),
    THINGS,
    COMMA,
    CONDITION,
    COMMA,
    DESTINATIONS,
    build=lambda things, held, where: PutClause((PutGroup(things, where),), conditions=(held,)),
)
PUT_GROUPS = Rule(variants(separated(PUT_GROUP, LIST, most=5), lending_nouns))
EXTRAS = some(EXTRA, most=3)
_FRONTED = quiet(
    sequence(
        either(
            sequence(silent(phrase(verbs.PUT)), DESTINATIONS, build=lambda where: where),
            sequence(
                DESTINATIONS, OPTIONAL_COMMA, silent(phrase(verbs.PUT)), build=lambda where: where
            ),
        ),
        noun_phrase,
        build=lambda where, np: PutClause((PutGroup(Things((np,)), where),)),
    )
)
"""The place before the thing."""
_ALONG_WITH = sequence(
    silent(phrase(verbs.PUT)),
    NP_LIST,
    DESTINATIONS,
    OPTIONAL_COMMA,
    silent(phrase("together with, along with")),
    NP_LIST,
    build=lambda things, where, more: PutClause((PutGroup(Things((*things, *more)), where),)),
)
DOWN = (Destination(Toward.HERE, word="down"),)
BACK = (Destination(Toward.HOME),)
_BY_COLOR = sequence(
    THINGS, silent(phrase(manner.BY_COLOR)), OPTIONAL_COMMA, DESTINATIONS, build=PutGroup
)


def _in_this_order(first_said: bool, first: NounPhrase, more: tuple[NounPhrase, ...]) -> Any:
    """Things one after the other; what stands before "then" with a place was rather put there."""
    before = (first, *more[:-1])
    placed = any(item.phrases for np in before for item in np.modifiers)
    return None if placed and not first_said else Things((first, *more))


_FIRST_THEN = sequence(
    optional(phrase("first", True), False),
    noun_phrase,
    silent(optional(phrase("first"), None)),
    some(
        sequence(
            OPTIONAL_COMMA,
            silent(phrase(small_words.THEN_JOINTS)),
            noun_phrase,
            build=lambda np: np,
        ),
        least=1,
        most=4,
    ),
    build=_in_this_order,
)
_ONE_BY_ONE = sequence(_FIRST_THEN, OPTIONAL_COMMA, DESTINATIONS, build=PutGroup)
_ONES_THAT_GO = sequence(_FIRST_THEN, silent(phrase(verbs.MODAL)), DESTINATIONS, build=PutGroup)
_SO_THAT_IT_IS = sequence(
    THINGS,
    OPTIONAL_COMMA,
    silent(phrase(small_words.SO_THAT)),
    either(
        sequence(silent(phrase("it, they")), BE, build=lambda: NOTHING),
        silent(phrase("it (stands|sits|lies), they (stand|sit|lie)")),
    ),
    DESTINATIONS,
    build=PutGroup,
)
_INSTEAD = sequence(
    DESTINATIONS,
    OPTIONAL_COMMA,
    silent(phrase("but [rather|instead]")),
    DESTINATIONS,
    build=lambda out, where: (out, where),
)


def _elsewhere(
    things: Things, out: tuple[Destination, ...], where: tuple[Destination, ...]
) -> PutClause:
    """Things that go to one place and not to another ("not in the box but on the tray")."""
    return PutClause((PutGroup(things, where),), ruled_out=out)


_IT = Things((NounPhrase(pronoun="it", text="it"),))
PUT = either(
    valued(_ONES_THAT_GO, lambda group: PutClause((group,))),
    _GROUPED,
    _FRONTED,
    _ALONG_WITH,
    _IN_TURNS,
    _WITH_WHAT_IT_HOLDS,
    sequence(
        # "Pick up the plum and place in the bowl"; "put away" and "set down" are no such words.
        silent(phrase(verbs.PLACE)),
        either(INTO, ONTO),
        build=lambda where: PutClause((PutGroup(_IT, (where,)),)),
    ),
    sequence(
        silent(phrase(verbs.PUT)),
        either(_ONE_BY_ONE, _SO_THAT_IT_IS),
        build=lambda group: PutClause((group,)),
    ),
    sequence(
        silent(phrase(verbs.PUT)),
        _BY_COLOR,
        build=lambda group: PutClause((group,), by_color=True),
    ),
    sequence(
        silent(phrase(verbs.DISTRIBUTE)),
        sequence(
            THINGS,
            silent(phrase(places.AMONG)),
            NP_LIST,
            build=lambda things, nps: PutGroup(things, (Destination(Toward.TO, nps),)),
        ),
        EXTRAS,
        build=lambda group, extras: _put((group,), extras, Grouping.SPREAD),
    ),
    sequence(
        silent(phrase(verbs.STACK)),
        PUT_GROUPS,
        build=lambda groups: PutClause(groups) if len(groups) > 1 else None,
    ),
    sequence(silent(phrase(verbs.SET_DOWN)), PUT_GROUPS, EXTRAS, build=_put),
    sequence(silent(phrase("leav(e|ing)")), PUT_GROUPS, EXTRAS, build=_left),
    sequence(silent(phrase("keep[ing]")), PUT_GROUPS, EXTRAS, build=_kept),
    sequence(
        # "Get the pen in the box" is rather about the pen that is there.
        silent(phrase("get[ting]")),
        PUT_GROUP,
        build=lambda group: PutClause((group,), far_fetched=2),
    ),
    sequence(
        silent(phrase(verbs.PUT)),
        THINGS,
        silent(phrase("not")),
        _INSTEAD,
        build=lambda things, places: _elsewhere(things, *places),
    ),
    sequence(
        silent(phrase(verbs.DO_NOT)),
        silent(phrase(verbs.PUT)),
        THINGS,
        _INSTEAD,
        build=lambda things, places: _elsewhere(things, *places),
    ),
    sequence(
        silent(phrase(verbs.PUT)),
        RESPECTIVE_GROUPS,
        build=lambda groups: PutClause(groups),
    ),
    sequence(
        silent(phrase(verbs.BRING)),
        separated(
            sequence(
                valued(sequence(THINGS, OPTIONAL_SOURCE, build=from_source), lambda things: things),
                DIRECTED,
                build=PutGroup,
            ),
            LIST,
            most=5,
        ),
        EXTRAS,
        build=_put,
    ),
    *(
        sequence(
            silent(phrase(verb)),
            THINGS,
            silent(particle),
            build=lambda things, where=where: PutClause((PutGroup(things, where),)),
        )
        for verb, particle, where in (
            (verbs.PUT_DOWN, optional(phrase("down"), None), DOWN),
            (verbs.PUT, phrase("down"), DOWN),
            (verbs.PUT_BACK, optional(phrase("back"), None), BACK),
            (verbs.PUT, phrase("back"), BACK),
        )
    ),
)
VERBLESS = sequence(PUT_GROUPS, EXTRAS, build=_put)
"""Places for things without a word for doing; only whole sentences are so."""

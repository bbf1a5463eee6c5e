"""Which of what is asked for by a condition is asked for, as things are at the start."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Close, Open, Put, Step, Thing
from etot_cli.reasoning.builtin.relations import bearers, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.understanding import Understanding
from etot_cli.reasoning.language.grammar.conditions.how_things_are import EVERYTHING
from etot_cli.reasoning.language.grammar.parsers.trees import nodes, pronouns
from etot_cli.reasoning.language.grammar.sentences.as_things_are import NOTHING
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import (
    AvoidClause,
    MoveClause,
    ReorientClause,
    themes,
)
from etot_cli.reasoning.language.grammar.syntax.phrases import (
    CLEARED,
    Condition,
    Destination,
    Modifier,
    NounPhrase,
    Things,
    Toward,
)
from etot_cli.reasoning.language.reference.geometry.space import is_flat, lies_in, rests_on, touches
from etot_cli.reasoning.language.reference.memory.antecedents import EmptyAlready
from etot_cli.reasoning.language.reference.naming.states import state_holds
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.world.state import DESK, SceneState

_HOLDS = {Toward.INSIDE: Role.CONTAINER, Toward.ON: Role.SURFACE}
"""What something is in, or on."""
_HOLDS_UNSEEN = frozenset({"cup"})
"""Kinds of vessels that may hold what no scene knows of, so that who knows if they are empty."""


def decided(state: Understanding, reading: Sequence[Spoken]) -> tuple[Spoken, ...]:
    """The clauses of a sentence that are asked for as things are, behind what the condition names;
    ``state`` notes which way was taken.

    Raises:
        ReferenceProblem: it cannot be told, or what comes next may hang on it, too.
    """
    given = [_key(said) for said in reading]
    found = tuple(said for said in reading if said.only_if is None)
    if found == (*reading,):
        _check_further(state, reading)
        return found
    for condition in dict.fromkeys(key for key in given if key is not None):
        known = state.copy()
        if found:
            known.read(found)
        clauses = [said for said, key in zip(reading, given, strict=True) if key == condition]
        found += _asked_for(state, known, clauses)
    return found


def _key(said: Spoken) -> Condition | None:
    """The condition of a clause, be it asked for where that holds or otherwise."""
    return None if said.only_if is None else replace(said.only_if, so=True)


def _asked_for(
    state: Understanding, known: Understanding, clauses: Sequence[Spoken]
) -> tuple[Spoken, ...]:
    """What is asked for of what hangs on one condition, by what is ``known`` when that is said.

    Raises:
        ReferenceProblem: it cannot be told whether the condition holds.
    """
    given = clauses[0].only_if
    assert given is not None  # it is what they hang on
    ways = [_holds(known, part) for part in given.parts]
    holds = any(ways) if given.either else all(ways)
    first, second = (
        tuple(said for said in clauses if (said.only_if == given) is is_first)
        for is_first in (True, False)
    )
    several = given.either or (given.some is not None and given.there is None)
    if several and "it" in pronouns(first[0].clause):
        raise ReferenceProblem(given.text, "say which of them is meant", 3)
    placed = given.place is not None and any(n.targets for n in _destinations(first))
    if placed and any(n.word == "there" for n in _destinations(second)):
        raise ReferenceProblem("there", "say where", 3)  # where it is, or where it was to go
    start = first[0].position - 1
    told = {so: _named(_told(given, so, holds=holds), start) for so in (True, False)}
    if given.there is not None:
        absent = (s.clause for s in clauses if s.only_if and s.only_if.so is given.denied)
        ones = (n for n in nodes((*absent,)) if isinstance(n, NounPhrase))
        if any("one" in (np.head, np.pronoun, "" if np.words else np.determiner) for np in ones):
            raise ReferenceProblem("one", "name what is meant", 3, word="one")
        if _is_what_is_there(first[0].clause):
            told[given.so] = _named(given.place.targets if given.place else (), start)
    there = (np for np in _themes(first) if holds or not _is_what_is_there(np))
    told[not given.so] += _named(there, start)
    second = tuple(_with_them(said, _themes(first)) for said in second)
    ways_out = {given.so: first, not given.so: second}
    to_do = {so: tuple(s for s in ways_out[so] if s.clause != NOTHING) for so in ways_out}
    now, otherwise = to_do[holds], to_do[not holds]
    with suppress(EmptyAlready):  # "if there is anything in the cup, empty it"
        known.read(_plain((*told[not holds], *otherwise)))  # it has to be understood, too
    if first[1:] and not ways_out[holds]:
        why = "that is not so; say whether all of it hangs on that"
        raise ReferenceProblem(given.text, why, 3)
    so = "so" if holds else "not so"
    state.context.discourse.notes.append(f"{given.text!r}: that is {so}")
    state.conditional = True
    state.undone |= not now
    stays = (isinstance(said.clause, AvoidClause) for said in now)
    state.let_be |= bool(now and otherwise) and all(stays)
    return _plain((*told[holds], *now))


def _told(given: Condition, so: bool, *, holds: bool) -> Iterable[NounPhrase]:
    """What a condition speaks of, for what is asked for where it is ``so``: what is not there can
    be meant only there, as whatever might have been.
    """
    if given.there is None:
        return given.named
    places, anything = given.place.targets if given.place else (), given.there.head == EVERYTHING
    one = replace(given.subjects[0], determiner="any")
    if so is given.denied:
        return places if anything else (one, *places)  # "if there is none, put one in it"
    if holds is so:
        return (*places, given.there)
    return (*places, replace(one, words=("object",)) if anything else one)


def _destinations(clauses: Iterable[Spoken]) -> Iterable[Destination]:
    return (n for said in clauses for n in nodes(said.clause) if isinstance(n, Destination))


def _is_what_is_there(said: object) -> bool:
    """Whether it is about whatever is in or on something ("empty it")."""
    return any(isinstance(n, Modifier) and n.words == CLEARED for n in nodes(said))


def _plain(reading: Iterable[Spoken]) -> tuple[Spoken, ...]:
    return tuple(replace(said, only_if=None) for said in reading)


def _named(nps: Iterable[NounPhrase], at: int) -> tuple[Spoken, ...]:
    return tuple(
        Spoken(ReorientClause(Things((np,)), only_named=True), at) for np in nps if not np.pronoun
    )


def _themes(clauses: Iterable[Spoken]) -> tuple[NounPhrase, ...]:
    """What the first of some clauses that names things is about, which "it" may mean in what is
    asked for instead.
    """
    for said in clauses:
        found = themes(said.clause)
        if any(not np.pronoun for np in found):
            return found
        if not isinstance(said.clause, MoveClause):
            break
    return ()


def _with_them(said: Spoken, moved: tuple[NounPhrase, ...]) -> Spoken:
    """What is left alone otherwise, where "them" is what would have been moved, not the place."""
    clause = said.clause
    several = bool(moved[1:]) or any(singular(np.head) != np.head for np in moved)
    left = clause.things if several and isinstance(clause, AvoidClause) else None
    if left is None or [np.pronoun for np in left.phrases] != ["them"]:
        return said
    return replace(said, clause=replace(clause, things=Things(moved)))


def _check_further(state: Understanding, reading: Sequence[Spoken]) -> None:
    """Whether a sentence behind a condition is clear without that.

    Raises:
        ReferenceProblem: it may be asked for only if that holds, or comes before it.
    """
    text = state.context.sentence
    first = reading[0]
    leans = [*pronouns(tuple(said.clause for said in reading))] or first.order is not Order.SAID
    if state.undone and leans:
        raise ReferenceProblem(text, "say whether that is asked for in any case", 3)
    if state.conditional and any(
        said.order in (Order.FIRST, Order.BEFORE_THAT) for said in reading
    ):
        raise ReferenceProblem(text, "say it before what depends on how things are", 3)


def _holds(state: Understanding, condition: Condition) -> bool:
    """Whether a condition holds in the scene.

    Raises:
        ReferenceProblem: it is not clear what it is about, or whether it does.
    """
    attempt = state.copy()
    scene = attempt.context.scene
    anything = condition.there is not None and condition.there.head == EVERYTHING
    subjects = () if anything else _meant(attempt, condition.subjects)
    places = _holders(attempt, condition.place) if condition.place else ()
    about = (*subjects, *places)
    touched = _touched(state, turned=condition.place is None)
    if any(
        _overlap(at, other) for thing in about for at in _around(thing, scene) for other in touched
    ):
        raise ReferenceProblem(condition.text, "what is done before it may change that", 3)
    everything = tuple(map(Thing, scene.states))
    ways = [_ways(condition, subjects or everything, at, scene) for at in places or (None,)]
    if any(way != ways[0] for way in ways):
        raise ReferenceProblem(condition.text, "say what it is in or on", 3)
    (so, *_) = ways
    if len(so) != 1:
        if condition.some is None:
            raise ReferenceProblem(condition.text, "that is so of some of them only", 3)
        return condition.some
    return so == {not condition.denied}


def _ways(
    condition: Condition, subjects: Iterable[Thing], place: Thing | None, scene: SceneState
) -> set[bool]:
    """How it is with several things, of which one is enough where one is said to be there.

    Raises:
        ReferenceProblem: that cannot be told of all, and of none it is said.
    """
    one_is_enough = condition.there is not None
    subjects = [thing for thing in subjects if not (one_is_enough and thing == place)]
    if not subjects:  # "if the teapot contains tea"
        raise ReferenceProblem(condition.text, "say what is in or on it", 3)
    found: set[bool] = set()
    unclear: Thing | None = None
    for thing in subjects:
        try:
            found.add(_is_so(condition, thing, place, scene))
        except ReferenceProblem:
            unclear = thing
    if unclear is not None and not (one_is_enough and True in found):
        _is_so(condition, unclear, place, scene)  # says why
    return found


def _holders(state: Understanding, place: Destination) -> tuple[Thing, ...]:
    """What something may be in or on, as far as it can be.

    Raises:
        ReferenceProblem: it is not clear, or nothing of it can hold anything.
    """
    role = _HOLDS.get(place.toward, Role.ANY)
    if not place.targets[1:]:
        return _meant(state, place.targets, role)
    found: list[Thing] = []
    problem: ReferenceProblem | None = None
    for np in place.targets:
        try:
            found += _meant(state.copy(), (np,), role)
        except ReferenceProblem as error:
            problem = error
    if not found and problem is not None:
        raise problem
    return tuple(found)


def _meant(
    state: Understanding, phrases: tuple[NounPhrase, ...], role: Role = Role.ANY
) -> tuple[Thing, ...]:
    """The things that are meant for sure."""
    discourse = state.context.discourse
    found: list[Thing] = []
    for index in state.context.phrases.things(Things(phrases), role):
        (*options,) = discourse.referents[index].options
        if len(options) != 1:
            raise ReferenceProblem(discourse.referents[index].text, "say which one", 3)
        found += options[0]
    return tuple(found)


def _is_so(condition: Condition, thing: Thing, place: Thing | None, scene: SceneState) -> bool:
    """Whether it holds of one thing.

    Raises:
        ReferenceProblem: that cannot be told of it.
    """
    if condition.place is None or place is None:
        info = scene.infos.get(thing.name)
        known = info is not None and bool(info.parts)
        if info is not None and condition.word == "empty":
            seen = info.container and info.kind not in _HOLDS_UNSEEN
            seen |= info.container and not state_holds("empty", thing, scene)  # a thing is in it
            known |= seen or is_flat(info) or bool(info.boards)
        elif (
            len(
                {
                    state_holds(condition.word, Thing(thing.name, p.name), scene)
                    for p in parts_of(scene, thing)
                }
            )
            > 1
        ):
            raise ReferenceProblem(condition.text, "that is so of some of its parts only", 3)
        if not known:
            raise ReferenceProblem(condition.text, "that cannot be told by the scene", 3)
        return state_holds(condition.word, thing, scene)
    how = {Toward.INSIDE: lies_in, Toward.ON: rests_on}.get(condition.place.toward, touches)
    if how(thing, place, scene):
        return True
    holders = [Thing(name) for name in bearers(scene, thing.name) if name != place.name]
    if any(touches(item, place, scene) for item in (thing, *holders)):
        raise ReferenceProblem(condition.text, "say what it is in or on", 3)
    return False


def _around(thing: Thing, scene: SceneState) -> set[str]:
    """The addresses of a thing, and of what is in or on it."""
    held = (name for name in scene.states if touches(Thing(name), thing, scene))
    return {thing.address, *held}


def _overlap(one: str, other: str) -> bool:
    """Whether two addresses are the same, or one is a part of the other."""
    return one == other or other.startswith(f"{one}.") or one.startswith(f"{other}.")


def _touched(state: Understanding, *, turned: bool) -> set[str]:
    """What was to be moved, put into or (``turned``) opened before, and what that is in by now."""
    scene, things = state.context.scene, state.context.discourse.things
    steps: list[Step] = [step for item in state.timed for step in item.steps]
    found: set[str] = set()
    for step in steps:
        if isinstance(step, Open | Close) and not turned:
            continue  # what is in a drawer stays in it
        what = step.what if isinstance(step, Put) else (step.what,)
        at = [p.where for p in step.places if p.where is not None] if isinstance(step, Put) else []
        found |= {thing.address for thing in things(*what, *at) if thing.name != DESK}
        for thing in things(*what):
            here = scene.states.get(thing.name)
            if here is not None and thing.address == thing.name:
                found |= {*here.on, *({here.inside} if here.inside else ())} - {DESK}
    return found

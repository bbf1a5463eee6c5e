"""What is opened and closed: what is said of one of several, and what takes turns.

Of drawers and doors an instruction may say how they are to stay, and that they are to be opened or
closed; one of them cannot be both at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from msgspec import structs

from etot_cli.reasoning.builtin.goal import (
    Close,
    Constraint,
    Keep,
    Open,
    Put,
    Referent,
    Step,
    Thing,
    things_in,
)
from etot_cli.reasoning.builtin.relations import is_closed, is_open, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.alone import so_many_turned
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.unchosen import is_not_chosen
from etot_cli.reasoning.language.grammar.syntax.phrases import AS_FOUND, NounPhrase, State
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.words.lexicon import singular
from etot_cli.reasoning.language.words.nouns import is_only
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import SceneState

_WAYS = {Keep.OPEN: Open, Keep.CLOSED: Close}


def leave_among_turned(context: Context, index: int, *, opens: bool) -> None:
    """What is to stay open is none of those that the clause before closes, and the other way round
    ("close all the drawers, but leave the top one open"); "all three" leaves none out.
    """
    referents, left = context.discourse.referents, context.discourse.things(index)
    for step in context.done:
        if isinstance(step, Open | Close) and isinstance(step, Open) != opens:
            (every, *others) = referents[step.what].options
            kept = tuple(thing for thing in every if thing not in left)
            counted = quantity_of(referents[step.what].text).count is not None
            if 0 < len(kept) < len(every) and not others and not counted:
                referents[step.what] = replace(referents[step.what], options=(kept,))


def leave_unclosed(context: Context, index: int, spoken: Sequence[Thing]) -> None:
    """What was spoken of before is not closed along with the rest, nor by itself once something is
    in it ("put the cup in the drawer; close the box, but not the drawer").
    """
    for thing in context.discourse.left_out.get(index, ()):
        if thing in spoken:
            context.constraints.append(Constraint(Keep.OPEN, (thing.address,)))


def in_turn(
    steps: Sequence[Step],
    constraints: Sequence[Constraint],
    referents: Sequence[Referent],
    scene: SceneState,
) -> tuple[list[Step], list[Constraint]]:
    """Steps and constraints, where what stays open until something is done with it, and is closed
    then, only takes its turns.

    Raises:
        ReferenceProblem: a part is to be both open and closed.
    """
    steps = list(steps)
    turns: dict[str, list[int]] = {}
    for at, step in enumerate(steps):
        for part in _parts(step, referents, scene):
            turns.setdefault(part, []).append(at)
    released: set[str] = set()
    for part, own in turns.items():
        for at, then in pairwise(own):
            one, other = steps[at], steps[then]
            assert isinstance(one, Open | Close) and isinstance(other, Open | Close)
            if isinstance(one, Open) == isinstance(other, Open):
                continue
            if then == at + 1 and (one.final or other.final):
                raise _both(part, other, referents)
            sweeping = len([*_parts(other, referents, scene)]) > 1
            if (
                one.final
                and sweeping
                and part not in _filled_parts(steps[at:then], referents, scene)
            ):
                raise _both(part, other, referents)
            steps[at] = replace(one, final=False)
            released.add(part)
    for item in constraints:
        way = _WAYS.get(item.keep)
        for at in (at for name in item.names if name not in released for at in turns.get(name, ())):
            if way is not None and not item.needless and not isinstance(steps[at], way):
                raise _both(item.names[0], steps[at], referents)
    kept = [
        item
        for item in constraints
        if item.keep not in _WAYS or not item.names or not {*item.names} <= released
    ]
    return steps, kept


def _both(part: str, step: Step, referents: Sequence[Referent]) -> ReferenceProblem:
    assert isinstance(step, Open | Close)
    why = f"{part} cannot be both open and closed; say which are meant, or 'then'"
    return ReferenceProblem(referents[step.what].text, why, 4)


def _filled_parts(
    steps: Sequence[Step], referents: Sequence[Referent], scene: SceneState
) -> Iterator[str]:
    """The parts that steps put something into."""
    for place in (place for step in steps if isinstance(step, Put) for place in step.places):
        for thing in () if place.where is None else things_in(referents[place.where].options):
            yield from (f"{part.owner}.{part.name}" for part in parts_of(scene, thing))


def _emptied_parts(
    steps: Sequence[Step], referents: Sequence[Referent], scene: SceneState
) -> Iterator[str]:
    """The parts that what steps move is in at the start."""
    for index in (index for step in steps if isinstance(step, Put) for index in step.what):
        for thing in things_in(referents[index].options):
            here = scene.states.get(thing.name)
            part = scene.part(here.inside) if here is not None and here.inside else None
            yield from () if part is None else (f"{part.owner}.{part.name}",)


def _parts(step: Step, referents: Sequence[Referent], scene: SceneState) -> Iterator[str]:
    """The parts that a step surely opens or closes; who opens a chest opens some drawer of it."""
    options: tuple[tuple[Thing, ...], ...] = ()
    if isinstance(step, Open | Close):
        options = referents[step.what].options
    for thing in options[0] if len(options) == 1 else ():
        parts = parts_of(scene, thing)
        if len(parts) == 1 or isinstance(step, Close):
            yield from (f"{part.owner}.{part.name}" for part in parts)


def _keep_as_it_is(
    context: Context,
    index: int,
    word: str,
    *,
    every: bool,
    left: bool = False,
    always: bool = False,
    called: str = "",
) -> None:
    """What is open or closed by now, and is to stay so, must not be moved in between; what is
    closed ``always`` must not be opened at all.

    Of a chest of drawers that was spoken of as "the drawer" or "the drawers", only what is so by
    now is meant, and noted where it is ``called`` one; ``every``: all are; ``left``: that is to
    be left closed, not kept.
    """
    keep = Keep.OPEN if word == "open" else Keep.CLOSED
    if is_not_chosen(context, index):  # "open one of the drawers and keep the other one closed"
        context.constraints.append(Constraint(keep, (), referent=index))
        return
    holds = is_open if word == "open" else is_closed
    if not every:
        context.discourse.as_it_stands(index, holds, called, word)
    # Behind what goes in or comes out of one, "leave it shut" says how it is to be in the end.
    filled = {*_filled_parts(context.done, context.discourse.referents, context.scene)}
    filled |= {*_emptied_parts(context.done, context.discourse.referents, context.scene)}
    for thing in context.discourse.things(index):
        for part in parts_of(context.scene, thing):
            name = f"{part.owner}.{part.name}"
            if (every or left) and not always and name in filled:
                if keep is Keep.CLOSED and is_closed(context.scene, part):
                    context.discourse.notes.append(f"{name} is open meanwhile, as it has to be")
                continue
            if holds(context.scene, part) or (always and word == "closed"):
                context.constraints.append(Constraint(keep, (name,)))


def _leave_out(context: Context, index: int, word: str) -> None:
    """Of several that "the drawer" may mean, what is open or closed anyway is not spoken of."""
    so = is_open if word == "open" else is_closed
    referent = context.discourse.referents[index]
    options = tuple(
        option
        for option in referent.options
        if not all(
            so(context.scene, part) for thing in option for part in parts_of(context.scene, thing)
        )
    )
    context.discourse.referents[index] = replace(referent, options=options or referent.options)


def ensure_turned(context: Context, state: State) -> None:
    """Adds the steps after which something is open, or closed, as it is said to be."""
    if state.word == AS_FOUND:
        _turn_as_found(context, state)
        return
    opens = state.word == "open"
    for phrase in state.subjects:
        so, others = so_many_turned(context, phrase, opens=opens)
        for thing in (*so, *others):
            part = context.single(thing, thing.part or thing.name)
            context.steps.append(_made(part, opens=opens == (thing in so)))
        if so:
            if state.denied or state.kept or state.allowed:
                raise ReferenceProblem(phrase.text, "say which", 3)
            continue
        if phrase.determiner in ("a", "an"):
            # Of the drawers, not the whole chest
            phrase = structs.replace(phrase, determiner="one")
        for index in context.phrases.refer(phrase, Role.PART):
            if state.allowed:
                context.discourse.notes.append(f"{phrase.text!r} may be {state.word}, or not")
                continue
            if state.denied:
                _leave_out(context, index, state.word)
            if state.kept:
                one = phrase.determiner == "the" and phrase.head == singular(phrase.head)
                one &= all(
                    phrase.head != context.scene.infos[thing.name].label.split()[-1]
                    for thing in context.discourse.things(index)
                )
                _keep_as_it_is(
                    context,
                    index,
                    state.word,
                    every=quantity_of(phrase.determiner).every,
                    left=not opens and f"leave {phrase.text} " in context.sentence.lower(),
                    always=state.always,
                    called=phrase.text if one else "",
                )
            leave_among_turned(context, index, opens=opens)
            context.steps.append(_made(index, opens=opens))
            _not_instead(context, phrase, index, opens=opens)
        if is_only(phrase.determiner):
            own = context.discourse.things(index)
            rest = [t for t in context.all_called(phrase, Role.PART) if t not in own]
            if not rest:
                _check_only(context, phrase, own, opens=opens)
            for thing in rest:
                other = context.single(thing, thing.part or thing.name)
                context.steps.append(_made(other, opens=not opens))


def _check_only(context: Context, phrase: NounPhrase, own: Sequence[Thing], *, opens: bool) -> None:
    """Whether nothing that is called otherwise is open beside what alone is to be so, or closed.

    Raises:
        ReferenceProblem: something is, which may be meant by "only".
    """
    so = is_open if opens else is_closed
    parts = [part for info in context.scene.infos.values() for part in info.parts]
    alike = [part.owner for thing in own for part in parts_of(context.scene, thing)]
    others = [p.address for p in parts if p.owner not in alike and so(context.scene, p)]
    if others:
        why = f"say whether {' and '.join(others)} is to be {'closed' if opens else 'open'}"
        raise ReferenceProblem(phrase.text, why, 3, word="only")


def _turn_as_found(context: Context, state: State) -> None:
    """Adds the steps after which each of several things is open, or closed, as it was."""
    found = [o for np in state.subjects for o in context.phrases.meaning(np, Role.PART).options]
    for part in (p for option in found for t in option for p in parts_of(context.scene, t)):
        opens = not is_closed(context.scene, part)
        index = context.single(Thing(part.owner, part.name), part.address)
        context.steps.append(_made(index, opens=opens))
        so = "open" if opens else "closed"
        context.discourse.notes.append(f"{part.address!r} is {so} at the start")


def _not_instead(context: Context, phrase: NounPhrase, index: int, *, opens: bool) -> None:
    """What another thing is to be open instead of is to be closed, and the other way round."""
    contrasted = any(item.prep is Prep.CONTRAST for item in phrase.modifiers)
    for thing in context.discourse.left_out.get(index, ()) if contrasted else ():
        other = context.single(thing, thing.part or thing.name)
        context.steps.append(_made(other, opens=not opens))


def _made(index: int, *, opens: bool) -> Open | Close:
    return Open(index, final=True) if opens else Close(index, final=True)

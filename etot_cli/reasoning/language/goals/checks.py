"""What a goal as a whole may not ask for: one thing in two places, held and used, kept and moved.

Each raises a ReferenceProblem that names the words.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence, Set
from dataclasses import replace

from msgspec import structs

from etot_cli.reasoning.builtin.goal import Close, Goal, Keep, Pick, Put, Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import bearers, carriers, is_open, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.context import InTheWay
from etot_cli.reasoning.language.goals.turns import Timed
from etot_cli.reasoning.language.grammar.sentences.spoken import Order
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, SceneState


def check_held(said: Sequence[Timed], goal: Goal, scene: SceneState) -> None:
    """Whether anything is to be done "then" while what was picked up stays in the hand, or moves
    what it stands on before it is picked up.
    """
    moved = {
        thing.name
        for step in goal.steps
        if isinstance(step, Put)
        for index in step.what
        for option in goal.referents[index].options
        for thing in option
    }
    for out in (out for out in goal.constraints if (Relation.ON, DESK) in out.places):
        for name in out.names:
            if DESK in scene.states[name].on and name not in moved:
                raise ReferenceProblem(name, "say where it is to go", 3)
    for pick in (step for step in goal.steps if isinstance(step, Pick)):
        for thing in things_in(goal.referents[pick.what].options):
            if below := sorted(moved & carriers(scene, thing.name)):
                why = f"it would go along with {below[0]}; say where it is to go before"
                raise ReferenceProblem(goal.referents[pick.what].text, why, 4)
    held: int | None = None
    for item in said:
        further = any(not (isinstance(step, Pick) and step.what == held) for step in item.steps)
        if held is not None and further and item.order is Order.THEN:
            why = "it is in the hand by then; say where it is to go before"
            raise ReferenceProblem(goal.referents[held].text, why, 4)
        picked = [step.what for step in item.steps if isinstance(step, Pick) and step in goal.steps]
        held = picked[-1] if picked else held


def check_kept(goal: Goal, scene: SceneState) -> None:
    """Whether anything is to be moved and to stay where it is, by itself or with what it is on."""
    still = (Keep.UNTOUCHED, Keep.UNMOVED)
    kept = {
        name
        for item in goal.constraints
        if item.keep in still
        for name in item.names
        if name in scene.states  # parts go nowhere
    }
    for index in _moved(goal):
        referent = goal.referents[index]
        always = set.intersection(*({t.name for t in option} for option in referent.options))
        for name in sorted(kept):
            if name in always:
                why = f"{name} cannot both be put somewhere and be left as it is"
                raise ReferenceProblem(referent.text, why, 4)
            if below := sorted(always & carriers(scene, name)):
                why = f"{name} would come along with {below[0]}; say where it is to go"
                raise ReferenceProblem(referent.text, why, 4)


def with_room_made(goal: Goal, in_the_way: Sequence[InTheWay]) -> Goal:
    """The goal, where what is in the way goes to the desk only if nothing else takes it away.

    Raises:
        ReferenceProblem: nothing takes it away.
    """
    for item in in_the_way:
        off = item.off and replace(item.off, run=0)
        others = tuple(
            step for step in goal.steps if not isinstance(step, Put) or replace(step, run=0) != off
        )
        without = replace(goal, steps=others)
        moved = {
            thing
            for index in _moved(without)
            for thing in set.intersection(*map(set, goal.referents[index].options))
        }
        if item.things <= moved and item.spot is not None:
            goal = _to_the_spot(without, item, moved)
        elif item.things <= moved:
            goal = without
        elif item.off is None and item.spot is None:
            raise ReferenceProblem(item.text, item.why, 3)
    return goal


def _to_the_spot(goal: Goal, item: InTheWay, moved: Set[Thing]) -> Goal:
    """The goal, where one thing goes to the very spot that another one leaves by then, unless what
    that is on is moved itself.
    """
    assert item.spot is not None  # asked before
    below = things_in(() if (at := item.spot.where) is None else goal.referents[at].options)
    if {thing.name for thing in below} & {thing.name for thing in moved}:
        return goal

    def things(*indices: int) -> set[Thing]:
        return {*things_in(option for i in indices for option in goal.referents[i].options)}

    puts = [step for step in goal.steps if isinstance(step, Put)]
    away = min((put.run for put in puts if things(*put.what) & item.things), default=0)
    to_it = [put for put in puts if put.what == item.lent and not put.places[0].beside]
    lent = [put for put in to_it if put.run >= away and len(things(*put.what)) == 1]
    steps = (replace(put, places=(item.spot,)) if put in lent else put for put in goal.steps)
    return replace(goal, steps=tuple(steps))


def _moved(goal: Goal) -> Iterator[int]:
    """The referents that are put somewhere or picked up."""
    for step in goal.steps:
        if isinstance(step, Put | Pick):
            yield from step.what if isinstance(step, Put) else (step.what,)


def check_shut(goal: Goal, scene: SceneState) -> None:
    """Whether anything is to be put into what is closed and must not be opened, or taken out."""
    shut = {name for item in goal.constraints if item.keep is Keep.CLOSED for name in item.names}
    for step in (step for step in goal.steps if isinstance(step, Put) and shut):
        for place in step.places:
            if place.where is None or place.relation is not Relation.INSIDE:
                continue
            referent = goal.referents[place.where]
            parts = [p for t in things_in(referent.options) for p in parts_of(scene, t)]
            if parts and all({f"{p.owner}.{p.name}", p.owner} & shut for p in parts):
                why = "nothing can be put in there while it stays closed; say 'then close it'"
                raise ReferenceProblem(referent.text, why, 4)
    for index in _moved(goal) if shut else ():
        within = [
            scene.part(scene.states[thing.name].inside or "")
            for thing in things_in(goal.referents[index].options)
            if thing.name in scene.states
        ]
        if all(
            p and not is_open(scene, p) and {f"{p.owner}.{p.name}", p.owner} & shut for p in within
        ):
            why = "it cannot be taken out of what stays closed; say 'then close it'"
            raise ReferenceProblem(goal.referents[index].text, why, 4)


def check_shut_away(goal: Goal, scene: SceneState) -> None:
    """Whether anything is to be put into or onto what has been put away and shut in before."""
    within: dict[Thing, set[str]] = {}
    shut: set[str] = set()
    for step in goal.steps:
        (index, *more) = step.what if isinstance(step, Put) else (step.what,)
        if not isinstance(step, Put):
            parts = {
                p.address
                for t in things_in(goal.referents[index].options)
                for p in parts_of(scene, t)
            }
            shut = shut | parts if isinstance(step, Close) else shut - parts
            continue
        (place, *others) = step.places
        where = None if place.where is None else goal.referents[place.where]
        at = things_in(where.options) if where else ()
        if where and not others and all(shut & within.get(thing, set()) for thing in at):
            why = "it is shut in by then; say whether that is to be opened again"
            raise ReferenceProblem(where.text, why, 4)
        around = {p.address for thing in at for p in parts_of(scene, thing)}
        for thing in things_in(
            option for i in (index, *more) for option in goal.referents[i].options
        ):
            within[thing] = around if place.relation is Relation.INSIDE and not others else set()
        shut -= around if place.relation is Relation.INSIDE else set()


def check_everything(goal: Goal) -> None:
    """Whether "everything" goes where things that were named went before: it may be these only."""
    filled: set[tuple[Relation, int]] = set()
    for step in (step for step in goal.steps if isinstance(step, Put)):
        there = {(p.relation, p.where) for p in step.places if p.where is not None and not p.beside}
        said = [goal.referents[index].text for index in step.what]
        if "everything" in said and there & filled:
            why = "say whether all things are meant, or those that were named before"
            raise ReferenceProblem("everything", why, 3)
        filled |= there


def check_run(goal: Goal) -> None:
    """Whether puts of one sentence that no word puts in an order send something to two places."""
    gone: set[tuple[int, object]] = set()
    for step in goal.steps:
        returned = isinstance(step, Put) and any(
            near.relation is Nearby.AT_POINT for place in step.places for near in place.beside
        )
        if isinstance(step, Put) and not (step.removal or step.aside or returned):
            for index in step.what:
                options = goal.referents[index].options
                own = {(step.run, item) for item in (options[0] if len(options) == 1 else (index,))}
                # "The cups on the tray, one at the front": whichever it is goes to both.
                every = {(step.run, thing) for option in options for thing in option}
                if own & gone or every <= gone:
                    why = "it cannot go to two places at once; say 'then'"
                    raise ReferenceProblem(goal.referents[index].text, why, 4)
                gone |= own


def check_circle(goal: Goal) -> None:
    """Whether anything is to go where what is to be in or on itself goes, choices included."""
    below: dict[object, object] = {}

    def meant(index: int) -> object:
        (option, *more) = goal.referents[index].options
        return index if more or len(option) > 1 else option[0].name

    for step in (step for step in goal.steps if isinstance(step, Put)):
        for theme in step.what:
            where = None if step.removal or len(step.places) > 1 else step.places[0].where
            at = below[meant(theme)] = None if where is None else meant(where)
            for _ in goal.steps:
                at = below.get(at)
            if at is not None:
                why = "it cannot be in or on what is to be in or on it"
                raise ReferenceProblem(goal.referents[theme].text, why, 4)


def check_turns(said: Sequence[Timed], discourse: Discourse) -> None:
    """Whether "the small one goes in last" speaks of what was put there by another clause."""
    put = [
        {
            (thing, there)
            for step in item.steps
            if isinstance(step, Put)
            for place in step.places
            for there in (discourse.things(place.where) if place.where is not None else (None,))
            for index in step.what
            for thing in discourse.things(index)
        }
        for item in said
    ]
    for number, item in enumerate(said):
        others = set().union(*put[:number], *put[number + 1 :])
        if item.order in (Order.FIRST, Order.LAST) and put[number] & others:
            why = "it was asked for already; say there what goes first or last"
            raise ReferenceProblem(str(item.order), why, 4)


def check_stays(said: Sequence[Timed], discourse: Discourse) -> None:
    """Whether anything is to stay somewhere and is put elsewhere by another sentence, where no word
    says which comes first. What stays on the desk may be on what stands there.
    """

    def places(item: Timed) -> Iterator[tuple[Thing, set[str]]]:
        for step in (step for step in item.steps if isinstance(step, Put)):
            where = [place.where for place in step.places]
            known = discourse.things(*(at for at in where if at is not None))
            if None not in where and (step.removal or DESK not in {at.name for at in known}):
                yield from ((t, {at.name for at in known}) for t in discourse.things(*step.what))

    for item in (item for item in said if item.stays and item.order is Order.SAID):
        left = tuple(s for s in item.steps if not isinstance(s, Put) or not s.removal)
        staying = dict(places(structs.replace(item, steps=left)))
        others = (i for i in said if i.sentence != item.sentence and i.order is Order.SAID)
        for thing, there in (found for other in others for found in places(other)):
            if thing in staying and not staying[thing] & there:
                why = "it cannot stay where it is said to and go elsewhere; say 'then'"
                raise ReferenceProblem(thing.name, why, 4)


def check_one_of_several(said: Sequence[Timed], discourse: Discourse) -> None:
    """Whether one of several things that go somewhere goes elsewhere by another sentence, where no
    word says which comes first, nor that it is taken from there: it may be meant to go there alone.
    """
    gone: list[tuple[Timed, set[Thing], set[str]]] = []
    taken = set[int]()
    for item, step in ((each, step) for each in said for step in each.steps):
        if isinstance(step, Pick):
            taken.add(step.what)
        if not isinstance(step, Put) or step.removal or step.aside:
            taken |= {*step.what} if isinstance(step, Put) else set[int]()
            continue
        referents = [discourse.referents[index] for index in step.what]
        if {*step.what} & taken:
            continue
        chosen = any(it.options[1:] for it in referents)
        things = {*things_in(option for it in referents for option in it.options)}
        at = {t.name for p in step.places if p.where is not None for t in discourse.things(p.where)}
        near = [near for place in step.places for near in place.beside]
        marks = {t.name for item in near for t in discourse.things(*item.landmarks)}
        at = at or {at for name in marks for at in bearers(discourse.scene, name) or (DESK,)}
        back = any(item.relation is Nearby.AT_POINT for item in near)
        for other, several, places in gone if item.order is Order.SAID and not back else ():
            part = things < several or (chosen and things == several)
            some = part or (several < things and not chosen)
            some = some and not (at | marks) & {it.name for it in several}
            if some and other.sentence != item.sentence and not (at <= places or places <= at):
                why = "say 'then', or leave it out where the others go"
                raise ReferenceProblem(referents[0].text, why, 4)
        gone += [] if chosen else [(item, things, at)]


def check_swept_away(goal: Goal, swept: Collection[int]) -> None:
    """Whether everything that is to be taken off the desk goes elsewhere.

    Raises:
        ReferenceProblem: nobody says where to.
    """
    for step in goal.steps:
        for index in step.what if isinstance(step, Put) and step.removal else ():
            if index in swept:
                why = "it stands on the desk; say where it is to go"
                raise ReferenceProblem(goal.referents[index].text, why, 2)

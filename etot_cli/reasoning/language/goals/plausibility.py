"""Which of several equally simple readings is the likeliest."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import islice

from msgspec import structs

from etot_cli.reasoning.builtin.branching import branches_of
from etot_cli.reasoning.builtin.goal import Goal, Pick, Put, Relation
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.builtin.settling import settled
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import SET_ASIDE
from etot_cli.reasoning.language.goals.turns import Timed
from etot_cli.reasoning.language.grammar.sentences.spoken import Order, Spoken
from etot_cli.reasoning.language.grammar.syntax.clauses import PutClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Destination, Toward
from etot_cli.reasoning.language.reference.choosing.landmarks import ROUGHLY
from etot_cli.reasoning.language.reference.geometry.vessels import goes_in
from etot_cli.reasoning.language.reference.naming.sifting import TAKEN_FOR
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.skills.action import Action, Verb
from etot_cli.world.state import SceneState

Moves = tuple[tuple[Action, ...], ...]
"""What is done with one thing after the other."""
MAX_BRANCHES = 16
"""Branches by which goals are compared; those that differ do so from the first."""


def guesses(context: Context, said: Sequence[Timed]) -> int:
    """How much speaks against a reading: words that are taken for something near them, since what
    is said is said of what it is true of ("everything on the desk that is red"), what is moved from
    but roughly where a phrase says, what has no room where it is to go ("clear the board into the
    bowl"), and what is left out and has to be moved for all that.
    """
    things = context.discourse.things
    inside = [
        (theme, place.where)
        for item in said
        for step in item.steps
        if isinstance(step, Put)
        for place in step.places
        if place.relation is Relation.INSIDE and place.where is not None
        for theme in step.what
    ]
    cramped = sum(not goes_in(things(what), things(at), context.scene) for what, at in inside)
    notes = context.discourse.notes
    moved = {
        thing.name
        for item in said
        for s in item.steps
        if isinstance(s, Put)
        for thing in things(*s.what)
    }
    rough = [note.removesuffix(ROUGHLY).split(": ")[-1] for note in notes if note.endswith(ROUGHLY)]
    roughly = sum(bool(moved & {*names.split()}) for names in rough)
    said_so = sum(note.startswith(TAKEN_FOR) or note.endswith(SET_ASIDE) for note in notes)
    return cramped + roughly + said_so


def _is_bare(where: Destination) -> bool:
    """Whether a place is but "in the middle", which may as well say which thing is meant; "to the
    middle" is where something goes.
    """
    aside = where.toward is Toward.BESIDE and not where.beside[0].phrases
    return aside and where.beside[0].text.split()[:1] != ["to"]


def told_needlessly(context: Context, reading: Sequence[Spoken]) -> int:
    """How many things that go to the middle, to the left or the like are told by where they are for
    no reason: in "put the ball in the cup in the middle", with one ball and several cups, it is the
    cup that is in the middle. So is what a sentence asks for alone said to come first or last.

    Args:
        context: before the reading.
        reading: clauses of it.
    """
    puts = [said.clause for said in reading if isinstance(said.clause, PutClause)]
    groups = (group for put in puts for group in put.groups)
    bare = (group for group in groups if all(map(_is_bare, group.destinations)))
    needless = sum(said.order in (Order.FIRST, Order.LAST) for said in reading if not reading[1:])
    for np in (np for group in bare for np in group.things.phrases):
        held = [m.phrases for m in np.modifiers if m.prep in (Prep.IN, Prep.ON)]
        if len(held) != len(np.modifiers) or [*map(len, held)] != [1]:
            continue
        with suppress(ReferenceProblem):
            thing = context.phrases.meaning(structs.replace(np, modifiers=()), Role.THEME)
            marks = context.phrases.meaning(held[0][0], Role.PLACE)
            needless += len(thing.options) == 1 < len(marks.options)
    return needless


def taken_up_again(said: Sequence[Timed]) -> bool:
    """Whether a sentence moves again what it has put somewhere, without a word for order."""
    put: set[tuple[int, int]] = set()
    again = False
    for item in said:
        for step in (step for step in item.steps if isinstance(step, Put | Pick)):
            what = step.what if isinstance(step, Put) else (step.what,)
            again |= item.order is Order.SAID and any((item.sentence, i) in put for i in what)
            if isinstance(step, Put) and not (step.removal or step.aside):
                put |= {(item.sentence, index) for index in what}
    return again


def plans_of(goal: Goal, scene: SceneState, *, ordered: bool) -> tuple[Moves, ...]:
    """What the branches of a goal do, none where it holds already.

    Raises:
        InstructionError, ReferenceProblem, ReasonerStopped: there is no plan for it.
    """
    branches = islice(branches_of((settled(goal, scene),), scene), MAX_BRANCHES)
    return tuple(_moves(branch.actions, ordered=ordered) for branch in branches)


def _moves(actions: Sequence[Action], *, ordered: bool) -> Moves:
    """What a branch moves where; in the order of the text only where a word asks for an order."""
    moves: list[tuple[Action, ...]] = [()]
    for action in actions:
        moves[-1] += (action,)
        if action.verb is not Verb.PICK_UP:
            moves.append(())
    return tuple(moves if ordered else sorted(moves, key=str))


def holds_roughly(goal: Goal) -> bool:
    """Whether what holds already is that things are beside others, which may be meant nearer."""
    puts = [step for step in goal.steps if isinstance(step, Put)]
    # "The tomato next to the onion" of two tells which one.
    told = any(goal.referents[index].options[1:] for step in puts for index in step.what)
    beside = (near for step in puts for place in step.places for near in place.beside)
    return not told and any(near.landmarks for near in beside)


def does_as_well(plans: Sequence[Moves], others: Sequence[Moves]) -> bool:
    """Whether whatever is done of some plans does one of the others, too: what is put on the stove
    next to the pot is on the stove.
    """

    def does(action: Action, other: Action) -> bool:
        there = action.target == other.target or action.target.startswith(f"{other.target}.")
        same = (action.verb, action.pose) == (other.verb, other.pose)
        return there and same and {*other.where} <= {*action.where}

    def follows(moves: Moves, others: Moves) -> bool:
        pairs = zip(moves, others, strict=False)
        return len(moves) == len(others) and all(
            len(one) == len(other) and all(map(does, one, other)) for one, other in pairs
        )

    all_known = 0 < len(plans) < MAX_BRANCHES
    return all_known and all(any(follows(one, other) for other in others) for one in plans)

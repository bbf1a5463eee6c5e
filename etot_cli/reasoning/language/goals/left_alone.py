"""Furniture, a drawer or one board that is left as it is, with what is in or on it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from etot_cli.reasoning.builtin.goal import Constraint, Keep, Relation, Thing
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import Avoid, AvoidClause
from etot_cli.reasoning.language.reference.geometry.space import touches


def what_is_there(context: Context, names: Sequence[str]) -> tuple[str, ...]:
    """What is in or on furniture that is left as it is."""
    infos, scene = context.scene.infos, context.scene
    fixed = {name for name in names if name in infos and not infos[name].movable}
    moved = _moved(context)
    return tuple(n for n in _movable(context) if bearers(scene, n) & fixed and n not in moved)


def is_of_boards(clause: AvoidClause, kept: Sequence[Thing]) -> bool:
    """Whether single boards are left alone. They move with the whole only, so that "do not move the
    upper shelf" says nothing of what is on it.
    """
    alone = clause.avoid is Avoid.TOUCH or (clause.avoid is Avoid.MOVE and not clause.negated)
    return alone and bool(kept) and all(thing.board for thing in kept)


def boards_left_alone(
    context: Context, boards: Sequence[Thing], keep: Keep
) -> Iterator[Constraint]:
    """What is on such boards stays there, and nothing else is put on them."""
    there = [n for n in _movable(context) if any(_is_on(context, n, board) for board in boards)]
    if there:
        yield Constraint(keep, tuple(there))
    away = tuple(name for name in _movable(context) if name not in there)
    places = tuple((Relation.ON, board.address) for board in boards)
    if away:
        yield Constraint(Keep.AWAY, away, places)


def in_part(context: Context, addresses: Sequence[str]) -> tuple[str, ...]:
    """What is in drawers or behind doors that are left as they are."""
    states, moved = context.scene.states, _moved(context)
    return tuple(n for n in _movable(context) if states[n].inside in addresses and n not in moved)


def _is_on(context: Context, name: str, board: Thing) -> bool:
    """Whether a thing stands on a board, be it on another thing."""
    scene = context.scene
    below = (name, *(item for item in bearers(scene, name) if item != board.name))
    return any(touches(Thing(item), board, scene) for item in below)


def _movable(context: Context) -> list[str]:
    infos, states = context.scene.infos, context.scene.states
    return [name for name in infos if infos[name].movable and name in states]


def _moved(context: Context) -> set[str]:
    return {thing.name for thing in context.discourse.things(*context.discourse.put)}

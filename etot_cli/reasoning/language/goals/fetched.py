"""What is fetched out of something that is closed behind it."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Close, Grouping, Pick, Put, Step
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.goals.placing import add_put
from etot_cli.reasoning.language.goals.turns import Timed
from etot_cli.reasoning.language.reference.geometry.space import touches


def set_down(context: Context, item: Timed, after: Sequence[Step]) -> Timed:
    """What a clause fetches out of the very thing that the next one closes: it takes a hand to
    close that, so it is put on the desk, of which is noted.
    """
    picked = [step.what for step in item.steps if isinstance(step, Pick)]
    closed = [step.what for step in after if isinstance(step, Close)]
    things = context.discourse.things(*picked)
    around = context.discourse.things(*closed)
    if len(picked) != len(item.steps) or len(closed) != len(after) or not (things and around):
        return item
    if len(things) > 1 or not all(touches(things[0], at, context.scene) for at in around):
        return item
    kept, context.steps = context.steps, []
    add_put(context, picked, (context.places.on_the_desk(),), Grouping.ANY, removal=True)
    steps = tuple(step for step in context.steps if isinstance(step, Put))
    context.steps = kept
    context.discourse.lifted -= {*picked}
    context.discourse.notes.append(f"{things[0].name}: onto the desk, as closing takes the hand")
    return replace(item, steps=steps)

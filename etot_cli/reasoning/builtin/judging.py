"""The judge: did an action have its effect, and was any object harmed by it?"""

from __future__ import annotations

from etot_cli.reasoning.builtin.blame import cause_of_failure, cause_of_harm
from etot_cli.reasoning.builtin.effects import acted_object, effect_holds
from etot_cli.reasoning.builtin.harm import changed, harms
from etot_cli.reasoning.protocol import Outcome, Verdict
from etot_cli.skills.action import Action
from etot_cli.world.state import RolloutRecord, owner_of


def judge_action(action: Action, record: RolloutRecord) -> Verdict:
    """Compares all objects before and after an action.

    Success needs the effect, by the skill's own account and by the states, and no harm to any
    object. Unsafe is what the skills cannot recover; every other shortcoming is a failure. A small
    displacement that leaves an object's relations alone is a change and no failure.
    """
    harmed = harms(action, record)
    changes = _changes(action, record)
    missing = not (record.effect and effect_holds(action, record))
    if missing:
        cause = cause_of_failure(action, record, harmed)
    elif harmed:
        cause = cause_of_harm(action, record, harmed)
    else:
        return Verdict(Outcome.SUCCESS, None, changes)
    unsafe = any(harm.kind.unsafe for harm in harmed)
    return Verdict(Outcome.UNSAFE if unsafe else Outcome.FAILURE, cause, changes)


def _changes(action: Action, record: RolloutRecord) -> tuple[str, ...]:
    """Names of changed objects, those that the action is about included, in scene order."""
    about = {acted_object(action, record), owner_of(action.target)}
    different = changed(record)
    return tuple(name for name in record.before.states if name in about or name in different)

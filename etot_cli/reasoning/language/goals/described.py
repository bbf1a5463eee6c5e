"""Whether "the apple next to the lemon" tells where it is now, or where it goes."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Place, Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import PutGroup
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.reference.geometry.space import touches
from etot_cli.reasoning.language.words.places import Prep

_BESIDE = (Prep.NEXT_TO, Prep.NEAR, Prep.LEFT, Prep.RIGHT, Prep.BEHIND, Prep.FRONT, Prep.BETWEEN)


def note_described(
    context: Context, group: PutGroup, places: Sequence[Place], *, told: bool
) -> None:
    """Notes that "vial A next to vial B" tells where the only one is, and not where it goes;
    ``told``: a verb behind it says where it goes.

    Raises:
        ReferenceProblem: it is where it would go, so that this is hardly what is meant.
    """
    if any(place.beside or place.where is None for place in places):
        return
    for phrase in group.things.phrases:
        near = [item for item in phrase.modifiers if item.prep in _BESIDE and not item.denied]
        if len(near) != 1 or near != [*phrase.modifiers]:
            continue
        alone: list[Thing] = []
        with suppress(ReferenceProblem):  # "the tool behind the tin" is one of several tools
            whole = replace(phrase, modifiers=())
            alone = [*things_in(context.phrases.meaning(whole, Role.THEME).options)]
        if len(alone) == 1:
            at = context.discourse.things(*(p.where for p in places if p.where is not None))
            if any(touches(alone[0], place, context.scene) for place in at):
                why = "it is there already; say 'on …, next to …' for where it goes"
                raise ReferenceProblem(phrase.text, why, 3)
            if not told and _may_go_there(context, phrase, group):
                why = "it is or goes there; say 'the … that is next to …', or 'in …, next to …'"
                raise ReferenceProblem(phrase.text, why, 3)
            text = phrase.text.replace("_", " ")
            note = f"{text!r}: where it is now, not where it goes"
            context.discourse.notes.append(note)


def _may_go_there(context: Context, phrase: NounPhrase, group: PutGroup) -> bool:
    """Whether "next to the lemon", which tells the only apple from no other, may be where it goes:
    behind a verb of putting, before "in", and beside what can be in there, too.
    """
    said = re.escape(phrase.text.replace("_", " "))
    other = any("other" in np.determiner.split() for w in group.destinations for np in w.targets)
    told = re.search(r" (?:that|which|standing|lying|sitting|now|currently) ", phrase.text)
    placed = re.search(rf"\b{said} (?:in|on|inside|on top of) ", context.sentence)
    if other or told or not placed or group.things.phrases[1:]:
        return False
    marks: set[Thing] = set()
    for np in phrase.modifiers[0].phrases:
        with suppress(ReferenceProblem):
            marks |= {*things_in(context.phrases.meaning(np, Role.ANY).options)}
    return any(context.scene.infos[thing.name].movable for thing in marks)

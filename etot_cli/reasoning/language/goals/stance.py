"""How things are turned, and how they stand or lie where they are put."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Constraint, Keep, Near, Pick, Place, Put, Relation, Step
from etot_cli.reasoning.builtin.relations import can_topple
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.goals.context import Context
from etot_cli.reasoning.language.grammar.syntax.clauses import ReorientClause
from etot_cli.reasoning.language.grammar.syntax.phrases import Things, Toward
from etot_cli.reasoning.language.grammar.text.splitting import ASIDE
from etot_cli.reasoning.language.reference.geometry.space import is_flat
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world import spatial
from etot_cli.world.spatial import Nearby, Whereabouts
from etot_cli.world.stance import NO_SIDE, can_lie

_NO_PLACES = (
    Prep.OF,
    Prep.FROM,
    Prep.CONTAINING,
    Prep.WITH,
    Prep.CONTRAST,
    Prep.EXCEPT,
    Prep.COLORED,
)
_ROOM_THERE = frozenset({"on", "in"})
"""Behind what room is made: where; "room for the cup" is made elsewhere."""


def _tell_where(context: Context, things: Things, named: Sequence[int]) -> None:
    """Notes where something that is only named is, for what goes "there" next."""
    (np, *more), discourse = things.phrases, context.discourse
    where = [item.prep for item in np.modifiers if item.phrases and item.prep not in _NO_PLACES]
    said = (m.referent for m in discourse.mentions if m.clause == discourse.clause)
    marks = [*dict.fromkeys(index for index in said if index not in named)]
    if where and not more:
        toward = {Prep.IN: Toward.INSIDE, Prep.ON: Toward.ON}.get(where[0])
        known = len(where) == len(marks) == 1
        discourse.told_at = (
            discourse.clause,
            toward if known else None,
            marks[-1] if marks else -1,
        )


def reorient(context: Context, clause: ReorientClause) -> None:
    """Stands up what has toppled, or lays down what stands, where it is; any other turning is part
    of what follows.
    """
    if clause.only_named:
        named: tuple[int, ...] = ()
        if not (clause.remark and all(np.pronoun for np in clause.things.phrases)):
            named = (*context.phrases.things(clause.things, Role.ANY),)
            context.discourse.is_about(named)
            _tell_where(context, clause.things, named)
        if clause.not_yet and {*context.discourse.placed} & {*context.discourse.things(*named)}:
            why = "it was to be moved before that; say first what is done first"
            raise ReferenceProblem(clause.things.text, why, 3)
        if clause.remark:
            context.discourse.remarked |= {*named}
            said = clause.remark.split()
            made = said[0].startswith("mak") and {*said[:5]} & _ROOM_THERE
            if len(named) == 1 and made:
                (context.discourse.roomy,) = named
            if clause.remark != ASIDE:  # that is told anyway
                context.discourse.notes.append(f"not checked: {clause.remark}")
        return
    step: Step | None
    again = clause.meanwhile and all(np.pronoun for np in clause.things.phrases)
    step = context.done[-1] if again and context.done else None
    themes: Sequence[int]
    if isinstance(step, Put):  # "put it in the holder, rotating it as needed": what goes there
        themes = step.what if clause.stance else ()
    else:
        themes = _to_be_turned(context, clause)
    for index in themes:
        lying = clause.stance is Nearby.LYING
        if clause.stance is None or not (lying or can_stand(context, index)):
            if clause.meanwhile and clause.stance and not _is_rod(context, index):
                text = context.discourse.referents[index].text
                context.discourse.notes.append(f"not checked: {text} is kept level on the way")
            context.turned.append(index)
            continue
        if lying:
            _check_lying(context, index)
        if index in context.discourse.put:
            step = _being_there(context, index, themes, clause.stance)
            context.steps += [] if step in context.steps else [step]
            continue
        if clause.meanwhile:
            text = context.discourse.referents[index].text
            if _is_carried_so(context, index):
                context.discourse.notes.append(f"{text} is lifted as it stands")
                continue
            if not again:
                _keep_standing(context, index)
                continue
        near, state = Near(clause.stance), "lies" if lying else "stands upright"
        any_of_them = context.discourse.things(index)
        so = Whereabouts(clause.stance)
        if not lying and all(spatial.holds(so, t.name, context.scene) for t in any_of_them):
            context.discourse.notes += [f"{thing.name} {state} as it is" for thing in any_of_them]
            continue
        for thing in context.only(index, "say which one"):
            if lying and thing in context.discourse.things(*context.discourse.put):
                why = f"{thing.name} is put somewhere else before; say where it is to lie"
                raise ReferenceProblem(thing.name, why, 5)
            if spatial.holds(so, thing.name, context.scene):
                context.discourse.notes.append(f"{thing.name} {state} as it is")
            else:
                place = replace(context.home(thing), beside=(near,))
                context.steps.append(Put((context.single(thing, thing.name),), (place,)))


def _to_be_turned(context: Context, clause: ReorientClause) -> Sequence[int]:
    """What is to stand or lie: "it" is rather what was just put somewhere than what it was put on
    or into, if it can ("put the jar on the box and make sure it stands upright").
    """
    try:
        return context.phrases.things(clause.things, Role.THEME)
    except AmbiguousReference:
        it = [np.pronoun for np in clause.things.phrases] == ["it"]
        step = context.done[-1] if context.done else None
        if not (it and clause.stance and isinstance(step, Put)):
            raise
        said = [m for m in context.discourse.mentions if m.role is Role.THEME]
        moved = {m.referent for m in said if m.clause == said[-1].clause}
        (index, *more) = step.what
        turns = can_stand(context, index) or _is_rod(context, index)
        if more or moved != {index} or not turns:
            raise
        context.discourse.mention_again(index, Role.THEME)
        return (index,)


def _being_there(context: Context, index: int, themes: Sequence[int], stance: Nearby) -> Put:
    """What was put somewhere, be it with other ``themes``, standing or lying there ("put it on the
    tray; it should be upright").

    Raises:
        ReferenceProblem: something else was asked for since.
    """
    for step in context.done:
        if isinstance(step, Put) and index in step.what and {*step.what} <= {*themes}:
            return replace(step, places=with_stance(context, step.what, step.places, stance))
    text = context.discourse.referents[index].text
    how = "lie" if stance is Nearby.LYING else "stand"
    word = "upright" if stance is Nearby.UPRIGHT else ""
    raise ReferenceProblem(text, f"say that it is to {how} where it is put", 2, word=word)


def _is_rod(context: Context, index: int) -> bool:
    """Whether things stand as what holds them lets them."""
    things = context.discourse.things(index)
    return all(context.scene.infos[thing.name].elongated for thing in things)


def _keep_standing(context: Context, index: int) -> None:
    """What stands as it is, and is not tilted by what is done with other things.

    Raises:
        ReferenceProblem: it lies, or nothing is done yet; how it is put is told where it is put.
    """
    text = context.discourse.referents[index].text
    things = context.only(index, "say which one")
    upright = Whereabouts(Nearby.UPRIGHT)
    stand = all(spatial.holds(upright, thing.name, context.scene) for thing in things)
    if not (context.done and stand):
        raise ReferenceProblem(text, "say behind where it is put how it is kept", 4)
    names = tuple(thing.name for thing in things)
    context.constraints.append(Constraint(Keep.UNHIT, names))


def _is_carried_so(context: Context, index: int) -> bool:
    """Whether what is to be kept upright on the way is picked up, by which it does not tilt."""
    things = {*context.discourse.things(index)}
    picks = (step for step in context.done if isinstance(step, Pick))
    return any(things <= {*context.discourse.things(step.what)} for step in picks)


def with_stance(
    context: Context, themes: Sequence[int], places: Sequence[Place], stance: Nearby
) -> tuple[Place, ...]:
    """Places where things are to stand, or to lie; a rod stands as what holds it lets it.

    Raises:
        ReferenceProblem: nothing makes them stand, or lie, there.
    """
    if stance is Nearby.LYING:
        for index in themes:
            _check_lying(context, index)
    if stance is Nearby.LYING or all(can_stand(context, index) for index in themes):
        near = Near(stance)
        return tuple(replace(place, beside=(*place.beside, near)) for place in places)
    held = all(place.relation is Relation.INSIDE for place in places)
    for index in themes:
        referent = context.discourse.referents[index]
        things = context.discourse.things(index)
        if not held or not all(context.scene.infos[item.name].elongated for item in things):
            raise ReferenceProblem(referent.text, "it does not stand by itself", 3, word="upright")
        context.discourse.notes.append(f"{referent.text} stands as what holds it lets it")
    return tuple(places)


def _check_lying(context: Context, index: int) -> None:
    """Raises a ReferenceProblem where one of some things has no side to lie on."""
    for thing in context.discourse.things(index):
        if not can_lie(context.scene.infos[thing.name]):
            text = context.discourse.referents[index].text
            raise ReferenceProblem(text, f"{thing.name}: {NO_SIDE}", 5)


def can_stand(context: Context, index: int) -> bool:
    """Whether things have an upright pose; what lies flat as it is would stand on its edge."""
    scene = context.scene
    things = context.discourse.things(index)
    return all(
        can_topple(info) and (state.toppled or info.container or not is_flat(info))
        for info, state in ((scene.infos[t.name], scene.states[t.name]) for t in things)
    )

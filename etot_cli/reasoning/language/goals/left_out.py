"""What a goal leaves out of what its words name: places, and what must not go somewhere."""

from __future__ import annotations

from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Goal, Put, things_in
from etot_cli.reasoning.builtin.relations import carriers
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.goals.placing import SET_ASIDE
from etot_cli.reasoning.language.reference.geometry.space import addresses, touches
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any
from etot_cli.world.state import SceneState


def without_places(goal: Goal, discourse: Discourse) -> Goal:
    """The goal, where "the red ones" are none of the places that it brings things to; what stays
    in one of them goes along with it.
    """

    def stays(put: Put) -> bool:
        at = [t for p in put.places if p.where is not None for t in discourse.things(p.where)]
        held = discourse.things(*put.what)
        moved = [t for s in puts if s is not put for t in discourse.things(*s.what)]
        there = [touches(one, other, discourse.scene) for one in held for other in at]
        return all(there) and not {*held} & {*moved}

    puts = [step for step in goal.steps if isinstance(step, Put)]
    where = {place.where for step in puts if not stays(step) for place in step.places} - {None}
    places = {t.name for i in where if i is not None for t in discourse.things(i)}
    sweeping = {m.referent for m in discourse.mentions if matches_any(m.noun, THING_NOUNS)}
    # "Everything else" takes up the noun before it.
    sweeping |= {i for i, r in enumerate(goal.referents) if {"else", "rest"} & {*r.text.split()}}
    referents, notes, still = list(goal.referents), list(goal.notes), set[str]()
    for index in sorted(sweeping & {index for step in puts for index in step.what}):
        for option in referents[index].options if len(referents[index].options) == 1 else ():
            kept = tuple(thing for thing in option if thing.name not in places)
            out = ", ".join(thing.name for thing in option if thing not in kept)
            if out and kept:
                referents[index] = replace(referents[index], options=(kept,))
                notes.append(f"{referents[index].text!r}: without {out}, where things go")
                still |= {thing.name for thing in {*option} - {*kept}}
    moved = {t.name for put in puts for i in put.what for t in things_in(referents[i].options)}
    steps = list(goal.steps)
    for step in puts:
        # "Everything but the apple, which stays in the bowl": the bowl is not moved after all
        (thing, *more) = things_in(referents[step.what[0]].options)
        aside = f" {thing.name} {SET_ASIDE}"
        around = carriers(discourse.scene, thing.name)
        if not more and around & still and not around & moved and aside in "".join(notes):
            steps.remove(step)
            notes = [note for note in notes if not note.endswith(aside)]
    return replace(goal, referents=tuple(referents), notes=tuple(notes), steps=tuple(steps))


def without_needless(goal: Goal) -> Goal:
    """The goal without what was only said to be needless: "no need to close it" forbids nothing."""
    kept = tuple(item for item in goal.constraints if not item.needless)
    out = {name: None for item in goal.constraints if item.needless for name in item.names}
    note = [f"nothing is asked or forbidden of {', '.join(out)}"] if out else []
    return replace(goal, constraints=kept, notes=(*goal.notes, *note))


def without_ruled_out(goal: Goal, scene: SceneState) -> Goal:
    """The goal without what must not go where it brings several things ("all of them into the
    box, but keep the cup out of it").

    Raises:
        ReferenceProblem: nothing else is to go there.
    """
    referents = list(goal.referents)
    for step in (step for step in goal.steps if isinstance(step, Put) and not step.removal):
        (place, *more) = step.places
        if more or place.where is None or len(referents[place.where].options) > 1:
            continue
        at = {a for t in things_in(referents[place.where].options) for a in addresses(t, scene)}
        ruled_out: dict[str, set[str]] = {}
        for item in goal.constraints:
            for relation, address in item.places:
                for name in item.names if relation is place.relation else ():
                    ruled_out.setdefault(name, set()).add(address)
        out = {name for name, where in ruled_out.items() if at <= where}
        for index in step.what:
            options = referents[index].options
            kept = tuple(tuple(t for t in option if t.name not in out) for option in options)
            if len(kept) > 1:
                kept = tuple(option for option in options if option in kept)
            if not any(kept):
                why = "it cannot both go there and be kept from there"
                raise ReferenceProblem(referents[index].text, why, 4)
            referents[index] = replace(referents[index], options=kept)
    return replace(goal, referents=tuple(referents))

"""Whether things go into or onto what is named, whichever fits it and what is asked for."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Place, Relation, Thing
from etot_cli.reasoning.builtin.roles import Role, can_be
from etot_cli.reasoning.language.grammar.syntax.phrases import Toward
from etot_cli.reasoning.language.reference.choosing.instances import check_not_part
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.geometry.vessels import goes_in, lies_on
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.world.state import SceneState


def in_or_on(
    discourse: Discourse, toward: Toward, index: int, themes: Sequence[int]
) -> list[Place]:
    """In or on a referent, the likelier one first; empty where neither fits.

    Args:
        discourse: what was spoken of; what a preposition was taken for is noted there.
        toward: the relation that the preposition asks for.
        index: the referent.
        themes: referents of what goes there.

    Raises:
        AmbiguousReference: of several lids that may be meant not all lie on the rim.
    """
    scene, things = discourse.scene, discourse.things(index)
    found = []
    fits_in = any(can_be(thing, Role.CONTAINER, scene) for thing in things)
    laid = [thing for thing in discourse.things(*themes) if thing not in things]
    if toward is Toward.ON and fits_in:
        _check_alike(discourse, laid, things, index)
    to = toward is Toward.TO
    on = (thing for thing in things if not to or space.is_support(thing, scene))
    fits_on = any(
        can_be(thing, Role.SURFACE, scene) and lies_on(laid, thing, scene) for thing in on
    )
    if to and fits_in and all(_has_door(thing, scene) for thing in things):
        fits_on = False  # what is brought to the microwave goes in
    if to and not goes_in(laid, things, scene):
        fits_in = False  # who brings it to a mug may want it beside that
    names = " or ".join(dict.fromkeys(thing.name for thing in things))
    if fits_in and (toward is not Toward.ON or not fits_on):
        found.append(Place(Relation.INSIDE, index))
    if fits_on and (toward is not Toward.INSIDE or not fits_in):
        found.append(Place(Relation.ON, index))
        if toward is Toward.INSIDE:
            discourse.notes.append(f"read 'in' as onto {names}")
    if toward is Toward.ON and fits_in and not fits_on:
        check_not_part(discourse.referents[index].text, things)
        discourse.notes.append(f"read 'on' as into {names}")
    return found


def _has_door(thing: Thing, scene: SceneState) -> bool:
    """Whether a thing is furniture whose parts are doors."""
    info = scene.infos.get(thing.name)
    parts = info.parts if info is not None else ()
    return bool(parts) and all(part.joint_type == "hinge" for part in parts)


def _check_alike(
    discourse: Discourse, laid: Sequence[Thing], things: Sequence[Thing], index: int
) -> None:
    """Of several lids that may be meant, all or none lie on a vessel's rim."""
    ways = {any(lies_on([one], thing, discourse.scene) for thing in things) for one in laid}
    if len(ways) > 1:
        text = f"on {discourse.referents[index].text}"
        names = [thing.name for thing in laid]
        raise AmbiguousReference(text, names, "only one stays on top of it, of")

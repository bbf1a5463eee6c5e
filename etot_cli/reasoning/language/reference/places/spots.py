"""Places narrowed to a part of them, or to where something is beside what stands or lies there."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from etot_cli.reasoning.builtin.goal import Place, Relation, Thing, things_in
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Beside, Destination
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.places.surroundings import Surroundings
from etot_cli.reasoning.language.reference.several import Phrases
from etot_cli.reasoning.language.words.lexicon import JOINT_NOUNS, matches_any
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, SceneState


class Spots:
    """Narrows places of a discourse.

    Args:
        scene: what is spoken about.
        phrases: resolves the noun phrases in them.
        discourse: what was spoken of before; it grows.
        surroundings: of things.
    """

    def __init__(
        self,
        scene: SceneState,
        phrases: Phrases,
        discourse: Discourse,
        surroundings: Surroundings,
    ) -> None:
        self._scene = scene
        self._phrases = phrases
        self._discourse = discourse
        self._surroundings = surroundings

    def narrowed(
        self, places: list[Place], destination: Destination, themes: Sequence[int]
    ) -> list[Place]:
        """Places at some part of a surface, or in what holds that which they are beside.

        Raises:
            ReferenceProblem: there is no such part, or it is not plain of which of several.
        """
        text = " or ".join(phrase.text for phrase in destination.targets) or destination.word
        surfaces = [place for place in places if place.relation is Relation.ON]
        slides = JOINT_NOUNS["slide"][:1]  # "to the drawer in the middle" is into it
        drawer = any(matches_any(np.words[-1], slides) for np in destination.targets if np.words)
        if not surfaces or (drawer and len(surfaces) < len(places)):
            if within := self._within(places, destination.beside, themes):
                return within
            for np in (np for near in destination.beside for np in near.phrases if np.words):
                self._phrases.meaning(np, Role.ANY)  # of "by three o'clock" that is to blame
            raise ReferenceProblem(text, "there is no left or right inside a container", 2)
        # "On the plate on the left" is the left one of several, not the left part of any, and "on
        # the plate next to the cup" the one of several that is there.
        targets = [item for item in destination.targets if not item.pronoun]
        meant = [self._phrases.meaning(item, Role.SURFACE).options for item in targets]
        things = [thing for options in meant for thing in things_in(options)]
        upon = {t for p in places if p.where is not None for t in self._discourse.things(p.where)}
        for phrase in (
            np for b in destination.beside if not b.relation.landmarks for np in b.phrases
        ):
            # "On the tray at the back of the table" may say which tray, but no part of it.
            if not {*things_in(self._phrases.meaning(phrase, Role.ANY).options)} & {*things, *upon}:
                raise ReferenceProblem(phrase.text, f"it is no part of {text}", 2)
        stacked = [t for t in things if t.name != DESK and self._scene.infos[t.name].boards]
        part = all(item.relation.landmarks == 0 and not item.phrases for item in destination.beside)
        if len(things) > 1 and len(bearing := self._bearing(things, destination.beside)) == 1:
            # Of several plates "the plate to the left of the cup" that stands on one of them
            things = bearing
            for place in surfaces:
                assert place.where is not None  # it has targets
                referent = self._discourse.referents[place.where]
                self._discourse.referents[place.where] = replace(referent, options=((*bearing,),))
        if len(things) > 1 or (part and stacked and things[0].board is None):
            raise ReferenceProblem(text, "say which one of them", 2)
        below = {thing.name for thing in things or upon}
        near = self._surroundings.near(destination.beside, themes, below)
        return [replace(place, beside=near) for place in surfaces]

    def _bearing(self, things: Sequence[Thing], beside: Sequence[Beside]) -> list[Thing]:
        """Those of some things on which all stands that something is to be beside."""
        marks: list[Thing] = []
        for phrase in (np for item in beside for np in item.phrases):
            with suppress(ReferenceProblem):
                marks += things_in(self._phrases.meaning(phrase, Role.ANY).options)
        if not marks or any(np.pronoun for item in beside for np in item.phrases):
            return []
        return [
            thing
            for thing in things
            if all(space.rests_on(mark, thing, self._scene) for mark in marks)
        ]

    def around(self, beside: Sequence[Beside], themes: Sequence[int]) -> Place | None:
        """The place beside what lies in a container, which is in there; None where it does not."""
        around = self._surroundings.container(beside)
        if around is None or any(item.relation is not Nearby.NEXT_TO for item in beside):
            return None
        near = self._surroundings.near(beside, themes, {around.name})
        inside = Resolved(((around,),), definite=True, noun=around.part or around.name)
        index = self._discourse.add(inside, around.address, Role.CONTAINER)
        self._discourse.notes.append(f"{beside[0].text!r}: in {around.address}, where that is")
        return Place(Relation.INSIDE, index, near)

    def _within(
        self, places: Sequence[Place], beside: Sequence[Beside], themes: Sequence[int]
    ) -> list[Place]:
        """Places in a container beside what lies in it; none where that lies elsewhere."""
        if any(item.relation.landmarks == 0 for item in beside):
            return []
        found = []
        for place in places:
            options = () if place.where is None else self._discourse.referents[place.where].options
            held = tuple(o for o in options if self._surroundings.are_in(o[0], beside))
            if place.where is not None and held and place.relation is Relation.INSIDE:
                near = self._surroundings.near(beside, themes, {held[0][0].name})
                referent = self._discourse.referents[place.where]
                self._discourse.referents[place.where] = replace(referent, options=held)
                found.append(replace(place, beside=near))
        return found

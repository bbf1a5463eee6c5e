"""What a place beside things, or a part of a surface, is beside and a part of."""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Near, Thing, things_in
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax.phrases import Beside, Destination, NounPhrase
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.geometry.areas import side_across
from etot_cli.reasoning.language.reference.geometry.space import OPPOSITE
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.naming.usual_form import is_robot
from etot_cli.reasoning.language.reference.places.alongside import Landmarks
from etot_cli.reasoning.language.reference.several import Phrases
from etot_cli.reasoning.language.words.lexicon import word_set
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import ACROSS
from etot_cli.world.spatial import Nearby, Whereabouts, holds
from etot_cli.world.state import DESK, SceneState

_PARTS = word_set("edge end border rim half part corner quarter area")
"""Words for parts of a flat top."""


def _is_across(beside: Beside) -> bool:
    """Whether a place is told by where things are not yet ("on the other side of the box")."""
    return " ".join(beside.text.split()[:5]) in spellings(ACROSS)


class Surroundings:
    """Turns relations to things into relations to referents of a discourse.

    Args:
        scene: what is spoken about.
        phrases: resolves the noun phrases in them.
        discourse: what was spoken of before; it grows.
    """

    def __init__(self, scene: SceneState, phrases: Phrases, discourse: Discourse) -> None:
        self._scene = scene
        self._phrases = phrases
        self._discourse = discourse
        self._landmarks = Landmarks(scene, phrases, discourse)

    def surface(self, beside: Sequence[Beside], themes: Sequence[int]) -> int | None:
        """The referent of which regions are said to be parts, if any."""
        surface: int | None = None
        for item in (item for item in beside if item.relation.landmarks == 0):
            for phrase in item.phrases:
                self._check_region(phrase, item)
                (surface,) = self._phrases.refer(phrase, Role.SURFACE, themes)
        return surface

    def near(
        self, beside: Sequence[Beside], themes: Sequence[int], below: Set[str] = frozenset()
    ) -> tuple[Near, ...]:
        """The relations; ``below``: names of what it is all to be on, where that is said.

        Raises:
            ReferenceProblem: nothing can be there.
        """
        beside = [self._landmarks.of_themes(item, themes, below) for item in beside]
        found = [(item, self._near(item, themes, below)) for item in beside]
        near = tuple(near for _, ways in found for near in ways)
        self._check_upon(found)
        moved = set(self._discourse.things(*self._discourse.put))
        for item in near:
            things = self._discourse.things(*item.landmarks)
            if len(item.landmarks) == 2 and len(things) == 1:
                text = " and ".join(self._discourse.referents[i].text for i in item.landmarks)
                raise ReferenceProblem(text, "nothing is between one thing and itself", 1)
            things = tuple(thing for thing in things if thing not in moved)
            if below - {DESK} and any(thing.name in below for thing in things):
                raise ReferenceProblem(things[0].name, "nothing is beside itself", 2)
            under = [bearers(self._scene, thing.name) for thing in things]
            names = " and ".join(thing.name for thing in things)
            if len(item.landmarks) > 1 and any(under) and not frozenset.intersection(*under):
                raise ReferenceProblem(names, "they do not stand on the same", 3)
            away = [thing for thing, on in zip(things, under, strict=True) if not below & on]
            if below - {DESK} and any(
                not any(space.can_be_at(item.relation, thing, name, self._scene) for name in below)
                for thing in away
            ):
                on = " and ".join(sorted(below))
                side = item.relation in OPPOSITE
                why = f"no place on {on} is {item.relation} it" if side else f"it is far from {on}"
                raise ReferenceProblem(names, why, 2)
        return near

    def _check_upon(self, found: Sequence[tuple[Beside, Sequence[Near]]]) -> None:
        """What is "on the right side of the mat, next to the cup" that stands on it is on the mat.

        Raises:
            AmbiguousReference: it may be beside that.
        """
        marks = {
            thing: item.text
            for item, ways in found
            if item.relation in OPPOSITE and item.text.startswith(("on ", "at "))
            for near in ways
            for thing in self._discourse.things(*near.landmarks)
        }
        others = self._discourse.things(
            *(i for _, ways in found for n in ways for i in n.landmarks)
        )
        for mark, text in marks.items():
            if any(space.touches(thing, mark, self._scene) for thing in others if thing != mark):
                raise AmbiguousReference(text, ["beside it", "a part of it"])

    def container(self, beside: Sequence[Beside]) -> Thing | None:
        """The one thing that holds all that something is to be beside by then; None where there is
        no such thing.
        """
        around: set[Thing | None] = set()
        for phrase in (np for item in beside for np in item.phrases):
            if phrase.pronoun or not phrase.words:
                return None
            with suppress(ReferenceProblem):
                options = self._phrases.meaning(phrase, Role.ANY).options
                around |= {self._holder(thing) for thing in things_in(options)}
        (only, *more) = around or {None}
        return None if more else only

    def are_in(self, thing: Thing, beside: Sequence[Beside]) -> bool:
        """Whether a thing holds all that something is to be beside by then, what is called so and
        is elsewhere left out of account.
        """
        found: set[Thing | None] = set()
        for phrase in (np for item in beside for np in item.phrases):
            if phrase.pronoun or not phrase.words:
                return False
            told = self._landmarks.told_there(phrase, {thing.name})
            with suppress(ReferenceProblem):
                options = self._phrases.meaning(told, Role.ANY).options
                found |= {self._holder(item) for item in things_in(options)}
        names = {None if holder is None else holder.name for holder in found}
        parts = {holder.part for holder in found if holder is not None}
        return names == {thing.name} and (thing.part is None or parts <= {thing.part, None})

    def _holder(self, thing: Thing) -> Thing | None:
        """What a thing is in, or has been put into; None where it is in nothing."""
        discourse = self._discourse
        if thing in discourse.things(*discourse.put):
            put = [at for at in discourse.put_into if thing in discourse.things(at)]
            into = {t for at in put for t in discourse.things(discourse.put_into[at])}
            return next(iter(into)) if len(into) == 1 else None
        state = self._scene.states.get(thing.name)
        owner, _, part = ("" if state is None else state.inside or "").partition(".")
        return Thing(owner, part or None) if owner else None

    def _check_region(self, phrase: NounPhrase, region: Beside) -> None:
        """Whether a thing has such a region. The left side of what can be moved is beside it, the
        left edge of a tray is a part of it.
        """
        resolved = self._phrases.meaning(phrase, Role.ANY)
        things = set(things_in(resolved.options))
        inside = region.text.split()[0] in ("in", "into")
        if inside and any(can_be(thing, Role.CONTAINER, self._scene) for thing in things):
            raise ReferenceProblem(region.text, "no part of what is inside can be asked for", 2)
        anywhere = (Nearby.AT_CENTRE, Nearby.AT_EDGE, Nearby.AT_CORNER)
        if region.relation in anywhere or all(thing.name == DESK for thing in things):
            return
        part = _PARTS & {*region.text.split()}
        if not self._are_fixed(things) and not (
            part and all(space.is_support(thing, self._scene) for thing in things)
        ):
            raise ReferenceProblem(phrase.text, "say 'left of', 'in front of' and so on", 1)

    def _are_fixed(self, things: Iterable[Thing]) -> bool:
        return not any(t.name == DESK or self._scene.infos[t.name].movable for t in things)

    def _near(self, beside: Beside, themes: Sequence[int], below: Set[str]) -> list[Near]:
        """A relation to the things that its phrases mean; "next to the two cups" is to each."""
        if beside.relation.landmarks == 0:
            return [Near(beside.relation)]
        landmarks: list[int] = []
        clause, mark, side = self._discourse.last_landmark
        sided = clause >= self._discourse.clause - 1 and side in OPPOSITE
        if sided and _is_across(beside) and beside.phrases[0].pronoun:
            # "… to the left of the mug and the pen on the other side of it"
            beside = replace(beside, relation=OPPOSITE[side])
        for phrase in beside.phrases:
            if is_robot(phrase) or phrase.text in ("each other", "one another"):
                raise ReferenceProblem(phrase.text, "say beside which object", 2)
            landmarks += self._landmarks.referents(phrase, themes, beside.relation, below)
        if beside.relation is Nearby.AWAY:
            landmarks = [each for index in landmarks for each in self._discourse.each(index)]
        if beside.text.startswith(("closer", "nearer")):
            closer = self._closer(beside.text, themes, landmarks)
            if not isinstance(closer, Nearby):
                return [Near(Nearby.NEXT_TO, tuple(landmarks)), closer]
            beside = replace(beside, relation=closer)
        if _is_across(beside):
            things = self._discourse.things
            last = side if sided and things(mark) == things(*landmarks) else None
            beside = replace(beside, relation=self._across(beside.text, themes, landmarks, last))
        near_both = beside.relation in (Nearby.NEXT_TO, Nearby.NEAR) and len(landmarks) == 2
        if near_both or (beside.relation in (*OPPOSITE, Nearby.AWAY) and len(landmarks) > 1):
            return [Near(beside.relation, (landmark,)) for landmark in landmarks]
        if len(landmarks) != beside.relation.landmarks:
            text = " and ".join(phrase.text for phrase in beside.phrases)
            why = "say between which two things" if beside.relation.landmarks == 2 else "say which"
            raise ReferenceProblem(text, why, 2)
        if beside.relation in OPPOSITE:
            self._check_side(beside, self._discourse.things(*landmarks))
        return [Near(beside.relation, tuple(landmarks))]

    def _closer(self, text: str, themes: Sequence[int], landmarks: Sequence[int]) -> Nearby | Near:
        """Where is closer to something: near it, for what is near it already next to it, and for
        what is next to it a point between them, where there is one.
        """
        things = [thing.name for index in themes for thing in self._discourse.things(index)]
        marks = [mark.name for index in landmarks for mark in self._discourse.things(index)]

        def are(relation: Nearby) -> bool:
            around = [Whereabouts(relation, (mark,)) for mark in marks]
            return any(holds(where, name, self._scene) for where in around for name in things)

        if not are(Nearby.NEAR):
            return Nearby.NEAR
        if are(Nearby.NEXT_TO):
            point = None
            if len(things) == len(marks) == 1 and not {*themes, *landmarks} & self._discourse.put:
                point = space.point_closer(Thing(things[0]), Thing(marks[0]), self._scene)
            if point is None:
                raise ReferenceProblem(text, "it is next to that already", 3)
            self._discourse.notes.append(
                f"{text!r} is closer than now, as it is next to it already"
            )
            return Near(Nearby.AT_POINT, point=point)
        self._discourse.notes.append(f"{text!r} is next to it, as it is near that already")
        return Nearby.NEXT_TO

    def _across(
        self, text: str, themes: Sequence[int], landmarks: Sequence[int], last: Nearby | None
    ) -> Nearby:
        """The other side of something than that where things are, or have been put; what is not
        moved "to" it is not on the ``last`` side, where something else just went.
        """
        discourse = self._discourse
        marks = discourse.things(*landmarks)
        if discourse.put & {*themes}:
            near = (near for place in discourse.last_places for near in place.beside)
            found = {n.relation for n in near if discourse.things(*n.landmarks) == marks}
        else:
            found = {
                side
                for side in OPPOSITE
                for name in (thing.name for thing in discourse.things(*themes))
                if holds(Whereabouts(side, tuple(t.name for t in marks)), name, self._scene)
            }
            if last is not None:
                found = found | {last} if text.startswith("to ") else {last}
        sides = [OPPOSITE[side] for side in found if side in OPPOSITE]
        several = last is None and len(themes) > 1  # which of them are on the one side?
        if len(marks) != 1 or several or len(sides) != len(found) or len(sides) != 1:
            raise ReferenceProblem(text, "say 'left of', 'in front of' and so on", 3)
        discourse.notes.append(f"{text!r} is {sides[0]} it")
        return sides[0]

    def across_the_desk(self, where: Destination, themes: Sequence[int]) -> Destination:
        """The other side of the desk than that where things are, which is told."""
        (beside, *more) = where.beside
        if more or not _is_across(beside) or beside.phrases[0].pronoun:
            return where
        marks = things_in(self._phrases.meaning(beside.phrases[0], Role.ANY).options)
        if [mark.name for mark in marks] != [DESK]:
            return where
        things = self._discourse.things(*themes)
        (side, *others) = {side_across(thing, self._scene) for thing in things}
        if others or side is None or self._discourse.put & {*themes}:
            raise ReferenceProblem(beside.text, "say to the left, right, front or back", 3)
        self._discourse.notes.append(f"{beside.text!r}: {side}")
        return replace(where, beside=(replace(beside, relation=side, phrases=()),))

    def _check_side(self, beside: Beside, things: Sequence[Thing]) -> None:
        """The left side of a sideboard is a part of it; what is on the left of a tray is beside it,
        which is said.
        """
        part = "side" in beside.text.split() and not _is_across(beside)
        if part and self._are_fixed(things):
            raise ReferenceProblem(beside.text, "say 'left of' and so on, or on which part", 1)
        flat = all(space.is_support(thing, self._scene) for thing in things)
        if flat and beside.text.startswith(("to the front of", "to the back of")):
            raise AmbiguousReference(beside.text, ["beside it", "a part of it"])
        note = f"{beside.text!r}: beside it, not on it"
        if flat and beside.text.startswith(("on ", "at ")) and note not in self._discourse.notes:
            self._discourse.notes.append(note)

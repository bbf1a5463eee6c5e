"""What things are put beside: what the phrases for that mean."""

from __future__ import annotations

from collections.abc import Sequence, Set
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Relation, Thing, things_in
from etot_cli.reasoning.builtin.relations import bearers
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role
from etot_cli.reasoning.language.grammar.syntax.phrases import Beside, Modifier, NounPhrase
from etot_cli.reasoning.language.reference.choosing.modified import names_of_things
from etot_cli.reasoning.language.reference.geometry.rows import is_column
from etot_cli.reasoning.language.reference.geometry.space import OPPOSITE, is_flat
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.memory.by_now import is_shut_away
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.resolved import Resolved
from etot_cli.reasoning.language.reference.memory.spoken_of import (
    are_several,
    clauses_of,
    mentioned_in,
)
from etot_cli.reasoning.language.reference.naming.determiners import quantity_of
from etot_cli.reasoning.language.reference.pronouns.coreference import PLURAL_PRONOUNS
from etot_cli.reasoning.language.reference.pronouns.one_thing import ROOMY
from etot_cli.reasoning.language.reference.several import Phrases
from etot_cli.reasoning.language.words.lexicon import matches_any, same_noun, singular, word_set
from etot_cli.reasoning.language.words.nouns import STACK
from etot_cli.reasoning.language.words.patterns import spellings
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, SceneState, owner_of

_STACKS = frozenset(spellings(STACK))
_SIDES = (Nearby.NEXT_TO, Nearby.NEAR, Nearby.LEFT, Nearby.RIGHT)
"""What is put behind or in front of "it" may as well be so of the tray."""
_BEARING = word_set("tray board pallet cart trolley stand rack sheet shelf table stool pad")
"""What things are put on together; beside a plate a table is laid, a book is one thing more."""


def _put_on_the_same(
    discourse: Discourse, themes: Sequence[int], relation: Nearby, excluded: Sequence[int]
) -> int | None:
    """In "the apple on the tray and the banana next to it" the apple, where the tray has room for
    both; None where that is not said, or there is not.
    """
    said: tuple[tuple[int, ...], ...] = ((), (), ())
    for clause in clauses_of(discourse):
        said = mentioned_in(discourse, clause, Role.ANY, excluded)
        if any(said):
            break
    moved, places, landmarks = said
    upon = [place for place in discourse.last_places if place.relation is Relation.ON]
    if len(moved) != 1 or len(places) != 1 or landmarks or relation not in _SIDES:
        return None
    plain = [place.where for place in upon if not place.beside] == [*places]
    nouns = {mention.noun for mention in discourse.mentions if mention.referent in places}
    bearing = all(matches_any(noun, _BEARING) for noun in nouns)
    if not (plain and bearing) or moved[0] not in discourse.put or discourse.is_desk(places[0]):
        return None
    infos = discourse.scene.infos
    (below, *others) = [infos[thing.name] for thing in discourse.things(*places)]
    above = [infos[thing.name] for thing in discourse.things(*moved, *themes)]
    wide = min(below.size[:2]) >= ROOMY * max(min(info.size[:2]) for info in above)
    long = max(below.size[:2]) >= max(max(info.size[:2]) for info in above)
    return moved[0] if not others and is_flat(below) and wide and long else None


class Landmarks:
    """Turns phrases for what things are put beside into referents of a discourse.

    Args:
        scene: what is spoken about.
        phrases: resolves the noun phrases.
        discourse: what was spoken of before; it grows.
    """

    def __init__(self, scene: SceneState, phrases: Phrases, discourse: Discourse) -> None:
        self._scene = scene
        self._phrases = phrases
        self._discourse = discourse

    def of_themes(self, beside: Beside, themes: Sequence[int], below: Set[str]) -> Beside:
        """Next to the red one, on the red tray: the tray is the place, and not what is meant."""
        mentions = self._discourse.mentions
        nouns = [mention.noun for mention in mentions if mention.referent in themes]
        phrases = list(beside.phrases)
        for number, phrase in enumerate(phrases if nouns else ()):
            if phrase.head == "one":
                told = phrase.called(singular(nouns[-1]))
                found, alike = (
                    self._meant(phrase),
                    self._meant(told)
                    - {thing for index in themes for thing in self._discourse.things(index)},
                )
                # Nothing is beside a drawer, either, that something was taken out of.
                if found and all(
                    thing.part or thing.board or thing.name in below for thing in found
                ):
                    phrases[number] = told
                elif len(found) == len(alike) == 1 and found != alike:
                    if self._is_other_than(phrase, themes):
                        (name,) = (thing.name for thing in alike)
                        self._discourse.notes.append(f"read {phrase.text!r} as {name}")
                        phrases[number] = told
                        continue
                    raise AmbiguousReference(phrase.text, [t.name for t in (*found, *alike)])
        return replace(beside, phrases=tuple(phrases))

    def _that_one(self, phrase: NounPhrase, themes: Sequence[int]) -> tuple[int, ...]:
        """Of several things with one noun "that cup" is the one spoken of last but for what goes
        there itself; nothing where that is called something else.
        """
        discourse, (noun, *more) = self._discourse, phrase.words or ("",)
        if phrase.determiner not in ("that", "this") or more or phrase.modifiers or noun == "one":
            return ()
        alike = [item for item in discourse.mentions if same_noun(item.noun, noun)]
        said = [item.referent for item in alike if item.referent not in themes]
        own = any(item.referent in themes for item in alike)
        last = {item.referent for item in alike if item.clause == alike[-1].clause}
        if not (own and said and len(discourse.things(*last - {*themes}, said[-1])) == 1):
            return ()
        discourse.mention_again(said[-1], Role.ANY)
        return (said[-1],)

    def referents(
        self, phrase: NounPhrase, themes: Sequence[int], relation: Nearby, below: Set[str]
    ) -> list[int]:
        """Referents of a landmark, each a single thing; "the two bowls" gives two."""
        found = []
        discourse = self._discourse
        single = phrase.pronoun and phrase.pronoun not in PLURAL_PRONOUNS and not phrase.modifiers
        indices = (
            (self._beside_it(phrase, themes, relation, below),)
            if single and not phrase.determiner
            else self._that_one(phrase, themes)
            or self._phrases.refer(self.told_there(phrase, below), Role.ANY, themes)
        )
        for index in self._lowest(indices, phrase) if phrase.pronoun else indices:
            discourse.last_landmark = (discourse.clause, index, relation)
            referent = self._discourse.referents[index]
            if index in themes:
                raise ReferenceProblem(phrase.text, "nothing can be put beside itself", 2)
            things = self._discourse.things(index)
            if any(thing.name == DESK for thing in things):
                raise ReferenceProblem(phrase.text, "beside the desk is off the desk", 2)
            if any(thing.board for thing in things):
                raise ReferenceProblem(phrase.text, "nothing is put beside a board", 2)
            moved = discourse.things(*discourse.put)
            kept = (self._scene.states[thing.name] for thing in things if thing not in moved)
            around = (owner_of(state.inside) for state in kept if state.inside is not None)
            if not below >= {*around}:
                raise ReferenceProblem(phrase.text, "it lies in a container", 2)
            if phrase.head in _STACKS and is_column(things, self._scene):
                base = Resolved(((things[0],),), noun=phrase.head)  # the rest lies upon that
                if things[0] in discourse.things(*themes):
                    raise ReferenceProblem(phrase.text, "nothing can be put beside itself", 2)
                found.append(discourse.add(base, phrase.text, Role.ANY))
            elif all(len(option) == 1 for option in referent.options):
                found.append(index)
            else:
                for thing in things:
                    alone = Resolved(((thing,),), noun=thing.name)
                    found.append(self._discourse.add(alone, phrase.text, Role.ANY))
        return found

    def _lowest(self, indices: Sequence[int], phrase: NounPhrase) -> list[int]:
        """Of things that were put upon each other the lowest: what is beside them is beside that.

        Raises:
            ReferenceProblem: some were put into something.
        """
        discourse, lowest = self._discourse, []
        named = {*discourse.things(*indices)}
        for index in indices:
            if len(indices) > 1 and index in discourse.put_into:
                raise ReferenceProblem(phrase.text, "some of it lies in a container by then", 2)
            below = (discourse.put_upon.get(thing, ()) for thing in discourse.things(index))
            if not named & {thing for things in below for thing in things}:
                lowest.append(index)
        return lowest or [*indices]

    def _is_other_than(self, phrase: NounPhrase, themes: Sequence[int]) -> bool:
        """Whether "the other one" is another such thing as is taken from somewhere ("take the
        pen out of the box and lay it by the other one") than another such place.
        """
        mentions, things = self._discourse.mentions, self._discourse.things
        named = [m for m in mentions if m.referent not in themes and m.role is Role.ANY]
        moved = [thing.name for index in themes for thing in things(index)]
        sources = {thing.name for m in named for thing in things(m.referent)}
        around = {name for theme in moved for name in bearers(self._scene, theme)}
        other = quantity_of(phrase.determiner).other and phrase.words == ("one",)
        return other and len(moved) == 1 and bool(sources) and sources <= around

    def _meant(self, phrase: NounPhrase) -> set[Thing]:
        """All that a landmark's phrase may mean; nothing where it means nothing."""
        with suppress(ReferenceProblem):
            return {*things_in(self._phrases.meaning(phrase, Role.ANY).options)}
        return set()

    def told_there(self, phrase: NounPhrase, below: Set[str]) -> NounPhrase:
        """On a tray, "between the two cups" is between those on it, and "next to the cup" next to
        the one on it, where there are others.
        """
        if phrase.pronoun or phrase.modifiers or not below - {DESK} or len(below) > 1:
            return phrase
        there = [Modifier(prep, (NounPhrase(words=tuple(below)),)) for prep in (Prep.ON, Prep.IN)]
        ways: list[set[tuple[Thing, ...]]] = []
        for told in (phrase, *map(phrase.told_by, there)):
            ways.append(set())
            with suppress(ReferenceProblem):
                ways[-1] = {*self._phrases.meaning(told, Role.ANY).options}
        plain, *within = ways
        known = len(plain) == 1 and len({t for o in plain for t in o}) == 1
        fitting = [at for at, way in zip(there, within, strict=True) if len(way) == 1]
        return phrase if known or not fitting else phrase.told_by(fitting[0])

    def _beside_it(
        self, phrase: NounPhrase, themes: Sequence[int], relation: Nearby, below: Set[str]
    ) -> int:
        """What "next to it" is beside.

        In "the can left of the jar and the tin right of it" that is the jar, in "the can next to
        the jar and the tin behind it" it may as well be the can. What was put into
        something that can be moved is not "it" but that is: nothing is beside what is inside.

        Raises:
            AmbiguousReference: it may as well be beside the place that something was put at.
        """
        discourse = self._discourse
        clause, mark, how = discourse.last_landmark
        here = {item.referent for item in discourse.mentions if item.clause == discourse.clause}
        contrasted = clause == discourse.clause - 1 and OPPOSITE.get(how) is relation
        if contrasted and here <= {*themes} and mark not in themes:
            # "… to the right of the plate and set the mug to its left"
            names = names_of_things(discourse.things(mark))
            discourse.notes.append(f"read {phrase.text!r} as that of {names}")
            discourse.mention_again(mark, Role.ANY)
            return mark
        if clause == discourse.clause:
            same = (item for item in discourse.mentions if item.clause == clause)
            moved = {item.referent for item in same if item.role is Role.THEME} - {*themes}
            if moved and OPPOSITE.get(how) is not relation:
                named = [discourse.referents[item].text for item in (*sorted(moved), mark)]
                raise AmbiguousReference(phrase.text, named)
            discourse.mention_again(mark, Role.ANY)
            return mark
        inside = discourse.put_into
        upon = [
            item
            for item in range(len(discourse.referents))
            if {thing.name for thing in discourse.things(item)} <= below
        ]
        excluded = [*themes, *inside, *upon]
        try:
            (index,) = self._phrases.refer(phrase, Role.ANY, excluded)
        except AmbiguousReference:
            rather = _put_on_the_same(discourse, themes, relation, excluded)
            if rather is None:
                raise
            names = names_of_things(discourse.things(rather))
            discourse.notes.append(f"read {phrase.text!r} as {names}")
            discourse.mention_again(rather, Role.ANY)
            return rather
        said = [item.clause for item in discourse.mentions if item.referent == index]
        rivals = [mark] if mark != index and clause in said else []
        infos = self._scene.infos
        if any(not infos[t.name].movable for t in discourse.things(index) if t.name in infos):
            # "Put both pens in it, close it and put the cup in front of it"
            within = (theme for theme, around in inside.items() if around == index)
            rivals += [
                theme
                for theme in within
                if not (are_several(discourse, theme) or is_shut_away(theme, discourse))
            ]
        if rivals:
            named = [discourse.referents[item].text for item in (*rivals, index)]
            raise AmbiguousReference(phrase.text, named)
        return index

"""What has been spoken of so far: referents, and what pronouns and short forms mean."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from etot_cli.reasoning.builtin.goal import Place, Referent, Relation, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.reference.antecedents import (
    UNCLEAR,
    AmbiguousReference,
    Mention,
)
from etot_cli.reasoning.language.reference.noun_phrases import Resolved
from etot_cli.reasoning.language.words.lexicon import THING_NOUNS, matches_any, same_noun, singular
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import DESK, ObjectInfo, SceneState

PLURAL_PRONOUNS = frozenset({"them", "they", "these", "those"})
FLAT = 0.5
"""What is at most so high, as a share of its width, is a support by its looks (a tray, a book)."""
ROOMY = 2.0
"""What is so many times wider than a thing on it has room for another one beside that."""


def is_flat(info: ObjectInfo) -> bool:
    """Whether a thing is much lower than wide as it rests."""
    return info.size[2] <= FLAT * min(info.size[:2])


@dataclass
class Discourse:
    """Referents and mentions up to some point of an instruction.

    Args:
        scene: what is spoken about.
        clause: number of the clause being read.
        last_place: the latest destination, for "there".
    """

    scene: SceneState
    referents: list[Referent] = field(default_factory=list)
    mentions: list[Mention] = field(default_factory=list)
    clause: int = 0
    last_places: tuple[Place, ...] = ()
    put_into: dict[int, int] = field(default_factory=dict)
    """Referent → the referent that it was to be put into last."""
    notes: list[str] = field(default_factory=list)
    """What words were taken for, where that was a choice."""
    put: frozenset[int] = frozenset()
    """Referents that have been given a place."""
    last_landmark: tuple[int, int, Nearby] = (-1, -1, Nearby.NEAR)
    """Number of a clause, the referent that something is put beside there, and how it is to be."""
    stacks: dict[int, int] = field(default_factory=dict)
    """Number of the clause that built a stack → the referent at its bottom."""
    undecided: frozenset[int] = frozenset()
    """Referents of "the …" where several things fit and nothing tells them apart."""

    def copy(self) -> Discourse:
        """An independent copy, for trying a reading."""
        return Discourse(
            self.scene,
            list(self.referents),
            list(self.mentions),
            self.clause,
            self.last_places,
            dict(self.put_into),
            list(self.notes),
            self.put,
            self.last_landmark,
            dict(self.stacks),
            self.undecided,
        )

    def add(
        self,
        resolved: Resolved,
        text: str,
        role: Role,
        *,
        several: bool = False,
        whatever: bool = False,
    ) -> int:
        """Notes what a phrase means and returns its referent; ``several``: no "it" means that.

        A definite phrase with the same meaning as an earlier one speaks of the same choice.
        """
        self.notes += [note for note in resolved.notes if note not in self.notes]
        index = len(self.referents)
        mention = Mention(
            index, role, self.clause, resolved.noun, several, resolved.adjectives, whatever
        )
        if resolved.definite and not resolved.other:
            for earlier in range(index - 1, -1, -1):
                if self._is_again(earlier, resolved):
                    self.mentions.append(replace(mention, referent=earlier))
                    return earlier
        distinct = self._told_from(resolved, role)
        if resolved.definite and not resolved.other and len(resolved.options) > 1:
            self._check_among_spoken(resolved, text)
            self.undecided |= {index}
        self.referents.append(Referent(resolved.options, text, distinct))
        self.mentions.append(mention)
        return index

    def _told_from(self, resolved: Resolved, role: Role) -> tuple[int, ...]:
        """Referents that a phrase means none of: "another cup", and "a cup" of which one has been
        given a place before ("a cup on the tray and a cup on the shelf").
        """
        things = {thing for option in resolved.options for thing in option}
        shared = [
            earlier
            for earlier, referent in enumerate(self.referents)
            if things & {thing for option in referent.options for thing in option}
        ]
        if resolved.other:
            return tuple(shared)
        known = resolved.definite and (len(things) > 1 or len(resolved.options) > 1)
        if known or resolved.again or role is not Role.THEME:
            return ()
        moved = {mention.referent for mention in self.mentions if mention.role is Role.THEME}
        return tuple(
            index
            for index in shared
            if index in moved
            and (len(resolved.options) > 1 or len(self.referents[index].options) > 1)
            and not any(things <= set(option) for option in self.referents[index].options)
        )

    def _check_among_spoken(self, resolved: Resolved, text: str) -> None:
        """After "the black things" "the jar" may be the black one, or any.

        Raises:
            AmbiguousReference: some of what a definite phrase fits was spoken of, and some not.
        """
        if matches_any(resolved.noun, THING_NOUNS):
            return
        sets = [referent.options[0] for referent in self.referents if len(referent.options) == 1]
        spoken = {thing for things in sets if len(things) > 1 for thing in things}
        fitting = dict.fromkeys(thing for option in resolved.options for thing in option)
        if spoken & set(fitting) and set(fitting) - spoken:
            raise AmbiguousReference(text, [thing.name for thing in fitting])

    def _is_again(self, referent: int, resolved: Resolved) -> bool:
        """Whether a definite phrase speaks of an earlier referent.

        It does when it means the same, and when it means, among others, what was spoken of by the
        same noun: "the red plum … the plum".
        """
        earlier, now = set(self.referents[referent].options), set(resolved.options)
        if earlier == now:
            return True
        nouns = {mention.noun for mention in self.mentions if mention.referent == referent}
        return earlier < now and any(same_noun(noun, resolved.noun) for noun in nouns)

    def mention_again(self, referent: int, role: Role) -> None:
        """Notes that a pronoun spoke of a referent."""
        noun = next((m.noun for m in reversed(self.mentions) if m.referent == referent), "object")
        self.mentions.append(Mention(referent, role, self.clause, noun))

    def step_back(self, first: int) -> None:
        """What was mentioned from ``first`` on is what "it" speaks of only if nothing else is."""
        said = [replace(mention, role=Role.ANY, clause=0) for mention in self.mentions[first:]]
        self.mentions[:] = [*said, *self.mentions[:first]]

    def things(self, referent: int) -> tuple[Thing, ...]:
        """Everything that a referent may stand for."""
        options = self.referents[referent].options
        return tuple(dict.fromkeys(thing for option in options for thing in option))

    def last_noun(self, role: Role) -> str | None:
        """The noun that "one" or "the other" stands for in a role; never the desk, which is one."""
        said = [mention for mention in self.mentions if not self._is_desk(mention.referent)]
        mentions = [mention for mention in said if _alike(mention.role, role)] or said
        return mentions[-1].noun if mentions else None

    def nouns(self) -> tuple[str, ...]:
        """All nouns that "one" may stand for."""
        said = (item.noun for item in self.mentions if not self._is_desk(item.referent))
        return tuple(dict.fromkeys(said))

    def _is_desk(self, referent: int) -> bool:
        return all(thing.name == DESK for thing in self.things(referent))

    def mentioned_like(self, noun: str | None) -> tuple[Thing, ...]:
        """Single things spoken of by a noun; "the other" is none of them."""
        found: dict[Thing, None] = {}
        for mention in self.mentions:
            options = self.referents[mention.referent].options
            if noun is not None and same_noun(mention.noun, noun) and len(options) == 1:
                found.update(dict.fromkeys(options[0]))
        return tuple(found)

    def is_about_parts(self, noun: str | None) -> bool:
        """Whether what was spoken of last by a noun is part of something ("one drawer")."""
        for mention in reversed(self.mentions):
            if noun is not None and same_noun(mention.noun, noun):
                things = self.things(mention.referent)
                return all(thing.part or thing.board for thing in things)
        return False

    def antecedents(
        self, pronoun: str, role: Role, text: str, excluded: Sequence[int] = ()
    ) -> tuple[int, ...]:
        """The referents that a pronoun means.

        Args:
            pronoun: as written.
            role: what it is used for.
            text: the whole phrase, for messages.
            excluded: referents that it cannot mean.

        Raises:
            AmbiguousReference: several things are as likely to be meant.
            ReferenceProblem: nothing before it fits.
        """
        if pronoun in PLURAL_PRONOUNS:
            found = self._plural(role, text)
            if not found:
                raise ReferenceProblem(text, UNCLEAR, 2)
            return found
        return (self.singular(role, text, excluded),)

    def singular(self, role: Role, text: str, excluded: Sequence[int] = ()) -> int:
        """What "it" means in a role, of the latest clause that has anything to play it: the one
        thing that was acted on there, else the one place that something went to, else the one
        landmark. Where that thing went to a place that could be meant as well ("put the plum into
        the mug and move it to the tray"), either may be meant.

        Raises:
            AmbiguousReference: several things are as likely to be meant.
            ReferenceProblem: nothing before it fits.
        """
        for clause in self._clauses():
            acted_on, places, landmarks = self._mentioned_in(clause, role, excluded)
            around = self.put_into.get(acted_on[0]) if len(acted_on) == 1 else None
            if around is not None and role is Role.SURFACE and around not in excluded:
                return around  # what is put on what lies in a vessel, goes on or into that
            if len(acted_on) == 1:
                rivals = [place for place in places if self._rivals(place, acted_on[0], role)]
                # "Take the cup off the saucer and put the plum on it": either takes a plum.
                own = {thing.name for thing in self.things(acted_on[0])}
                if role in (Role.SURFACE, Role.CONTAINER):
                    rivals += [i for i in landmarks if not own & {t.name for t in self.things(i)}]
                found = (*acted_on, *rivals)
            else:
                # One of several things that were acted on together is not "it".
                found = places or acted_on or landmarks
                if role is Role.THEME and found == landmarks:
                    # "Take everything off the tray and put it away": what stood there, or that.
                    found = (*self._whatever(clause), *found)
            if len(found) > 1:
                raise AmbiguousReference(text, [self.referents[index].text for index in found])
            if found:
                return found[0]
        raise ReferenceProblem(text, UNCLEAR, 2)

    def _whatever(self, clause: int) -> tuple[int, ...]:
        """What a clause moved from somewhere, whatever it is, where it is several things."""
        return tuple(
            mention.referent
            for mention in self.mentions
            if mention.clause == clause
            and mention.whatever
            and any(len(option) > 1 for option in self.referents[mention.referent].options)
        )

    def openable(self) -> tuple[int, ...]:
        """All drawers and doors that were spoken of, in whatever role."""
        spoken = dict.fromkeys(mention.referent for mention in self.mentions)
        return tuple(
            index
            for index in spoken
            if all(can_be(thing, Role.PART, self.scene) for thing in self.things(index))
        )

    def candidates(self) -> tuple[int, ...]:
        """All that "it" may mean where only what is said about it tells which."""
        for clause in self._clauses():
            acted_on, places, landmarks = self._mentioned_in(clause, Role.ANY, ())
            if found := (*acted_on, *places) or landmarks:
                return found
        return ()

    def _clauses(self) -> list[int]:
        return sorted({mention.clause for mention in self.mentions}, reverse=True)

    def _mentioned_in(
        self, clause: int, role: Role, excluded: Sequence[int]
    ) -> tuple[tuple[int, ...], tuple[int, ...], tuple[int, ...]]:
        """What a clause acted on, its places and its landmarks, so far as they fit a role."""
        acted_on: dict[int, None] = {}
        places: dict[int, None] = {}
        landmarks: dict[int, None] = {}
        for mention in self.mentions:
            referent = mention.referent
            single = any(len(option) == 1 for option in self.referents[referent].options)
            target = role in (Role.SURFACE, Role.CONTAINER, Role.PLACE)
            single = single and not mention.several and not (mention.whatever and target)
            fits = single and referent not in excluded and self._fits(referent, role)
            if mention.clause != clause or not fits:
                continue
            if mention.role in (Role.THEME, Role.PART):
                acted_on[referent] = None
            else:
                (landmarks if mention.role is Role.ANY else places)[referent] = None
        return (
            tuple(acted_on),
            tuple(index for index in places if index not in acted_on),
            tuple(index for index in landmarks if index not in {**acted_on, **places}),
        )

    def _fits(self, referent: int, role: Role) -> bool:
        return any(can_be(thing, role, self.scene) for thing in self.things(referent))

    def _rivals(self, place: int, theme: int, role: Role) -> bool:
        """Whether "it" may as well mean the place that a thing was put at."""
        things = self.things(place)
        if self._is_desk(place):
            return False
        if role is Role.SURFACE:
            themes = [self.scene.infos[thing.name] for thing in self.things(theme)]
            below = [self.scene.infos[thing.name].size for thing in things]
            support = all(map(is_flat, themes))
            side = max(min(info.size[:2]) for info in themes)
            return not support and any(min(size[:2]) >= ROOMY * side for size in below)
        if role is Role.CONTAINER:
            return self.put_into.get(theme) == place
        return all(self.scene.infos[thing.name].movable for thing in things)

    def _plural(self, role: Role, text: str) -> tuple[int, ...]:
        for clause in sorted({mention.clause for mention in self.mentions}, reverse=True):
            if clause in self.stacks and role in (Role.THEME, Role.ANY):
                # What stands on the bottom goes with it.
                return (self.stacks[clause],)
            found = self._acted_on([m for m in self.mentions if m.clause == clause], role)
            several = len(found) > 1 or any(
                len(option) > 1 for index in found for option in self.referents[index].options
            )
            if several:
                return found
        found = self._acted_on(self.mentions, role)
        said = [mention for mention in self.mentions if mention.referent in found]
        options = [option for index in found for option in self.referents[index].options]
        single = len(found) == 1 and all(len(option) == 1 for option in options)
        plural = any(singular(mention.noun) != mention.noun for mention in said)  # "the pliers"
        if single and not plural and not any(item.several or item.whatever for item in said):
            raise AmbiguousReference(text, [item.text for item in self.referents])
        return found

    def _acted_on(self, mentions: Sequence[Mention], role: Role) -> tuple[int, ...]:
        return tuple(
            dict.fromkeys(
                mention.referent
                for mention in mentions
                if mention.role in (Role.THEME, Role.PART) and self._fits(mention.referent, role)
            )
        )

    def places_spoken_of(self) -> frozenset[int]:
        """What the latest clause named but for what it moved."""
        last = [mention for mention in self.mentions if mention.clause == self._clauses()[0]]
        moved = {mention.referent for mention in last if mention.role is Role.THEME}
        return frozenset({mention.referent for mention in last} - moved)

    def latest_place(self, relation: Relation, excluded: Sequence[int], text: str) -> Place:
        """What "inside" or "on top" without an object means.

        Raises:
            ReferenceProblem: nothing before it fits, or several things do.
        """
        role = Role.CONTAINER if relation is Relation.INSIDE else Role.SURFACE
        return Place(relation, self.singular(role, text, excluded))


def _alike(first: Role, second: Role) -> bool:
    """Whether two roles speak of the same side of an action: what is moved, or where to."""
    moved = (Role.THEME, Role.PART)
    return (first in moved) == (second in moved)

"""What has been spoken of so far: referents, and what pronouns and short forms mean."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from etot_cli.reasoning.builtin.goal import Place, Referent, Relation, Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.reference.noun_phrases import Resolved
from etot_cli.reasoning.language.words.lexicon import same_noun
from etot_cli.world.state import SceneState

PLURAL_PRONOUNS = frozenset({"them", "they", "these", "those"})


@dataclass(frozen=True, slots=True)
class Mention:
    """A referent spoken of in a clause, in a role."""

    referent: int
    role: Role
    clause: int
    noun: str


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
    last_landmark: tuple[int, int] = (-1, -1)
    """Number of a clause and the referent that something is put beside there."""
    stacks: dict[int, int] = field(default_factory=dict)
    """Number of the clause that built a stack → the referent at its bottom."""

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
        )

    def add(self, resolved: Resolved, text: str, role: Role) -> int:
        """Notes what a phrase means and returns its referent.

        A definite phrase with the same meaning as an earlier one speaks of the same choice.
        """
        self.notes += [note for note in resolved.notes if note not in self.notes]
        index = len(self.referents)
        if resolved.definite and not resolved.other:
            for earlier in range(index - 1, -1, -1):
                if self._is_again(earlier, resolved):
                    self.mentions.append(Mention(earlier, role, self.clause, resolved.noun))
                    return earlier
        distinct: tuple[int, ...] = ()
        if resolved.other:
            things = {thing for option in resolved.options for thing in option}
            distinct = tuple(
                earlier
                for earlier, referent in enumerate(self.referents)
                if things & {thing for option in referent.options for thing in option}
            )
        self.referents.append(Referent(resolved.options, text, distinct))
        self.mentions.append(Mention(index, role, self.clause, resolved.noun))
        return index

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

    def things(self, referent: int) -> tuple[Thing, ...]:
        """Everything that a referent may stand for."""
        options = self.referents[referent].options
        return tuple(dict.fromkeys(thing for option in options for thing in option))

    def last_noun(self, role: Role) -> str | None:
        """The noun that "one" or "the other" stands for in a role."""
        alike = [mention for mention in self.mentions if _alike(mention.role, role)]
        mentions = alike or self.mentions
        return mentions[-1].noun if mentions else None

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
                return all(thing.part for thing in self.things(mention.referent))
        return False

    def antecedents(
        self, pronoun: str, role: Role, text: str, excluded: Sequence[int] = ()
    ) -> tuple[int, ...]:
        """The referents that a pronoun means: the latest that can play its role.

        Args:
            pronoun: as written.
            role: what it is used for.
            text: the whole phrase, for messages.
            excluded: referents that it cannot mean.

        Raises:
            ReferenceProblem: nothing before it fits.
        """
        if pronoun in PLURAL_PRONOUNS:
            found = self._plural(role)
        else:
            single = self._singular(role, excluded)
            found = () if single is None else (single,)
        if not found:
            raise ReferenceProblem(text, "it is not clear what this refers to", 2)
        return found

    def _by_recency(self) -> list[Mention]:
        """Mentions from the latest clause back; in each what was acted on comes first."""
        acted_on = (Role.THEME, Role.PART)
        return sorted(
            self.mentions,
            key=lambda m: (
                -m.clause,
                m.role not in acted_on,
                m.role is Role.ANY,
                -self.mentions.index(m),
            ),
        )

    def _fits(self, referent: int, role: Role) -> bool:
        return any(can_be(thing, role, self.scene) for thing in self.things(referent))

    def _fits_or_holds(self, referent: int, role: Role) -> bool:
        """Whether a vessel can play a role; things are put "on" one, too."""
        return self._fits(referent, role) or (
            role is Role.SURFACE and self._fits(referent, Role.CONTAINER)
        )

    def _singular(self, role: Role, excluded: Sequence[int]) -> int | None:
        for mention in self._by_recency():
            referent = mention.referent
            single = any(len(option) == 1 for option in self.referents[referent].options)
            if not single or referent in excluded or not self._fits(referent, role):
                continue
            around = self.put_into.get(referent)
            if around is not None and self._fits_or_holds(around, role):
                # "Put the plum into the mug and it onto the tray" is about the mug: nobody asks
                # for something and for its undoing in one breath.
                return around
            return referent
        return None

    def _plural(self, role: Role) -> tuple[int, ...]:
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
        return self._acted_on(self.mentions, role)

    def _acted_on(self, mentions: Sequence[Mention], role: Role) -> tuple[int, ...]:
        return tuple(
            dict.fromkeys(
                mention.referent
                for mention in mentions
                if mention.role in (Role.THEME, Role.PART) and self._fits(mention.referent, role)
            )
        )

    def latest_place(self, relation: Relation, excluded: Sequence[int], text: str) -> Place:
        """What "inside" or "on top" without an object means.

        Raises:
            ReferenceProblem: nothing before it fits.
        """
        role = Role.CONTAINER if relation is Relation.INSIDE else Role.SURFACE
        for mention in self._by_recency():
            if mention.referent not in excluded and self._fits(mention.referent, role):
                return Place(relation, mention.referent)
        raise ReferenceProblem(text, "it is not clear what this refers to", 2)


def _alike(first: Role, second: Role) -> bool:
    """Whether two roles speak of the same side of an action: what is moved, or where to."""
    moved = (Role.THEME, Role.PART)
    return (first in moved) == (second in moved)

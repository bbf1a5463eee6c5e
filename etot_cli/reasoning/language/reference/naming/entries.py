"""The words of one object, drawer, board or surface, and how well a noun fits them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from msgspec import Struct

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.language.grammar.text.spelling import is_english
from etot_cli.reasoning.language.reference.naming.labels import (
    LINKS,
    as_word,
    contents_of,
    head_of,
    is_odd,
    twins_of,
    words_of,
)
from etot_cli.reasoning.language.words.alike import SORTS
from etot_cli.reasoning.language.words.categories import (
    CATEGORIES,
    GROUND,
    LUMPS,
    OF_A_SORT,
    PACKED,
    PACKS,
    SERVED,
    SERVING,
)
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    COMMON_NOUNS,
    COMPOUNDS,
    CONTAINER_NOUNS,
    HELPING_NOUNS,
    JOINT_NOUNS,
    KIND_GROUPS,
    LIDDED,
    NAMED_FOR_A_SORT,
    ONLY_SO_CALLED,
    OTHER_SORTS,
    PADS,
    RACKED,
    SIZES,
    basic_color,
    is_plural_of,
    matches_any,
    singular,
    word_set,
)
from etot_cli.world.state import ObjectInfo

CUBIC = 2.0
"""What is so many times longer than high, or higher, is no cube, whatever it is called for."""

EXACT, HEAD, GENERIC, CONTENT = range(4)
"""How well a phrase's noun fits, best first: it is the very name; the name's own noun; a noun for
its kind; what it is a pack or box of. A word before the noun (the "paper" of a paper clip) tells
what is called so from others, but names nothing where the noun is for it."""


SHAPES = frozenset({"block", "cube", "ball", "sphere", "cylinder", "square", "triangle", "star"})
PORTIONS = frozenset({"roll", "pack", "bundle", "bar", "sheet", "bag", "reel", "spool"})
"""Nouns for so much of what stands before them, which is what the thing is."""
PIECES = word_set(
    "piece slice loaf chunk lump wedge hunk block cube ball head bunch clove ear bulb deck"
)
"""Other nouns for one thing of what is told behind an "of" ("the loaf of bread")."""
_VESSELS = frozenset(
    noun
    for kind, groups in KIND_GROUPS.items()
    for group in groups
    for noun in group
    if kind not in ("sphere", "capsule", "pen") and not {*group} & {*SHAPES}
)
"""Nouns for what things are kept in or on, be it solid in this scene."""


class Entry(Struct, frozen=True):
    """A thing and its words, all lower case.

    Args:
        thing: what is called so.
        own: words of its label and name.
        heads: the nouns among them (the last words).
        generic: nouns by kind.
        context: words that may come before its noun without singling it out (its owner's).
        numbers: numbers in its name or label.
        exact: full names.
        color: its basic colour.
        info: the object (or the part's owner); None for the desk.
        called: the words of its label and of its name.
        owner: the own words of what it is a part of.
        content: the noun behind the "of" of its label.
        twins: other names, of several words each, of what is called as it is.
    """

    thing: Thing
    own: tuple[str, ...]
    heads: tuple[str, ...]
    generic: tuple[str, ...] = ()
    context: tuple[str, ...] = ()
    numbers: tuple[str, ...] = ()
    exact: tuple[str, ...] = ()
    color: str | None = None
    info: ObjectInfo | None = None
    called: tuple[tuple[str, ...], ...] = ()
    owner: tuple[str, ...] = ()
    content: tuple[str, ...] = ()
    twins: tuple[tuple[str, ...], ...] = ()

    def is_called(self, words: Sequence[str]) -> bool:
        """Whether words are its whole name or label."""
        return tuple(words) in self.called

    def numbered(self) -> list[str]:
        """The words before its numbers."""
        return [word for words in self.called for word, n in pairwise(words) if n.isdigit()]

    def grade(self, noun: str) -> int | None:
        """How well a noun fits, None where it does not."""
        if noun in self.exact:
            return EXACT
        if matches_any(noun, self.heads) or matches_any(noun.replace("_", ""), self.heads):
            # Reading glasses are rather no glass.
            return GENERIC if self.is_pair() and is_plural_of(self.heads[0], (noun,)) else HEAD
        if matches_any(noun, self.generic):
            return GENERIC if self.info is None or _may_be(noun, self.info) else None
        if matches_any(noun, self.content):
            return CONTENT
        return None

    def is_pair(self) -> bool:
        """Whether it is one thing called by a plural; one of the "drawers" is a drawer."""
        levels = self.info is None or self.info.parts or self.info.boards
        return bool(not levels and self.heads) and singular(self.heads[0]) != self.heads[0]

    def only_tells(self, word: str) -> bool:
        """Whether a word stands in its name before the noun and does not name it."""
        return self.has_word(word) and not matches_any(word, (*self.heads, *self.content))

    def is_compound(self, noun: str, table: Mapping[str, frozenset[str]] = COMPOUNDS) -> bool:
        """Whether it is called by a noun only with the word before it ("trash can")."""
        before = table.get(singular(noun), frozenset())
        return any(
            w in before and matches_any(noun, (n,)) for c in self.called for w, n in pairwise(c)
        )

    def holds(self) -> bool:
        """Whether it may be for something: a vessel, furniture, a holder or a tool."""
        if self.info is None or self.info.container or self.info.parts or self.info.boards:
            return True
        return bool({*map(singular, self.heads)} & (HELPING_NOUNS | _VESSELS))

    def is_short_for(self, word: str) -> bool:
        """Whether the word before its noun is a usual short name for it ("the remote"): it is no
        vessel, holder or tool for that, and the word no adjective.
        """
        heads = {*map(singular, self.heads)}
        # A key of a car is no car; a cube of sponge is a sponge, and a roll of tape is tape.
        other = heads & (COMMON_NOUNS - SHAPES) and singular(word) in COMMON_NOUNS
        return self.is_portion() or not (self.holds() or other)

    def is_portion(self) -> bool:
        """Whether its noun is for so much of something ("tape roll") and it holds nothing."""
        vessel = self.info is not None and self.info.container
        return not vessel and any(singular(head) in PORTIONS for head in self.heads)

    def is_box_of(self, noun: str) -> bool:
        """Whether its label is for a pack of several such things ("pill box" of the pills)."""
        solid = self.info is not None and not self.info.container
        (*said, pack) = self.called[0]
        several = said[-1:] == [singular(noun)] != [noun]
        return solid and several and (pack in PADS or (pack in PACKS and len(said) == 1))

    def is_pack_of(self, before: str, word: str) -> bool:
        """Whether its label is for a pack of that ("soy sauce bottle", "coke can")."""
        solid = self.info is not None and not self.info.container
        (*said, pack) = self.called[0]
        # A can of tomato soup is soup; a jar of peanut butter is no butter.
        plain = said[-1:] == [word] and not {*said[:-1]} & COMPOUNDS.get(word, frozenset())
        named = (plain and not before) or said[-2:] == [before, word]
        lump = pack in LUMPS and basic_color(word) is None
        return solid and named and (lump or pack in PACKS) and word in PACKED

    def is_serving_of(self, word: str) -> bool:
        """Whether its label is for a vessel that this is drunk or eaten from ("water glass")."""
        (*said, vessel) = self.called[0]
        return said == [word] and vessel in SERVING and word in SERVED

    def is_glass(self) -> bool:
        """Whether it is a glass to drink from, called after what it is made of."""
        tumblers = {*map(singular, self.heads)} & {"tumbler", "cup", "mug", "goblet"}
        return bool(tumblers) and "glass" in self.own

    def is_sort_named(self, noun: str) -> bool:
        """Whether its one word is for a sort of what a noun names ("textbook")."""
        return any(SORTS.get(singular(head)) == singular(noun) for head in self.heads)

    def is_plainly_called(self, noun: str) -> bool:
        """Whether its name is a noun alone, but for colours and numbers."""
        return any(
            [singular(w) for w in words if not (w.isdigit() or basic_color(w))] == [singular(noun)]
            for words in self.called
        )

    def is_sort_of(self, word: str) -> bool:
        """Whether its label is a name and what it tastes of ("crispo vanilla")."""
        named = self.called[0][0] == word and word not in COMMON_NOUNS and word not in PACKED
        return named and len(self.called[0]) == 2 and self.called[0][1] in PACKED

    def counts_among(self, members: frozenset[str]) -> bool:
        """Whether it is called by one of some nouns, or is a pack of what is."""
        solid = self.info is not None and not self.info.container
        packs = (
            words
            for words in self.called
            if solid
            and (
                singular(words[-1]) in PACKS
                or (words[-1] in LUMPS and len(words) == 2 and basic_color(words[0]) is None)
            )
        )
        spiced = CATEGORIES["spice"] <= members
        inner = {
            singular(words[-2])
            for words in packs
            if len(words) > 1 and (spiced or words[-1] not in GROUND)
        }
        heads = {*map(singular, (*self.heads, *self.content))}
        heads = {
            head
            for head in heads
            if not (self.is_compound(head) or self.is_compound(head, OTHER_SORTS))
        }
        heads -= {"glass"} if self.heads[:1] == ("glasses",) else set()
        heads |= {singular("_".join(words[-2:])) for words in self.called if len(words) > 1}
        boxed = self.info is not None and self.info.kind == "box"
        for words in self.called[:1] if boxed else ():
            if len(words) == 2 and not all(map(is_english, words)):
                # What a bar with a name of its own tastes of makes it food, and no fruit.
                tastes = {*words} & PACKED
                heads = heads | tastes if CATEGORIES["food"] <= members else heads - tastes
        return bool(heads & members) or bool(inner & members & PACKED)

    def is_twin(self, words: Sequence[str]) -> bool:
        """Whether words are another name of what is called as it is ("trash can" of a bin)."""
        return tuple(words) in self.twins

    def has_word(self, word: str) -> bool:
        """Whether a word is one of its own, apart from number."""
        return matches_any(word, self.own) or (
            word.endswith("en") and word.removesuffix("en") in self.own  # of wood, "wooden"
        )

    def has_color(self, color: str) -> bool:
        """Whether it is of a basic colour, or is called by a word for it."""
        return self.color == color or any(basic_color(word) == color for word in self.own)

    def is_plainly(self, color: str) -> bool:
        """Whether a basic colour is what people would call its colour first: by its own words, or
        by how it looks when it is called by no colour.
        """
        named = {word for word in self.own if basic_color(word)}
        plain = self.color == color and (self.info is None or self.info.plain_color)
        return color in named or (not named and plain)

    def colors(self) -> frozenset[str]:
        """The basic colours that it is called by, or else the one that it has."""
        named = frozenset(color for word in self.own if (color := basic_color(word)) is not None)
        return named or frozenset(() if self.color is None else (self.color,))

    def is_colored(self) -> bool:
        """Whether anything is known of its colour."""
        return self.color is not None or any(basic_color(word) for word in self.own)

    def is_plural(self, noun: str) -> bool:
        """Whether a noun is the plural of one of its nouns."""
        singulars = (*self.heads, *self.generic, *self.own, *self.content)
        # The name "pills_1" of a pill bottle is the plural of its label's word.
        by_name = any(singular(noun) in words for words in self.called[:1])
        return (by_name or noun not in singulars) and is_plural_of(noun, singulars)


_FLAT = 1 / 3
"""What is thinner than so much of its length is a plate or a bar, no block that has no other name:
a brick of 21 by 10 by 7 cm is just one; a round one is no can or jar, as a tuna can is."""


_LUMPS = {"box": frozenset({"block"}), "cylinder": PACKS}
"""Nouns, by kind, for what is not flat."""


def _kind_nouns(info: ObjectInfo, heads: Iterable[str]) -> tuple[str, ...]:
    """Nouns for a thing's kind that fit something called by these nouns: a can is no bottle, a
    remote no box, but milk may be in a carton.
    """
    kind = info.kind
    groups = KIND_GROUPS.get(kind, ())
    if kind in _LUMPS and min(info.size) < _FLAT * max(info.size):
        lumps = _LUMPS[kind]
        groups = tuple(group for group in groups if not lumps & {*group} or {*heads} & {*group})
    own = {singular(head) for head in heads}
    fitting = [group for group in groups if own & set(group)]
    if own & PACKED and not own & PACKS:
        fitting += [group for group in groups if PACKS & {*group}]
    if not fitting and not own & (COMMON_NOUNS | OF_A_SORT):
        fitting = list(groups[-1:] if kind in NAMED_FOR_A_SORT else groups)
        fitting = [group for group in fitting if not ONLY_SO_CALLED & {*group}]
    if kind in own and kind not in NAMED_FOR_A_SORT:
        fitting = list(groups)
    return tuple(noun for group in fitting for noun in group)


_HANDS = frozenset({"left", "right"})


def _noun_last(words: Sequence[str], color: str | None) -> Sequence[str]:
    """A name's words without what stands behind the noun in it ("block_red", "cup_left"): a size or
    a side, or the colour that the thing has. An orange is no "navel" that is orange.
    """
    last = words[-1] if len(words) > 1 else ""
    colored = color is not None and basic_color(last) == basic_color(color)
    noun = any(last in members for members in CATEGORIES.values())
    noun = noun and words[-2] not in SHAPES | COMMON_NOUNS
    behind = last in SIZES or last in _HANDS or (colored and not noun)
    return words[:-1] if behind else words


def object_entry(info: ObjectInfo) -> Entry:
    """The words of an object."""
    found = (words_of(info.label), words_of(info.name))
    called = [(as_word(words[0]),) if len(words) == 1 else words for words in found]
    own: dict[str, None] = {}
    heads: dict[str, None] = {}
    numbers: dict[str, None] = {}
    for words in called:
        nouns = [word for word in words if not word.isdigit() and len(word) > 1]
        own.update(dict.fromkeys(word for word in nouns if word not in LINKS))
        head = head_of(_noun_last(nouns, info.color))
        # The name "tea_2" of a tea mug is no noun for it.
        short = heads and len(nouns) == 1 and head in called[0][:-1] and head not in heads
        heads.update({} if head is None or short else {head: None})
        numbers.update(dict.fromkeys(word for word in words if word.isdigit()))
    whole = dict.fromkeys("_".join(words) for words in called if is_odd(words))
    twins = [twin for words in called for twin in twins_of(words)]
    generic = (*_kind_nouns(info, heads), *dict.fromkeys(words[-1] for words in twins))
    generic = (*generic, *(SORTS[word] for word in map(singular, heads) if word in SORTS))
    if info.container or any(part.container for part in info.parts):
        generic = (*generic, *(CONTAINER_NOUNS if info.container else CONTAINER_NOUNS[:-1]))
    return Entry(
        thing=Thing(info.name),
        own=(*own, *whole),
        heads=(*heads, *whole),
        generic=generic,
        context=tuple(word for words in twins for word in words[:-1]),
        numbers=tuple(numbers),
        exact=tuple(dict.fromkeys((info.name.casefold(), as_word(info.name.casefold())))),
        color=info.color,
        info=info,
        called=tuple(dict.fromkeys(words for words in called if words)),
        twins=tuple(words for words in twins if len(words) > 1),
        content=tuple(noun for words in called for noun in contents_of(words)),
    )


def part_entries(info: ObjectInfo, owner: Entry) -> list[Entry]:
    """The words of an object's drawers and doors, ``owner`` being its own."""
    nouns = {part: JOINT_NOUNS.get(part.joint_type, ()) for part in info.parts}
    own = {*map(singular, owner.heads)}
    lidded, racked = bool(own & LIDDED), ("rack", "shelf", "tray") if own & RACKED else ()
    return [
        # A door is no lid, unless it is all that a chest has.
        _level_entry(
            info,
            owner,
            Thing(info.name, part.name),
            (
                *said[: 1 if part.front and not lidded else None],
                *(racked if part.joint_type == "slide" else ()),
            ),
        )
        for part, said in nouns.items()
    ]


def board_entries(info: ObjectInfo, owner: Entry) -> list[Entry]:
    """The words of an object's boards, ``owner`` being its own."""
    nouns = (*BOARD_NOUNS, *owner.heads, *owner.generic)
    return [_level_entry(info, owner, Thing(info.name, board=b), nouns) for b in info.boards]


def _level_entry(info: ObjectInfo, owner: Entry, thing: Thing, nouns: tuple[str, ...]) -> Entry:
    words = words_of(thing.part or thing.board or "")
    # A board is called by its number as by a noun.
    numbers = tuple(word for word in words if word.isdigit() and thing.part)
    own = tuple(word for word in words if word not in numbers)
    return Entry(
        thing=thing,
        own=own,
        heads=own[-1:],
        generic=nouns,
        context=(*owner.own, *owner.generic),
        numbers=numbers,
        exact=(thing.address.casefold(),),
        color=info.color,
        info=info,
        owner=owner.own,
    )


def _may_be(noun: str, info: ObjectInfo) -> bool:
    """Whether what is of a kind looks as its noun says: a cube is about as long as high."""
    return not matches_any(noun, ("cube",)) or max(info.size) <= CUBIC * min(info.size)

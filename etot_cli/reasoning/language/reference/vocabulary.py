"""The words by which a scene's objects, parts and surfaces can be called."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import lru_cache
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.language.grammar.text import normalized
from etot_cli.reasoning.language.words.known import GRAMMAR_WORDS
from etot_cli.reasoning.language.words.lexicon import (
    BOARD_NOUNS,
    COMMON_NOUNS,
    CONTAINER_NOUNS,
    DESK_NOUNS,
    HELPING_NOUNS,
    JOINT_NOUNS,
    KIND_GROUPS,
    KIND_NOUNS,
    MATERIALS,
    NUMBERS,
    PURPOSES,
    RUBBISH,
    STATES,
    THING_NOUNS,
    TWINS,
    basic_color,
    is_descriptive,
    is_plural_of,
    matches_any,
    singular,
)
from etot_cli.world.state import DESK, ObjectInfo, SceneState

EXACT, HEAD, GENERIC, CONTENT = range(4)
"""How well a phrase's noun fits, best first: it is the very name; the name's own noun; a noun for
its kind; what it is a pack or box of. A word before the noun (the "paper" of a paper clip) tells
what is called so from others, but names nothing where the noun is for it."""


_SHAPES = frozenset({"block", "cube", "ball", "sphere", "cylinder", "square", "triangle", "star"})
_VESSELS = frozenset(
    noun
    for kind, groups in KIND_GROUPS.items()
    for group in groups
    for noun in group
    if kind not in ("sphere", "capsule", "pen") and not {*group} & {*_SHAPES}
)
"""Nouns for what things are kept in or on, be it solid in this scene."""


_SHORTEST = 3
"""Letters of the shortest word that a longer one is put together of ("cup board")."""


@dataclass(frozen=True, slots=True)
class Entry:
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
            return HEAD
        if matches_any(noun, self.generic):
            return GENERIC
        if matches_any(noun, self.content):
            return CONTENT
        return None

    def only_tells(self, word: str) -> bool:
        """Whether a word stands in its name before the noun and does not name it."""
        return self.has_word(word) and not matches_any(word, (*self.heads, *self.content))

    def is_short_for(self, word: str) -> bool:
        """Whether the word before its noun is a usual short name for it ("the remote"): it is no
        vessel, holder or tool for that, and the word no adjective.
        """
        if self.info is None or self.info.container or self.info.parts or self.info.boards:
            return False
        heads = {*map(singular, self.heads)}
        holds = heads & (HELPING_NOUNS | _VESSELS)
        # A key of a car is no car; a cube of sponge is a sponge.
        other = heads & (COMMON_NOUNS - _SHAPES) and singular(word) in COMMON_NOUNS
        return not holds and not other

    def has_word(self, word: str) -> bool:
        """Whether a word is one of its own, apart from number."""
        return matches_any(word, self.own)

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
        singulars = (*self.heads, *self.generic, *self.own)
        # The name "pills_1" of a pill bottle is the plural of its label's word.
        by_name = any(singular(noun) in words for words in self.called[:1])
        return (by_name or noun not in singulars) and is_plural_of(noun, singulars)


class Vocabulary:
    """All entries of a scene, in scene order."""

    def __init__(self, scene: SceneState) -> None:
        self.objects: list[Entry] = []
        self.parts: list[Entry] = []
        self.boards: list[Entry] = []
        for info in scene.infos.values():
            entry = _object_entry(info)
            self.objects.append(entry)
            self.parts += _part_entries(info, entry)
            self.boards += _board_entries(info, entry)
        self.desk = Entry(Thing(DESK), (), (), generic=DESK_NOUNS, exact=(DESK,))

    def entries(self) -> dict[Thing, Entry]:
        """All entries, by what they stand for."""
        return {
            entry.thing: entry for entry in (*self.objects, *self.parts, *self.boards, self.desk)
        }

    def short_names(self, noun: str, *, place: bool) -> list[Entry]:
        """Entries of one label that a noun is short for, with it as a noun of theirs.

        Args:
            noun: what nothing else is called by.
            place: something is to go there, so that rubbish is what is for it.
        """
        word = singular(noun)
        told = [entry for entry in self.objects if entry.only_tells(noun)]
        if is_descriptive(word) or word in PURPOSES | MATERIALS or word in STATES:
            return []
        if is_general_noun(word) or len({entry.called[:1] for entry in told}) > 1:
            return []
        for_it = place and word in RUBBISH
        fitting = all(
            entry.info is not None and entry.info.container if for_it else entry.is_short_for(word)
            for entry in told
        )
        return [replace(e, content=(*e.content, word)) for e in told] if fitting else []

    def words(self) -> frozenset[str]:
        """Every word of the scene's names and labels."""
        entries = (*self.objects, *self.parts, *self.boards)
        return frozenset(word for entry in entries for word in (*entry.own, *entry.exact))

    def joined(self, text: str) -> str:
        """Normalized text in which names and labels that no noun phrase could be ("mug a", "carton
        of milk", "yellow and white mug") stand as one word each, in either number.
        """
        for before in {word for entry in self.objects for word in entry.numbered()}:
            # "Box two" where boxes have numbers; "the box one by one" is none of them.
            number = rf"\b({re.escape(before)}) ({'|'.join(NUMBERS)})\b"
            no_count = r"(?! (?:by|at|after|of|per|(?:in )?each)\b)"
            text = re.sub(number + no_count, lambda said: f"{said[1]} {NUMBERS[said[2]]}", text)
        for head in {head for entry in self.objects for head in entry.heads if "_" not in head}:
            # "Cup board" for what is called a cupboard
            for cut in range(_SHORTEST, len(head) - _SHORTEST + 1):
                if f"{head[:cut]} {head[cut:]}" in text:
                    text = re.sub(rf"\b({head[:cut]}) ({head[cut:]}(?:e?s)?)\b", r"\1_\2", text)
        odd = {words for entry in self.objects for words in entry.called if _is_odd(words)}
        for words in sorted(odd, key=lambda words: (-len(words), words)):
            cut = _cut_of(words) or len(words)
            plural = "(?:es|s)?" if cut < len(words) else ""
            spelled = [re.escape(word) + plural * (i == cut - 1) for i, word in enumerate(words)]
            pattern = r"(?<!\w)" + r"[ ,]*\s".join(spelled) + r"(?!\w)"
            text = re.sub(pattern, lambda found: re.sub(r"[ ,]+", "_", found[0]), text)
        return _lettered(text, [words for words in odd if re.fullmatch(r"\D", words[-1])])

    def is_known(self, word: str) -> bool:
        """Whether some object of the scene is called so, at least in part."""
        return any(entry.has_word(word) for entry in (*self.objects, *self.parts, *self.boards))

    def nearest(self, word: str) -> list[str]:
        """Names of the things whose words are most like a word, at most three; often none."""
        close = get_close_matches(word, sorted(self.words()), n=3, cutoff=0.6)
        return list(
            dict.fromkeys(
                entry.exact[0]
                for item in close
                for entry in (*self.objects, *self.parts)
                if item in entry.exact or entry.has_word(item)
            )
        )[:3]

    def names(self) -> str:
        """What an error message lists."""
        return ", ".join(
            entry.info.label if entry.info is not None else DESK for entry in self.objects
        )


def _lettered(text: str, names: Sequence[tuple[str, ...]]) -> str:
    """Text with the nouns that letters leave out ("vials A and C", "vial A in the top drawer and B
    in the lower"); a letter that names two things, or might be a word, is left alone.
    """
    for words in names:
        text = re.sub(rf"\b{' '.join(words[:-1])}e?s {words[-1]}\b", "_".join(words), text)
    for letter in {words[-1] for words in names}:
        spoken = [
            words
            for words in names
            if words[-1] == letter
            and re.search(rf"\b(?:{'_'.join(words[:-1])}_|{' '.join(words[:-1])}e?s\b)", text)
        ]
        if len(spoken) == 1:
            end = r"(?=,|[.;]|$| (?:and|or|in|into|on|onto|to)\b)" if letter in "adist" else ""
            text = re.sub(rf"(?<![\w'-]){letter}(?![\w'-]){end}", "_".join(spoken[0]), text)
    return text


def is_general_noun(word: str) -> bool:
    """Whether a word is one of the lexicon's nouns, whatever the scene."""
    groups: Sequence[Sequence[str]] = (
        *KIND_NOUNS.values(), *JOINT_NOUNS.values(), CONTAINER_NOUNS, THING_NOUNS, DESK_NOUNS,
    )  # fmt: skip
    return any(matches_any(word, group) for group in groups)


def is_of_parts(entry: Entry, noun: str, vocabulary: Vocabulary) -> bool:
    """Whether an entry is a piece of furniture of which several parts or boards are called so."""
    if entry.thing.part is not None or entry.thing.board is not None:
        return False
    own = [
        item
        for item in (*vocabulary.parts, *vocabulary.boards)
        if item.thing.name == entry.thing.name and item.grade(noun) is not None
    ]
    return len(own) > 1


def _kind_nouns(kind: str, heads: Iterable[str]) -> tuple[str, ...]:
    """Nouns for a kind that fit something called by these nouns: a can is no bottle."""
    groups = KIND_GROUPS.get(kind, ())
    own = {singular(head) for head in heads}
    fitting = [group for group in groups if own & set(group)]
    if not fitting and not own & COMMON_NOUNS:
        fitting = list(groups[-1:] if kind == "pen" else groups)
    if kind in own:
        fitting = list(groups)
    return tuple(noun for group in fitting for noun in group)


_LINKS = ("of", "with", "for", "in", "and", "on", "the", "a")
"""Words inside a label after which no noun of its own stands ("carton of milk" is a carton)."""


def _is_odd(words: Sequence[str]) -> bool:
    """Whether one of several words of a name is no noun or adjective."""
    odd = (word in GRAMMAR_WORDS or re.fullmatch(r"\D", word) for word in words)
    return len(words) > 1 and any(odd)


def _cut_of(words: Sequence[str]) -> int | None:
    """Where what a thing is of, with or for begins."""
    return next((i for i, word in enumerate(words) if i and word in ("of", "with", "for")), None)


def _head_of(words: Sequence[str]) -> str | None:
    """The noun of a label's words."""
    nouns = words[: _cut_of(words)]
    return nouns[-1] if nouns else None


@lru_cache(maxsize=1024)  # every sentence about a scene needs the words of all its names
def _words_of(text: str) -> tuple[str, ...]:
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z])|_|(?<=[A-Za-z])(?=\d)", " ", text)
    return tuple(re.findall(r"\w+", normalized(spaced)))


def _twins_of(words: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Other names of what is called so, one that is written as one word among them."""
    nouns = tuple(word for word in words if not word.isdigit())
    groups = [tuple(tuple(name.split()) for name in group) for group in TWINS]
    own = [name for group in groups if any(nouns[-len(t) :] == t for t in group) for name in group]
    written = [("".join(nouns),)] if len(nouns) == 2 else []
    return [name for name in (*own, *written) if name != nouns[-len(name) :]]


def _object_entry(info: ObjectInfo) -> Entry:
    called = [_words_of(info.label), _words_of(info.name)]
    own: dict[str, None] = {}
    heads: dict[str, None] = {}
    numbers: dict[str, None] = {}
    for words in called:
        nouns = [word for word in words if not word.isdigit() and len(word) > 1]
        own.update(dict.fromkeys(word for word in nouns if word not in _LINKS))
        head = _head_of(nouns)
        # The name "tea_2" of a tea mug is no noun for it.
        short = heads and len(nouns) == 1 and head in called[0][:-1] and head not in heads
        heads.update({} if head is None or short else {head: None})
        numbers.update(dict.fromkeys(word for word in words if word.isdigit()))
    whole = dict.fromkeys("_".join(words) for words in called if _is_odd(words))
    twins = [twin for words in called for twin in _twins_of(words)]
    generic = (*_kind_nouns(info.kind, heads), *dict.fromkeys(words[-1] for words in twins))
    if info.container or any(part.container for part in info.parts):
        generic = (*generic, *(CONTAINER_NOUNS if info.container else CONTAINER_NOUNS[:-1]))
    return Entry(
        thing=Thing(info.name),
        own=(*own, *whole),
        heads=(*heads, *whole),
        generic=generic,
        context=tuple(word for words in twins for word in words[:-1]),
        numbers=tuple(numbers),
        exact=(info.name.casefold(),),
        color=info.color,
        info=info,
        called=tuple(dict.fromkeys(words for words in called if words)),
        content=tuple(words[-1] for words in called if "of" in words[1:]),
    )


def _part_entries(info: ObjectInfo, owner: Entry) -> list[Entry]:
    entries = []
    for part in info.parts:
        words = [word for word in _words_of(part.name) if not word.isdigit()]
        entries.append(
            Entry(
                thing=Thing(info.name, part.name),
                own=tuple(words),
                heads=tuple(words[-1:]),
                generic=JOINT_NOUNS.get(part.joint_type, ()),
                context=(*owner.own, *owner.generic),
                numbers=tuple(word for word in _words_of(part.name) if word.isdigit()),
                exact=(f"{info.name}.{part.name}".casefold(),),
                color=info.color,
                info=info,
                owner=owner.own,
            )
        )
    return entries


def _board_entries(info: ObjectInfo, owner: Entry) -> list[Entry]:
    return [
        Entry(
            thing=Thing(info.name, board=board),
            own=tuple(_words_of(board)),
            heads=tuple(_words_of(board)[-1:]),
            generic=(*BOARD_NOUNS, *owner.heads, *owner.generic),
            context=(*owner.own, *owner.generic),
            exact=(f"{info.name}.{board}".casefold(),),
            color=info.color,
            info=info,
            owner=owner.own,
        )
        for board in info.boards
    ]

"""The words by which a scene's objects, parts and surfaces can be called."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from difflib import get_close_matches
from functools import partial

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.language.grammar.syntax.phrases import NounPhrase
from etot_cli.reasoning.language.grammar.text.spelling import may_be_meant
from etot_cli.reasoning.language.reference.naming.entries import (
    EXACT,
    HEAD,
    PIECES,
    PORTIONS,
    Entry,
    board_entries,
    object_entry,
    part_entries,
)
from etot_cli.reasoning.language.reference.naming.labels import cut_of, is_odd
from etot_cli.reasoning.language.words.alike import TWINS
from etot_cli.reasoning.language.words.categories import (
    CALLED,
    NO_PARTS,
    PART_NOUNS,
    ROUND,
    members_of,
)
from etot_cli.reasoning.language.words.known import GRAMMAR_WORDS, OTHER_VERBS
from etot_cli.reasoning.language.words.lexicon import (
    BINS,
    DESK_NOUNS,
    KIND_NOUNS,
    MATERIALS,
    NUMBERS,
    OPEN_VESSELS,
    PURPOSES,
    RUBBISH,
    SPELLINGS,
    STATES,
    basic_color,
    is_descriptive,
    is_general_noun,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK, SceneState

_SHORTEST = 3
"""Letters of the shortest word that a longer one is put together of ("cup board")."""


_BEHIND_NAMES = (
    r"(?=[,.;:!?]|$| (?:and|or|on|onto|in|into|to|from|off|next|beside|behind|near|between|with|at|"
    r"is|goes|should|then|first|last|left|right)\b)"
)
"""What stands behind a name rather than behind an article."""


class Vocabulary:
    """All entries of a scene, in scene order."""

    def __init__(self, scene: SceneState) -> None:
        self.objects: list[Entry] = []
        self.parts: list[Entry] = []
        self.boards: list[Entry] = []
        for info in scene.infos.values():
            entry = object_entry(info)
            self.objects.append(entry)
            self.parts += part_entries(info, entry)
            self.boards += board_entries(info, entry)
        self.desk = Entry(Thing(DESK), (), (), generic=DESK_NOUNS, exact=(DESK,))

    def entries(self) -> dict[Thing, Entry]:
        """All entries, by what they stand for."""
        return {
            entry.thing: entry for entry in (*self.objects, *self.parts, *self.boards, self.desk)
        }

    def as_labelled(self, phrase: NounPhrase) -> NounPhrase:
        """A phrase with its words as in a label: "the teacher's desk" where no teacher is in the
        scene, "the tube of paint", "the jar with jam", "the bin for paper".
        """
        words, rest = phrase.words, phrase
        before: tuple[str, ...] = ()
        of, more = next(iter(phrase.modifiers), None), phrase.modifiers[1:]
        if phrase.owner is not None:
            before, rest = phrase.owner.words, replace(phrase, owner=None)
        elif "for" in words[1:-1]:
            at = words.index("for")
            words, before = words[:at], words[at + 1 :]
        elif of is not None and of.prep in (Prep.OF, Prep.WITH) and len(of.phrases) == 1:
            (inner,) = of.phrases
            if not (inner.determiner or inner.pronoun or inner.owner or inner.modifiers):
                before, rest = inner.words, replace(phrase, modifiers=more)
        # "The levels of shelf B" are told by what has them.
        whose = phrase.owner is not None
        everything = (
            *self.objects,
            *(self.parts if whose else ()),
            *(self.boards if whose else ()),
        )
        told = [
            entry
            for entry in everything
            if words
            and before
            and entry.grade(words[-1]) is not None
            and all(matches_any(word, (*entry.own, *entry.owner)) for word in before)
        ]
        # What belongs to or holds a thing that is there is told by that.
        others = everything if whose else [entry for entry in everything if entry not in told]
        landmark = whose or (of is not None and of.prep is Prep.WITH)
        there = landmark and any(
            entry.grade(before[-1]) in (EXACT, HEAD) for entry in others if before
        )
        return replace(rest, words=(*before, *words)) if told and not there else phrase

    def short_names(self, noun: str, *, place: bool, before: str = "") -> list[Entry]:
        """Entries of one label that a noun is short for, with it as a noun of theirs.

        Args:
            noun: what nothing else is called by.
            place: something is to go there, so that rubbish is what is for it.
            before: the word before it, where an article says that a thing is meant and not some of
                what is in a pack.
        """
        word = singular(noun)
        told = [entry for entry in self.objects if entry.only_tells(noun)]
        if word in MATERIALS:  # a tumbler of glass is a glass
            told = [
                entry
                for entry in told
                if (entry.info and word in KIND_NOUNS.get(entry.info.kind, ()))
                or (word == "glass" and entry.is_glass())
            ]
            return [replace(entry, content=(*entry.content, word)) for entry in told]
        kind = "" if is_descriptive(before) else before  # green soda is soda, soy sauce no sauce
        packed = [e for e in told if e.is_pack_of(kind, word) or (not kind and e.is_box_of(noun))]
        packed += [e for e in told if e.is_serving_of(word) and not place]
        said = is_descriptive(word) or word in STATES
        if said or (word in PURPOSES and not packed):
            return []
        for_it = place and word in RUBBISH
        if for_it and not told:  # what is thrown away goes into the bin, whatever kind it is
            told = [e for e in self.objects if {*map(singular, e.heads)} & BINS]
            told = [e for e in told if e.info is not None and e.info.container]
        if not for_it:  # a yarn basket is no yarn, but who wants the water takes the water glass
            told = [
                entry
                for entry in told
                if entry.info is None
                or not entry.info.container
                or (not place and entry.is_serving_of(word))
            ]
        twin = word not in RUBBISH and any(word in group for group in TWINS)
        lumps = PORTIONS | PIECES
        if twin and not packed and not all({*map(singular, e.heads)} & lumps for e in told):
            return []  # a remote of the TV is no TV
        sorts = len({entry.called[:1] for entry in told}) > 1
        if is_general_noun(word) or (
            sorts and not packed and not all(entry.is_sort_of(word) for entry in told)
        ):
            return []
        told = packed or told
        fitting = bool(packed) or all(
            entry.info is not None and entry.info.container if for_it else entry.is_short_for(word)
            for entry in told
        )
        return [replace(e, content=(*e.content, word)) for e in told] if fitting else []

    def of_category(self, noun: str) -> list[Entry]:
        """Entries that count among what a noun like "fruit", "tools" or "parts" means, with it as a
        noun of theirs.
        """
        members = members_of(noun)
        found = [entry for entry in self.objects if members and entry.counts_among(members)]
        if singular(noun) == ROUND and not self.is_known("round"):
            found = [e for e in self.objects if e.info and e.info.kind == "sphere"]
        if singular(noun) in PART_NOUNS:
            solid = (e for e in self.objects if e.info and e.info.movable and not e.info.container)
            found = [entry for entry in solid if not entry.counts_among(NO_PARTS)]
        return [
            replace(entry, generic=(), content=(*entry.content, singular(noun))) for entry in found
        ]

    def open_vessels(self, adjectives: Sequence[str], noun: str) -> list[Entry]:
        """Entries of vessels that a colour tells where none is called by the noun that is another
        name for their like ("the green bin" of a green crate), with it as a noun of theirs.
        """
        vessels = [e for e in self.objects if e.info and e.info.container and e.info.movable]
        called = any(entry.grade(noun) in (EXACT, HEAD) for entry in vessels)
        colored = any(basic_color(word) for word in adjectives)
        if called or not colored or singular(noun) not in OPEN_VESSELS:
            return []
        alike = [e for e in vessels if OPEN_VESSELS & {*map(singular, e.heads)}]
        return [replace(entry, generic=(*entry.generic, singular(noun))) for entry in alike]

    def called_after(
        self, things: Sequence[Thing], owners: Collection[Thing], said: Sequence[str]
    ) -> str | None:
        """The name of the one thing that is called after its owners, or else of the only thing,
        where no word tells whose it is.
        """
        entries = self.entries()
        own = {singular(word) for thing in owners for word in entries[thing].own}
        named: dict[str, bool] = {}
        for thing in things:
            entry = entries[thing]
            heads = {*map(singular, (*entry.heads, *said)), *MATERIALS}
            words = {*map(singular, entry.own)} - heads
            told = {word for word in words if not is_descriptive(word)}
            if entry.info is not None and not (thing.part or thing.board) and told <= own:
                named[thing.name] = bool(told)
        after = [name for name, told in named.items() if told]
        found = after or ([*named] if len(things) == 1 else [])
        return found[0] if len(found) == 1 else None

    def words(self) -> frozenset[str]:
        """Every word of the scene's names and labels; of what else its things are called those that
        would be verbs or adverbs ("the cutting board" for a chopping board, "the telly").
        """
        entries = (*self.objects, *self.parts, *self.boards)
        twins = {word for entry in self.objects for words in entry.twins for word in words}
        own = (word for entry in entries for word in (*entry.own, *entry.exact))
        odd = (word for word in twins if word in OTHER_VERBS or word.endswith(("ing", "ly")))
        return frozenset((*own, *odd))

    def joined(self, text: str) -> str:
        """Normalized text in which names and labels that no noun phrase could be ("mug a", "carton
        of milk", "yellow and white mug") stand as one word each, in either number.
        """
        text = self._spelled(text)
        for before in dict.fromkeys(w for entry in self.objects for w in entry.numbered()):
            # "Box two" where boxes have numbers; "the box one by one" is none of them, nor is "the
            # orange one".
            counted = [word for word in NUMBERS if word != "one" or not is_descriptive(before)]
            number = rf"\b({re.escape(before)}) ({'|'.join(counted)})\b"
            no_count = r"(?! (?:by|at|after|of|per|(?:in )?each)\b)"
            text = re.sub(number + no_count, lambda said: f"{said[1]} {NUMBERS[said[2]]}", text)
        for head in dict.fromkeys(h for entry in self.objects for h in entry.heads if "_" not in h):
            # "Cup board" for what is called a cupboard
            for cut in range(_SHORTEST, len(head) - _SHORTEST + 1):
                if f"{head[:cut]} {head[cut:]}" in text:
                    text = re.sub(rf"\b({head[:cut]}) ({head[cut:]}(?:e?s)?)\b", r"\1_\2", text)
        for category, said in CALLED.items():
            if self.of_category(category):
                text = re.sub(rf"\b{said}(?=s?\b)", category, text)
        alone = [words[0] for e in self.objects if len(e.called) == 1 for words in e.called]
        letters = {word[0] for word in alone if len(word) == 2 and word.endswith("_")}
        for letter in sorted(letters):
            # "Put a on b" where boxes are called A and B; "a cup" is no such thing.
            told = _BEHIND_NAMES if letter in "ai" else ""
            text = re.sub(rf"(?<![\w'~]){letter}(?![\w']){told}", f"{letter}_", text)
        for portion in sorted(PORTIONS | PIECES):
            # "Both rolls of tape" where they are but called tape
            if re.search(rf"\b{portion}s? of\b", text) and not self.is_known(portion):
                text = re.sub(rf"\b{portion}(s?) of ([a-z]+)\b", self._portioned, text)
        called = {words for entry in self.objects for words in entry.called if is_odd(words)}
        odd = sorted(called, key=lambda words: (-len(words), words))
        for words in odd:
            cut = cut_of(words) or len(words)
            plural = "(?:es|s)?" if cut < len(words) else ""
            spelled = [re.escape(word) + plural * (i == cut - 1) for i, word in enumerate(words)]
            pattern = r"(?<!\w)" + r"[ ,]*\s".join(spelled) + r"(?!\w)"
            text = re.sub(pattern, lambda found: re.sub(r"[ ,]+", "_", found[0]), text)
        return _lettered(text, [words for words in odd if re.fullmatch(r"\D", words[-1])])

    def _spelled(self, text: str) -> str:
        """Text with the words that the scene has in another spelling ("tire" of a tyre)."""
        for group in SPELLINGS:
            for said in group:
                ending = r"(?=(?:e?s)?(?![a-z]))"
                if said in text and re.search(rf"(?<![a-z]){said}{ending}", text):
                    own = next((word for word in group if self.is_known(word)), said)
                    if not self.is_known(said):
                        text = re.sub(rf"(?<![a-z]){said}{ending}", own, text)
        return text

    def _portioned(self, said: re.Match[str]) -> str:
        """The noun of "roll of tape", in the number of the roll."""
        several, noun = said.groups()
        plural = f"{noun}s" if several and singular(noun) == noun else noun
        return plural if self.is_known(singular(noun)) else said[0]

    def is_known(self, word: str) -> bool:
        """Whether some object of the scene is called so, at least in part."""
        return any(entry.has_word(word) for entry in (*self.objects, *self.parts, *self.boards))

    def nearest(self, word: str) -> list[str]:
        """Names of the things whose words are most like a word, at most three; often none."""
        close = get_close_matches(word, sorted(self.words()), n=3, cutoff=0.6)
        near = (e for item in close if may_be_meant(item, word)
                for e in (*self.objects, *self.parts) if item in e.exact or e.has_word(item)
                )  # fmt: skip
        return list(dict.fromkeys(entry.exact[0] for entry in near))[:3]

    def names(self) -> str:
        """What an error message lists."""
        return ", ".join(entry.info.label if entry.info else DESK for entry in self.objects)


def _lettered(text: str, names: Sequence[tuple[str, ...]]) -> str:
    """Text with the nouns that letters leave out ("vials A and C", "vial A in the top drawer and B
    in the lower"); a letter that names two things, or might be a word, is left alone.
    """
    for words in names:
        text = re.sub(rf"\b{' '.join(words[:-1])}e?s {words[-1]}\b", "_".join(words), text)
    for letter in dict.fromkeys(words[-1] for words in names):
        called = [words for words in names if words[-1] == letter]
        spoken = [
            words
            for words in called
            if re.search(rf"\b(?:{'_'.join(words[:-1])}_|{' '.join(words[:-1])}e?s\b)", text)
        ] or called
        if len(spoken) == 1:
            end = (
                r"(?=,|[.;]|$| (?:and|or|in|into|on|onto|to|at|with|then|behind|beside|from|off)\b"
                r"| (?:first|last)(?:[,.;]|$))"
                if letter in "adist"
                else ""
            )
            alone = rf"(?<![\w'-]){letter}(?![\w'-]){end}"
            text = re.sub(alone, partial(_spelled_out, "_".join(spoken[0])), text)
    return text


def _spelled_out(name: str, letter: re.Match[str]) -> str:
    """The name that a letter stands for; "tote A" is no shelf A."""
    before = letter.string[: letter.start()].split()[-1:]
    return letter[0] if before and before[0].isalpha() and before[0] not in GRAMMAR_WORDS else name


def is_of_parts(entry: Entry, noun: str, vocabulary: Vocabulary) -> bool:
    """Whether an entry is a piece of furniture of which several parts or boards are called so."""
    own = [item.grade(noun) for item in (*vocabulary.parts, *vocabulary.boards)
           if item.thing.name == entry.thing.name]  # fmt: skip
    whole = entry.thing.part is None and entry.thing.board is None
    return whole and len(own) > 1 + own.count(None)

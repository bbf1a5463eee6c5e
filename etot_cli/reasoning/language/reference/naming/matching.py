"""Which things a noun with its adjectives may mean, before it is said where they are."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.reference.naming.entries import (
    CONTENT,
    EXACT,
    GENERIC,
    HEAD,
    SHAPES,
    Entry,
)
from etot_cli.reasoning.language.reference.naming.sifting import (
    Sifted,
    graded_by,
    is_selecting,
    is_stacked,
    names_of,
    not_understood,
    nothing_fits,
    sift,
)
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary, is_of_parts
from etot_cli.reasoning.language.words.categories import CATEGORIES, FRUITING, MASS_NOUNS, ROUND
from etot_cli.reasoning.language.words.lexicon import (
    COMPOUNDS,
    CONTAINER_NOUNS,
    DESK_NOUNS,
    JOINT_NOUNS,
    KIND_NOUNS,
    LEVELS,
    MATERIALS,
    ORDINALS,
    OTHER_SORTS,
    PACKS,
    PAIRED,
    RUBBISH,
    STATES,
    THING_NOUNS,
    basic_color,
    matches_any,
    singular,
)


class Match(Struct, frozen=True):
    """Things that a noun and its adjectives fit.

    Args:
        entries: in scene order.
        selectors: words that single out instances by place, size, order or state.
        plural: the noun stands in the plural.
        notes: words that were taken for something near them, as sentences.
    """

    entries: tuple[Entry, ...]
    selectors: tuple[str, ...] = ()
    plural: bool = False
    notes: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()
    """Words of these notes that do not tell one thing from another."""
    loose: bool = False
    """The noun only says what is in them ("the tissues" of a box of tissues)."""
    named: tuple[tuple[str, tuple[Entry, ...]], ...] = ()
    """Words for size, side, order or state that are part of their names, with all that these told
    them from."""
    whole: bool = False
    """The words are a whole name or label."""


def match_words(
    words: Sequence[str],
    vocabulary: Vocabulary,
    phrase: str,
    noun: str | None = None,
    *,
    by_name: bool = True,
    parts_first: bool = False,
    upon: bool = False,
    counted: bool = False,
    place: bool = False,
) -> Match:
    """Finds what a noun phrase's words fit; every word of them counts.

    Args:
        words: adjectives and the noun; it may be followed by a number.
        vocabulary: the scene's.
        phrase: the whole phrase, for messages.
        noun: what "one" stands for, the noun of an earlier phrase.
        by_name: a name that a word is means that thing alone ("the book"); else it is a noun like
            any other ("the book that is not red").
        parts_first: what follows the noun tells parts of one piece of furniture from each other
            ("the drawer with the pen in it").
        upon: something is to go on it, so that a level is rather a board than a drawer.
        counted: ordinals among the words count from a side that is said, and are no names.
        place: something is to go into it.

    Raises:
        ReferenceProblem: nothing fits, or a word is not understood.
    """
    everything = (*vocabulary.objects, *vocabulary.parts, *vocabulary.boards, vocabulary.desk)
    # Two things with one label are called alike, whatever their names are; so are two of which one
    # has the other's name and a number.
    by_name &= sum(entry.is_called(words[-1:]) for entry in vocabulary.objects) < 2
    by_name &= not any(words[-1] in entry.numbered() for entry in vocabulary.objects)
    for entry in everything:
        if len(words) == 1 and words[0] in entry.exact and (by_name or not words[0].isalpha()):
            if entry.info is None or not entry.only_tells(words[0]):
                return Match((entry,))
            return Match((entry,), notes=(f"read {words[0]!r} as {entry.info.label}",))
    number = words[-1] if words[-1].isdigit() and len(words) > 1 else None
    if number is not None:
        words = words[:-1]
    if counted:
        # "The second drawer from the bottom" is not the one that is named "second".
        chosen = tuple(word for word in words[:-1] if word in ORDINALS)
        rest = [word for word in words if word not in chosen]
        uncounted = match_words(rest, vocabulary, phrase, noun, by_name=False, parts_first=True)
        return replace(uncounted, selectors=(*uncounted.selectors, *chosen))
    adjectives, head = tuple(words[:-1]), words[-1]
    elliptic = matches_any(head, ("one",)) and noun is not None
    if elliptic and noun is not None:
        single = singular(noun)
        plural = noun if noun != single else f"{noun}es" if noun.endswith("s") else f"{noun}s"
        head = plural if head == "ones" else single
    if basic_color(head) and not any(entry.grade(head) in (EXACT, HEAD) for entry in everything):
        found = _by_color(adjectives, head, number, vocabulary, phrase)
        if found is not None:
            return found
    packed = _packed(adjectives, head, vocabulary, phrase)
    if packed is not None:
        return packed
    if _is_plain_bin(words, vocabulary):
        found = match_words((*words[:-2], "bin"), vocabulary, phrase, noun)
        return replace(found, notes=(*found.notes, f"read {' '.join(words[-2:])!r} as bin"))
    pools = _pools(vocabulary, head, adjectives, parts_first, upon)
    grades = {entry.grade(head) for entry in everything} - {None}
    if not grades:
        before = words[-2] if len(words) > 1 and phrase.split()[:1] != words[:1] else ""
        pools.append(
            vocabulary.of_category(head) or vocabulary.short_names(head, place=place, before=before)
        )
    elif grades == {GENERIC} and singular(head) != head:
        pools.insert(0, vocabulary.of_category(head))  # plates are dishes, too, beside a bowl
    if singular(head) == "fruit":
        pools.append(
            [replace(e, content=(*e.content, "fruit")) for e in vocabulary.of_category(FRUITING)]
        )
    pools.append(vocabulary.open_vessels(adjectives, head))
    for pool in pools:
        found = _match_in(pool, adjectives, head, number, vocabulary, phrase, by_name, upon)
        if found is not None and (found.plural or found.dropped) and len(found.entries) == 1:
            # "The drawers" of the only chest, "the shelves" of the only shelf; "the resistor
            # drawer" is one of them, which "the toy shelf" need not be.
            named = found.entries[0].grade(head) in (EXACT, HEAD) and not found.plural
            parts = [*vocabulary.parts, *(() if named else vocabulary.boards)]
            if is_of_parts(found.entries[0], head, vocabulary):
                found = _match_in(parts, adjectives, head, number, vocabulary, phrase) or found
        level = any(word in LEVELS for word in adjectives)
        if found is not None and (level or not _is_of_another(head, found.entries, vocabulary)):
            return found
    raise nothing_fits(head, adjectives, number, vocabulary, phrase)


def _is_plain_bin(words: Sequence[str], vocabulary: Vocabulary) -> bool:
    """Whether a name of what rubbish goes into is that of a mere "bin", as nothing else has it."""
    said = tuple(words[-2:])
    if words[-1] not in ("can", "bin") or not {*said[:-1]} & RUBBISH:
        return False
    called = [e for e in vocabulary.objects if e.has_word(said[0]) or e.is_twin(said)]
    return not called and any(entry.is_called(("bin",)) for entry in vocabulary.objects)


def _packed(
    adjectives: tuple[str, ...], head: str, vocabulary: Vocabulary, phrase: str
) -> Match | None:
    """What is called by the word before a noun for its pack alone ("the rice packet")."""
    single = singular(head)
    if not adjectives or single not in PACKS:
        return None
    several = singular(adjectives[-1]) != adjectives[-1]
    called = [entry for entry in vocabulary.objects if entry.has_word(head)]
    if any(several or entry.has_word(adjectives[-1]) for entry in called):
        return None  # a jar of nails, where there is a jar, is no nail
    inner = [
        entry
        for entry in vocabulary.objects
        if entry.grade(adjectives[-1]) in (EXACT, HEAD)
        and entry.info is not None
        and single in KIND_NOUNS.get(entry.info.kind, (single,))
    ]
    found = _match_in(inner, adjectives[:-1], adjectives[-1], None, vocabulary, phrase)
    if found is None:
        return None
    if any(entry.info is not None and entry.info.container for entry in called):
        names = names_of([*found.entries, *called])
        raise ReferenceProblem(phrase, f"it may mean {names}", 2, word=head)
    notes = (*found.notes, f"read {head!r} as what {names_of(found.entries)} is in")
    return replace(found, plural=single != head, notes=notes)


def _by_color(
    adjectives: tuple[str, ...],
    color: str,
    number: str | None,
    vocabulary: Vocabulary,
    phrase: str,
) -> Match | None:
    """What a colour alone may mean ("the orange"), said as the guess that it is."""
    words = (*adjectives, color)
    basic = basic_color(color)
    colored = [entry for entry in vocabulary.objects if basic and entry.has_color(basic)]
    if singular(color) in CATEGORIES["food"]:
        # A ball or an "orange block" may be "the orange"; no carrot or carton of that colour is.
        colored = [
            entry
            for entry in colored
            if (info := entry.info) is not None
            and (info.kind == "sphere" or entry.has_word(color))
            and not (info.container or entry.counts_among(CATEGORIES["food"]))
        ]
    found = _match_in(colored, words, "object", number, vocabulary, phrase)
    if found is None:
        return None
    names = names_of(found.entries)
    return replace(found, notes=(*found.notes, f"read {color!r} as the colour of {names}"))


def _pools(
    vocabulary: Vocabulary, head: str, adjectives: Sequence[str], parts_first: bool, upon: bool
) -> list[list[Entry]]:
    """Where to look, in this order: parts come first where a level or their own name is said."""
    fitting = [entry for entry in vocabulary.objects if entry.grade(head) is not None]
    units = [entry for entry in fitting if is_stacked(entry)]
    only_units = bool(fitting) and len(units) == len(fitting)
    one_of_many = only_units and len(fitting) == 1
    level = (parts_first and any(map(is_stacked, fitting))) or any(
        word in LEVELS or (one_of_many and word in ORDINALS) or (only_units and word in STATES)
        for word in adjectives
    )
    objects, parts, boards = vocabulary.objects, vocabulary.parts, vocabulary.boards
    if not adjectives and head in DESK_NOUNS and all(e.grade(head) == CONTENT for e in fitting):
        return [[vocabulary.desk], objects]  # whatever a table tennis ball is called
    levels = [entry for entry in (*parts, *boards) if entry.grade(head) is not None]
    if (
        levels
        and fitting
        and all(e.is_sort_named(head) and e.grade(head) == GENERIC for e in fitting)
    ):
        # Beside a shelf "the board" may be one of its boards as well as a chessboard.
        leveled = any(word in LEVELS or word in ORDINALS for word in adjectives)
        return [parts, boards] if leveled else [[*fitting, *levels]]
    if upon or any(entry.info is not None and entry.info.boards for entry in fitting):
        # "The top shelf" is a board of the shelf before it is a drawer of something else.
        parts, boards = boards, parts
    named = [
        part
        for part in parts
        if any(part.has_word(word) for word in adjectives) and part.grade(head) is not None
    ]
    pools = [objects, parts, boards, [vocabulary.desk]]
    if named:
        return [named, *pools]
    of_parts = any(part.grade(head) is not None for part in parts)
    by_kind = len(units) > 1 and all(entry.grade(head) == GENERIC for entry in units)
    if of_parts and by_kind and not upon:
        # Of several pieces of furniture "drawer" is one drawer, unless a piece is called so.
        return [parts, boards, objects, [vocabulary.desk]]
    if level and not any(
        entry.grade(head) is not None and any(entry.has_word(word) for word in adjectives)
        for entry in objects
    ):
        return [parts, boards, objects, [vocabulary.desk]]
    return pools


def _match_in(
    pool: list[Entry],
    adjectives: tuple[str, ...],
    head: str,
    number: str | None,
    vocabulary: Vocabulary,
    phrase: str,
    by_name: bool = True,
    upon: bool = False,
) -> Match | None:
    """What fits among some entries, None when nothing does."""
    sifted = Sifted(graded_by(pool, head), head)
    called = (*adjectives, head, *((number,) if number else ()))
    exactly = [item for item in sifted.graded if item[0].is_called(called)] or [
        item for item in sifted.graded if item[0].is_twin(called)
    ]
    if len(exactly) == 1 and len(called) > 1:
        every = tuple(entry for entry, _ in sifted.graded)
        named = tuple((word, every) for word in adjectives if is_selecting(word))
        (entry, _), said = exactly[0], " ".join(called)
        notes = () if entry.is_called(called) else (f"read {said!r} as {names_of([entry])}",)
        return Match((entry,), named=named, whole=True, notes=notes)
    if number is not None:
        sifted.graded = [item for item in sifted.graded if number in item[0].numbers]
    if not any(word in COMPOUNDS.get(singular(head), ()) for word in adjectives):
        plain = [item for item in sifted.graded if not item[0].is_compound(head)]
        sifted.graded = plain or sifted.graded
    # Where some are called parcels a crate is none, whatever colour is said.
    called_so = [item for item in sifted.graded if item[1] in (EXACT, HEAD)]
    if not any(word in OTHER_SORTS.get(singular(head), ()) for word in adjectives):
        # Beside a dinner plate "the plate" is no license plate.
        called_so = [
            item for item in called_so if not item[0].is_compound(head, OTHER_SORTS)
        ] or called_so
    if not any(entry.is_plainly_called(head) for entry, _ in called_so):
        # Beside an exercise book "the book" may be a textbook.
        others = (item[0] for item in sifted.graded if item not in called_so)
        sorts = [entry for entry in others if entry.is_sort_named(head)]
        called_so += [(entry, HEAD) for entry in sorts if called_so]
    sifted.graded = called_so or sifted.graded
    for word in adjectives:
        sift(sifted, word, vocabulary)
    if not sifted.graded:
        return None
    least = EXACT if by_name else HEAD
    sifted.graded = [(entry, max(grade, least)) for entry, grade in sifted.graded]
    # Reading glasses are no glass where there is one.
    single = [item for item in sifted.graded if item[0].heads[:1] != (f"{head}es",)]
    sifted.graded = single or sifted.graded
    best = min(grade for _, grade in sifted.graded)
    entries = tuple(entry for entry, grade in sifted.graded if grade == best)
    if sifted.unknown:
        raise not_understood(sifted.unknown[0], entries, phrase)
    pairs = tuple(entry for entry in entries if entry.is_pair() and head == entry.heads[0])
    if 0 < len(pairs) < len(entries):
        # Beside one wine glass "the glasses" are the reading glasses.
        if len(entries) - len(pairs) > 1:
            raise ReferenceProblem(phrase, f"it may mean {names_of(entries)}", 2, word=head)
        entries = pairs
        sifted.notes.append(f"read {head!r} as {names_of(pairs)}")
    mass = False
    if matches_any(head, THING_NOUNS):
        plural = head in ("everything", "rest", "others", "stuff") or singular(head) != head
    else:
        # Of several pairs of socks "the socks" are all.
        packs = len(entries) > 1 and singular(head) != head and head not in PAIRED
        plural = packs or any(entry.is_plural(head) for entry in entries)
        # "The fruit", "the yarn" of several balls of it
        shapes = all({*map(singular, entry.heads)} & SHAPES for entry in entries)
        stuff = best == CONTENT or all(head in entry.content for entry in entries)
        mass = stuff and shapes and singular(head) != ROUND and len(entries) > 1
        plural |= mass or (head in MASS_NOUNS and len(entries) > 1)
    jars = [e for e in pool if e.only_tells(head) and e.grade(head) is None]
    if best == GENERIC and jars and singular(head) in MATERIALS:
        return None  # where there is a glass jar "the glass" is no cup
    loose = (
        best == CONTENT
        or mass
        or (
            best == GENERIC and not matches_any(head, (*THING_NOUNS, *CONTAINER_NOUNS, *DESK_NOUNS))
        )
    )
    # "The drawer" of a chest is one of its drawers, unless something is to go on it.
    parts = not upon and all(_has_such_part(entry, head) for entry in entries)
    if loose and not parts and any(is_object(entry) for entry in entries):
        said = head.replace("_", " ")
        sifted.notes.append(f"read {said!r} as {names_of(entries)}")
    return Match(
        entries,
        tuple(sifted.selectors),
        plural,
        tuple(sifted.notes),
        tuple(sifted.dropped),
        loose=best == CONTENT,
        named=tuple(sifted.named),
    )


def _is_of_another(noun: str, entries: Sequence[Entry], vocabulary: Vocabulary) -> bool:
    """Whether a noun would mean boards for their kind, where something else is called so: where
    there is a brown tray "the white tray" is no board of a white shelf.
    """
    called = {e.thing.name for e in vocabulary.objects if e.grade(noun) in (EXACT, HEAD)}
    boards = all(entry.thing.board is not None for entry in entries)
    return bool(called) and boards and not called & {entry.thing.name for entry in entries}


def _has_such_part(entry: Entry, noun: str) -> bool:
    """Whether an entry is a piece of furniture with a drawer, where that is what a noun means."""
    parts = entry.info.parts if entry.info is not None else ()
    return any(singular(noun) in JOINT_NOUNS[part.joint_type] for part in parts)


def is_object(entry: Entry) -> bool:
    """Whether an entry is an object as a whole."""
    return entry.info is not None and entry.thing.part is None and entry.thing.board is None

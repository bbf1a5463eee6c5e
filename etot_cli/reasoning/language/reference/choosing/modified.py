"""Which of the things that a noun fits are left by what is said behind it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress

from msgspec.structs import replace

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem, Role, can_be
from etot_cli.reasoning.language.grammar.syntax.phrases import CLEARED, Modifier, NounPhrase
from etot_cli.reasoning.language.reference.choosing.compared import more_so, on_either_side
from etot_cli.reasoning.language.reference.choosing.landmarks import (
    HOLDING,
    RANKED,
    ROUGHLY,
    Told,
    between_the_others,
    is_one,
    means_the_others,
    related,
)
from etot_cli.reasoning.language.reference.choosing.nouns import with_quality
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.reference.memory.antecedents import (
    AmbiguousReference,
    EmptyAlready,
    UnclearLandmark,
)
from etot_cli.reasoning.language.reference.naming.determiners import Quantity, quantity_of
from etot_cli.reasoning.language.reference.naming.entries import EXACT, HEAD
from etot_cli.reasoning.language.reference.naming.usual_form import how_many_out
from etot_cli.reasoning.language.reference.naming.vocabulary import Vocabulary
from etot_cli.reasoning.language.words.categories import is_category
from etot_cli.reasoning.language.words.lexicon import (
    DESK_NOUNS,
    NUMBERS,
    SIDES,
    SIZES,
    STATES,
    THING_NOUNS,
    basic_color,
    matches_any,
    singular,
)
from etot_cli.reasoning.language.words.nouns import THE_WORDS
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK, SceneState

_SO_MANY = frozenset({*NUMBERS, *map(str, range(100)), "any", "some", "either"})
"""Determiners that leave open which ones are left out."""


def names_of_things(things: Sequence[Thing]) -> str:
    """Names of things, parts and boards, for messages."""
    return ", ".join(dict.fromkeys(thing.address for thing in things))


def modified(
    things: list[Thing],
    modifiers: Sequence[Modifier],
    quantity: Quantity,
    count: int | None,
    phrase: NounPhrase,
    scene: SceneState,
    landmark_sets: Callable[[Modifier], list[list[list[Thing]]]],
    notes: list[str],
) -> tuple[list[Thing], tuple[Thing, ...]]:
    """Things that all modifiers are true of, or that they fit best, and others that the last one is
    true of as well; ``notes`` grows.

    ``landmark_sets`` gives all ways to understand a modifier's landmarks.
    """
    waiting = sorted(modifiers, key=lambda item: item.prep in RANKED)
    unclear = 0
    others: tuple[Thing, ...] = ()
    while waiting:
        modifier = waiting.pop(0)
        if modifier.prep is Prep.MATCHING:
            why = "say which thing's colour is meant"
            raise ReferenceProblem(phrase.text, why, 2)
        if modifier.prep in (Prep.SIDE, Prep.AREA, Prep.QUALITY, Prep.EXCEPT, Prep.CONTRAST):
            continue
        if modifier.prep is Prep.BETWEEN and means_the_others(modifier):
            things = between_the_others(things, phrase, scene)
            continue
        if modifier.prep is Prep.AMONG:
            things = _among(things, landmark_sets(modifier), phrase)
            continue
        if modifier.prep in (Prep.THAN, Prep.FLANKING):
            own = means_the_others(modifier)  # "smaller than the others"
            sets = [] if own else landmark_sets(modifier)
            if modifier.prep is Prep.THAN:
                found = more_so(things, modifier, sets, phrase, scene)
            else:
                marks = [mark for way in sets for several in way for mark in several]
                every = quantity.every and count is None
                found = on_either_side(things, modifier, marks, count, phrase, scene, every=every)
            if not found:
                raise _untrue(phrase, modifier, things)
            things = found
            continue
        if modifier.prep in RANKED | HOLDING and any(thing.name == DESK for thing in things):
            raise ReferenceProblem(phrase.text, "this tells no desk from another", 2)
        if modifier.words == CLEARED:
            _check_cleared(modifier, landmark_sets(modifier), scene)
            if _are_drawers(landmark_sets(modifier), scene):
                modifier = replace(modifier, prep=Prep.IN)
        ways: dict[tuple[Thing, ...], tuple[list[Thing], list[str]]] = {}
        for landmarks in landmark_sets(modifier):
            said: list[str] = []
            # What stands behind it tells which of them ("right of the box, nearest to the cup").
            so_many = None if RANKED & {item.prep for item in waiting} else count
            told = Told(modifier, landmarks, quantity, so_many, scene, phrase.text)
            found, more = related(told, things, said)
            found = _holding_so_many(modifier, found, landmarks, scene)
            rough = any(ROUGHLY in note for note in said)
            if rough and modifier.prep in RANKED and modifier.words[1:]:
                continue  # "with the cup next to it" rather says where that is to be
            if found and (tuple(found) not in ways or not rough):
                ways[tuple(found)] = more, said
        if len(ways) > 1 and unclear < len(waiting):
            # Another modifier may tell.
            waiting.append(modifier)
            unclear += 1
            continue
        if len(ways) > 1:
            named = [thing.name for way in ways for thing in way]
            raise UnclearLandmark(phrase.text, sorted(named))
        found = [thing for way in ways for thing in way]
        atop = _is_atop(things, modifier, scene)
        if atop and modifier.denied:
            raise ReferenceProblem(phrase.text, _ALONE, 2)
        if not found and atop:
            found = things
            ways = {tuple(things): ([], [_atop(things[0], scene)])}
        if not found:
            raise _untrue(phrase, modifier, things)
        if modifier.prep is Prep.FROM and quantity.every:
            _check_in_or_on(phrase, found, landmark_sets(modifier), scene)
        bare = modifier.denied and (
            modifier.prep in (Prep.WITH, Prep.FROM)
            or (modifier.prep in HOLDING and is_one(modifier.phrases[0]))
        )
        alike = len(things) == 1 or all(thing.board for thing in things)
        if bare and found == things and alike:
            raise ReferenceProblem(phrase.text, _ALONE, 2)
        if modifier.prep in (Prep.ON, Prep.FROM) and not (modifier.denied or modifier.direct):
            whole = space.with_what_lies_on_them(found, things, scene)
            # "The two blocks on the tray" are a tower there if only one stands on it.
            found = whole if count is None or len(found) < count == len(whole) else found
        ((more, said),) = ways.values()
        things, others = found, tuple(more)
        notes += said
    return things, others


def _among(things: list[Thing], ways: list[list[list[Thing]]], phrase: NounPhrase) -> list[Thing]:
    """Those of the things that are named one by one.

    Raises:
        UnclearLandmark: of one of them it is open which thing it is.
    """
    named = {thing for way in ways for several in way for thing in several}
    if len(ways) != 1 or any(len(several) != 1 for several in ways[0]) or len(named) < 2:
        raise UnclearLandmark(phrase.text, sorted(thing.name for thing in named))
    return [thing for thing in things if thing in named]


def _holding_so_many(
    modifier: Modifier, things: list[Thing], landmarks: list[list[Thing]], scene: SceneState
) -> list[Thing]:
    """Those of the things that hold as many as is said ("the bowl with two apples in it"); with
    "one" any that holds some, if none holds but one.
    """
    (np, *more) = modifier.phrases or (NounPhrase(),)
    said = quantity_of(np.determiner)
    counted = said.count is not None and np.determiner.split()[0] not in ("a", "an", "any")
    if modifier.prep not in HOLDING or modifier.denied or more or said.definite or not counted:
        return things
    marks = {mark for several in landmarks for mark in several}
    held = {
        thing: sum(
            mark != thing and space.holds_at(modifier.prep, thing, [mark], scene) is True
            for mark in marks
        )
        for thing in things
    }
    exact = [thing for thing in things if held[thing] == said.count]
    return exact if exact or said.count != 1 else things


def _is_atop(things: Sequence[Thing], modifier: Modifier, scene: SceneState) -> bool:
    """Whether the only thing of its name is "on the desk" as what stands on top of a piece of
    furniture is that stands there itself.
    """
    if modifier.prep not in (Prep.ON, Prep.FROM) or len(things) != 1:
        return False
    if not all(np.words and matches_any(np.head, DESK_NOUNS) for np in modifier.phrases):
        return False
    state = scene.states.get(things[0].name)
    below = set() if state is None or state.inside or things[0].part else {*state.on}
    fixed = {name for name, info in scene.infos.items() if not info.movable}
    return bool(below) and below <= fixed


def _atop(thing: Thing, scene: SceneState) -> str:
    below = " and ".join(scene.states[thing.name].on)
    return f"on the {DESK}: {thing.name}, which stands on {below} there"


_ALONE = "there is no other one that this would tell it from"


def _untrue(phrase: NounPhrase, modifier: Modifier, things: Sequence[Thing]) -> ReferenceProblem:
    """The words that are true of nothing, and why; a place may stand apart from what is there."""
    landmark = next((np.text for np in modifier.phrases), phrase.text)
    if modifier.words == CLEARED:
        return EmptyAlready(landmark, "there is nothing in or on it", 1)
    if modifier.prep is Prep.FROM and landmark not in phrase.text:
        return ReferenceProblem(landmark, f"{phrase.text!r} is not there", 1)
    why = f"this is true of none of what it could mean ({names_of_things(things)})"
    return ReferenceProblem(phrase.text, why, 1)


def _check_cleared(
    modifier: Modifier, landmarks: Sequence[Sequence[Sequence[Thing]]], scene: SceneState
) -> None:
    """Whether "tidy up the blocks" is said of what holds things, not of things to be put away."""
    for thing in (thing for way in landmarks for several in way for thing in several):
        holds = can_be(thing, Role.CONTAINER, scene) or space.is_support(thing, scene)
        bears = thing.name in scene.infos and any(
            space.rests_on(Thing(name), thing, scene) for name in scene.states
        )
        if not (holds or bears):
            raise ReferenceProblem(modifier.phrases[0].text, "say where it is to go", 3)


def _are_drawers(landmarks: Sequence[Sequence[Sequence[Thing]]], scene: SceneState) -> bool:
    return all(
        space.is_drawer(thing, scene) for way in landmarks for several in way for thing in several
    )


def _check_in_or_on(
    phrase: NounPhrase,
    things: Sequence[Thing],
    landmarks: Sequence[Sequence[Sequence[Thing]]],
    scene: SceneState,
) -> None:
    """Whether "everything from the drawer" is in it, or all of it stands on that."""
    around = [mark for way in landmarks for several in way for mark in several]
    inside = [t for t in things if any(space.lies_in(t, mark, scene) for mark in around)]
    if _are_drawers(landmarks, scene) and 0 < len(inside) < len(things):
        raise ReferenceProblem(phrase.text, "say whether what is in it or on it is meant", 3)


def _is_one(phrase: NounPhrase) -> bool:
    """Whether a phrase means one thing by its looks alone, and of several none rather."""
    compares = any(word in table for word in phrase.words for table in (SIZES, SIDES))
    single = bool(phrase.words) and singular(phrase.head) == phrase.head
    plain = single and not (compares or phrase.modifiers or is_category(phrase.head))
    return plain and phrase.determiner in THE_WORDS


def _named_out(
    item: NounPhrase,
    noun: str,
    things: Sequence[Thing],
    landmarks: Callable[..., list[Thing]],
) -> set[Thing]:
    """What is not meant; "the round one" of several things is rather one of these."""
    if item.is_elliptic and len(things) > 1:
        with suppress(ReferenceProblem):
            return set(landmarks(item, noun, among=things))
    return set(landmarks(item, noun))


def all_but(phrase: NounPhrase, things: Sequence[Thing]) -> tuple[NounPhrase, int | None]:
    """A phrase without "but one", where that says of how many all but so many are meant, and how
    many these are; None where it says no such thing.
    """
    for modifier in phrase.modifiers:
        out = how_many_out(modifier)
        (item, *_) = modifier.phrases or (NounPhrase(),)
        of_them = (m.prep is Prep.OF and m.phrases[0].pronoun for m in item.modifiers)
        if out and item.words in ((), ("one",), phrase.words) and all(of_them):
            rest = tuple(m for m in phrase.modifiers if m is not modifier)
            if out >= len(things):
                raise ReferenceProblem(phrase.text, "nothing is left without those", 1)
            return replace(phrase, modifiers=rest), len(things) - out
    return phrase, None


def left_out(
    things: list[Thing],
    phrase: NounPhrase,
    words: tuple[str, ...],
    vocabulary: Vocabulary,
    scene: SceneState,
    landmarks: Callable[..., list[Thing]],
    notes: list[str],
    role: Role,
) -> tuple[list[Thing], set[Thing]]:
    """The things but for those that a phrase takes out, and these; ``landmarks`` gives them;
    ``notes`` grows.
    """
    out: set[Thing] = set()
    for word in phrase.without:
        meant = with_quality(things, word, phrase, vocabulary, scene)
        if not meant and basic_color(word) is None and word not in STATES:
            raise ReferenceProblem(phrase.text, f"none of them is {word!r}", 1, word=word)
        out |= meant
    for modifier in phrase.modifiers:
        if modifier.prep is Prep.QUALITY and modifier.denied:
            known = (with_quality(things, w, phrase, vocabulary, scene) for w in modifier.words)
            not_so = set[Thing]().union(*known)
            # The only mug is "the mug that is not white" if it is red.
            lone = phrase.determiner in THE_WORDS and phrase.modifiers == (modifier,)
            true = lone and role is Role.THEME and all(map(basic_color, modifier.words))
            if len(things) == 1 and not (not_so or true):
                # "Everything off the tray that is not red"
                raise ReferenceProblem(phrase.text, _ALONE, 2)
            out |= not_so
        if modifier.prep in (Prep.EXCEPT, Prep.CONTRAST):
            for item in modifier.phrases:
                said = " ".join((item.determiner, *item.words, item.pronoun))
                none = modifier.prep is Prep.CONTRAST and said.startswith("one of ")
                if said.split()[0] in _SO_MANY and not none:
                    why = "say which are left out of"
                    raise AmbiguousReference(phrase.text, [t.name for t in things], why)
                named = _named_out(item, words[-1], things, landmarks)
                if not named & {*things} and {Thing(thing.name) for thing in named} & {*things}:
                    # "On the shelf, not the top board" is still to be somewhere on it.
                    raise ReferenceProblem(item.text, "say in or on what it is not to be", 1)
                several = [thing for thing in things if thing in named]
                if several[1:] and _is_one(item):
                    why = f"{names_of_things(several)} would be left out"
                    raise ReferenceProblem(item.text, why, 1)
                if modifier.denied:
                    named = {*things} - named  # "but only the red one"
                out |= named
    excepting = [m for m in phrase.modifiers if m.prep is Prep.EXCEPT and not m.denied]
    if excepting and not out & set(things):
        entries = [vocabulary.entries()[thing] for thing in things]
        out_nps = [np for item in excepting for np in item.phrases]
        behind = all(np.text in phrase.text and not np.is_elliptic for np in out_nps)
        # Who leaves the star out of "the blocks", which are but cubes, may count it among these.
        own = all(entry.grade(words[-1]) in (EXACT, HEAD) for entry in entries)
        # "Anything in there that is not a battery" need not mean that there is one.
        told = matches_any(words[-1], THING_NOUNS) and " is not a" in phrase.text
        if not (behind and (told or (own and things[1:]))):
            raise ReferenceProblem(phrase.text, "what is to be left out is none of them", 1)
        said = " and ".join(np.text for np in out_nps)
        notes.append(f"{said!r} is none of {names_of_things(things)}: nothing is left out")
    left = [thing for thing in things if thing not in out]
    if not left:
        raise ReferenceProblem(phrase.text, "nothing is left without those", 1)
    contrasted = (m.phrases for m in phrase.modifiers if m.prep is Prep.CONTRAST)
    bare = (np for np in sum(contrasted, ()) if not (np.determiner or np.modifiers))
    for np in (np for np in bare if len(np.words) == 1):
        entries = [vocabulary.entries()[thing] for thing in left]
        if any(entry.grade(np.head) is not None for entry in entries):
            raise ReferenceProblem(np.text, "it would be one itself", 1)
    return left, out

"""Singles out instances by place, size, order and state ("the left cup", "the second ball")."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier
from etot_cli.reasoning.language.reference.geometry import rows, space
from etot_cli.reasoning.language.reference.geometry.areas import in_area
from etot_cli.reasoning.language.reference.memory.antecedents import AmbiguousReference
from etot_cli.reasoning.language.reference.naming.states import in_state
from etot_cli.reasoning.language.words.lexicon import LEVELS, ORDINALS, SIDES, SIZES, STATES
from etot_cli.reasoning.language.words.places import Prep
from etot_cli.world.state import DESK, SceneState

ELONGATED = 2.0
"""What is so many times longer than wide is called long, among things of other shapes."""

ALIKE, UNLIKE = 1.05, 1.15
"""Sides of things of about one size differ by less, those of another size by more; sizes from
noisy captures are off by 0.9 % in the median (docs/results.md)."""


def side_word(phrase: str) -> str | None:
    """The side that "on the far left of the desk" and "farthest to the left" name."""
    sides = [word for word in phrase.split() if word in (*SIDES, "top", "bottom")]
    if sides:
        return sides[-1]
    return next((side for words, side in _OF_A_ROW if words & {*phrase.split()}), None)


_OF_A_ROW = ({"ends", "either", "both", "each", "outside"}, "outer"), ({"inside"}, "inner")
"""What "at the ends", "at either end" and "on the inside" name; "at the end" may be either."""


def select(
    words: Sequence[str],
    modifiers: Sequence[Modifier],
    things: list[Thing],
    count: int | None,
    scene: SceneState,
    phrase: str,
) -> list[Thing]:
    """Things that selecting words and modifiers of place single out.

    Args:
        words: adjectives such as ``left``, ``second``, ``big``, ``empty``.
        modifiers: of the phrase; those of place ("on the left") are looked at.
        things: to choose from, in scene order.
        count: how many are meant, None when the noun is an open plural.
        scene: where they are.
        phrase: as written, for messages.

    Raises:
        ReferenceProblem: nothing is left, or of two sides one leaves what the other does not.
    """
    if scene.forward != (1.0, 0.0) and any("your" in item.words for item in modifiers):
        why = "the scene is looked at through a camera; say whether the robot's side is meant"
        raise ReferenceProblem(phrase, why, 3, word="your")
    denied = [item for item in modifiers if item.prep is Prep.SIDE and item.denied]
    for item in denied:
        side = side_word(" ".join(item.words))
        at_side = _at_side(SIDES.get(side, side), things, 1, scene, phrase) if side else []
        things = [thing for thing in things if thing not in at_side]
    if any(item.prep is Prep.SIDE and item.words[-1:] == ("row",) for item in modifiers):
        things = _in_the_row(things, scene, phrase)
    for item in modifiers:
        if item.prep is Prep.AREA:
            things = in_area(item, things, count, scene, phrase)
    sides = [
        side_word(" ".join(item.words))
        for item in modifiers
        if item.prep is Prep.SIDE and not item.denied
    ]
    ordinals = [word for word in words if word in ORDINALS]
    if ordinals == ["last"] and any(
        m.prep is Prep.SIDE and m.words[0] != "from" for m in modifiers
    ):
        ordinals = ["first"]  # the last one on the right is the first from there
    named = [word for word in phrase.split() if word in ORDINALS and word not in words]
    if any(sides) and named and len(things) == 1 and things[0].part:
        why = f"{named[0]!r} is the name of one of them; say it without a side"
        raise ReferenceProblem(phrase, why, 3, word=named[0])
    if any(thing.name == DESK for thing in things) and (words or any(sides)):
        word = words[0] if words else "side"
        raise ReferenceProblem(phrase, f"{word!r} tells no desk from another", 2, word=word)
    for word in words:
        if word in STATES:
            things = in_state(word, things, scene, every=count != 1)
    if not things:
        raise ReferenceProblem(phrase, "nothing is in that state", 1)
    by_size = [word for word in words if word in SIZES]
    plain = not any(sides) and not any(word in SIDES for word in words)
    if len(ordinals) == len(by_size) == 1 and plain and by_size[0].endswith("est"):
        return [_nth_by_size(ordinals[0], by_size[0], things, scene, phrase)]
    if ordinals:
        others = [word for word in words if word in SIZES or word in SIDES]
        if len(others) == 1 and others[0].endswith(("est", "most")) and others[0] in SIDES:
            sides, others = [*sides, others[0]], []  # "the second closest", "… rightmost cup"
        if len(ordinals) > 1 or others or len(sides) > 1:
            word = (*ordinals[1:], *others, "the side")[0]
            why = f"{word!r} does not go together with {ordinals[0]!r}"
            raise ReferenceProblem(phrase, why, 2, word=word)
        many = max(count or 1, 1)
        return _nth(ordinals[0], sides[0] if sides else None, things, scene, phrase, many)
    for word in words:
        if word in SIZES:
            things = _by_size(word, things, count, scene, phrase)
    selected = [word for word in words if word in SIDES or word in LEVELS]
    if len(selected) > 1:  # "the far left cup"
        selected = [word for word in selected if word not in ("far", "near")]
    selected = [
        SIDES.get(word, LEVELS.get(word, word)) for word in (*selected, *sides) if word is not None
    ]
    ways = []
    for order in (selected, selected[::-1]):
        left = things
        for side in order:
            left = _at_side(side, left, count, scene, phrase)
        ways.append(left)
    if set(ways[0]) != set(ways[1]):
        raise AmbiguousReference(phrase, [thing.name for left in ways for thing in left])
    return ways[0]


def _in_the_row(things: list[Thing], scene: SceneState, phrase: str) -> list[Thing]:
    """Those of the things that stand in a row.

    Raises:
        ReferenceProblem: they stand on several things, and it is open where the row is.
    """
    row = rows.standing_in_a_row(things, scene)
    states = [scene.states[thing.name] for thing in things if thing.name in scene.states]
    if not row and len({(*state.on, state.inside) for state in states}) > 1:
        raise ReferenceProblem(phrase, "say which things stand in that row", 2, word="row")
    return row or things


def in_line(side: str, things: Sequence[Thing], scene: SceneState, phrase: str) -> list[Thing]:
    """Things in order from a side on, be it the ``top`` or the ``bottom``, or from a size on.

    Raises:
        ReferenceProblem: two of them are as far to that side.
    """
    if side in SIZES:
        measure = _measure(side, scene, list(things))
        ordered = sorted(things, key=measure)
        for one, other in pairwise(ordered):
            if measure(one) == measure(other):
                raise ReferenceProblem(
                    phrase, f"{one.name} and {other.name} are alike", 2, word=side
                )
        return ordered
    if side not in ("top", "bottom"):
        ordered = rows.by_side(side, things, scene)
        for one, other in pairwise(ordered):
            _check_apart(side, one, other, scene, phrase, side)
        return ordered
    if len({thing.name for thing in things}) == 1 and (things[0].part or things[0].board):
        # Parts are listed from the top down, boards from the bottom up.
        upward = things[0].board is not None
        return list(things[::-1] if upward == (side == "top") else things)
    if len(things) == 1 and rows.ends_stack(side, things[0], scene):
        return list(things)  # "the green block at the bottom" of a tower
    levels = rows.on_boards(things, scene)
    if levels[1:] and len(levels[-1 if side == "top" else 0]) == 1:
        shelved = [thing for level in levels for thing in level]  # the upper book of a shelf
        return shelved[::-1] if side == "top" else shelved
    if not rows.is_column(things, scene):
        raise ReferenceProblem(phrase, "they do not lie upon each other", 2, word=side)
    stack = rows.upon_each_other(things, scene)
    return stack[::-1] if side == "top" else stack


def _nth(
    ordinal: str,
    origin: str | None,
    things: list[Thing],
    scene: SceneState,
    phrase: str,
    many: int,
) -> list[Thing]:
    """The n-th from the left unless another side is said, or the first or last so many of them;
    parts count from the top.
    """
    if all(thing.part is not None or thing.board is not None for thing in things):
        owners = list(dict.fromkeys(thing.name for thing in things))
        if len(owners) > 1:
            raise ReferenceProblem(phrase, f"say of which of {', '.join(owners)}", 2, word=ordinal)
        # Parts are listed from the top down, boards from the bottom up.
        upward = things[0].board is not None
        ordered = things[::-1] if origin == ("top" if upward else "bottom") else things
    elif origin in ("top", "bottom") or rows.is_column(things, scene):
        if origin not in ("top", "bottom"):
            why = "they lie upon each other; say 'top', 'middle' or 'bottom'"
            raise ReferenceProblem(phrase, why, 2, word=ordinal)
        ordered = in_line(origin, things, scene, phrase)
    else:
        if origin is None and rows.is_deep(things, scene):
            why = "they stand one behind the other; say 'front', 'middle' or 'back'"
            raise ReferenceProblem(phrase, why, 2, word=ordinal)
        side = SIDES[origin or "left"]
        if side == "middle":
            why = f"in the {origin} none is the {ordinal}"
            raise ReferenceProblem(phrase, why, 2, word=ordinal)
        ordered = rows.by_side(side, things, scene)
    index = ORDINALS[ordinal]
    if index >= len(ordered) or many > len(ordered):
        raise too_few(things, phrase)
    if many > 1 and index not in (0, -1):
        raise ReferenceProblem(phrase, f"say which {many} they are", 2, word=ordinal)
    chosen = [ordered[index]] if many == 1 else ordered[:many] if index == 0 else ordered[-many:]
    side = "" if origin in ("top", "bottom") else SIDES[origin or "left"]
    level = not (chosen[0].part or chosen[0].board or not side)
    for other in [thing for thing in things if level and thing not in chosen]:
        for found in chosen:
            _check_apart(side, found, other, scene, phrase, ordinal)
    return chosen


_DARKNESS = {"white": 1.0, "black": 4.0}
"""Of two other colours who knows which is darker."""


def _by_size(
    word: str, things: list[Thing], count: int | None, scene: SceneState, phrase: str
) -> list[Thing]:
    if word == "long":  # A pan is wider than a carrot, and not long.
        sides = {thing: sorted(scene.infos[thing.name].size) for thing in things}
        things = [t for t, size in sides.items() if size[2] >= ELONGATED * size[1]] or things
    if word == "flat" and len(things) > 1:
        # What is lower than others is not flat.
        flat = [thing for thing in things if space.is_flat(scene.infos[thing.name])]
        if count is None and not flat:
            raise ReferenceProblem(phrase, "none of them is flat", 2, word=word)
        if count is None:
            return flat
        things = flat or things
    measure = _measure(word, scene, things)
    ordered = sorted(things, key=measure)
    groups = _groups(ordered, [abs(measure(thing)) for thing in ordered], SIZES[word][0])
    two = len(groups) == 2 or not word.endswith("er")
    if count is None and len(groups) > 1 and len(groups[0]) > 1 and two:
        return groups[0]  # "the small pots" of two small ones and a big one
    last = measure(_leading(ordered, count, phrase)[-1])
    said = [own for thing in ordered for own in scene.infos[thing.name].label.casefold().split()]
    alike = len(ordered) > 1 and measure(ordered[0]) == measure(ordered[-1])
    if alike and (word.endswith("er") or any(map(word.startswith, {*said} - {word}))):
        # "The bigger of two that are as big", "the lightest brown pad" of a dark and a light brown
        names = " and ".join(thing.name for thing in ordered)
        raise ReferenceProblem(phrase, f"{word!r} tells nothing of {names}", 2, word=word)
    return [thing for thing in ordered if measure(thing) <= last]  # of equals any may be meant


def _groups(ordered: list[Thing], values: list[float], quantity: str) -> list[list[Thing]]:
    """Things of about one size each; none where it is unclear which belong together."""
    power = 3 if quantity in ("volume", "mass") else 1
    groups: list[list[Thing]] = [ordered[:1]]
    for thing, before, value in zip(ordered[1:], values, values[1:], strict=False):
        apart = (max(before, value) / max(min(before, value), 1e-9)) ** (1 / power)
        if ALIKE < apart < UNLIKE:
            return []
        if apart >= UNLIKE:
            groups.append([])
        groups[-1].append(thing)
    return groups


def too_few(things: Sequence[Thing], phrase: str) -> ReferenceProblem:
    """That more are asked for than there are."""
    there = "is only one" if len(things) == 1 else f"are only {len(things)} of them"
    return ReferenceProblem(phrase, f"there {there}: {', '.join(t.address for t in things)}", 1)


def _nth_by_size(
    ordinal: str, word: str, things: list[Thing], scene: SceneState, phrase: str
) -> Thing:
    """The second largest, where that is one and no more."""
    measure = _measure(word, scene, things)
    ordered = sorted(things, key=measure)
    index = ORDINALS[ordinal] % len(ordered) if ordinal == "last" else ORDINALS[ordinal]
    if index >= len(ordered):
        raise too_few(things, phrase)
    equal = [thing.name for thing in ordered if measure(thing) == measure(ordered[index])]
    if len(equal) > 1:
        raise ReferenceProblem(phrase, f"{' and '.join(equal)} are as large", 2, word=ordinal)
    return ordered[index]


def _measure(word: str, scene: SceneState, things: list[Thing]) -> Callable[[Thing], float]:
    """What a word for size orders things by, the one that fits it best first. Of spoons that lie
    there "the shortest" is so by its length, as of all that is slim, or as high as each other.
    """
    quantity, sign = SIZES[word]
    sizes = [scene.infos[thing.name].size for thing in things]
    lying = all(max(size[:2]) >= ELONGATED * size[2] for size in sizes)
    slim = all(max(size[:2]) >= ELONGATED * min(size[:2]) for size in sizes)
    if quantity == "height" and lying and (slim or len({size[2] for size in sizes}) == 1):
        quantity = "width"

    def measure(thing: Thing) -> float:
        info = scene.infos[thing.name]
        x, y, z = info.size
        values = {"volume": x * y * z, "height": z, "width": max(x, y), "girth": min(x, y, z)}
        values |= {"mass": info.mass, "darkness": _DARKNESS.get(info.color or "", 2.0)}
        return -sign * values[quantity]

    return measure


def _at_side(
    side: str, things: list[Thing], count: int | None, scene: SceneState, phrase: str
) -> list[Thing]:
    owners = [Thing(name) for name in dict.fromkeys(thing.name for thing in things)]
    if len(owners) > 1 and side not in LEVELS and all(thing.part for thing in things):
        # "The left drawer" of two chests is one of the left chest.
        (owner,) = _at_side(side, owners, 1, scene, phrase)
        return [thing for thing in things if thing.name == owner.name]
    if side in ("top", "bottom"):
        if len(things) == 1 and rows.is_end_of_stack(side, things[0], scene):
            return things
        stack = rows.upon_each_other(things, scene)
        ordered = in_line(side, stack or things, scene, phrase)
        highest = max(things, key=lambda thing: space.position(thing, scene)[2])
        if stack and side == "top" and highest not in stack:
            why = f"{highest.name} is higher than {ordered[0].name}"
            raise ReferenceProblem(phrase, why, 2, word=side)
        return _leading(ordered, count, phrase)
    if side in ("outer", "inner"):
        ends, inner = rows.ends_of_row(things, scene)
        if not (ends if side == "outer" else inner[1:]):
            raise ReferenceProblem(phrase, "say which", 2, word=side)
        return ends if side == "outer" else inner
    if side == "middle":
        _, inner = rows.ends_of_row(things, scene)
        if count is not None and len(inner) == count > 1:
            return inner
        upon = rows.is_column(things, scene)
        things = (rows.upon_each_other if upon else rows.in_a_row)(things, scene)
        if len(things) % 2 == 0:
            names = ", ".join(thing.name for thing in things)
            raise ReferenceProblem(phrase, f"none of {names} is in the middle", 1)
        middle = things[len(things) // 2]
        central = middle if upon else rows.most_central(things, scene)
        if central != middle:
            raise AmbiguousReference(phrase, [middle.address, central.address])
        axis = rows.row_from(things, scene)
        for other in () if upon or middle.part or middle.board else things:
            if other != middle and rows.are_level(axis, middle, other, scene):
                why = f"{middle.name} and {other.name} are as much in the middle"
                raise ReferenceProblem(phrase, why, 2, word="middle")
        return [middle]
    ordered = rows.by_side(side, things, scene)
    leading = _leading(ordered, count, phrase)
    for other in ordered[len(leading) : len(leading) + 1]:
        _check_apart(side, leading[-1], other, scene, phrase, side)
    return leading


def _check_apart(
    side: str, one: Thing, other: Thing, scene: SceneState, phrase: str, word: str
) -> None:
    if rows.are_level(side, one, other, scene):
        why = f"{one.name} and {other.name} are as far to that side"
        raise ReferenceProblem(phrase, why, 2, word=word)


def _leading(ordered: list[Thing], count: int | None, phrase: str) -> list[Thing]:
    """As many as are meant, of things that are ordered from the best fitting one on."""
    if count is None and len(ordered) > 1:
        names = [thing.name for thing in ordered]
        raise AmbiguousReference(phrase, names, "say how many of them are meant,")
    return ordered[: count or 1]

"""Adjectives of state ("open", "empty", "loose") and the things that they are true of."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Thing
from etot_cli.reasoning.builtin.relations import contents, is_closed, is_inside, is_on, parts_of
from etot_cli.reasoning.builtin.roles import ReferenceProblem
from etot_cli.reasoning.language.reference.geometry import space
from etot_cli.reasoning.language.words.lexicon import STATES
from etot_cli.world.state import CLOSED_AT, DESK, OPEN_AT, SceneState

_ROUND = ("sphere", "cylinder", "cup", "bowl")
"""Kinds of objects that are so from above."""
_DARK = ("black", "brown")
_BRIGHT = frozenset({"white", "yellow", "pink", "orange"})
"""Of other colours who knows whether they are dark."""


def in_state(
    word: str,
    things: Sequence[Thing],
    scene: SceneState,
    *,
    every: bool = False,
    left_out: bool = False,
) -> list[Thing]:
    """The things that an adjective of state is true of; one that is "open" is rather one that is
    fully so, and one that is "round" rather a ball: "everything round" is no cup, which "everything
    that is not round" may be (``left_out``).

    Raises:
        ReferenceProblem: of several things, or colours, it is open which are "dark", or "round".
    """
    if STATES[word] == "dark":
        _check_dark(word, things, scene, every=every)
    found = [thing for thing in things if state_holds(word, thing, scene)]
    if STATES[word] == "round":
        balls = [thing for thing in found if scene.infos[thing.name].kind == "sphere"]
        vessels = [] if left_out else [t for t in found if scene.infos[t.name].container]
        solid = [thing for thing in found if thing not in vessels]
        mixed = balls != solid if balls else bool(vessels and solid)
        if every and mixed:
            raise ReferenceProblem(word, "say what they are", 3, word=word)
        # Of an orange, a bowl and a cube only the cube is "not round".
        return found if left_out and found != [*things] else balls or found
    wide = [
        thing
        for thing in found
        if any(scene.openness(part) >= OPEN_AT for part in parts_of(scene, thing))
    ]
    return wide if wide and STATES[word] == "open" and not every else found


def _check_dark(word: str, things: Sequence[Thing], scene: SceneState, *, every: bool) -> None:
    """Whether what is dark is clear: something black, or something brown among bright things."""
    colors = {scene.infos[thing.name].color for thing in things if thing.name != DESK}
    if every or not (_DARK[0] in colors or colors <= {*_DARK, *_BRIGHT}):
        raise ReferenceProblem(word, "say the colour", 3, word=word)


def state_holds(word: str, thing: Thing, scene: SceneState) -> bool:
    """Whether an adjective of state ("open", "empty", …) is true of a thing.

    Raises:
        ReferenceProblem: of what lies on something else it is open whether it is "loose".
    """
    if thing.name == DESK:
        return False
    info, state = scene.infos[thing.name], scene.states[thing.name]
    parts = parts_of(scene, thing)
    match STATES[word]:
        case "open":
            return any(scene.openness(part) > CLOSED_AT for part in parts)
        case "ajar":
            return any(CLOSED_AT < scene.openness(part) < OPEN_AT for part in parts)
        case "closed":
            return bool(parts) and all(is_closed(scene, part) for part in parts)
        case "empty" | "full":
            places = [part.address for part in parts] if thing.part else [thing.name]
            places += [part.address for part in parts]
            filled = any(contents(scene, place) for place in places)
            if thing.board is not None:
                places = [f"{thing.name}.{thing.board}"]
            # What rests in a vessel's mouth keeps it from being empty, too.
            if thing.board is not None or not parts:
                filled = filled or any(is_on(scene, name, places[0]) for name in scene.states)
            return filled == (STATES[word] == "full")
        case "stacked":
            upon = [Thing(name) for name, other in scene.infos.items() if other.movable]
            return any(
                space.rests_on(one, below, scene) and not is_inside(scene, one.name, below.name)
                for other in upon
                for one, below in ((thing, other), (other, thing))
            )
        case "loose":
            if state.inside is None and state.on and DESK not in state.on and info.movable:
                why = f"say whether {thing.name} is meant, too: it lies on {state.on[0]}"
                raise ReferenceProblem(word, why, 3)
            bears = bool(contents(scene, thing.name)) or any(
                is_on(scene, name, thing.name) for name in scene.states
            )  # what holds other things is put away itself
            return state.inside is None and DESK in state.on and not bears
        case "round":
            return info.kind in _ROUND
        case "dark":
            return info.color in _DARK
        case _:
            return state.toppled

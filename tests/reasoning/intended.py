"""The scene that actions lead to if all goes as it is meant, without physics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from etot_cli.skills.action import Action, Verb
from etot_cli.world.spatial import Nearby
from etot_cli.world.state import SceneState, owner_of


def intended(scene: SceneState, actions: Sequence[Action]) -> SceneState | None:
    """The scene after ``actions``; None where something goes beside something else."""
    for action in actions:
        held = scene.holding
        states = dict(scene.states)
        if action.verb is Verb.PICK_UP:
            scene = replace(scene, holding=action.target)
            change = {"on": (), "inside": None, "in_hand": True}
            states[action.target] = replace(states[action.target], **change)
        elif action.verb in (Verb.PUT_ON, Verb.PUT_INTO):
            assert held is not None
            inside = action.target if action.verb is Verb.PUT_INTO else None
            on = owner_of(action.target) if inside else action.target
            x, y, z = states[held].position
            for where in action.where:
                if where.point is not None and not where.denied:
                    x, y = where.point
                elif where.relation is not Nearby.UPRIGHT:
                    return None
            states[held] = replace(
                states[held], on=(on,), inside=inside, in_hand=False, position=(x, y, z),
                toppled=False,
            )  # fmt: skip
            scene = replace(scene, holding=None)
        else:
            part = scene.part(action.target)
            assert part is not None
            opened = action.verb is Verb.OPEN
            before = states[part.owner]
            states[part.owner] = replace(
                before,
                openness={**before.openness, part.name: float(opened)},
                opened={**before.opened, part.name: opened},
            )
        scene = replace(scene, states=states)
    return scene

"""Relations turned round: the same arrangement, said of another of the things that it is about."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from etot_cli.world.spatial import Nearby, Whereabouts

CONVERSE = {
    Nearby.LEFT: Nearby.RIGHT,
    Nearby.RIGHT: Nearby.LEFT,
    Nearby.FRONT: Nearby.BEHIND,
    Nearby.BEHIND: Nearby.FRONT,
    Nearby.NEXT_TO: Nearby.NEXT_TO,
    Nearby.NEAR: Nearby.NEAR,
    Nearby.AWAY: Nearby.AWAY,
}
"""What holds of a landmark and a thing where the key holds of the thing and the landmark."""


def turned(name: str, where: Whereabouts) -> Iterator[tuple[str, Whereabouts]]:
    """What it means for each of its landmarks that a thing is somewhere, while that stays.

    Args:
        name: the thing.
        where: where it is, or is not.

    Yields:
        A landmark, and where that is with respect to the thing and the other landmark.
    """
    if where.relation in CONVERSE:
        turned_round = replace(where, relation=CONVERSE[where.relation], landmarks=(name,))
        yield where.landmarks[0], turned_round
    elif where.relation is Nearby.BETWEEN:
        for one, other in (where.landmarks, where.landmarks[::-1]):
            yield one, replace(where, relation=Nearby.BEYOND, landmarks=(name, other))

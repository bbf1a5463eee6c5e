"""What "next to it" is beside, once something was put on what has room for both."""

from __future__ import annotations

from collections.abc import Sequence

from etot_cli.reasoning.builtin.goal import Relation
from etot_cli.reasoning.builtin.roles import Role
from etot_cli.reasoning.language.reference.geometry.space import is_flat
from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from etot_cli.reasoning.language.reference.memory.spoken_of import clauses_of, mentioned_in
from etot_cli.reasoning.language.reference.pronouns.one_thing import ROOMY
from etot_cli.reasoning.language.words.lexicon import matches_any, word_set
from etot_cli.world.spatial import Nearby

_SIDES = (Nearby.NEXT_TO, Nearby.NEAR, Nearby.LEFT, Nearby.RIGHT)
"""What is put behind or in front of "it" may as well be so of the tray."""
_BEARING = word_set("tray board pallet cart trolley stand rack sheet shelf table stool pad")
"""What things are put on together; beside a plate a table is laid, a book is one thing more."""


def put_on_the_same(
    discourse: Discourse, themes: Sequence[int], relation: Nearby, excluded: Sequence[int]
) -> int | None:
    """In "the apple on the tray and the banana next to it" the apple, where the tray has room for
    both; None where that is not said, or there is not.
    """
    said: tuple[tuple[int, ...], ...] = ((), (), ())
    for clause in clauses_of(discourse):
        said = mentioned_in(discourse, clause, Role.ANY, excluded)
        if any(said):
            break
    moved, places, landmarks = said
    upon = [place for place in discourse.last_places if place.relation is Relation.ON]
    if len(moved) != 1 or len(places) != 1 or landmarks or relation not in _SIDES:
        return None
    plain = [place.where for place in upon if not place.beside] == [*places]
    nouns = {mention.noun for mention in discourse.mentions if mention.referent in places}
    bearing = all(matches_any(noun, _BEARING) for noun in nouns)
    if not (plain and bearing) or moved[0] not in discourse.put or discourse.is_desk(places[0]):
        return None
    infos = discourse.scene.infos
    (below, *others) = [infos[thing.name] for thing in discourse.things(*places)]
    above = [infos[thing.name] for thing in discourse.things(*moved, *themes)]
    wide = min(below.size[:2]) >= ROOMY * max(min(info.size[:2]) for info in above)
    long = max(below.size[:2]) >= max(max(info.size[:2]) for info in above)
    return moved[0] if not others and is_flat(below) and wide and long else None

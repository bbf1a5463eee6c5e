"""What can be asked of a syntax tree as a whole."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec import Struct

from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words.places import Prep

_CONTRASTS = (Prep.CONTRAST, Prep.EXCEPT)
UNSAID = "it or them"
"""The pronoun of what is left out behind a verb ("take the cup out and place on the tray")."""
UNPLACED = "what has no place yet"
"""The pronoun of what a place is used for that stands alone ("clear the desk; use the box")."""


def nodes(tree: object) -> Iterator[object]:
    """All that a tree is made of, from its root on."""
    ahead = [tree]
    while ahead:
        node = ahead.pop()
        yield node
        if isinstance(node, tuple):
            ahead.extend(reversed(node))
        elif isinstance(node, Struct):
            ahead.extend(getattr(node, name) for name in reversed(node.__struct_fields__))


def pronouns(tree: object) -> Iterator[str]:
    """The pronouns in a tree, those in determiners left out."""
    return (node.pronoun for node in nodes(tree) if isinstance(node, NounPhrase) and node.pronoun)


def reading_cost(tree: object) -> int:
    """How far-fetched a reading is: modifiers on nouns, which say nothing of the goal, count."""
    return sum(
        getattr(node, "far_fetched", 0)
        + (len(node.modifiers) + node.loose if isinstance(node, NounPhrase) else 0)
        + (2 * _contrasts(node) if isinstance(node, Modifier) else 0)
        for node in nodes(tree)
    )


def _contrasts(modifier: Modifier) -> bool:
    """Whether it says of a landmark what that is not ("the jar nearest to the cart, but not …")."""
    told = any(item.prep in _CONTRASTS for np in modifier.phrases for item in np.modifiers)
    return modifier.prep not in _CONTRASTS and told

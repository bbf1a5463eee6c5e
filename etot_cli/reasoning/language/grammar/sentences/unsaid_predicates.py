"""What is left out behind "the one that is not": how another thing was told before."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from etot_cli.reasoning.language.grammar.parsers.trees import nodes
from etot_cli.reasoning.language.grammar.phrases.modifiers import UNSAID_SO
from etot_cli.reasoning.language.grammar.sentences.spoken import Reading
from etot_cli.reasoning.language.grammar.syntax.phrases import Modifier, NounPhrase
from etot_cli.reasoning.language.words.lexicon import singular


def spelled_out(reading: Reading) -> Reading | None:
    """A reading in which "the one that is not" is told by what another thing was told by before
    ("the block that is in the box … the one that is not", "… the cup that is not"); None where
    nothing was, or by several things, or where the same is said of both.
    """
    if not any(isinstance(node, Modifier) and _is_unsaid(node) for node in nodes(reading)):
        return reading
    told = _Told()
    found: Reading = told.spelled_out(reading)
    return None if told.failed else found


def _is_unsaid(modifier: Modifier) -> bool:
    return modifier.words == UNSAID_SO


@dataclass
class _Told:
    """The last thing that was told from others, in the order in which they are said."""

    last: NounPhrase | None = None
    failed: bool = False

    def spelled_out(self, node: Any) -> Any:
        """A tree with all that is left out in it."""
        if isinstance(node, tuple):
            return tuple(map(self.spelled_out, node))
        if not isinstance(node, Struct):
            return node
        if isinstance(node, NounPhrase) and any(map(_is_unsaid, node.modifiers)):
            return self._so(node)
        values = {name: getattr(node, name) for name in node.__struct_fields__}
        found = {name: self.spelled_out(value) for name, value in values.items()}
        if isinstance(node, NounPhrase) and node.modifiers and node.words and not node.is_elliptic:
            self.last = node
        changed = {name: value for name, value in found.items() if value is not values[name]}
        return replace(node, **changed) if changed else node

    def _so(self, phrase: NounPhrase) -> NounPhrase:
        """A phrase with what is said of the last one or not, and with its noun for "one"."""
        (so, *more), before = phrase.modifiers, self.last
        if before is None or more or before.modifiers[1:]:
            self.failed = True
            return phrase
        (told,) = before.modifiers
        self.failed |= told.denied is so.denied
        if phrase.is_elliptic:
            one = singular(before.head)
            plural = before.head if one != before.head else f"{one}s"
            phrase = phrase.called(plural if phrase.head == "ones" else one)
        return replace(phrase, modifiers=(replace(told, denied=so.denied),))

"""Which failures of a search a person wants to hear of, each with the history that led to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from etot_cli.reporting.tree_report import NodeModel


@dataclass(frozen=True, slots=True)
class Failure:
    """A failed node. ``times``: how often the same action failed for the same reason."""

    node: NodeModel
    path: tuple[NodeModel, ...]
    """The actions before it, from the start."""
    times: int

    @property
    def kind(self) -> str:
        """Status and physical kind, e.g. ``failure, rebound``."""
        cause = self.node.cause
        words = [self.node.status] if cause is None else [self.node.status, cause.kind.value]
        return ", ".join(words).replace("_", " ")

    @property
    def text(self) -> str:
        """The cause in a sentence; empty when none is on record."""
        return self.node.cause.text if self.node.cause else ""

    @property
    def history(self) -> str:
        """The actions before it as they are written in plans; empty for a first action."""
        return " ".join(node.action for node in self.path)


def distinct_failures(nodes: Sequence[NodeModel]) -> list[Failure]:
    """One failure per action, object in hand and cause: the same failure often recurs.

    The one with the shortest history stands for the others; in order of appearance.
    """
    by_id = {node.id: node for node in nodes}
    found: dict[tuple[str, str, str], Failure] = {}
    for node in nodes:
        if node.status not in ("failure", "unsafe"):
            continue
        path: list[NodeModel] = []
        at = by_id.get(node.parent) if node.parent is not None else None
        while at is not None and len(path) <= len(nodes):
            path.append(at)
            at = by_id.get(at.parent) if at.parent is not None else None
        # "[PUT INTO, holder] failed" does not say what was put; the action before it does.
        held = path[0].action if path else ""
        key = (node.action, held, node.cause.text if node.cause else node.status)
        failure = Failure(node, tuple(reversed(path)), 1)
        known = found.get(key)
        if known is not None:
            shorter = failure if len(failure.path) < len(known.path) else known
            failure = Failure(shorter.node, shorter.path, known.times + 1)
        found[key] = failure
    return list(found.values())

"""Watching a search in the terminal: the tree as it grows, each verdict with its cause."""

from __future__ import annotations

import time
from textwrap import wrap

from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from etot_cli.planning.result import SearchObserver, SearchResult
from etot_cli.planning.tree import FAILED, NodeStatus, PlanNode, PlanTree
from etot_cli.reasoning.protocol import Branch
from etot_cli.reporting.style import LOOKS, RUNNING, badge, counted, speaks_unicode

REFRESHES_PER_SECOND = 4
"""Often enough for a running clock; drawing must not take time from the simulation."""
FOOTER_LINES = 4
"""Title, footer, the note on a narrow screen, and the line of the cursor."""
NARROW = 64
"""On a narrower screen an action fills its line, and why it failed stands below it."""
MIN_WORDS = 12
"""Width that is left for words however deep the tree is [characters]."""
LINES_LEFT_BEHIND = 40
"""Of a large tree that stays on the screen after the search."""


class LiveView(SearchObserver):
    """Draws the planning tree in place while it is searched. A context manager and an observer.

    Args:
        console: a terminal.
        title: what is being planned.
        detailed: also show changed objects, times, and branches that were removed untried.
    """

    def __init__(self, console: Console, title: str, *, detailed: bool = False) -> None:
        self._console = console
        self._title = title
        self._detailed = detailed
        self._unicode = speaks_unicode(console.file)
        self._tree = PlanTree()
        self._focus: PlanNode | None = None
        self._plan: frozenset[int] = frozenset()
        self._reflections = 0
        self._note = "building the world"
        self._started = time.monotonic()
        self._ended = False
        self._live = Live(
            console=console,
            get_renderable=self._render,
            refresh_per_second=REFRESHES_PER_SECOND,
            vertical_overflow="visible",
        )

    def __enter__(self) -> LiveView:
        self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended = True
        self._live.stop()

    def proposed(self, tree: PlanTree) -> None:
        """Starts to draw the tree."""
        self._tree = tree
        self._note = "searching"

    def started(self, node: PlanNode) -> None:
        """Marks the node that the search waits for."""
        self._focus = node
        self._note = f"simulating {node.action}"

    def judged(self, node: PlanNode) -> None:
        """The node's own line shows its verdict."""
        if node.status in FAILED:
            self._note = f"reflecting on {node.action}"

    def revised(self, node: PlanNode, branch: Branch | None) -> None:
        """Counts the reflection; a new branch shows in the tree."""
        self._reflections += 1

    def finished(self, result: SearchResult) -> None:
        """Leaves the last picture on the screen."""
        self._focus = result.leaf
        self._plan = frozenset(node.id for node in result.leaf.path) if result.leaf else self._plan
        self._note = ""

    def _render(self) -> Group:
        lines, focus = self._tree_lines()
        if not (self._ended and self._detailed):
            least = LINES_LEFT_BEHIND if self._ended else 3
            lines = window(lines, focus, max(least, self._console.height - FOOTER_LINES))
        title = Text(self._title, style="bold", no_wrap=True, overflow="ellipsis")
        return Group(title, *lines, *self._footer())

    @property
    def _narrow(self) -> bool:
        return self._console.width < NARROW

    def _footer(self) -> list[Text]:
        nodes = list(self._tree)
        evaluated = sum(node.verdict is not None for node in nodes)
        waiting = sum(node.status is NodeStatus.PENDING for node in nodes)
        simulated = sum(node.simulated_s for node in nodes)
        elapsed = f"{time.monotonic() - self._started:.0f} s"
        separator = " · " if self._unicode else " | "
        parts = [f"{evaluated} done", f"{waiting} waiting", elapsed]
        if not self._narrow:
            parts = [
                f"{evaluated} evaluated",
                f"{waiting} waiting",
                counted(self._reflections, "reflection"),
                f"{simulated:.0f} s simulated",
                f"{elapsed} elapsed",
            ]
        text = Text(no_wrap=True, overflow="ellipsis")
        text.append(separator.join(parts), style="dim")
        if not self._note or self._ended:
            return [text]
        if self._narrow:
            note = Text(self._note, LOOKS[RUNNING].style, no_wrap=True, overflow="ellipsis")
            return [note, text]
        return [text.append(f"{separator}{self._note}", style=LOOKS[RUNNING].style)]

    def _tree_lines(self) -> tuple[list[Text], int]:
        """All lines of the tree, and the index of the one to keep in sight."""
        lines: list[Text] = []
        focus = 0
        tops = [node for node in list(self._tree) if node.parent is None]
        stack = [(node, "", node is tops[-1]) for node in reversed(tops)]
        while stack:
            node, indent, last = stack.pop()
            lines.append(self._line(node, indent, last))
            if node is self._focus:
                focus = len(lines) - 1
            children = [child for child in list(node.children) if self._shown(child)]
            deeper = indent + ("   " if last else self._guide("│  ", "|  "))
            if self._narrow:
                lines += self._why(node, deeper)
            stack.extend((child, deeper, child is children[-1]) for child in reversed(children))
        return lines, focus

    def _why(self, node: PlanNode, indent: str) -> list[Text]:
        """Lines below a failed node that say what happened."""
        if node.status not in FAILED or node.verdict is None or node.verdict.cause is None:
            return []
        room = max(MIN_WORDS, self._console.width - len(indent) - 2)
        return [
            Text(no_wrap=True, overflow="ellipsis").append(indent, "dim").append(f"  {words}")
            for words in wrap(f"{node.status.value}: {node.verdict.cause.text}", room)
        ]

    def _shown(self, node: PlanNode) -> bool:
        return self._detailed or node.status is not NodeStatus.REMOVED

    def _line(self, node: PlanNode, indent: str, last: bool) -> Text:
        running = node is self._focus and node.verdict is None and not self._ended
        status = RUNNING if running else node.status.value
        branch = self._guide("└─ ", "`- ") if last else self._guide("├─ ", "|- ")
        line = Text(no_wrap=True, overflow="ellipsis")
        line.append(indent + branch, style="dim")
        line.append_text(badge(status, self._unicode))
        line.append(f" {node.action}", style=self._emphasis(node))
        if node.action.safe:
            line.append(" safe place", style="dim")
        if node.status is NodeStatus.SUCCESS and node.losses and node.survived is not None:
            line.append(f" {counted(len(node.survived), 'world')} left", style="yellow")
        verdict = node.verdict
        if node.status in FAILED and verdict is not None and not self._narrow:
            kind = verdict.cause.kind.value if verdict.cause else ""
            line.append(f"  {' '.join((node.status.value, kind)).strip()}", LOOKS[status].style)
            if verdict.cause is not None:
                line.append(f": {verdict.cause.text}")
        if self._detailed and verdict is not None:
            changed = ", ".join(verdict.changes) or "nothing"
            line.append(f"  {node.simulated_s:.1f} s, changed: {changed}", style="dim")
        return line

    def _emphasis(self, node: PlanNode) -> str:
        if node.status is NodeStatus.REMOVED:
            return "dim"
        return "bold" if node.id in self._plan else ""

    def _guide(self, drawn: str, plain: str) -> str:
        return drawn if self._unicode else plain


def window(lines: list[Text], focus: int, room: int) -> list[Text]:
    """The part of ``lines`` around ``focus`` that fits into ``room``, and how much is left out."""
    if len(lines) <= room:
        return lines
    inner = max(1, room - 2)
    first = min(max(0, focus - inner // 2), len(lines) - inner)
    above, below = first, len(lines) - first - inner
    return [
        Text(f"   ({above} more above)" if above else "", style="dim"),
        *lines[first : first + inner],
        Text(f"   ({below} more below)" if below else "", style="dim"),
    ]

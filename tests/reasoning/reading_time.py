"""Whether reading stays within its bound, on machines of any speed."""

from __future__ import annotations

import time
from collections.abc import Callable

from etot_cli.reasoning.language.grammar.sentences.reader import parsed

LIMIT_S = 1.0
"""Processor time for any sentence; the worst ones take half of it where the yardstick takes
YARDSTICK_S."""
YARDSTICK_S = 0.13
"""What the yardstick takes on a machine on which the longest sentences take half a second."""
_ENTRIES = 200_000


def is_in_time(read: Callable[[], object]) -> bool:
    """Whether reading takes no longer than it may; tried twice, as a virtual machine that stands
    still is charged to whoever runs. A slower machine has longer: how much is measured beside it.
    """
    for _ in range(2):
        parsed.cache_clear()
        start = time.process_time()
        read()
        taken = time.process_time() - start
        if taken < LIMIT_S or taken < LIMIT_S * _yardstick_s() / YARDSTICK_S:
            return True
    return False


def _yardstick_s() -> float:
    """Processor time for what reading is made of: tuples, and looking them up."""
    start = time.process_time()
    memo: dict[tuple[int, int], tuple[int, ...]] = {}
    for number in range(_ENTRIES):
        key = (number % 997, number % 83)
        memo[key] = (*memo.get(key, ())[-3:], number)
    return time.process_time() - start

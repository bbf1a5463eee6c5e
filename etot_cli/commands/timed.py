"""How long a reasoner thinks, apart from the simulation that it waits for."""

from __future__ import annotations

import time
from typing import Any

from etot_cli.reasoning.protocol import Reasoner


class TimedReasoner:
    """Hands every question on to a reasoner and adds up the time that the answers take."""

    def __init__(self, reasoner: Reasoner) -> None:
        self.inner = reasoner
        self.spent_s = 0.0
        """Wall time in the reasoner [s]."""

    def __getattr__(self, name: str) -> Any:
        found = getattr(self.inner, name)
        if not callable(found):
            return found

        def timed(*arguments: Any, **named: Any) -> Any:
            begun = time.monotonic()
            try:
                return found(*arguments, **named)
            finally:
                self.spent_s += time.monotonic() - begun

        return timed

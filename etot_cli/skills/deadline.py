"""A moment by which the work on an action has to end, looked at wherever that work may last."""

from __future__ import annotations

import math
import time

NEVER = math.inf
"""A deadline that does not come."""


class OutOfTimeError(Exception):
    """The deadline passed while an action was being worked out or simulated.

    What was under way says nothing about the action: it is no physical failure.
    """


class Deadline:
    """The deadline of the work under way; shared by all that take part in it.

    Attributes:
        at_s: reading of ``time.monotonic``, which all processes of a machine share [s].
    """

    def __init__(self) -> None:
        self.at_s = NEVER

    def check(self) -> None:
        """Ends the work when its time is up.

        Raises:
            OutOfTimeError: it is.
        """
        # Without a deadline nothing may depend on a clock, nor pay for reading it.
        if self.at_s != NEVER and time.monotonic() >= self.at_s:
            raise OutOfTimeError

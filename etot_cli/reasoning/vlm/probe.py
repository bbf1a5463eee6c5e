"""Finds out whether a model sees: servers without vision may answer an image with inventions."""

from __future__ import annotations

import random

import numpy as np

from etot_cli.reasoning.protocol import ReasonerStopped, StopReason
from etot_cli.reasoning.vlm.asking import Asker
from etot_cli.reasoning.vlm.chat import Picture
from etot_cli.reasoning.vlm.reading.text import words

COLORS = {
    "red": (200, 20, 20), "green": (20, 150, 40), "blue": (25, 60, 200),
    "yellow": (240, 220, 30), "black": (10, 10, 10), "white": (245, 245, 245),
}  # fmt: skip
"""Colours that nobody mixes up."""
SIDE = 256
"""Of the test picture [px]: large enough for two plain colours to be told apart."""


def probe_picture(seed: int) -> tuple[Picture, tuple[str, str]]:
    """A picture of two colours, and their names from left to right."""
    left, right = random.Random(seed).sample(sorted(COLORS), 2)
    pixels = np.empty((SIDE, SIDE, 3), dtype=np.uint8)
    pixels[:, : SIDE // 2] = COLORS[left]
    pixels[:, SIDE // 2 :] = COLORS[right]
    return Picture.of_pixels("The picture:", pixels), (left, right)


def check_sight(asker: Asker) -> None:
    """Asks for the colours of a picture; guessing both right is a matter of one in thirty.

    Raises:
        ReasonerStopped: the model does not see, a limit was reached, or the service is not there.
    """
    picture, expected = probe_picture(asker.seed)
    reply = asker.free_text("probe", {}, [picture])
    named = [word for word in words(reply) if word in COLORS]
    if tuple(named[:2]) != expected:
        said = " ".join(reply.split())[:80] or "nothing"
        raise ReasonerStopped(
            StopReason.SERVICE,
            f"the model does not see: shown a picture half {expected[0]}, half {expected[1]}, it "
            f"answered {said!r}. Choose a --model that takes images, set ETOT_VLM_IMAGES=0 to plan "
            "without frames, or ETOT_VLM_PROBE=false to skip this check",
        )

"""Whether pictures can be rendered here; the only reason for which their tests may be skipped."""

from __future__ import annotations

from functools import cache

import pytest

from etot_cli.errors import ServiceError


@cache
def missing_opengl() -> str | None:
    """What is missing for rendering; None where nothing is."""
    from etot_cli.world.opengl import open_context

    try:
        open_context(16, 16).free()
    except ServiceError as error:
        return str(error)
    return None


def need_opengl() -> None:
    """Skips the test where there is no OpenGL."""
    if missing := missing_opengl():
        pytest.skip(missing)

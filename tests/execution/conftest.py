"""Fixtures shared with the tests of reconstruction."""

from __future__ import annotations

from tests.reconstruction.conftest import folder, picture, table

__all__ = ["folder", "picture", "table"]

"""Shared by the tests of pages: one browser for all of them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.pages.browser import Browser, missing


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    reason = missing()
    if reason:
        pytest.skip(reason)
    started = Browser.start()
    yield started
    started.driver.quit()

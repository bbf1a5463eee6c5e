"""What has been spoken of so far is copied to try a reading, and the copy is independent."""

from __future__ import annotations

from dataclasses import fields

from etot_cli.reasoning.language.reference.memory.discourse import Discourse
from tests.reasoning import corpus_scenes


def test_a_copy_shares_nothing_that_can_change() -> None:
    discourse = Discourse(corpus_scenes.breakfast())
    copy = discourse.copy()
    assert copy == discourse
    shared = [
        item.name
        for item in fields(Discourse)
        if isinstance(getattr(copy, item.name), list | dict | set)
        and getattr(copy, item.name) is getattr(discourse, item.name)
    ]
    assert shared == []

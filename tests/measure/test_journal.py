"""Measurements that go on where they were stopped, and never count for other code."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests.measure.journal import Journal, code_digest


def test_only_what_this_code_has_not_measured_is_asked(tmp_path: Path) -> None:
    asked: list[tuple[str, int]] = []

    def double(job: tuple[str, int]) -> list[int]:
        asked.append(job)
        return [2 * job[1]]

    file = tmp_path / "deep" / "kept.jsonl"
    with ThreadPoolExecutor(1) as pool:
        assert Journal(file, "one").measure(pool, double, [("a", 1), ("a", 2)]) == [[2], [4]]
        with file.open("a", encoding="utf-8") as stream:
            stream.write('{"code": "one", "asked": "[\\"dou')  # killed while it wrote
        again = Journal(file, "one")
        assert again.measure(pool, double, [("a", 3), ("a", 2)]) == [[6], [4]]
        assert asked == [("a", 1), ("a", 2), ("a", 3)]
        assert Journal(file, "two").measure(pool, double, [("a", 2)]) == [[4]]
        assert asked[-1] == ("a", 2)


def test_a_changed_source_is_other_code(tmp_path: Path) -> None:
    (tmp_path / "room").mkdir()
    (tmp_path / "room" / "one.py").write_text("x = 1")
    (tmp_path / "room" / "one.pyc").write_text("old")
    before = code_digest(tmp_path, ["room"])
    (tmp_path / "room" / "one.pyc").write_text("new")
    assert code_digest(tmp_path, ["room"]) == before
    (tmp_path / "room" / "one.py").write_text("x = 2")
    assert code_digest(tmp_path, ["room"]) != before

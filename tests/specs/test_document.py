"""Reading YAML: what is accepted, what is refused, and where errors point."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from etot_cli.errors import SpecError
from etot_cli.specs.document import (
    MAX_DEPTH,
    MAX_NODES,
    Node,
    parse_document,
    path_text,
    read_document,
)
from etot_cli.specs.reading import MAX_BYTES


def refused(text: str) -> str:
    with pytest.raises(SpecError) as caught:
        parse_document(text, "f.yaml")
    return str(caught.value)


def value(text: str) -> object:
    return parse_document(f"a: {text}", "f.yaml").plain()["a"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("on", "on"),
        ("yes", "yes"),
        ("1e-3", 0.001),
        ("5.0e-4", 0.0005),
        ("-.5", -0.5),
        ("3.", 3.0),
        ("007", 7),
        ("1:30", "1:30"),
        ("2024-01-01", "2024-01-01"),
        ("1_000", "1_000"),
        ("'1'", "1"),
        ("true", True),
        ("False", False),
        ("~", None),
        ("", None),
        ("nan", "nan"),
        ("[1, [2], {b: c}]", [1, [2], {"b": "c"}]),
    ],
)
def test_scalars_follow_yaml_1_2(text: str, expected: object) -> None:
    found = value(text)
    assert found == expected
    assert type(found) is type(expected)


def test_the_key_on_stays_text() -> None:
    assert parse_document("on: 1\noff: 2\nyes: 3", "f").plain() == {"on": 1, "off": 2, "yes": 3}


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("", ["f.yaml: the file is empty"]),
        ("# nothing\n", ["f.yaml: the file is empty"]),
        ("~", ["f.yaml: the file is empty"]),
        ("- 1", ["f.yaml:1: expected keys and values at the top"]),
        ("words", ["f.yaml:1: expected keys and values at the top"]),
        ("a: 1\nb: [1", ["f.yaml:", "not valid YAML"]),
        ("a: 1\n b: 2", ["f.yaml:2", "not valid YAML"]),
        ("a:\n\tb: 1", ["f.yaml:2", "not valid YAML", "indent with spaces, not tabs"]),
        ("a: 1\nb: 2\na: 3", ["f.yaml:3: a: key given twice, first in line 1"]),
        ("x:\n  a: 1\n  a: 3", ["f.yaml:3: x.a: key given twice"]),
        ("a: 1\n---\nb: 2", ["f.yaml:2: a second document starts here"]),
        ("a:\n  b: .nan", ["f.yaml:2: a.b: found .nan, expected a finite number"]),
        ("a: -.inf", ["f.yaml:1: a: found -.inf, expected a finite number"]),
        ("a: 1e999", ["f.yaml:1: a: found 1e999, expected a finite number"]),
        ("a: " + "9" * 500, ["f.yaml:1: a: a number of 500 characters"]),
        ("a: !!python/object:os.system x", ["f.yaml:1: a: the tag", "not supported"]),
        ("a: !local x", ["the tag '!local' is not supported"]),
        ("a: ! x", ["the tag '!' is not supported"]),
        ("!!str a: x", ["the tag", "is not supported"]),
        ("a: !!map {b: 1}", ["the tag", "is not supported"]),
        ("[a]: 1", ["f.yaml:1: a key must be a word"]),
        ("? {a: b}\n: 1", ["a key must be a word"]),
        ("a: &x {b: 1}\nc:\n  <<: *x", ["f.yaml:3: c: merge keys are not supported"]),
        ("a: *x", ["f.yaml:1: a: alias *x refers to nothing defined before it"]),
        ("a: &x [*x]", ["f.yaml:1: a[0]: alias *x refers to nothing"]),
        ("a: &x {b: {c: *x}}", ["a.b.c: alias *x refers to nothing"]),
        ("a: \x07", ["f.yaml:1: control character U+0007"]),
        ("%TAG ! x\n", ["not valid YAML"]),
    ],
)
def test_refused_with_place(text: str, parts: list[str], tmp_path: Path) -> None:
    if "\x07" in text:
        file = tmp_path / "f.yaml"
        file.write_text(text)
        with pytest.raises(SpecError) as caught:
            read_document(file)
        message = str(caught.value)
    else:
        message = refused(text)
    for part in parts:
        assert part in message
    assert "\n" not in message


def test_depth_is_bounded() -> None:
    fits = "[" * MAX_DEPTH + "]" * MAX_DEPTH
    parse_document(f"a: {fits}", "f.yaml")
    assert "f.yaml:1: a: nested deeper than 32 levels" in refused(f"a: [{fits}]")
    assert "nested deeper" in refused("a: " + "[" * 100_000)
    assert "nested deeper" in refused("a: " + "{b: " * 100_000)


def test_depth_counts_through_aliases() -> None:
    half = "[" * 20 + "]" * 20
    message = refused(f"a: &x {half}\nb: {'[' * 20}*x{']' * 20}")
    assert "f.yaml:2: b: nested deeper" in message


def test_alias_bomb_is_refused_before_it_explodes() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 30)]
    message = refused("\n".join(lines))
    assert f"more than {MAX_NODES} values (aliases expanded)" in message


def test_many_values_are_refused() -> None:
    assert "more than 20000 values" in refused("a: [" + "1," * 30_000 + "1]")


def test_honest_aliases_work() -> None:
    node = parse_document("a: &ball {d: 1}\nb: *ball\nc: [*ball]", "f")
    assert node.plain() == {"a": {"d": 1}, "b": {"d": 1}, "c": [{"d": 1}]}
    assert node.locate(("b",)).line == 2
    assert node.locate(("b", "d")).line == 1  # where it is written


def test_places() -> None:
    node = parse_document("a:\n  b:\n    - 1\n    - c: 2\nd: 3", "f.yaml")
    assert node.locate(("a", "b", 1, "c")).line == 4
    assert node.locate(("a", "b", 1, "zzz")).line == 4  # what is missing: its parent
    assert node.locate(("a", "b", 9)).line == 2
    assert node.locate(("d",)).line == 5
    error = node.error(("a", "b", 1, "c"), "wrong")
    assert str(error) == "f.yaml:4: a.b[1].c: wrong"
    assert (error.file, error.line, error.path) == ("f.yaml", 4, "a.b[1].c")


def test_odd_keys_in_paths_stay_on_one_line() -> None:
    assert path_text(("a\nb", "c")) == "'a\\nb'.c"
    assert len(path_text(("x" * 1000,))) < 70


class TestFiles:
    def message(self, path: Path) -> str:
        with pytest.raises(SpecError) as caught:
            read_document(path)
        return str(caught.value)

    def test_missing(self, tmp_path: Path) -> None:
        (tmp_path / "task1.yaml").write_text("a: 1")
        assert "no such file; did you mean task1.yaml?" in self.message(tmp_path / "tsak1.yaml")
        assert "no such file" in self.message(tmp_path / "no" / "folder.yaml")

    def test_folder(self, tmp_path: Path) -> None:
        assert self.message(tmp_path).endswith("is a folder; expected a YAML file")

    def test_device_and_pipe_are_not_read(self, tmp_path: Path) -> None:
        assert "no regular file" in self.message(Path("/dev/zero"))
        os.mkfifo(tmp_path / "pipe")
        assert "no regular file" in self.message(tmp_path / "pipe")

    def test_too_large(self, tmp_path: Path) -> None:
        file = tmp_path / "big.yaml"
        file.write_bytes(b"#" * (MAX_BYTES + 1))
        assert "larger than 1 MiB" in self.message(file)

    def test_not_utf8(self, tmp_path: Path) -> None:
        file = tmp_path / "latin.yaml"
        file.write_bytes("a: 1\nb: Äpfel".encode("latin-1"))
        assert "latin.yaml:2: byte 0xc4 is not UTF-8" in self.message(file)
        file.write_bytes("a: 1".encode("utf-16"))
        assert "is not UTF-8" in self.message(file)

    def test_byte_order_mark_is_fine(self, tmp_path: Path) -> None:
        file = tmp_path / "bom.yaml"
        file.write_bytes(b"\xef\xbb\xbfa: 1")
        assert read_document(file).plain() == {"a": 1}

    def test_impossible_names(self) -> None:
        assert "cannot be read" in self.message(Path("a\0b"))
        assert "cannot be read" in self.message(Path("x" * 5000))

    def test_unreadable(self, tmp_path: Path) -> None:
        file = tmp_path / "secret.yaml"
        file.write_text("a: 1")
        file.chmod(0)
        if os.access(file, os.R_OK):
            pytest.skip("this user reads everything")
        assert "cannot be read" in self.message(file)


KEYS = st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), min_size=1, max_size=8)
PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(10**9), 10**9)
    | st.floats(allow_nan=False, allow_infinity=False, width=32)
    | st.text(st.characters(codec="ascii", exclude_categories=["C"]), max_size=12),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(KEYS, inner, max_size=4),
    max_leaves=20,
)


@settings(max_examples=40)
@given(st.dictionaries(KEYS.filter(lambda key: key != "<<"), PLAIN, min_size=1, max_size=5))
@pytest.mark.slow
def test_json_comes_back_unchanged(data: dict[str, object]) -> None:
    if any("<<" in str(item) for item in data.values()):
        return
    assert parse_document(json.dumps(data, ensure_ascii=False), "f").plain() == data


@settings(max_examples=40)
@given(st.text(max_size=60))
def test_any_text_gives_data_or_one_line(text: str) -> None:
    try:
        node = parse_document(text, "f.yaml")
    except SpecError as error:
        assert "\n" not in str(error)
        assert str(error).startswith("f.yaml")
    else:
        assert isinstance(node.plain(), dict)


@settings(max_examples=40)
@given(st.text("ab:-[]{}&*!#|>'\" \n0.", max_size=60))
def test_yaml_like_text_gives_data_or_one_line(text: str) -> None:
    test_any_text_gives_data_or_one_line.hypothesis.inner_test(text)  # type: ignore[attr-defined]


@settings(max_examples=40)
@given(st.dictionaries(KEYS, PLAIN, min_size=1, max_size=4).filter(lambda d: "<<" not in str(d)))
@pytest.mark.slow
def test_every_value_has_a_place(data: dict[str, object]) -> None:
    lines = [json.dumps({key: item}, ensure_ascii=False)[1:-1] for key, item in data.items()]
    node = parse_document("\n".join(lines), "f")
    for number, key in enumerate(data, start=1):
        assert node.locate((key,)).line == number
        child = node.child(key)
        assert isinstance(child, Node)
        assert child.place.path == (key,)

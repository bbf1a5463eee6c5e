"""Where settings come from, and that secrets stay inside."""

from __future__ import annotations

import os
import traceback
from pathlib import Path

import pytest

from etot_cli.errors import EtotError, SpecError
from etot_cli.reasoning.vlm.prompts import BUILTIN, NAMES, Prompts
from etot_cli.reasoning.vlm.settings import VlmSettings
from etot_cli.services.redact import Redactor, public_url
from tests.vlm.conftest import KEY


def test_flags_over_environment_over_file(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / ".env").write_text(
        f"OPENAI_API_KEY={KEY}\nETOT_VLM_MODEL=from-file\nETOT_VLM_REPAIRS=1\nOTHER=x\n"
    )
    settings = VlmSettings.load()
    assert settings.key is not None and settings.key.get_secret_value() == KEY
    assert (settings.model, settings.repairs, settings.judge) == ("from-file", 1, "both")
    monkeypatch.setenv("ETOT_VLM_MODEL", "from-environment")
    monkeypatch.setenv("OPENAI_BASE_URL", "http://127.0.0.1:1/v1")
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    monkeypatch.setenv("ETOT_VLM_JUDGE", "state")
    settings = VlmSettings.load(url=None, judge="vlm")
    assert settings.model == "from-environment" and settings.judge == "vlm"
    assert settings.url == "http://127.0.0.1:1/v1"
    assert VlmSettings.load(model="flag").model == "flag"


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("ETOT_VLM_URL", "ftp://x", "no http"),
        ("ETOT_VLM_URL", "not a url", "no http"),
        ("ETOT_VLM_URL", "http://h:99999", "no http"),
        ("ETOT_VLM_RETRIES", "-1", "greater than or equal to 0"),
        ("ETOT_VLM_IMAGE_FORMAT", "gif", "'jpeg' or 'png'"),
        ("ETOT_VLM_MAX_COST", "nan", "ETOT_VLM_MAX_COST"),
        ("OPENAI_API_KEY", "two words", "holds spaces"),
        ("OPENAI_API_KEY", "schlüssel-1234", "non-ASCII"),
        ("ETOT_VLM_KEY_HEADER", "a b", "ETOT_VLM_KEY_HEADER"),
    ],
)
def test_bad_values_are_named_and_not_shown(
    monkeypatch: pytest.MonkeyPatch, name: str, value: str, said: str
) -> None:
    monkeypatch.setenv(name, value)
    with pytest.raises(EtotError) as caught:
        VlmSettings.load()
    assert said in str(caught.value) and caught.value.exit_code == 2
    if "KEY" in name:
        text = "".join(traceback.format_exception(caught.value))
        assert value not in text


def test_the_key_never_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    settings = VlmSettings.load(key=KEY, url="http://u:hidden-pass@h/v1")
    assert KEY not in repr(settings) and KEY not in settings.model_dump_json()
    redact = Redactor(settings.secrets)
    for text in (f"key {KEY}!", f'{{"k": "{KEY}"}}', KEY.replace("/", "%2F").replace("=", "%3D")
                 .replace("+", "%2B"), "Bearer abcdefgh1jkl", "sk-proj-abcdefgh123"):  # fmt: skip
        assert "[redacted]" in redact(text) and KEY not in redact(text)
    plain = "an ordinary key-holder; authorization required"
    assert redact(plain) == plain
    assert redact.deep({"a": [KEY, 1]}) == {"a": ["[redacted]", 1]}
    assert public_url("https://u:p@h:8/v1?key=1#x") == "https://h:8/v1"
    assert public_url("http://[::1]:8/v1") == "http://[::1]:8/v1"


FILE_URL = "http://127.0.0.1:9/v1"


@pytest.mark.parametrize(
    ("in_file", "in_environment", "said"),
    [
        (["ETOT_VLM_URL"], ["OPENAI_API_KEY"], "URL comes from .env"),
        (["OPENAI_BASE_URL"], ["ETOT_VLM_KEY"], "URL comes from .env"),
        (["ETOT_VLM_URL"], ["ETOT_VLM_HEADERS"], "URL comes from .env"),
        (["OPENAI_API_KEY"], ["ETOT_VLM_URL"], "URL from the environment"),
    ],
)
def test_a_key_goes_only_to_a_url_from_the_same_place(
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    in_file: list[str],
    in_environment: list[str],
    said: str,
) -> None:
    values = {"ETOT_VLM_HEADERS": '{"X-Token": "abcdefgh"}'}
    for name in in_environment:
        value = FILE_URL if "URL" in name else values.get(name, KEY)
        monkeypatch.setenv(name, value)
    lines = [f"{name}={FILE_URL if 'URL' in name else KEY}" for name in in_file]
    (tmp_path / ".env").write_text("\n".join(lines))
    with pytest.raises(EtotError, match=said) as caught:
        VlmSettings.load()
    assert "--vlm-url" in str(caught.value) and KEY not in str(caught.value)
    # Confirmed on the command line, it is the user's word.
    assert VlmSettings.load(url=FILE_URL).url == FILE_URL


def test_a_file_may_bring_url_and_key_together(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    (tmp_path / ".env").write_text(f"ETOT_VLM_URL={FILE_URL}\nETOT_VLM_KEY=its-own-key-1\n")
    settings = VlmSettings.load()
    assert settings.url == FILE_URL
    assert settings.key is not None and settings.key.get_secret_value() == "its-own-key-1"


def test_a_file_expands_nothing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    (tmp_path / ".env").write_text(
        f"ETOT_VLM_URL={FILE_URL}/${{OPENAI_API_KEY}}\nETOT_VLM_KEY=its-own-key-1\n"
    )
    assert KEY not in VlmSettings.load().url


@pytest.mark.parametrize("name", ["PROMPTS", "RECORD", "REPLAY", "CACHE"])
def test_a_file_chooses_no_folder(tmp_path: Path, name: str) -> None:
    (tmp_path / ".env").write_text(f"ETOT_VLM_{name}=somewhere\n")
    with pytest.raises(EtotError, match=f"ETOT_VLM_{name}"):
        VlmSettings.load()


def test_a_file_that_is_none(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / ".env")
    with pytest.raises(EtotError, match="no regular file"):
        VlmSettings.load()


def test_a_dated_model_costs_what_its_model_costs() -> None:
    known = VlmSettings.load().prices()
    assert known is not None
    assert VlmSettings.load(model="gpt-4o-2024-11-20").prices() == known
    assert VlmSettings.load(model="gpt-4o-new").prices() is None


def test_every_built_in_prompt_has_a_version_and_is_our_own_kind_of_text() -> None:
    prompts = Prompts()
    assert {path.stem for path in BUILTIN.glob("*.md")} == set(NAMES)
    assert all(version for version in prompts.versions.values())
    filled = prompts["repair"].fill({"reasons": "{{objects}}", "objects": "x"})
    assert "{{objects}}" in filled  # what is put in is not expanded again


def test_a_user_replaces_a_prompt(tmp_path: Path) -> None:
    (tmp_path / "screen.md").write_text("---\nversion: mine-2\n---\nIs {{plan}} a trick?\n")
    prompts = Prompts(tmp_path)
    assert prompts["screen"].label == "screen/mine-2"
    assert prompts["screen"].fill({"plan": "this"}) == "Is this a trick?"
    assert prompts["scene"].version == Prompts()["scene"].version


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("screen.md", "no head", "three lines"),
        ("screen.md", "---\nversion: 1\n---\n{{nonsense}}", r"unknown field \{\{nonsense\}\}"),
        ("scren.md", "---\nversion: 1\n---\n", "no prompt is called 'scren'"),
    ],
)
def test_bad_prompts_are_told(tmp_path: Path, name: str, text: str, said: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(SpecError, match=said):
        Prompts(tmp_path)
    with pytest.raises(SpecError, match="no such folder"):
        Prompts(tmp_path / "none")

"""The documentation as a site, and the page that is generated from the models."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from etot_cli.specs.shape import allowed_keys
from tests.docs.formats import SECTIONS, formats_text

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
def test_page_of_keys_is_up_to_date() -> None:
    text = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
    assert text == formats_text(), "make docs writes it anew"


@pytest.mark.slow
def test_every_key_of_every_model_is_told() -> None:
    text = formats_text()
    for _, models in SECTIONS:
        for model in models:
            assert f"### {model.__name__}\n" in text
            keys = {*allowed_keys(model)} - {"include"}  # told in the head
            assert all(f"| `{key}` | " in text for key in keys), model
    assert "| `diameter` | number over 0" in text
    assert "directory" not in text


def test_no_table_is_torn() -> None:
    """A row that no head stands over is shown as text with bars in it."""
    for page in [*ROOT.glob("docs/*.md"), ROOT / "README.md"]:
        code = False
        lines = ["", *page.read_text(encoding="utf-8").splitlines(), ""]
        for number, line in enumerate(lines):
            code ^= line.startswith("```")
            if not code and line.startswith("|") and not lines[number - 1].startswith("|"):
                below = lines[number + 1]
                assert below and set(below) <= set("|-: "), f"{page.name}:{number}"


@pytest.mark.slow
def test_site_builds_strictly(tmp_path: Path) -> None:
    pytest.importorskip("mkdocs")
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)],
        cwd=ROOT, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "index.html").is_file()

"""Exchanges on disk: recorded, replayed without a network, and the cache, which is the same thing.

A cassette is a folder with one JSON file per question, named ``<role>-<key>.json``; ``pictures/``
holds what the model saw, for people. Nothing of it is ever a secret: headers are not written, and
every text is masked.
"""

from __future__ import annotations

import contextlib
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from etot_cli.errors import EtotError, ServiceError, SpecError
from etot_cli.reasoning.vlm.chat import Answer, Question, Trouble, Usage
from etot_cli.reasoning.vlm.images import encode
from etot_cli.services.redact import Redactor
from etot_cli.specs.reading import read_utf8
from etot_cli.specs.writing import replacing

SCHEMA = "etot.exchange/1"
PICTURES = "pictures"
PICTURE_BYTES = 400_000
"""Of a recorded picture, for people to look at; the model saw the original."""
MAX_EXCHANGE = 16 * 1024 * 1024
"""An exchange with all its repairs has some 100 kB."""
EXPECTED = "a recorded exchange"


class Cassette:
    """A folder of exchanges.

    Args:
        folder: is created by the first exchange written.
        redact: masks secrets in everything written.
        pictures: also write what the model saw.
    """

    def __init__(self, folder: Path, redact: Redactor, *, pictures: bool = True) -> None:
        self._folder = folder
        self._redact = redact
        self._pictures = pictures

    def read(self, question: Question, model: str) -> Answer | None:
        """The recorded answer to a question; None when it was never asked.

        Raises:
            EtotError: the file is damaged.
        """
        path = self._path(question, model)
        if not path.exists():
            return None
        return _read_answer(path, read_utf8(path, MAX_EXCHANGE, EXPECTED))

    def write(self, question: Question, model: str, answer: Answer) -> None:
        """Adds an exchange.

        Raises:
            ServiceError: the file system refuses.
        """
        document = {
            "schema": SCHEMA,
            "key": question.key(model),
            "role": question.role,
            "template": question.template,
            "model": model,
            "seed": question.seed,
            "turns": [
                {
                    "speaker": turn.speaker,
                    "text": turn.text,
                    "pictures": [{"caption": p.caption, "digest": p.digest} for p in turn.pictures],
                }
                for turn in question.turns
            ],
            "answer": {
                "text": answer.text,
                "trouble": answer.trouble,
                "detail": answer.detail,
                "usage": asdict(answer.usage),
            },
        }
        text = json.dumps(self._redact.deep(document), ensure_ascii=False, indent=1)
        try:
            _write(self._path(question, model), text.encode())
            if self._pictures:
                self._write_pictures(question)
        except OSError as error:
            raise ServiceError(
                f"cannot write to {self._folder}: {error.strerror or error}"
            ) from None

    def models(self) -> list[str]:
        """The models whose answers are recorded here.

        Raises:
            EtotError: the folder is no cassette.
        """
        if not self._folder.is_dir():
            raise EtotError(f"--replay {self._folder}: there is no such folder")
        found = set()
        for path in sorted(self._folder.glob("*-*.json")):
            with contextlib.suppress(ValueError, RecursionError, SpecError):
                data = json.loads(read_utf8(path, MAX_EXCHANGE, EXPECTED))
                if isinstance(data, dict) and data.get("schema") == SCHEMA:
                    found.add(str(data.get("model")))
        if not found:
            raise EtotError(f"--replay {self._folder}: there are no recorded exchanges")
        return sorted(found)

    def _path(self, question: Question, model: str) -> Path:
        return self._folder / f"{question.role}-{question.key(model)}.json"

    def _write_pictures(self, question: Question) -> None:
        for turn in question.turns:
            for picture in turn.pictures:
                path = self._folder / PICTURES / f"{picture.digest}.jpg"
                if not path.exists():
                    _write(path, encode(picture.pixels, "jpeg", PICTURE_BYTES))


def find_answer(folder: Path, name: str) -> Answer | None:
    """An answer by its file's stem, ``<role>-<key>``, for servers that play a cassette."""
    path = folder / f"{name}.json"
    if Path(name).name != name or not path.is_file():
        return None
    return _read_answer(path, read_utf8(path, MAX_EXCHANGE, EXPECTED))


def _read_answer(path: Path, text: str) -> Answer:
    try:
        data: Any = json.loads(text)
        if data["schema"] != SCHEMA:
            raise ValueError(f"schema {data['schema']!r}, expected {SCHEMA!r}")
        answer = data["answer"]
        if not isinstance(answer["text"], str):
            raise ValueError("'text' is no string")
        trouble = None if answer["trouble"] is None else Trouble(answer["trouble"])
        return Answer(answer["text"], trouble, str(answer["detail"]), Usage(**answer["usage"]),
                      cached=True)  # fmt: skip
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise EtotError(f"{path}: not a recorded exchange ({error})") from None


def _write(path: Path, content: bytes) -> None:
    with replacing(path) as stream:
        stream.write(content)

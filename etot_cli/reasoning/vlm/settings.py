"""Settings of the endpoint and of what is sent to it: flags over environment over ``.env``.

A ``.env`` may have come with somebody else's folder. So it is data of lower trust: it names no
folders, nothing in it is expanded, and a key from outside it never goes to a URL that it names.
"""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path
from typing import Annotated, Any, Literal, Self
from urllib.parse import parse_qsl, unquote, urlsplit

from pydantic import AliasChoices, Field, SecretStr, ValidationError, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

from etot_cli.errors import EtotError
from etot_cli.reasoning.vlm.env_file import ENV_FILE, read_env_file
from etot_cli.specs.bounds import MAX_PICTURE_SIDE

DEFAULT_URL = "https://api.openai.com/v1"
DEFAULT_MODEL = "gpt-4o"
NOT_FROM_FILE = frozenset({"prompts", "record", "replay", "cache"})
"""Folders that are written to or read as instructions: only the user chooses these."""
PROOFS = frozenset({"key", "headers"})
"""Settings that hold secrets and are sent to the server."""
RESERVED_HEADERS = frozenset({"host", "content-length", "content-type", "transfer-encoding",
                              "connection", "accept-encoding"})  # fmt: skip
"""Headers that say where a request goes and how long it is; the client alone sets them."""

DECIDING = (
    "judge", "max_tokens", "temperature", "reasoning_effort", "repairs", "images", "image_width",
    "image_format", "image_detail", "marks", "hints", "prompts",
)  # fmt: skip
"""Settings that answers and verdicts depend on; the rest is how they are fetched."""

Judge = Literal["state", "vlm", "both"]
Positive = Annotated[float, Field(gt=0, le=86_400)]
Price = Annotated[float, Field(ge=0, le=1e6)]


class VlmSettings(BaseSettings):
    """Everything about the endpoint. Times in seconds, prices in US dollars per million tokens.

    Each field is read from ``ETOT_VLM_<FIELD>`` unless its description names other variables.
    """

    model_config = SettingsConfigDict(
        env_prefix="ETOT_VLM_",
        env_ignore_empty=True,
        extra="ignore",
        frozen=True,
        validate_by_name=True,
        hide_input_in_errors=True,
        protected_namespaces=(),
    )

    url: str = Field(
        default=DEFAULT_URL,
        validation_alias=AliasChoices("ETOT_VLM_URL", "OPENAI_BASE_URL"),
    )
    model: str = Field(
        default=DEFAULT_MODEL,
        max_length=200,
        validation_alias=AliasChoices("ETOT_VLM_MODEL", "ETOT_MODEL"),
    )
    key: SecretStr | None = Field(
        default=None, validation_alias=AliasChoices("ETOT_VLM_KEY", "OPENAI_API_KEY")
    )
    key_header: str = Field(default="Authorization", pattern=r"^[A-Za-z0-9-]{1,64}$")
    """Header that carries the key: ``Authorization`` with ``Bearer``, any other with the bare key
    (``api-key`` for Azure)."""
    judge: Judge = "both"

    connect_timeout_s: Positive = 10.0
    read_timeout_s: Positive = 60.0
    """Longest silence of the server."""
    deadline_s: Positive = 120.0
    """For one request as a whole, however the server drips."""
    patience_s: Positive = 300.0
    """For one question with all its retries and waits."""
    retries: Annotated[int, Field(ge=0, le=20)] = 4
    retry_after_cap_s: Positive = 60.0
    backoff_s: Annotated[float, Field(ge=0, le=600)] = 1.0
    """Wait before the first retry; doubles with each one."""
    concurrency: Annotated[int, Field(ge=1, le=64)] = 4

    max_tokens: Annotated[int, Field(ge=16, le=1_000_000)] = 2000
    temperature: Annotated[float, Field(ge=0, le=2)] | None = 0.0
    """None leaves it to the server."""
    reasoning_effort: str | None = Field(default=None, pattern=r"^[a-z]{1,20}$")
    """How long a reasoning model thinks: ``low``, ``medium``, ``high`` or what the server knows."""
    stream: bool = False
    """Ask for the reply in pieces, for servers that send it in no other way."""
    body: Annotated[dict[str, Any], NoDecode] = Field(default_factory=dict)
    """Further fields of every request, as a JSON object; ``null`` leaves a usual field out."""
    headers: Annotated[dict[str, str], NoDecode] = Field(default_factory=dict)
    """Further headers of every request, as a JSON object; secret, like the key."""
    repairs: Annotated[int, Field(ge=0, le=20)] = 3
    """How often a reply that breaks a rule goes back with the reason."""
    images: Annotated[int, Field(ge=0, le=16)] = 4
    """Frames per question at most; 0 sends none."""
    image_width: Annotated[int, Field(ge=64, le=MAX_PICTURE_SIDE)] = 768
    """Longest side of a frame [px]."""
    image_format: Literal["jpeg", "png"] = "jpeg"
    image_detail: Literal["auto", "low", "high"] | None = None
    """How closely the server looks at a frame; None leaves it to the server."""
    image_bytes: Annotated[int, Field(ge=2_000, le=50_000_000)] = 1_500_000
    """Encoded size of one frame at most."""
    marks: bool | None = None
    """Draw numbered marks on the objects; None draws them where names do not tell objects apart."""
    hints: bool | None = None
    """Tell the model what the simulator knows of a failure; None tells it where the world's state
    is known, in simulation."""
    probe: bool = True
    """Before a run, ask once for the colours of a picture, to find out whether the model sees."""
    prompts: Path | None = None
    """Folder with prompt templates that replace the built-in ones of the same name."""
    cache: Path | Literal["off"] | None = None
    """Folder of the cache; None for the user's cache folder."""
    price_input: Price | None = None
    price_output: Price | None = None

    record: Path | None = None
    replay: Path | None = None
    max_calls: Annotated[int, Field(ge=0, le=1_000_000)] | None = None
    max_cost: Price | None = None
    """US dollars."""

    @field_validator("url")
    @classmethod
    def _is_http(cls, value: str) -> str:
        try:
            parts = urlsplit(value.strip())
            usable = parts.scheme in ("http", "https") and bool(parts.hostname)
            _ = parts.port
        except ValueError:
            usable = False
        if not usable:
            raise ValueError("is no http(s) URL, expected e.g. http://127.0.0.1:8000/v1")
        return value.strip()

    @field_validator("key")
    @classmethod
    def _fits_a_header(cls, value: SecretStr | None) -> SecretStr | None:
        if value is None:
            return None
        text = value.get_secret_value().strip()
        if not text:
            return None
        if not text.isascii() or not text.isprintable() or " " in text:
            raise ValueError("holds spaces, control characters or non-ASCII characters")
        return SecretStr(text)

    @field_validator("body", "headers", mode="before")
    @classmethod
    def _is_object(cls, value: object) -> object:
        if not isinstance(value, str):
            return value
        try:
            data = json.loads(value)
        except (ValueError, RecursionError):
            data = None
        if not isinstance(data, dict):
            raise ValueError('is no JSON object, expected e.g. {"name": "value"}')
        return data

    @field_validator("headers")
    @classmethod
    def _are_headers(cls, value: dict[str, str]) -> dict[str, str]:
        for name, text in value.items():
            if not re.fullmatch(r"[A-Za-z0-9-]{1,64}", name) or name.lower() in RESERVED_HEADERS:
                raise ValueError(f"{name!r} is no header that can be set here")
            if not text.isascii() or not text.isprintable():
                raise ValueError(f"the value of {name!r} holds control or non-ASCII characters")
        return value

    @classmethod
    def load(cls, **given: Any) -> Self:
        """Settings from flags (those that are not None), the environment and ``.env``.

        Raises:
            EtotError: a value cannot be used, or the key would go to a URL that it was not given
                for; the message names what is wrong and what is expected, and never shows what was
                given, which may be a secret.
        """
        flags = {name: value for name, value in given.items() if value is not None}
        settings = cls._build(flags)
        filed = _by_field(read_env_file(Path(ENV_FILE)), cls)
        for name in sorted(NOT_FROM_FILE & filed.keys()):
            raise EtotError(
                f"{ENV_FILE} sets {_source(name)}, and a folder is not chosen by a file that may "
                f"have come with somebody else's; set it on the command line or in the environment"
            )
        known = settings.model_fields_set
        extra = {name: value for name, value in filed.items() if name not in known}
        if "url" in extra:
            # Whatever a request carries as proof has to come from where the URL comes from.
            foreign = [name for name in PROOFS & known - flags.keys() if name not in filed]
            extra.update({name: filed[name] for name in PROOFS & filed.keys() - flags.keys()})
            if foreign:
                raise EtotError(
                    f"the server's URL comes from {ENV_FILE} and the {foreign[0]} from the "
                    "environment: a key is sent only to a URL from the same place. Give the URL "
                    f"with --vlm-url, or put the key that is meant for it into {ENV_FILE}"
                )
        elif PROOFS & extra.keys() and "url" in known and "url" not in flags:
            raise EtotError(
                f"the key or headers come from {ENV_FILE} and the server's URL from the "
                "environment: a key is sent only to a URL from the same place. Give the URL "
                "with --vlm-url"
            )
        return cls._build({**flags, **extra}, f" in {ENV_FILE}") if extra else settings

    @classmethod
    def _build(cls, given: dict[str, Any], where: str = "") -> Self:
        try:
            return cls(**given)
        except ValidationError as error:
            first = error.errors(include_input=False, include_url=False)[0]
            name = str(first["loc"][0]) if first["loc"] else "settings"
            raise EtotError(f"{_source(name)}{where}: {_sentence(first['msg'])}") from None

    @property
    def secrets(self) -> tuple[str, ...]:
        """Texts that must never leave the process."""
        found = [] if self.key is None else [self.key.get_secret_value()]
        found += self.headers.values()
        parts = urlsplit(self.url)
        # Some servers take their key as a parameter of the address, and echo it.
        found += [value for _, value in parse_qsl(parts.query) if len(value) >= SHORTEST_PARAMETER]
        found += [parts.query] if parts.query else []
        if parts.password:
            password = unquote(parts.password)
            # The pair too: in base64 it stands in the header that is made of it.
            found += [parts.password, password, f"{unquote(parts.username or '')}:{password}"]
        return tuple(found)

    @property
    def deciding(self) -> dict[str, str]:
        """What answers and verdicts depend on besides the model, free of secrets."""
        found = {name: str(getattr(self, name)) for name in DECIDING}
        body = json.dumps(self.body, sort_keys=True)
        return {**found, "body": hashlib.sha256(body.encode()).hexdigest()}

    def prices(self) -> tuple[float, float] | None:
        """US dollars per million input and output tokens; None when unknown."""
        if self.price_input is not None and self.price_output is not None:
            return self.price_input, self.price_output
        # A dated snapshot costs what its model costs.
        return KNOWN_PRICES.get(_DATE.sub("", self.model.rpartition("/")[2]))


SHORTEST_PARAMETER = 12
"""Values of a URL's query from this length on are taken for secrets; an API version is shorter
[characters]."""
_DATE = re.compile(r"-20\d\d-\d\d-\d\d$")
KNOWN_PRICES: dict[str, tuple[float, float]] = {
    "gpt-4o": (2.50, 10.00),
    "gpt-4o-mini": (0.15, 0.60),
    "gpt-4.1": (2.00, 8.00),
    "gpt-4.1-mini": (0.40, 1.60),
}
"""List prices; they change, ``ETOT_VLM_PRICE_INPUT`` and ``…_OUTPUT`` override them."""

_FLAGS = {"url": "--vlm-url", "model": "--model", "judge": "--judge", "hints": "--hints",
          "record": "--record",
          "replay": "--replay", "max_calls": "--max-calls", "max_cost": "--max-cost"}  # fmt: skip


def _source(name: str) -> str:
    """Where a bad value may have come from, in the user's words."""
    if name.isupper():
        return name
    variable = f"ETOT_VLM_{name.upper()}"
    return f"{_FLAGS[name]} (or {variable})" if name in _FLAGS else variable


def _by_field(variables: dict[str, str], settings: type[VlmSettings]) -> dict[str, str]:
    """What a file's variables mean, by field; the first of a field's names that is there counts."""
    found = {}
    for name, field in settings.model_fields.items():
        alias = field.validation_alias
        names = alias.choices if isinstance(alias, AliasChoices) else [f"ETOT_VLM_{name.upper()}"]
        values = [variables[str(item)] for item in names if variables.get(str(item))]
        if values:
            found[name] = values[0]
    return found


def _sentence(message: str) -> str:
    return message.removeprefix("Value error, ")

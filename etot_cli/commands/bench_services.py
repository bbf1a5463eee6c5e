"""What a benchmark's trials ask of servers, looked at before the first trial asks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class ModelTerms:
    """How a run asks its model.

    ``name``: the model's, empty without one; ``deciding``: settings that its answers depend on;
    ``budget``: the most that all trials together may cost, by names of ``COSTS``.
    """

    name: str = ""
    deciding: Mapping[str, str] = field(default_factory=dict)
    budget: Mapping[str, float] = field(default_factory=dict)


def check_services(reasoner: str, vlm: Mapping[str, Any], video_url: str | None) -> ModelTerms:
    """Notices before the first trial what would make an error of every one.

    Args:
        reasoner: by name.
        vlm: settings of the model as given by flags; the environment may say more.
        video_url: of a video-generation server.

    Raises:
        EtotError: a setting or an address cannot be used.
        ServiceError: there is no key.
    """
    if video_url is not None:
        from etot_cli.benchmark.methods.video_endpoint import VideoEndpoint

        VideoEndpoint(video_url)
    if reasoner == "builtin":
        return ModelTerms()
    from etot_cli.reasoning.vlm.client import ChatClient
    from etot_cli.reasoning.vlm.session import usable_prompts
    from etot_cli.reasoning.vlm.settings import VlmSettings

    settings = VlmSettings.load(**vlm)
    usable_prompts(settings)
    ChatClient(settings).close()
    limits = {"model_requests": settings.max_calls, "cost": settings.max_cost}
    budget = {name: float(most) for name, most in limits.items() if most is not None}
    return ModelTerms(settings.model, settings.deciding, budget)

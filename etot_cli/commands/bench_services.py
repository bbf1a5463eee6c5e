"""What would make an error of every trial, noticed before the first one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import closing
from dataclasses import dataclass, field
from typing import Any

from etot_cli.control.simulator import open_simulator
from etot_cli.errors import InstructionError, SpecError, WorldError
from etot_cli.reasoning.builtin import BuiltinReasoner
from etot_cli.reasoning.protocol import Assignment
from etot_cli.specs.load import misread
from etot_cli.specs.task import Task


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


def check_tasks(tasks: Iterable[Task], reasoner: str) -> None:
    """Builds every task's twin once, and reads its instruction where that is done here.

    Args:
        tasks: to be run.
        reasoner: by name.

    Raises:
        SpecError: one cannot be built or read; the message names its file.
    """
    for task in tasks:
        try:
            with closing(
                open_simulator(task.scene, seed=0, jobs=1, worlds=1, record=False)
            ) as twin:
                if reasoner == "builtin":
                    BuiltinReasoner().propose(
                        Assignment(task.instruction, task.goal), twin.start()[1]
                    )
        except InstructionError as error:
            raise misread(task, error) from None
        except WorldError as error:
            raise SpecError(str(error), file=task.file, path="scene") from None

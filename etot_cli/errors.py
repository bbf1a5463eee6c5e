"""The exceptions etot raises on purpose.

    EtotError
    ├── SpecError            a task, scene or robot file is unusable          (exit 2)
    ├── InstructionError     the instruction cannot be read                   (exit 2)
    │   └── UnsatisfiableError  it is understood, and nothing can bring it about; a search
    │                           ends with that as its result                  (exit 1)
    ├── PlanSyntaxError      a plan or an action is not written as it must be (exit 2)
    ├── WorldError           the physics world is broken (NaN, compile error) (exit 2)
    └── ServiceError         something outside is not there (OpenGL, a server) (exit 3)
        └── RobotStoppedError   a robot stopped at a limit or an error of its own (exit 1)

"No solution" is never an exception: it is a result with a cause.
"""

from __future__ import annotations


class EtotError(Exception):
    """Root of all errors meant for the user; `str(error)` is the message shown."""

    exit_code = 2


class SpecError(EtotError):
    """A YAML document is unusable.

    Args:
        message: what was found and what is expected.
        file: the document, as the user named it.
        line: 1-based line, when known.
        path: YAML path such as ``objects.apple.diameter``, when known.
    """

    def __init__(
        self, message: str, *, file: str | None = None, line: int | None = None, path: str = ""
    ) -> None:
        self.message = message
        self.file = file
        self.line = line
        self.path = path
        where = file or ""
        if file and line is not None:
            where += f":{line}"
        parts = [part for part in (where, path) if part]
        super().__init__(": ".join([*parts, message]))


class InstructionError(EtotError):
    """The instruction (or goal) cannot be understood against the scene."""


class UnsatisfiableError(InstructionError):
    """What is asked for is understood, and contradicts itself or the rules of plans."""

    exit_code = 1


class PlanSyntaxError(EtotError):
    """A textual plan or action is malformed."""


class WorldError(EtotError):
    """The scene cannot be turned into a physics world, or the world broke."""


class ServiceError(EtotError):
    """A service or device that the command needs is not available."""

    exit_code = 3


class RobotStoppedError(ServiceError):
    """A robot stopped at one of its limits, or with an error of its own; it is there, but will not
    go on.
    """

    exit_code = 1

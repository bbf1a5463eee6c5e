"""The program ``etot``: its commands, and what happens to every error.

Errors meant for the user become one line and their exit code; only a defect of this program can
end otherwise, and even that shows its traceback on request alone.
"""

from __future__ import annotations

import errno
import functools
import sys
import traceback
from collections.abc import Callable, Sequence
from typing import Annotated, Any

import typer

from etot_cli.cli.bench import bench
from etot_cli.cli.execute import execute
from etot_cli.cli.exits import INTERNAL, INTERRUPTED, MISSING, NO, OK, UNUSABLE
from etot_cli.cli.interrupts import asked_to_stop, finish, listen
from etot_cli.cli.memory import (
    check_address_space,
    collect_seldom,
    is_lack_of_memory,
    spare_threads,
)
from etot_cli.cli.new import new, tasks
from etot_cli.cli.plan import plan
from etot_cli.cli.reconstruct import reconstruct
from etot_cli.cli.simulate import simulate
from etot_cli.cli.streams import lost, protect
from etot_cli.errors import EtotError
from etot_cli.specs.reading import visible


class _Answer(int):
    """An exit code that a command has chosen, and said why; Typer has codes of its own."""


def interruptible(command: Callable[..., int], *, light: bool = False) -> Callable[..., int]:
    """A command whose exit code can be told from those of the machinery around it.

    Unless it is ``light``, it loads libraries that need address space.
    """

    @functools.wraps(command)
    def wrapped(*given: Any, **named: Any) -> int:
        if not light:
            check_address_space()
        return _Answer(command(*given, **named))

    return wrapped


app = typer.Typer(
    name="etot",
    help="Plan robot manipulation by a tree search in a physics simulator.",
    invoke_without_command=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(interruptible(plan))
app.command()(interruptible(simulate))
app.command()(interruptible(execute))
app.command()(interruptible(bench))
app.command()(interruptible(reconstruct))
app.command()(interruptible(new))
app.command()(interruptible(tasks, light=True))


BAD_NAMES = frozenset({errno.ENAMETOOLONG, errno.ELOOP, errno.ENOENT, errno.ENOTDIR, errno.EISDIR,
                       errno.EACCES, errno.EINVAL})  # fmt: skip
"""What the system answers to names that the user has to change."""


def _show_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import PackageNotFoundError, version

        try:
            print(f"etot {version('etot')}")
        except PackageNotFoundError:
            print("etot (not installed)")
        raise typer.Exit(OK)


@app.callback()
def _root(
    context: typer.Context,
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Print the version."),
    ] = False,
) -> None:
    """Plan robot manipulation by a tree search in a physics simulator."""
    if context.invoked_subcommand is None:
        print(context.get_help(), file=sys.stderr)
        raise typer.Exit(UNUSABLE)


def run(arguments: Sequence[str]) -> int:
    """Runs the program.

    Args:
        arguments: the command line without the program's name.

    Returns:
        the exit code; see :mod:`etot_cli.cli.exits`.
    """
    try:
        code = app(list(arguments), prog_name="etot", standalone_mode=False)
    except EtotError as error:
        if is_lack_of_memory(error):
            return _no_room()
        _complain(str(error))
        return _interrupted() if asked_to_stop() else error.exit_code
    except typer.TyperException as error:  # a flag or argument that cannot be used
        _complain(error.format_message())
        return error.exit_code
    except (KeyboardInterrupt, typer.Abort):
        return _interrupted()
    except OSError as error:
        # Files that belong to the input are read with messages of their own.
        _complain(f"the system refuses: {error}")
        return UNUSABLE if error.errno in BAD_NAMES else MISSING
    except Exception as error:
        if asked_to_stop():  # an interrupt while a library was loaded, in that library's words
            return _interrupted()
        if is_lack_of_memory(error):  # libraries have words of their own for it
            return _no_room()
        # a defect: whatever it is, a person gets a sentence
        return _confess(error, detailed="-v" in arguments or "--verbose" in arguments)
    if code == INTERRUPTED and not isinstance(code, _Answer):
        return _interrupted()
    return int(code) if isinstance(code, int) else OK


def main() -> None:
    """Entry point of the script ``etot``."""
    output, _ = protect()
    try:
        listen()
        spare_threads()
        collect_seldom()
        code = run(sys.argv[1:])
        finish()
    except KeyboardInterrupt:  # in the moments around a command
        finish()
        code = _interrupted()
    reason = lost(output)
    if reason and code in (OK, NO):
        _complain(f"standard output took only a part of the answer: {reason}; see the report file")
        code = MISSING
    sys.exit(code)


def _complain(message: str) -> None:
    # What is quoted of files and replies must not speak to the terminal.
    print(f"error: {visible(message)}", file=sys.stderr)


def _no_room() -> int:
    _complain("there is not enough memory for this; --jobs 1 and --worlds 1 need least")
    return MISSING


def _interrupted() -> int:
    _complain("interrupted before there was anything to report")
    return INTERRUPTED


def _confess(error: Exception, *, detailed: bool) -> int:
    if detailed:
        traceback.print_exception(error)
    _complain(
        f"internal error: {type(error).__name__}: {error}. This is a defect of etot; please report "
        "it with the command and its input" + ("" if detailed else " (-v shows the details)")
    )
    return INTERNAL

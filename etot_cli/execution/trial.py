"""One trial of the closed loop, from its options to everything that happened in it."""

from __future__ import annotations

from contextlib import suppress

from etot_cli.errors import EtotError, RobotStoppedError, ServiceError, WorldError
from etot_cli.execution.cell import Cell, Closes, MakePlanner, TrialOptions, simulated_cell
from etot_cli.execution.loop import Loop
from etot_cli.execution.observers import TrialObserver
from etot_cli.execution.records import Ended, Trial
from etot_cli.specs.task import Task


def run_trial(
    task: Task,
    make_planner: MakePlanner,
    options: TrialOptions,
    observer: TrialObserver | None = None,
    cell: Cell | None = None,
) -> Trial:
    """Carries a task out once.

    Ctrl-C (KeyboardInterrupt) and a device that is lost do not escape: the robot is stopped and the
    trial says so.

    Args:
        task: the planner sees its instruction alone, through ``make_planner``.
        make_planner: makes a planner for the twin of a scene.
        options: how.
        observer: told of everything.
        cell: robot and eyes; a simulated one when None.

    Raises:
        EtotError: the task cannot be understood, or its scene cannot be built.
    """
    cell = cell or simulated_cell(task, options)
    loop = Loop(task, make_planner, options, observer or TrialObserver(), cell)
    try:
        ended = loop.run()
    except KeyboardInterrupt:
        ended = Ended.INTERRUPTED, "stopped by the user"
    except RobotStoppedError as error:
        ended = Ended.FAILED, str(error)
    except ServiceError as error:
        ended = Ended.LOST, str(error)
    except WorldError as error:  # what was seen cannot be
        ended = Ended.FAILED, str(error)
    finally:
        with suppress(EtotError):
            cell.robot.stop()
        with suppress(EtotError):
            cell.robot.close()
        if isinstance(cell.eyes, Closes):
            cell.eyes.close()
    return loop.trial(*ended)

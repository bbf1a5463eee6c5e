"""``etot simulate --view``: the simulation to look at, in the viewer that this machine has."""

from __future__ import annotations

from collections.abc import Callable

from etot_cli.commands.simulate import Simulation
from etot_cli.errors import ServiceError
from etot_cli.world.viewing.choice import Choice, choose, in_browser

Said = Callable[[str], None]


def viewer_here() -> Choice:
    """The viewer that this machine has.

    Raises:
        ServiceError: none; the message says what to install.
    """
    return choose()


def view(simulation: Simulation, choice: Choice, say: Said) -> None:
    """Shows what happened, until the viewer is closed or Ctrl-C.

    Args:
        simulation: with trajectories.
        choice: the viewer; where its window does not open, the browser takes over.
        say: tells which viewer, why, and where.

    Raises:
        ServiceError: no viewer can be had.
    """
    from etot_cli.world.model import build_world
    from etot_cli.world.recorder import Trajectory
    from etot_cli.world.viewing.reel import reel_of

    actions = [
        (f"{step.index + 1} of {len(simulation.report.plan)}: {step.action}, {step.status}",
         trajectory)
        for step, trajectory in zip(
            simulation.report.steps, simulation.trajectories, strict=False
        )
        if isinstance(trajectory, Trajectory) and len(trajectory.times)
    ]  # fmt: skip
    if simulation.scene is None or not actions:
        say("nothing was simulated, so there is nothing to view")
        return
    world, reel = build_world(simulation.scene, dressed=True), reel_of(actions)
    try:
        if choice.viewer == "window":
            from etot_cli.world.viewing.window import show_in_window

            say(f"viewing in MuJoCo's window, since {choice.why}; close it to end")
            try:
                show_in_window(world, reel, say)
                return
            except ServiceError as error:
                choice = in_browser(str(error))
        from etot_cli.world.viewing.browser import BrowserReplay

        with BrowserReplay(world, reel) as replay:
            say(f"viewing in a browser at {replay.url}, since {choice.why}; Ctrl-C ends")
            replay.play()
    except KeyboardInterrupt:
        say("the viewer is closed")

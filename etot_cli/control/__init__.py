"""Runs motions on a robot, the simulated one among them."""

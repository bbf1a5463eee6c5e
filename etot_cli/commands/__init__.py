"""What the commands do; every one of them works with MuJoCo, and none needs OpenGL to start."""

from etot_cli.world.engine import import_mujoco

# Before any other module does it: a MUJOCO_GL that cannot be used would make that fail.
import_mujoco()

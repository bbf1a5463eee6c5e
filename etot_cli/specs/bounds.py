"""Bounds that documents and the command line share; free of imports: ``--help`` is quick."""

MAX_WORLDS = 1000
"""Varied worlds that a plan can be tried in."""
MAX_TRIALS = 10_000
"""Trials of one method on one task; their interval is then within one point of the rate."""
MAX_PICTURE_SIDE = 4096
"""Width and height of any picture [px]: more than depth cameras have, and 64 MB in 32 bits."""
DEPTH_UNIT = 0.0001
"""Metres per unit of depth pictures that are written or sent: finer than sensors, and 16 bits hold
depth to 6.55 m."""

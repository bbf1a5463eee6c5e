"""How the arm moves: kinematics, collision checks, transits, timing."""

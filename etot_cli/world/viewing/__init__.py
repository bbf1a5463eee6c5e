"""Looking at a finished simulation: in MuJoCo's window, or in a browser without a display."""

"""From syntax and things to a goal: every clause gets its steps, in the order asked for."""

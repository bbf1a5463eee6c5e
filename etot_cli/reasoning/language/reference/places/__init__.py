"""Which places destinations are: in, on and beside things, at parts of surfaces."""

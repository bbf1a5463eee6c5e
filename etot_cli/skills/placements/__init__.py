"""Where and how a held object can be put down."""
